"""What a column of the workbook is: its headings, units, bounds and words."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from netdesign.units import (
    degree_from_radian,
    fourth_meter_from_fourth_centimeter,
    meter_from_millimeter,
    newton_from_kilonewton,
    pascal_from_kilopascal,
    pascal_from_megapascal,
    radian_from_degree,
    radian_from_percent,
    square_meter_from_square_centimeter,
)

Kind = Literal["number", "count", "word", "id", "text"]

_LONGEST_HEADING = 100
_UNIT_SPELLINGS = {
    "°": "deg",
    "°c": "degC",
    "c": "degC",
    "degc": "degC",
    "degree": "deg",
    "degrees": "deg",
    "degres": "deg",
    "kn/ml": "kN/m",
    "kn/m'": "kN/m",
    "kn/m": "kN/m",
    "kn": "kN",
    "kpa": "kPa",
    "mpa": "MPa",
    "n/mm2": "MPa",
}
_TO_SI = {
    "mm": meter_from_millimeter,
    "cm2": square_meter_from_square_centimeter,
    "cm4": fourth_meter_from_fourth_centimeter,
    "kPa": pascal_from_kilopascal,
    "MPa": pascal_from_megapascal,
    "deg": radian_from_degree,
    "kN": newton_from_kilonewton,
    "kN/m": newton_from_kilonewton,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """One quantity of the workbook.

    Attributes
    ----------
    key : str
        Name in the program.
    label : str
        Name in headings and reports.
    aliases : tuple of str
        Other accepted headings: English, French, German.
    kind : str
        ``number``, ``count`` (whole number), ``word``, ``id`` or ``text``.
    units : tuple of str
        Units that a heading may give; the first is that of bounds, default and
        reports.
    bounds : tuple of float
        Least and largest accepted value, in the first unit.
    required : bool
        Whether the heading and every cell below it must be there.
    default : float or None
        Value of an empty cell, in the first unit.
    words : mapping of str to tuple of str
        Accepted words, each with its aliases.
    refers_to : str
        Sheet that defines the id, for ids of another sheet.
    note : str
        What the engineer should know; shown on the heading of the template.
    """

    key: str
    label: str
    aliases: tuple[str, ...] = ()
    kind: Kind = "number"
    units: tuple[str, ...] = ()
    bounds: tuple[float, float] = (0.0, 0.0)
    required: bool = False
    default: float | None = None
    words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    refers_to: str = ""
    note: str = ""

    @property
    def unit(self) -> str:
        """Unit of bounds, default and reports; empty for words and ids."""
        return self.units[0] if self.units else ""

    @property
    def heading(self) -> str:
        """Label with the unit in brackets, as the template writes it."""
        return self.heading_in(self.unit)

    @property
    def names(self) -> frozenset[str]:
        """Accepted headings without unit, normalised."""
        return frozenset(normalise(name) for name in (self.label, *self.aliases))

    @property
    def accepted(self) -> str:
        """What a cell may hold, as a phrase."""
        if self.kind in ("number", "count"):
            low, high = self.bounds
            whole = "whole numbers, " if self.kind == "count" else ""
            return f"{whole}{low:g} to {high:g} {self.unit}".rstrip(" -")
        if self.kind == "word":
            return ", ".join(self.words)
        return "text"

    def heading_in(self, unit: str) -> str:
        """Label with another of the accepted units."""
        return f"{self.label} [{unit}]" if unit else self.label


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetPlan:
    """One sheet: its names, its columns in template order, its alternatives."""

    name: str
    aliases: tuple[str, ...]
    fields: tuple[Field, ...]
    required: bool = False
    one_of: tuple[str, ...] = ()  # keys of which at least one heading must be there

    def matches(self, sheet_name: str) -> bool:
        """Whether a workbook's sheet of this name is the planned one."""
        names = {normalise(name) for name in (self.name, *self.aliases)}
        return normalise(sheet_name) in names


def normalise(text: str) -> str:
    """Fold a name so that case, accents, spaces and punctuation do not count."""
    decomposed = unicodedata.normalize("NFKD", text.casefold())
    return "".join(sign for sign in decomposed if sign.isalnum())


def split_heading(text: str) -> tuple[str, str]:
    """Normalised name and unit of a heading; the unit is empty when not given.

    >>> split_heading("Slope angle [deg]")
    ('slopeangle', 'deg')
    """
    heading = text.strip()
    if len(heading) > _LONGEST_HEADING:
        return "", ""
    match = re.fullmatch(r"(.*)[\[(]([^\[\]()]*)[\])]", heading, re.DOTALL)
    if match is None:
        return normalise(heading), ""
    return normalise(match[1]), normalise_unit(match[2])


def normalise_unit(text: str) -> str:
    """Fold a unit to the spelling of this table: ``kg/m³`` to ``kg/m3``."""
    composed = unicodedata.normalize("NFKC", text)
    folded = "".join(composed.casefold().replace("^", "").split())
    return _UNIT_SPELLINGS.get(folded.replace("é", "e"), folded)


def to_first_unit(value: float, unit: str) -> float:
    """Value in a field's first unit; only a slope in per cent changes."""
    if unit == "%":
        return degree_from_radian(radian_from_percent(value))
    return value


def to_si(value: float, unit: str) -> float:
    """SI value of a number in one of the first units."""
    convert = _TO_SI.get(unit)
    return convert(value) if convert else value
