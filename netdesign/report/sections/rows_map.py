"""Map of the net rows: where each stands, and what was found of it."""

from __future__ import annotations

from netdesign.files.rows_map import RowsMap
from netdesign.report.blocks import Figure, Part, section
from netdesign.report.drawing.rows_map import MappedRow, draw_rows_map
from netdesign.report.sections.basis import anchor_rows
from netdesign.report.words import Words, show_text, show_verdict
from netdesign.study.governing import find_governing
from netdesign.study.records import RowStudy, Study


def show_rows_map(
    study: Study, places: RowsMap, words: Words, *, has_rows: bool
) -> Part:
    """Map with a caption that names the grid; without a coordinate.

    Parameters
    ----------
    study : Study
        What is shown.
    places : RowsMap
        Its rows in plan.
    words : Words
        Of the language.
    has_rows : bool
        The report has a page of each row, which its name leads to.
    """
    anchors = anchor_rows(study) if has_rows else {}
    rows = {
        row.id: _tell_row(row, anchors.get(row.id, ""), words) for row in study.rows
    }
    caption = words(
        "rows_map.caption", grid=show_text(places.grid), sha256=show_text(places.sha256)
    )
    others = tuple(show_text(one) for one in places.rows if one not in rows)
    if others:
        caption += f" {words('rows_map.others', rows=others)}"
    figure = Figure(
        svg=draw_rows_map(places, rows, _describe(study, words), words),
        caption=caption,
    )
    return section("map", words("heading.map"), figure)


def _tell_row(row: RowStudy, anchor: str, words: Words) -> MappedRow:
    check = find_governing(row.checks)
    is_known = check is not None and check.used is not None
    used = words.show_number("utilisation", check.used) if check and is_known else ""
    return MappedRow(verdict=row.verdict, used=used, anchor=anchor)


def _describe(study: Study, words: Words) -> str:
    """Map in words: each row with its verdict."""
    told = (
        words(
            "show.label",
            label=show_text(row.id),
            text=show_verdict(row.verdict, words).word,
        )
        for row in study.rows
    )
    return words("rows_map.title", rows=tuple(told))
