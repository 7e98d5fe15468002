"""What is assumed of a site where its workbook says nothing.

Ranges of what is built and of what nature has, and single values, from
``standards/assumed.toml``: one file for all limit profiles.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Literal

from netdesign.cable.net import find_sag
from netdesign.edge.input_files import find_resource
from netdesign.site.columns.fields import from_si, to_si
from netdesign.words.message import Message, say

# How an assumed range counts: among the cases that are solved, at its ends with the
# same cases, or as the one value that it is.
Kind = Literal["searched", "statics", "fixed"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Assumed:
    """Range or value of what a net row leaves empty.

    Attributes
    ----------
    key : str
        Name in ``assumed.toml``: that of the column without its sheet.
    column : str
        Sheet and key of the column: ``Nets.slack``.
    kind : str
        ``searched``, ``statics`` or ``fixed``.
    low, high : float
        Ends of the range in SI units; equal where one value is assumed, 0 where it is
        a word.
    unit : str
        Of the column; "" of a number that has none, and of a word. D_K of a multiple.
    word : str
        Name of the text of what is assumed, where it is no number.
    source : str
        Name of the text of where the range comes from.
    is_typed : bool
        The range stands in the workbook and needs no confirmation.
    """

    key: str
    column: str
    kind: Kind
    low: float = 0.0
    high: float = 0.0
    unit: str = ""
    word: str = ""
    source: str
    is_typed: bool = False

    @property
    def is_range(self) -> bool:
        """More than one value is assumed."""
        return self.low < self.high

    @property
    def name(self) -> Message:
        """Name of the column in words."""
        return say(f"column.{self.column}")

    @property
    def shown(self) -> tuple[float, float]:
        """Ends of the range in the unit of its column."""
        return from_si(self.low, self.unit), from_si(self.high, self.unit)

    @property
    def text(self) -> Message:
        """What is assumed, as a report has it: range, value or word."""
        low, high = self.shown
        if self.word:
            return say(f"assumed_word.{self.word}", value=low)
        if self.key == "slack":  # makers state the sag
            ends = tuple(
                say("assumed.slack", value=x, sag=100.0 * find_sag(x))
                for x in (low, high)
            )
            return say("assumed.ends", ends=ends) if self.is_range else ends[0]
        if self.key in _SAGS:
            return say("assumed.range", low=100.0 * low, high=100.0 * high, unit=" %")
        if self.low == self.high:
            return say(
                _OF_UNIT.get(self.unit, "assumed.value"), value=low, unit=self._unit
            )
        return say("assumed.range", low=low, high=high, unit=self._unit)

    @property
    def why(self) -> Message:
        """Where the range comes from."""
        return say(f"assumed_source.{self.source}")

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit.strip("-") else ""


_SAGS = ("ridge_sag", "lower_sag")  # makers state them in percent
MULTIPLE = "D_K"  # unit of what is a multiple of the net's height
_OF_UNIT = {"m": "assumed.length", "a": "assumed.years"}  # texts of one value


@lru_cache(maxsize=1)
def load_assumed() -> Mapping[str, Assumed]:
    """What may be assumed, by key, in the order of the file."""
    file = find_resource("standards") / "assumed.toml"
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    return MappingProxyType({key: _build(key, entry) for key, entry in tables.items()})


def assume(key: str, factor: float = 1.0) -> Assumed:
    """Range or value of an empty column.

    Parameters
    ----------
    key : str
        Name in ``assumed.toml``.
    factor : float
        What a multiple is multiplied with: D_K [m].
    """
    table = load_assumed()[key]
    if table.unit != MULTIPLE:
        return table
    return replace(table, low=factor * table.low, high=factor * table.high, unit="m")


def assume_ends(key: str, low: float, high: float) -> Assumed:
    """Range of an empty column with ends of the row's own, in SI units."""
    return replace(load_assumed()[key], low=low, high=high)


def _build(key: str, table: dict[str, object]) -> Assumed:
    values = dict(table)
    values["column"] = values.pop("id")
    unit = str(values.get("unit", ""))
    for end in ("low", "high"):
        if end in values:
            values[end] = to_si(float(values[end]), unit)  # type: ignore[arg-type]
    return Assumed(**{**values, "key": key})  # type: ignore[arg-type]
