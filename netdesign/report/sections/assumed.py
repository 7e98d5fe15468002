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

DEFAULT = "default"  # cell of an input that nobody typed
# Left empty, its factor is taken by the guideline's load.
ALTITUDE = say("column.Nets.altitude")


@dataclass(frozen=True, slots=True, kw_only=True)
class AssumedLine:
    """One range or value, with the rows that have it; none: all of them."""

    name: str
    value: str
    rows: tuple[str, ...] = ()
    is_default: bool = False  # nobody typed it


def list_assumed(study: Study, words: Words) -> Iterator[AssumedLine]:
    """Ranges that were searched, then values that nobody typed, each once."""
    yield from _list_ranges(study, words)
    found: dict[tuple[str, str], list[str]] = {}
    for row in study.rows:
        told = {words.show(x.input): words.show(x.text) for x in row.assumed}
        for echo in row.inputs:
            shown = _show_default(echo, words)
            if shown:
                told.setdefault(words.show(echo.label), shown)
        for pair in told.items():
            found.setdefault(pair, []).append(row.id)
    for (label, shown), ids in found.items():
        rows = () if len(ids) == len(study.rows) else tuple(ids)
        yield AssumedLine(name=label, value=shown, rows=rows, is_default=True)


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
        numbers = [one.value for one in echoes if isinstance(one.value, float)]
        shown = [words.show_given(end) for end in (min(numbers), max(numbers))]
        is_one = shown[0] == shown[1]
        text = (
            shown[0] if is_one else words("show.from_to", low=shown[0], high=shown[1])
        )
        yield AssumedLine(
            name=words.show(names[key]),
            value=append_unit(text, show_unit(echoes[0].unit)),
            is_default=any(one.cell == DEFAULT for one in echoes),
        )


def _is_message(echo: InputEcho) -> bool:
    return isinstance(echo.label, Message)
