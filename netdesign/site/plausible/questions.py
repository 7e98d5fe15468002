"""Questions about numbers that can hardly be meant, by the net rows that rest on them.

A net row with an open question is not proven until somebody changes the number, or
confirms it on sheet Declared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from netdesign.site.cells.cells import Cell
from netdesign.site.cells.findings import Finding, quote
from netdesign.site.confirmed_values import Confirmation, show_value
from netdesign.site.plausible.columns import list_column_doubts
from netdesign.site.plausible.doubts import Doubt, list_doubts
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.type_references import TypeSheets, list_references
from netdesign.words.message import Message, say

_TYPE_SHEETS = ("Anchors", "Ropes", "Posts")


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """Lines of a site's sheets, without a fault.

    Attributes
    ----------
    nets : sequence of Row
        Of sheet Nets.
    ends : mapping of str to Row
        Of sheet Ends, by net row.
    snow : mapping of str to sequence of Row
        Of sheet Snow, by net row.
    types : mapping of str to mapping of str to Row
        Of the type sheets, by name and id.
    ranges : sequence of Row
        Of sheet Ranges: one end of a range each, by its quantity.
    """

    nets: Sequence[Row]
    ends: Mapping[str, Row]
    snow: Mapping[str, Sequence[Row]]
    types: TypeSheets
    ranges: Sequence[Row]


def ask(
    lines: Lines, confirmed: Iterable[Confirmation], findings: list[Finding]
) -> Mapping[str, tuple[Message, ...]]:
    """Open questions by net row.

    Parameters
    ----------
    lines : Lines
        Of the whole site.
    confirmed : iterable of Confirmation
        Numbers that somebody has confirmed.
    findings : list of Finding
        Appended to: each open question once.
    """
    settled = {one.cell for one in confirmed}
    asked: dict[str, Message] = {}  # by cell: one question each
    by_row: dict[str, dict[Message, None]] = {}
    for rows, (reading, rule) in _list_all(lines):
        if reading.cell is None or reading.place in settled or not rows:
            continue
        if reading.place not in asked:
            refuse(
                reading, rule, _tell_how(reading.cell), findings, severity="question"
            )
            asked[reading.place] = _name_question(reading, rule)
        for row in rows:
            by_row.setdefault(row, {})[asked[reading.place]] = None
    return {row: tuple(questions) for row, questions in by_row.items()}


def _name_question(reading: Reading, rule: Message) -> Message:
    """The question as the check of a net row has it."""
    return say(
        "plausible.asked",
        place=reading.place,
        field=reading.field.name,
        text=quote(reading.text),
        rule=rule,
    )


def _tell_how(cell: Cell) -> Message:
    """The way to settle a question."""
    sheet, value = say("sheet.Declared"), show_value(cell)
    return say("plausible.settle", sheet=sheet, place=cell.place, value=value)


def _list_all(lines: Lines) -> Iterator[tuple[list[str], Doubt]]:
    """Doubts, each with the net rows that rest on its number."""
    every = [line["id"].word for line in lines.nets]
    for line in lines.nets:
        yield from _give([line["id"].word], list_doubts(line))
    place_of = {
        id(one): line["id"].word for line in lines.nets for one in line.values()
    }
    for doubt in list_column_doubts(lines.nets, "Nets"):
        yield [place_of[id(doubt[0])]], doubt
    for row, end in lines.ends.items():
        yield from _give([row], list_doubts(end))
    for row, layers in lines.snow.items():
        for layer in layers:
            yield from _give([row], list_doubts(layer))
    for line in lines.ranges:
        yield from _give(every, list_doubts(line))
    for sheet in _TYPE_SHEETS:
        yield from _list_of_types(lines, sheet)


def _give(
    rows: list[str], doubts: Iterator[Doubt]
) -> Iterator[tuple[list[str], Doubt]]:
    return ((rows, doubt) for doubt in doubts)


def _list_of_types(lines: Lines, sheet: str) -> Iterator[tuple[list[str], Doubt]]:
    """Doubts about the types of a sheet, with the net rows that name each."""
    types = lines.types[sheet] or {}
    users: dict[str, dict[str, None]] = {name: {} for name in types}
    for line in lines.nets:
        row = line["id"].word
        beside = [lines.ends[row]] if row in lines.ends else []
        for one in list_references([line, *beside], sheet):
            users.setdefault(one.word, {})[row] = None
    owner = {id(one): name for name, line in types.items() for one in line.values()}
    doubts = [one for line in types.values() for one in list_doubts(line)]
    for doubt in (*doubts, *list_column_doubts(list(types.values()), sheet)):
        yield list(users[owner[id(doubt[0])]]), doubt
