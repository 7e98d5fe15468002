"""Columns of the workbook: their headings, units, bounds and words.

Spellings of units are a table and no library: it has to refuse what the trade writes
with two meanings (``grad``, ``t``), and an engineer can read all of ``units.toml`` at a
glance.
"""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from importlib.resources import files
from typing import Literal

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
from netdesign.words.catalogue import Language, load_texts
from netdesign.words.message import Message, say

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
    spelling: unit
    for unit, spellings in _UNITS["spellings"].items()
    for spelling in spellings
}
_ABOVE_SEA = tuple(_UNITS["above_sea"]["m"])
_FACTORS: Mapping[tuple[str, str], float] = {
    (unit, first): factor
    for unit, factors in _UNITS["factors"].items()
    for first, factor in factors.items()
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

# Every unit that can be converted, and the spellings that are refused as unclear.
KNOWN_UNITS: frozenset[str] = frozenset(UNCLEAR_UNITS).union(
    _TO_SI, *_FACTORS, *_CONVERSIONS
)


def normalise_unit(text: str) -> str:
    """Fold a unit to the spelling of this table: ``kg/m³`` to ``kg/m3``.

    ``mN`` and ``Mn`` stay as they are: whether milli or mega is meant is not guessed.
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


Kind = Literal["number", "count", "word", "id", "date", "document", "text"]
LONGEST_HEADING = 100


@dataclass(frozen=True, slots=True)
class Usual:
    """Least and largest number that is built or measured.

    Alone, both are in the first unit, and ``source`` is the key of a text in area
    ``plausible``. Beside other columns, both are multiples of the product of
    ``powers`` of these, in SI.
    """

    least: float
    most: float
    source: str = ""
    powers: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Field:
    """One quantity of the workbook, as ``columns.toml`` has it.

    Attributes
    ----------
    key : str
        Name in the program.
    table : str
        Sheet or list that it belongs to.
    kind : str
        ``number``, ``count`` (whole number), ``word``, ``id``, ``date``, ``document``
        (that proves something) or ``text``.
    units : tuple of str
        Units that a heading may give; the first is that of bounds, default and
        reports.
    bounds : tuple of float
        Least and largest accepted value, in the first unit.
    usual : Usual or None
        Numbers that are not asked for.
    beside : tuple of Usual
        The same beside other columns of the line.
    zero_says_none : bool
        Whether a zero is a statement, and no number to ask for.
    scatters : bool
        Whether its numbers are not compared from line to line.
    of_product : tuple of str
        Quantities of a product that its number must agree with.
    required : bool
        Whether the heading and every cell below it must be there.
    not_with : mapping of str to sequence of str
        Words of other columns with which it means nothing.
    needs : tuple of str
        Keys of columns that may not be empty beside it.
    words : tuple of str
        Accepted words.
    is_grade : bool
        Whether a cell may name a steel grade instead of its strength.
    refers_to : str
        Sheet that defines the id, for ids of another sheet.
    headings : mapping of str to tuple of str
        Accepted headings by language, its name first; also of a language that the
        program only reads.
    notes : mapping of str to str
        Note on its heading, by language; of a sheet of an add-on.
    spellings : mapping of str to str
        Word by each of its spellings in every language.
    named : Message or None
        Another name than the column's, of a part of it.
    may_range : bool
        Whether a cell may hold a range, whose worst value counts.
    phrase : str
        Pattern of what a cell may say in the place of a number; empty for nothing.
    """

    key: str
    table: str = ""
    kind: Kind = "number"
    units: tuple[str, ...] = ()
    bounds: tuple[float, float] = (0.0, 0.0)
    usual: Usual | None = None
    beside: tuple[Usual, ...] = ()
    zero_says_none: bool = False
    scatters: bool = False
    of_product: tuple[str, ...] = ()
    required: bool = False
    not_with: Mapping[str, Sequence[str]] = field(default_factory=dict)
    needs: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    is_grade: bool = False
    refers_to: str = ""
    headings: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    notes: Mapping[Language, str] = field(default_factory=dict)
    spellings: Mapping[str, str] = field(default_factory=dict)
    named: Message | None = None
    may_range: bool = False
    phrase: str = ""

    @property
    def name(self) -> Message:
        """Name, in the language of whoever reads it."""
        return self.named or say(f"column.{self.table}.{self.key}")

    @property
    def label(self) -> str:
        """Name in English, as the example site has it."""
        return self.label_in("en")

    def label_in(self, language: Language) -> str:
        """Name in a language."""
        return self.headings[language][0]

    @property
    def title(self) -> Message:
        """Name with the unit in brackets."""
        return self.title_in(self.unit)

    def title_in(self, unit: str) -> Message:
        """Name with another of the accepted units."""
        return say("column.with_unit", name=self.name, unit=unit) if unit else self.name

    @property
    def unit(self) -> str:
        """Unit of bounds, default and reports; empty for words and ids."""
        return self.units[0] if self.units else ""

    @cached_property
    def names(self) -> frozenset[str]:
        """Accepted headings without unit, normalised; also as cp1252 has them."""
        names = frozenset(map(normalise, self.raw_names))
        return names.union(*map(_list_lossy, self.raw_names))

    @property
    def raw_names(self) -> tuple[str, ...]:
        """Accepted headings without unit, as they are written."""
        return tuple(name for names in self.headings.values() for name in names)

    @property
    def accepted(self) -> Message:
        """Accepted content of a cell, as a phrase."""
        if self.kind in ("number", "count"):
            low, high = self.bounds
            key = "accepted.whole_range" if self.kind == "count" else "accepted.range"
            unit = f" {self.unit}".rstrip(" -")
            return say(key, low=low, high=high, unit=unit)
        if self.kind == "word":
            return say("accepted.words", words=tuple(map(self.name_word, self.words)))
        return say("accepted.date" if self.kind == "date" else "accepted.text")

    def name_word(self, word: str) -> Message | str:
        """One of its words; what is alike in all languages stays."""
        return name_word(self.key, word)


@dataclass(frozen=True, slots=True, kw_only=True)
class SheetPlan:
    """One sheet: its names, its columns in template order."""

    name: str
    fields: tuple[Field, ...]
    required: bool = False
    # Accepted names by language, the sheet's own first; as the headings of a field.
    names: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    items: tuple[Field, ...] = ()  # what the lines of a table of items may name

    def matches(self, sheet_name: str) -> bool:
        """A workbook's sheet is the planned one."""
        return normalise(sheet_name) in set(map(normalise, self.raw_names))

    def find(self, heading: str) -> Field | None:
        """Column of that name, which may have a unit in brackets behind it.

        Behind a column without units brackets are no unit: they are part of the name.
        """
        if len(heading.strip()) > LONGEST_HEADING:
            return None
        whole, (own, bracket) = normalise(heading), split_heading(heading)
        for column in self.fields:
            if whole in column.names:
                return column
            is_unit = not bracket or bracket in KNOWN_UNITS or bool(column.units)
            if own in column.names and is_unit:
                return column
        return None

    @property
    def raw_names(self) -> tuple[str, ...]:
        """Accepted names, as they are written."""
        return tuple(name for names in self.names.values() for name in names)

    @property
    def title(self) -> Message:
        """Name of the sheet, in the language of whoever reads it."""
        return say(f"sheet.{self.name}")

    def name_in(self, language: Language) -> str:
        """Name of the sheet in a language."""
        return self.names[language][0]


def name_word(key: str, word: str) -> Message | str:
    """Word of a column; what is alike in all languages stays."""
    text = f"choice.{key}.{normalise(word)}"
    return say(text) if text in load_texts("en") else word


@lru_cache(maxsize=4096)
def normalise(text: str) -> str:
    """Fold a name so that case, accents, spaces and punctuation do not count."""
    decomposed = unicodedata.normalize("NFKD", text.casefold())
    return "".join(sign for sign in decomposed if sign.isalnum())


# Letters of cp1252 that spreadsheets write for Greek ones; of others "?" is left.
_FITTED = str.maketrans("\u03b1\u03b2\u03b4\u03b5\u03c0\u03c3\u03c4\u03c6", "aßdepstf")
_LEAST_LOSSY = 3  # signs: a symbol alone is not recognised without its letter


@lru_cache(maxsize=4096)
def _list_lossy(name: str) -> Sequence[str]:
    """Name as a csv file in cp1252 has it, which loses Greek letters and indices."""
    kept = (
        normalise(text.encode("cp1252", "ignore").decode("cp1252"))
        for text in (name, name.translate(_FITTED))
    )
    return tuple(folded for folded in kept if len(folded) >= _LEAST_LOSSY)


def split_heading(text: str) -> tuple[str, str]:
    """Normalised name and unit of a heading; the unit is empty when not given.

    >>> split_heading("Slope angle [deg]")
    ('slopeangle', 'deg')
    """
    heading = text.strip()
    if len(heading) > LONGEST_HEADING:
        return "", ""
    match = re.fullmatch(r"(.*)[\[(]([^\[\]()]*)[\])]", heading, re.DOTALL)
    if match is None:
        return normalise(heading), ""
    return normalise(match[1]), normalise_unit(match[2])


def find_item(text: str, items: Iterable[Field]) -> Field | None:
    """Field of that name, which may have a unit behind it; None if there is none."""
    key, _ = split_heading(text)
    return next((field for field in items if key in field.names), None)
