"""Data of the resistances, read once; each table with its status and source."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from importlib.resources import files
from typing import Any

from netdesign.errors import ModelError


@dataclass(frozen=True, slots=True, kw_only=True)
class Datum:
    """A number of the catalogue with where it comes from.

    Attributes
    ----------
    value : float
        In the unit that its function names.
    status : str
        "secondary" or "assumed", as in the limit profiles.
    source : str
        Publication.
    """

    value: float
    status: str
    source: str


@lru_cache(maxsize=1)
def load_catalogue() -> dict[str, Any]:
    """Load the catalogue as its file gives it."""
    file = files(__package__).joinpath("catalogue.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def find_bond_stress(ground: str, grouting: str) -> Datum:
    """Least ultimate bond stress of grout on a ground [kPa], by type A to D."""
    bond = load_catalogue()["bond"]
    ranges = pick("ground", ground, bond["ground"])
    types = {name: value for name, value in ranges.items() if name != "text"}
    least, _ = pick(f"grouting in {ground}", grouting, types)
    return Datum(value=float(least), status=bond["status"], source=bond["source"])


def find_rope_factor(construction: str, factor: str) -> Datum:
    """Factor "K" of the breaking force or "C" of the metallic area of a rope [-]."""
    rope = load_catalogue()["rope"]
    factors = pick("rope construction", construction, rope["construction"])
    value = pick("rope factor", factor, factors)
    return Datum(value=value, status=rope["status"], source=rope["source"])


def find_termination(kind: str) -> Datum:
    """Loss factor k_e of a rope's end [-]."""
    table = load_catalogue()["termination"]
    value = pick("termination", kind, list_terminations())
    return Datum(value=value, status=table["status"], source=table["source"])


def list_terminations() -> dict[str, float]:
    """Loss factor by kind of termination [-]."""
    table = load_catalogue()["termination"]
    return {name: value for name, value in table.items() if isinstance(value, float)}


def find_imperfection(curve: str) -> Datum:
    """Imperfection factor of a buckling curve [-]."""
    table = load_catalogue()["buckling"]
    value = pick("buckling curve", curve, table["curve"])
    return Datum(value=value, status=table["status"], source=table["source"])


def pick(what: str, name: str, known: dict[str, Any]) -> Any:
    """Entry of a table; an unknown name is refused with the nearest ones.

    Raises
    ------
    ModelError
        With the nearest known names.
    """
    if name in known:
        return known[name]
    raise ModelError(f"{what} = {name!r}: must be one of {_list(name, known)}")


def _list(name: str, known: Iterable[str]) -> str:
    names = list(known)
    near = get_close_matches(name, names, n=2)
    nearest = f" (nearest: {', '.join(near)})" if near else ""
    return f"{', '.join(names)}{nearest}"
