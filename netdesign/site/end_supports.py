"""From the lines of sheet Ends to the types of a row's first and last support."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.site.cells.findings import Finding
from netdesign.site.model import MEMBER_MODES, NAMED_BY, InputEcho
from netdesign.site.readings import Reading, Row, refuse
from netdesign.structure.members import EndMember
from netdesign.words.message import say

EndsByRow = Mapping[str, Row]  # one line by net row

# Columns of both sheets that name a type of the support.
_TYPES = tuple(dict.fromkeys(NAMED_BY.get(one, one) for one, _ in MEMBER_MODES))


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
