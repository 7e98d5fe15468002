"""Forces of the guideline's load on the anchors: a table on a terminal, and JSON."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from netdesign.edge.json_text import list_fields
from netdesign.edge.output import print_lines
from netdesign.report.words import MISSING, Words, show_text
from netdesign.structure.members import EndMember, Member
from netdesign.study.guideline_anchors import AnchorForce, RowAnchors

if TYPE_CHECKING:
    from rich.console import Console

SCHEMA = "netdesign.table/1"
# Supports of each line: those that a row's end loads are one, by the worse of them.
_PLACES = {"table.inside": ("intermediate",), "table.at_end": ("second", "edge")}
_SHOWN: Mapping[str, str] = {
    Member.FOOT_ANCHOR: "table.foot_anchor",
    Member.UPHILL_ANCHOR: "table.uphill_anchor",
    Member.DOWNHILL_ANCHOR: "table.downhill_anchor",
    EndMember.LATERAL_ANCHOR: "table.lateral_anchor",
    EndMember.END_GUY_ANCHOR: "table.end_guy_anchor",
}


def print_anchor_table(
    rows: Sequence[RowAnchors], console: Console, words: Words
) -> None:
    """Print the forces of each row, inside and at its end, and what they rest on.

    Parameters
    ----------
    rows : sequence of RowAnchors
        With coupled forces where a study has them.
    console : rich.console.Console
        Where it is printed.
    words : Words
        Of the language.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column(words("table.row"), overflow="fold", min_width=3)
    table.add_column(words("table.place"), overflow="fold")
    table.add_column(words("table.by"), no_wrap=True)
    for heading in _SHOWN.values():
        table.add_column(words(heading), justify="right", min_width=8)
    for line in list_table_lines(rows, words):
        table.add_row(*map(Text, line))
    print_lines((words("table.title"),), console)
    console.print(table)
    print_lines(_list_remarks(rows, words), console)


def list_table_lines(
    rows: Iterable[RowAnchors], words: Words
) -> Iterator[tuple[str, ...]]:
    """Cells of each line: row, place, by what, force on each anchor."""
    for row in rows:
        name = show_text(row.id)
        for place, positions in _PLACES.items():
            anchors = [row.find(anchor, *positions) for anchor in _SHOWN]
            if not any(anchors):
                continue
            forces = [_show_force(anchor, words) for anchor in anchors]
            yield name, words(place), words("table.guideline"), *forces
            name = ""
            if any(
                anchor is not None and anchor.coupled_kN is not None
                for anchor in anchors
            ):
                coupled = [_show_coupled(anchor, words) for anchor in anchors]
                yield "", "", words("table.coupled"), *coupled


def _show_force(anchor: AnchorForce | None, words: Words) -> str:
    return words.show_number("guideline_kN", anchor.guideline_kN if anchor else None)


def _show_coupled(anchor: AnchorForce | None, words: Words) -> str:
    """Coupled force, and in brackets its ratio to the guideline's."""
    if anchor is None or anchor.coupled_kN is None:
        return MISSING
    force = words.show_number("coupled_kN", anchor.coupled_kN)
    ratio = words.show_fixed(anchor.ratio, 2)
    return force if anchor.ratio is None else f"{force} ({ratio})"


def _list_remarks(rows: Sequence[RowAnchors], words: Words) -> Iterator[str]:
    """Remarks on rows, each once for all of them, and on the table."""
    by_remark: dict[str, list[str]] = {}
    for row in rows:
        for note in (*([row.reason] if row.reason else []), *row.notes):
            by_remark.setdefault(words.show(note), []).append(show_text(row.id))
    for remark, ids in by_remark.items():
        yield words("show.label", label=", ".join(ids), text=remark)
    forces = [anchor for row in rows for anchor in row.anchors]
    if any(force.coupled_kN is not None for force in forces):
        yield words("table.ratio")
    yield words("table.ropes")


def write_anchor_table(rows: Sequence[RowAnchors], words: Words) -> dict[str, Any]:
    """Document of the table: every support of each row, forces in kN.

    Parameters
    ----------
    rows : sequence of RowAnchors
        As they are printed.
    words : Words
        Of the language of notes and reasons.
    """
    return {
        "schema": SCHEMA,
        "rows": [
            {
                "id": row.id,
                "anchors": [list_fields(anchor) for anchor in row.anchors],
                "reason": words.show(row.reason) if row.reason else None,
                "notes": [words.show(note) for note in row.notes],
            }
            for row in rows
        ],
    }
