"""Columns that may be empty, but on whose values every force of a row depends.

No default is on the safe side for all members, so a row that lacks one of them is not
proven: knowing less never makes a verdict better.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from netdesign.site.cells.findings import Finding
from netdesign.site.readings import Reading, Row, refuse
from netdesign.words.message import Message, say

# What says the same as another column, or the contrary.
_ONE_OF_TWO = {
    "post_base_distance": ("post_tilt",),
    "anchor_axes": ("foot_axis", "uphill_axis", "downhill_axis"),
}
_LAYERED = ("layered", "layered with temperatures")


def list_unsaid(row: Row) -> tuple[Message, ...]:
    """Names of those columns of sheet Nets that a line leaves empty.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Nets, filled in by the ranges.
    """
    needed = ["slack", "uphill_anchor_distance", "downhill_anchor_distance"]
    needed += ["snow_layers", "guy_count"]
    if row["post_base_distance"].state != "given":
        needed.append("post_tilt")
    if row["guy_count"].state == "given" and row["guy_count"].number > 1:
        needed.append("guy_splay")
    return tuple(row[key].field.name for key in needed if row[key].state != "given")


def check_statements(
    row: Row, lines: Sequence[Row], end: Row | None, findings: list[Finding]
) -> None:
    """Refuse statements of a line that something else contradicts.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Nets.
    lines : sequence of Row
        Its layers in sheet Snow.
    end : Row or None
        Its line in sheet Ends.
    findings : list of Finding
        Appended to.
    """
    _check_layers(row["snow_layers"], lines, findings)
    _check_row_end(row, end, findings)
    for key, others in _ONE_OF_TWO.items():
        for beside in (row[other] for other in others):
            if row[key].state == beside.state == "given":
                rule = say("nets.beside", name=beside.field.name, place=beside.place)
                refuse(row[key], rule, say("accepted.one_of_two"), findings)


def _check_layers(said: Reading, lines: Sequence[Row], findings: list[Finding]) -> None:
    has_temperatures = any(one["temperature"].state == "given" for one in lines)
    expected = _LAYERED[has_temperatures] if lines else "uniform"
    if said.word and said.word != expected:
        word = said.field.name_word(expected)
        place = lines[0]["row"].place if lines else say("sheet.Snow")
        rule = say("nets.other_layers", place=place)
        refuse(said, rule, say("accepted.words", words=(word,)), findings)


def _check_row_end(row: Row, end: Row | None, findings: list[Finding]) -> None:
    for reading, beside in _list_contradictions(row, end):
        rule = say("nets.beside", name=beside.field.name, place=beside.place)
        refuse(reading, rule, say("accepted.one_of_two"), findings)
    said, neighbour = row["row_end"], row["neighbour"]
    if said.word == "continuous" and neighbour.state == "blank":
        refuse(said, say("nets.without_neighbour"), say("nets.other_ids"), findings)


def _list_contradictions(
    row: Row, end: Row | None
) -> Iterator[tuple[Reading, Reading]]:
    """Cells on the row's end that cannot both be true."""
    said, gap = row["row_end"], row["gap"]
    has_gap = gap.state == "given" and gap.si > 0.0
    has_none = gap.state == "given" and gap.si == 0.0
    if said.word == "continuous":
        if has_gap:
            yield gap, said
        if end is not None:
            yield end["row"], said
    elif row["neighbour"].state == "given" and said.state != "faulty":
        yield row["neighbour"], said
    if said.word == "free" and has_none:
        yield gap, said
