"""Native charts of the workbook: they follow the cells when these are changed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from netdesign.report.drawing.style import ACCENT, GREY, INK, PALE
from netdesign.report.words import name_heading
from netdesign.report.workbook.writer import Book

_FONT = {"name": "Arial", "size": 9, "color": INK}
_BARS = "#8A929A"
_MOST_LINES = 8  # of a chart of cases; more cannot be told apart
_SHADES = (INK, ACCENT, GREY, "#2A4B6B", "#C9A227", "#4F7A5B", "#8C6BB1", "#A9AFB6")
_MARKERS = ("circle", "square", "triangle", "diamond")


def add_utilisation_chart(
    book: Book,
    sheet: Any,
    rows: tuple[int, int],
    columns: tuple[int, int],
    place: tuple[int, int],
    unbounded: Sequence[int] = (),
) -> None:
    """Largest utilisation of each net row beside the limit, on the summary.

    ``columns`` are those of the two. Rows that are ``unbounded`` have no bar: what
    their cells show stands in its place.
    """
    first, last = rows
    ratio, bound = columns
    name = book.name("decision")
    chart = book.workbook.add_chart({"type": "column"})
    chart.add_series(
        {
            "name": book.words("heading.largest_utilisation"),
            "categories": [name, first, 1, last, 1],
            "values": [name, first, ratio, last, ratio],
            "fill": {"color": _BARS},
            "gap": 60,
            "data_labels": _label_rows(book, rows, ratio, unbounded),
        }
    )
    limit = book.workbook.add_chart({"type": "line"})
    limit.add_series(
        {
            "name": book.words("heading.limit"),
            "categories": [name, first, 1, last, 1],
            "values": [name, first, bound, last, bound],
            "line": {"color": ACCENT, "width": 1.5},
        }
    )
    chart.combine(limit)
    _finish(chart, (book.words("heading.largest_of_rows"), "", ""))
    chart.set_size({"width": 500, "height": 260})
    sheet.insert_chart(*place, chart, {"object_position": 1, "y_offset": 4})


def _label_rows(
    book: Book, rows: tuple[int, int], column: int, labelled: Sequence[int]
) -> dict[str, Any] | None:
    """Labels of some rows' bars, each with what its cell shows; None without any."""
    if not labelled:
        return None
    first, last = rows
    letter = chr(ord("A") + column)
    custom = [
        {"value": f"={book.refer('decision', f'${letter}${row + 1}')}"}
        if row in labelled
        else {"delete": True}
        for row in range(first, last + 1)
    ]
    return {"value": True, "custom": custom}


def add_case_chart(
    book: Book, sheet: Any, spans: Sequence[tuple[int, int]], bottom: int
) -> None:
    """Force on the foot anchor against density, one series for each net row.

    ``spans`` are first and last line of each net row; its id is in the first column.
    """
    name = book.name("cases")
    chart = book.workbook.add_chart({"type": "scatter"})
    for place, (first, last) in enumerate(spans[:_MOST_LINES]):
        shade = _SHADES[place % len(_SHADES)]
        chart.add_series(
            {
                # its cell, never its text: a text like "x!A1" would be a formula
                "name": [name, first, 0],
                "categories": [name, first, 1, last, 1],
                "values": [name, first, 4, last, 4],
                "marker": {
                    "type": _MARKERS[place % len(_MARKERS)],
                    "size": 6,
                    "border": {"color": shade},
                    "fill": {"color": shade},
                },
            }
        )
    density = name_heading(book.words, "density_kg_m3")
    titles = (book.words("heading.foot_in_cases"), density, "kN")
    _finish(chart, titles)
    chart.set_size({"width": 820, "height": 360})
    sheet.insert_chart(bottom + 2, 0, chart, {"object_position": 1})


def _finish(chart: Any, titles: tuple[str, str, str]) -> None:
    """Quiet frame; title, then names of the axes."""
    title, across, up = titles
    chart.set_title(
        {
            "name": title,
            "name_font": {**_FONT, "size": 10, "bold": True},
            "overlay": False,
        }
    )
    for axis, name in ((chart.set_x_axis, across), (chart.set_y_axis, up)):
        axis(
            {
                "name": name,
                "name_font": {**_FONT, "bold": False},
                "num_font": _FONT,
                "line": {"color": GREY},
                "major_gridlines": {
                    "visible": axis == chart.set_y_axis,
                    "line": {"color": PALE, "width": 0.5},
                },
            }
        )
    chart.set_legend({"position": "bottom", "font": _FONT})
    chart.set_chartarea({"border": {"color": PALE}})
