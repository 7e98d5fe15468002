"""Catalogue of products: its tables, read once, and sections, bars and ropes from them.

Each table has its status and source. Area, second moments and moduli of hollow sections
follow from their dimensions. `products.py` finds a product by the name of a type.
"""

from __future__ import annotations

import math
import tomllib
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any, TypeAlias

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


def quote(table: str, value: float) -> Datum:
    """Value of a table of the catalogue, with the status and source of the table."""
    status, source = load_catalogue()[table]["status"], f"resistance_source.{table}"
    return Datum(value=float(value), status=status, source=say(source))


def find_bond_span(ground: str = "") -> tuple[float, float]:
    """Least and largest ultimate bond stress on a ground [kPa], however it is grouted.

    Of all grounds together where it is not said, or the catalogue has none of it.
    """
    grounds = load_catalogue()["bond"]["ground"]
    spans = [grounds[ground]] if ground in grounds else list(grounds.values())
    return float(min(low for low, _ in spans)), float(max(high for _, high in spans))


SPIRAL = "1x"  # how the name of a spiral rope's construction begins


def find_termination(kind: str) -> Datum:
    """Loss factor k_e of a rope's end [-]."""
    return quote("termination", load_catalogue()["termination"][kind])


def find_loop_efficiency() -> Datum:
    """Least loss factor k_e of a rope anchor's loop [-]."""
    return quote("loop", load_catalogue()["loop"]["least"])


def find_imperfection(curve: str) -> Datum:
    """Imperfection factor of a buckling curve [-]."""
    return quote("buckling", load_catalogue()["buckling"]["curve"][curve])


