"""Units of a workbook: their spellings, and what turns them into a first unit.

A table and no unit library: it has to refuse what the trade writes with two
meanings (``grad``, ``t``), and an engineer can read all of ``units.toml`` at a glance.
"""

from __future__ import annotations

import tomllib
import unicodedata
from collections.abc import Callable, Mapping
from importlib.resources import files

from netdesign.units import (
    cubic_meter_from_cubic_centimeter,
    degree_from_radian,
    fourth_meter_from_fourth_centimeter,
    kelvin_from_celsius,
    meter_from_millimeter,
    newton_from_kilonewton,
    pascal_from_kilopascal,
    pascal_from_megapascal,
    radian_from_degree,
    radian_from_percent,
    second_from_day,
    square_meter_from_square_centimeter,
)
from netdesign.words.message import say

# Spellings that are used for two units: never guessed.
UNCLEAR_UNITS = {
    "grad": say("unclear_unit.grad"),  # German degrees, French and Swiss gons
    "t": say("unclear_unit.t"),  # tonnes of mass
    "t/m": say("unclear_unit.t_per_m"),
}

_UNITS = tomllib.loads(
    files(__package__).joinpath("units.toml").read_text(encoding="utf-8")
)
_SPELLINGS: Mapping[str, str] = {
    one: unit for unit, them in _UNITS["spellings"].items() for one in them
}
_ABOVE_SEA = tuple(_UNITS["above_sea"]["m"])
_FACTORS: Mapping[tuple[str, str], float] = {
    (unit, first): factor
    for unit, others in _UNITS["factors"].items()
    for first, factor in others.items()
}
_CONVERSIONS: dict[tuple[str, str], Callable[[float], float]] = {
    ("rad", "deg"): degree_from_radian,
    ("%", "deg"): lambda slope: degree_from_radian(radian_from_percent(slope)),
}
_TO_SI = {
    "mm": meter_from_millimeter,
    "cm2": square_meter_from_square_centimeter,
    "cm3": cubic_meter_from_cubic_centimeter,
    "cm4": fourth_meter_from_fourth_centimeter,
    "kPa": pascal_from_kilopascal,
    "MPa": pascal_from_megapascal,
    "d": second_from_day,
    "deg": radian_from_degree,
    "kN": newton_from_kilonewton,
    "kN/m": newton_from_kilonewton,
    "kN/m3": newton_from_kilonewton,
    "degC": kelvin_from_celsius,
}

# Every unit that can be turned into another or into SI, and what is refused as one.
KNOWN_UNITS: frozenset[str] = frozenset(UNCLEAR_UNITS).union(
    _TO_SI, *_FACTORS, *_CONVERSIONS
)


def normalise_unit(text: str) -> str:
    """Fold a unit to the spelling of this table: ``kg/m³`` to ``kg/m3``.

    ``mN`` and ``Mn`` stay as they are: of milli and mega none is guessed.
    """
    composed = unicodedata.normalize("NFKC", text)
    compact = "".join(composed.replace("^", "").split())
    if compact in ("MN", "MN/m", "MN/ml", "MN/m'"):
        return "MN" if compact == "MN" else "MN/m"
    if compact == "MN/m2":
        return "MPa"
    folded = compact.casefold()
    if folded.replace(".", "") in _ABOVE_SEA:
        return "m"
    if folded.startswith("mn"):
        return compact
    return _SPELLINGS.get(folded.replace("é", "e").replace("è", "e"), folded)


def convert_unit(value: float, unit: str, first: str) -> float:
    """Value in a field's first unit.

    >>> convert_unit(350.0, "cm", "m")
    3.5
    """
    if unit == first:
        return value
    if (unit, first) in _FACTORS:
        factor = _FACTORS[unit, first]
        # Dividing by 1000 is exact where multiplying by 0.001 is not.
        return value / round(1 / factor) if factor < 0.5 else value * factor
    return _CONVERSIONS[unit, first](value)


def to_si(value: float, unit: str) -> float:
    """SI value of a number in one of the first units."""
    convert = _TO_SI.get(unit)
    return convert(value) if convert else value


def from_si(value: float, unit: str) -> float:
    """Number in one of the first units, of an SI value; not of a temperature."""
    return value / to_si(1.0, unit)
