"""From the lines of sheet Ends to the types of a row's first and last support."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.cells.findings import Finding, add_nearest
from netdesign.site.model import MEMBER_MODES, NAMED_BY, InputEcho
from netdesign.site.readings import Reading, Row, refuse
from netdesign.site.tables import Table, read_rows
from netdesign.structure.members import EndMember
from netdesign.words.message import say

EndsByRow = Mapping[str, Row]  # one line by net row

# Columns of both sheets that name a type of the support.
_TYPES = tuple(dict.fromkeys(NAMED_BY.get(one, one) for one, _ in MEMBER_MODES))


def read_ends(table: Table | None, findings: list[Finding]) -> EndsByRow:
    """Lines of sheet Ends by net row; a second line of one is a finding."""
    by_row: dict[str, Row] = {}
    for line in read_rows(table, findings) if table else ():
        reading = line["row"]
        if reading.word in by_row:
            first = by_row[reading.word]["row"].place
            rule = say("nets.used_twice", place=first)
            refuse(reading, rule, say("ends.one_line"), findings)
        elif reading.word:
            by_row[reading.word] = line
    return by_row


def refuse_unknown_ends(
    ends: EndsByRow, net_rows: Mapping[str, Row], findings: list[Finding]
) -> None:
    """Refuse ends of a net row that sheet Nets does not have."""
    places = {name: row["id"].place for name, row in net_rows.items()}
    for name, line in ends.items():
        if name not in net_rows:
            sheet = say("sheet.Nets")
            accepted = say("accepted.id_of_sheet", sheet=sheet)
            accepted = add_nearest(accepted, name, net_rows, places)
            refuse(line["row"], say("nets.no_id", sheet=sheet), accepted, findings)


def list_end_types(end: Row) -> list[Reading]:
    """Cells that name what holds a row of panels along the row."""
    return [end[key] for key in EndMember if end[key].word]


def replace_types(row: Row, end: Row | None) -> Row:
    """Line of sheet Nets with the types of its end.

    A type that sheet Ends does not give is not known there, unless it says that the
    types not given are those inside.
    """
    if end is None:
        return {**row, **{key: _say_nothing(row[key]) for key in _TYPES}}
    if end["support_types"].word:
        return row
    return {**row, **{key: end[key] for key in _TYPES}}


def check_ends(end: Row, system: Reading, findings: list[Finding]) -> None:
    """Refuse types beside the statement that they are those inside.

    Without ropes nothing pulls along the row: then nothing is named that holds it.
    """
    said = end["support_types"]
    for reading in (end[key] for key in _TYPES if said.word):
        if reading.state == "given":
            rule = say("nets.beside", name=said.field.name, place=said.place)
            refuse(reading, rule, say("accepted.one_of_two"), findings)
    for reading in (end[key] for key in (*EndMember, "end_guy_angle")):
        if system.word == "none" and reading.state == "given":
            rule = say("panel.beside_none", place=system.place)
            refuse(reading, rule, say("panel.empty_or_ropes"), findings)


def _say_nothing(reading: Reading) -> Reading:
    return replace(reading, state="blank", value=None, text="", cell=None)


def has_same_types(at_end: Row, row: Row) -> bool:
    """Sameness of every type at the row's end and inside; none is left empty."""
    return all(at_end[key].word == row[key].word != "" for key in _TYPES)


def echo_ends(end: Row | None) -> tuple[InputEcho, ...]:
    """Types of the ends as typed; those left empty are those of the row."""
    readings = end.values() if end else ()
    return tuple(
        one.echo()
        for one in readings
        if one.state == "given" and one.field.key != "row"
    )