def interpolate(places: Sequence[float], values: Sequence[float], at: float) -> float:
    """Value of a table at a place, linear between its own.

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


def compute_tube(diameter: float, wall: float) -> dict[str, float]:
    """Values of a round tube, the quantities of `Product`; THEORY.md, (R7).

    Parameters
    ----------
    diameter, wall : float
        Outer diameter and wall [m].

    Returns
    -------
    dict of str to float
        In m, m2, m3, m4.
    """
    inner = diameter - 2.0 * wall
    area = math.pi / 4.0 * (diameter**2 - inner**2)
    second = math.pi / 64.0 * (diameter**4 - inner**4)
    ends = {"outer_diameter": diameter, "inner_diameter": inner}
    return ends | _name(diameter, diameter, area, second, second)


def compute_box(
    depth: float, width: float, wall: float, *, outer: float, inner: float
) -> dict[str, float]:
    """Values of a rectangular tube with round corners; THEORY.md, (R13) and (R14).

    Parameters
    ----------
    depth, width, wall : float
        Outer sides and wall [m].
    outer, inner : float
        Radii of the corners [m].

    Returns
    -------
    dict of str to float
        As of `compute_tube`.
    """
    whole = _compute_rounded(depth, width, outer)
    hole = _compute_rounded(depth - 2.0 * wall, width - 2.0 * wall, inner)
    area, strong, weak = (a - b for a, b in zip(whole, hole, strict=True))
    return _name(depth, width, area, strong, weak)


def _compute_rounded(depth: float, width: float, radius: float) -> list[float]:
    """A, I_y and I_z of a rectangle with round corners, eq. (R13)."""
    cut = (1.0 - math.pi / 4.0) * radius**2
    distance = (10.0 - 3.0 * math.pi) / (12.0 - 3.0 * math.pi) * radius
    own = 1.0 / 3.0 - math.pi / 16.0 - 1.0 / (36.0 - 9.0 * math.pi)
    return [depth * width - 4.0 * cut] + [
        b * h**3 / 12.0 - 4.0 * (own * radius**4 + cut * (h / 2.0 - distance) ** 2)
        for h, b in ((depth, width), (width, depth))
    ]


def _name(
    depth: float, width: float, area: float, strong: float, weak: float
) -> dict[str, float]:
    return {
        "depth": depth,
        "width": width,
        "area": area,
        "second_moment_strong": strong,
        "second_moment_weak": weak,
        "section_modulus_strong": 2.0 * strong / depth,
        "section_modulus_weak": 2.0 * weak / width,
    }


Span: TypeAlias = tuple[float, float]
# Values of one product that fits a name, by their quantities, and where they stand.
Fitting: TypeAlias = tuple[Mapping[str, Span], Message]


@dataclass(frozen=True, slots=True, kw_only=True)
class Product:
    """Product of the catalogue, or all that fit a name.

    Attributes
    ----------
    id : str
        As ``HEB120``, ``GEWI 28``, ``6x19 18 mm``.
    family : str
        "section", "solid bar", "hollow bar" or "rope".
    values : mapping of str to (float, float)
        Least and largest value of each quantity, SI units; they differ where several
        products fit the name, or where makers differ.
    sources : tuple of Message
        Publications.
    """

    id: str
    family: str
    values: Mapping[str, Span]
    sources: tuple[Message, ...]

    def list_ends(self, *names: str) -> list[float]:
        """Least and largest values of some quantities, where it has them."""
        return [end for name in names for end in self.values.get(name, ())]


@lru_cache(maxsize=1)
def load_products() -> dict[str, Any]:
    """Load the products as their file gives them, once a name is looked up."""
    file = files(__package__).joinpath("products.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def join(name: str, family: str, fitting: Sequence[Fitting]) -> Product:
    """Product with the least and largest values of all that a name may mean."""
    spans = {
        quantity: [values[quantity] for values, _ in fitting]
        for quantity in fitting[0][0]
        if all(quantity in values for values, _ in fitting)
    }
    values = {
        quantity: (min(low for low, _ in listed), max(high for _, high in listed))
        for quantity, listed in spans.items()
    }
    return Product(
        id=name,
        family=family,
        values=MappingProxyType(values),
        sources=tuple(dict.fromkeys(source for _, source in fitting)),
    )


def make_beam(row: list[float]) -> Fitting:
    """Values of a rolled I-section, from its line in the table.

    Parameters
    ----------
    row : list of float
        Its line [mm, cm2, cm3, cm4 by column].
    """
    table = load_products()["section"]
    columns = zip(row, table["columns"].items(), strict=True)
    values = {quantity: _span(values_, unit) for values_, (quantity, unit) in columns}
    return _quote(values, table)


def make_hollow_section(sizes: tuple[float, ...]) -> list[Fitting]:
    """Values of a hollow section: of a box twice, hot finished and cold formed.

    Parameters
    ----------
    sizes : tuple of float
        Diameter and wall, or depth, width and wall [mm].
    """
    table = load_products()["hollow_section"]
    *sides, wall = (size * 1e-3 for size in sizes)
    if len(sides) == 1:
        tube = compute_tube(sides[0], wall)
        return [_quote(tube, table["round"])]
    made = []
    for way in table["box"]:
        outer, inner = next(
            (outer * wall, inner * wall)
            for limit, outer, inner in way["radii"]
            if sizes[-1] <= limit
        )
        box = compute_box(sides[0], sides[1], wall, outer=outer, inner=inner)
        made.append(_quote(box, way))
    return made


def make_bar(entry: dict[str, Any], diameters: list[float]) -> Fitting:
    """Values of a solid bar that has one of these diameters.

    Parameters
    ----------
    entry : dict
        Of the data.
    diameters : list of float
        Nominal [mm].
    """
    outer = min(diameters) * 1e-3, max(diameters) * 1e-3
    area = math.pi / 4.0 * outer[0] ** 2, math.pi / 4.0 * outer[1] ** 2
    values = {"outer_diameter": outer, "area": area}
    for word in ("yield", "ultimate"):
        low, high = values[f"{word}_strength"] = _span(entry[word], 1e6)
        values[f"{word}_force"] = area[0] * low, area[1] * high
    return _quote(values, entry)


def make_hollow_bar(bar: dict[str, Any], family: dict[str, Any]) -> Fitting:
    """Values of a hollow bar, whose strengths are its forces over its area."""
    units = load_products()["hollow"]["units"].items()
    values = {key: _span(bar[key], unit) for key, unit in units if key in bar}
    least, most = values["area"]
    for word in ("yield", "ultimate"):
        if f"{word}_force" in values:
            low, high = values[f"{word}_force"]
            values[f"{word}_strength"] = low / least, high / most
    return _quote(values, family)


def make_rope(construction: str, diameter: float, grades: list[float]) -> Fitting:
    """Values of a wire rope that has one of these grades; THEORY.md, (R4) without ends.

    Parameters
    ----------
    construction : str
        With its core, of the catalogue.
    diameter : float
        Nominal [mm].
    grades : list of float
        Strengths of wires [N/mm2].
    """
    force = load_catalogue()["rope"]["construction"][construction] * diameter**2
    values = {
        "rope_diameter": _span(diameter, 1e-3),
        "grade": (min(grades) * 1e6, max(grades) * 1e6),
        "breaking_force": (force * min(grades), force * max(grades)),
    }
    table = "spiral" if construction.startswith(SPIRAL) else "rope"
    return values, say(f"resistance_source.{table}")


def _span(value: Any, unit: float = 1.0) -> Span:
    low, high = value if isinstance(value, list | tuple) else (value, value)
    return low * unit, high * unit


def _quote(
    values: Mapping[str, float] | Mapping[str, Span], entry: dict[str, Any]
) -> Fitting:
    """Values with the source that the entry of the data names."""
    spans = {quantity: _span(value) for quantity, value in values.items()}
    return spans, say(f"product_source.{entry['source']}")
