"""What the rows of a study were searched over or took, and what they ask for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from netdesign.report.words import (
    Words,
    append_unit,
    show_unit,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.study.records import Study
from netdesign.words.message import Message, say

DEFAULT = "default"  # cell of an input that takes its default value
# Left empty, its factor is taken by the guideline's load.
ALTITUDE = say("column.rows.altitude")


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumedLine:
    """One range or value, with the rows that have it; none: all of them."""

    name: str
    value: str
    rows: tuple[str, ...] = ()


def list_assumed(study: Study, words: Words) -> Iterator[AssumedLine]:
    """Searched ranges, then other assumed values, each name once.

    Rows whose ranges differ share a line: least low end to largest high end.
    """
    values: dict[str, dict[str, None]] = {}
    ends: dict[str, list[float]] = {}
    rows: dict[str, dict[str, None]] = {}
    units: dict[str, str] = {}
    for row in study.rows:
        for value in row.assumed:
            name = words.show(value.input)
            rows.setdefault(name, {})[row.id] = None
            values.setdefault(name, {})[words.show(value.text)] = None
            if value.low is not None and value.high is not None:
                ends.setdefault(name, []).extend((value.low, value.high))
                units[name] = value.unit.removeprefix("-")
        for echo in row.inputs:
            shown, name = _show_default(echo, words), words.show(echo.label)
            if shown and row.id not in rows.get(name, {}):
                rows.setdefault(name, {})[row.id] = None
                values.setdefault(name, {})[shown] = None
    yield from (x for x in _list_ranges(study, words) if x.name not in rows)
    for name, ids in rows.items():
        texts = list(values[name])
        if name in ends and len(texts) > 1:
            texts = [_show_ends(ends[name], units[name], words)]
        some = () if len(ids) == len(study.rows) else tuple(ids)
        yield AssumedLine(name=name, value=words.join(texts), rows=some)


def _show_ends(ends: list[float], unit: str, words: Words) -> str:
    """Least and largest of some ends, to four digits, with their unit."""
    low, high = (words.show_given(float(f"{x:.4g}")) for x in (min(ends), max(ends)))
    text = low if low == high else words("show.from_to", low=low, high=high)
    return append_unit(text, show_unit(unit)) if unit else text


def _show_default(echo: InputEcho, words: Words) -> str:
    """What an empty cell was taken as; "" of one that says nothing."""
    if echo.cell == DEFAULT and echo.value != "":
        return words.show_quantity(understand(echo, words), echo.unit)
    if echo.label == ALTITUDE and echo.value == "":
        return words("show.largest_altitude_factor")
    return ""


def _list_ranges(study: Study, words: Words) -> Iterator[AssumedLine]:
    """Ranges of the site, low and high end in one line."""
    ends: dict[str, list[InputEcho]] = {}
    names: dict[str, Message] = {}
    for echo in study.range_inputs:
        named = echo.label.arguments.get("name") if _is_message(echo) else None
        if isinstance(named, Message) and isinstance(echo.value, float):
            ends.setdefault(named.key, []).append(echo)
            names[named.key] = named
    for key, echoes in ends.items():
        numbers = [echo.value for echo in echoes if isinstance(echo.value, float)]
        shown = _show_ends(numbers, echoes[0].unit, words)
        yield AssumedLine(name=words.show(names[key]), value=shown)


def _is_message(echo: InputEcho) -> bool:
    return isinstance(echo.label, Message)
