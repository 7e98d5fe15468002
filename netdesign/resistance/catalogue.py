"""Data of the resistances, read once; each table with its status and source."""

from __future__ import annotations

import tomllib
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.outcome import ModelError
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Datum:
    """A number of the catalogue with where it comes from.

    Attributes
    ----------
    value : float
        In the unit that its function names.
    status : str
        "secondary" or "assumed", as in the limit profiles.
    source : Message
        Publication.
    """

    value: float
    status: str
    source: Message


@lru_cache(maxsize=1)
def load_catalogue() -> dict[str, Any]:
    """Load the catalogue as its file gives it."""
    file = files(__package__).joinpath("catalogue.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def find_bond_stress(
    ground: str, grouting: str, *, ground_name: Message | str = ""
) -> Datum:
    """Least ultimate bond stress of grout on a ground [kPa], by type A to D.

    A refusal calls the ground by its name where one is given, else by its key.
    """
    bond = load_catalogue()["bond"]
    ranges = pick(say("catalogue.ground"), ground, bond["ground"])
    types = {name: value for name, value in ranges.items() if name != "text"}
    what = say("catalogue.grouting_in", ground=ground_name or ground)
    least, _ = pick(what, grouting, types)
    return Datum(
        value=float(least), status=bond["status"], source=say("resistance_source.bond")
    )


def find_bond_span(ground: str = "") -> tuple[float, float]:
    """Least and largest ultimate bond stress on a ground [kPa], however it is grouted.

    Of all grounds together where it is not said, or the catalogue has none of it.
    """
    grounds = load_catalogue()["bond"]["ground"]
    listed = [grounds[ground]] if ground in grounds else list(grounds.values())
    spans = [span for table in listed for key, span in table.items() if key != "text"]
    return float(min(low for low, _ in spans)), float(max(high for _, high in spans))


def find_steel_bond() -> Datum:
    """Design bond stress f_bd of ribbed steel in grout [MPa]."""
    table = load_catalogue()["steel_bond"]
    source = say("resistance_source.steel_bond")
    return Datum(value=table["f_bd_MPa"], status=table["status"], source=source)


def find_rope_factor(construction: str, factor: str) -> Datum:
    """Factor "K" of the breaking force or "C" of the metallic area of a rope [-]."""
    rope = load_catalogue()["rope"]
    factors = pick(
        say("catalogue.rope_construction"), construction, rope["construction"]
    )
    value = pick(say("catalogue.rope_factor"), factor, factors)
    if "is_spiral" in factors:
        source = say("resistance_source.spiral")
        return Datum(value=value, status="assumed", source=source)
    source = say("resistance_source.rope")
    return Datum(value=value, status=rope["status"], source=source)


def list_constructions() -> list[str]:
    """Names of the constructions of wire ropes."""
    return list(load_catalogue()["rope"]["construction"])


def find_termination(kind: str) -> Datum:
    """Loss factor k_e of a rope's end [-]."""
    table = load_catalogue()["termination"]
    value = pick(say("catalogue.termination"), kind, list_terminations())
    return Datum(
        value=value, status=table["status"], source=say("resistance_source.termination")
    )


def find_loop_efficiency() -> Datum:
    """Least loss factor k_e of a rope anchor's loop [-]."""
    table = load_catalogue()["loop"]
    return Datum(
        value=table["least"],
        status=table["status"],
        source=say("resistance_source.loop"),
    )


def list_terminations() -> dict[str, float]:
    """Loss factor by kind of termination [-]."""
    table = load_catalogue()["termination"]
    return {name: value for name, value in table.items() if isinstance(value, float)}


def find_imperfection(curve: str) -> Datum:
    """Imperfection factor of a buckling curve [-]."""
    table = load_catalogue()["buckling"]
    value = pick(say("catalogue.buckling_curve"), curve, table["curve"])
    return Datum(
        value=value, status=table["status"], source=say("resistance_source.buckling")
    )


def interpolate(places: Sequence[float], values: Sequence[float], at: float) -> float:
    """Value of a table between its places, linear.

    Parameters
    ----------
    places, values : sequence of float, shape (n,)
        Of the table, rising places, in units of its own.
    at : float
        Among the places, in their unit.
    """
    end = max(bisect_left(places, at), 1)
    share = (at - places[end - 1]) / (places[end] - places[end - 1])
    return float(values[end - 1] + share * (values[end] - values[end - 1]))


def pick(what: Message, name: str, table: dict[str, Any]) -> Any:
    """Entry of a table; an unknown name is refused with the nearest ones.

    Raises
    ------
    ModelError
        With the nearest known names.
    """
    if name in table:
        return table[name]
    near = tuple(get_close_matches(name, list(table), n=2))
    raise ModelError(
        say(
            "catalogue.one_of",
            what=what,
            value=name,
            accepted=tuple(table),
            nearest=say("catalogue.nearest", near=near) if near else "",
        )
    )
