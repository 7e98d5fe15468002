"""Lines of the site workbook that rows on terrain give, with a note on each cell."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import (
    ANCHORS,
    ENDS,
    LINKS,
    NETS,
    POSTS,
    PROJECT,
    RANGES,
    ROPES,
    SHEETS,
    TESTS,
)
from netdesign.site.columns.fields import normalise
from netdesign.site.headings import Table
from netdesign.site.lines import ALL_ROWS
from netdesign.site.reader import read_cells
from netdesign.site.tables import find_table, read_rows
from netdesign.site.template.workbook import (
    list_starting_lines,
    start_book,
    write_notes,
    write_sheet,
)
from netdesign.terrain.measure import (
    CARED_ANGLE,
    CARED_LENGTH,
    LEAST_LENGTH,
    Band,
    MeasuredRow,
)
from netdesign.terrain.neighbours import find_gap
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

Lines = Mapping[str, Sequence[Mapping[str, object]]]
_TAKEN = (PROJECT, RANGES, ANCHORS, ROPES, POSTS, LINKS, TESTS)  # that name no row


@dataclass(frozen=True, slots=True, kw_only=True)
class DerivedCell:
    """A cell of sheet Nets that follows from the terrain, and how.

    Attributes
    ----------
    key : str
        Of the column.
    value : float, int or str
        In the column's first unit, or a word of the column.
    note : Message
        Stretch, band, and what was typed instead.
    """

    key: str
    value: float | int | str
    note: Message


def derive_cells(
    row: MeasuredRow, rows: Sequence[MeasuredRow], grid: str
) -> list[DerivedCell]:
    """Cells of a row: slope, upslope length, altitude, length, posts, gap.

    Of a band wider than a check cares about its severe end stands in the cell.

    Parameters
    ----------
    row : MeasuredRow
        On the terrain.
    rows : sequence of MeasuredRow
        All of the plan.
    grid : str
        Name of the grid's file, for the notes.
    """
    cells = [
        _derive_slope(row, grid),
        *_derive_snow(row, grid),
        DerivedCell(
            key="altitude",
            value=round(float(row.posts[:, 2].max()), 1),
            note=say("terrain.of_altitude", grid=grid),
        ),
        DerivedCell(
            key="row_length",
            value=round(row.length, 2),
            note=say("terrain.of_row", grid=grid),
        ),
        DerivedCell(
            key="post_count",
            value=len(row.posts),
            note=say("terrain.of_row", grid=grid),
        ),
    ]
    if "snow_height" in row.line.cells and "snow_thickness" not in row.line.cells:
        cells.append(_derive_thickness(row, grid))
    gap = find_gap(row, rows)
    if gap is not None:
        note = say("terrain.of_gap", grid=grid)
        cells.append(DerivedCell(key="gap", value=round(gap, 2), note=note))
    return cells


def _derive_thickness(row: MeasuredRow, grid: str) -> DerivedCell:
    """Snow normal to the slope of a vertical height, on the flattest ground of a post.

    The row's slope is that of its snow: where its foot is flatter, snow is deeper.
    """
    height = float(row.line.cells["snow_height"])
    return DerivedCell(
        key="snow_thickness",
        value=round(height * math.cos(row.flattest), 3),
        note=say(
            "terrain.of_thickness",
            grid=grid,
            height=height,
            flattest=math.degrees(row.flattest),
        ),
    )


def _derive_slope(row: MeasuredRow, grid: str) -> DerivedCell:
    slope = row.slope
    return DerivedCell(
        key="slope_angle",
        value=round(math.degrees(_choose(slope, CARED_ANGLE)), 2),
        note=say(
            "terrain.of_slope",
            grid=grid,
            posts=len(row.posts),
            low=math.degrees(slope.low),
            high=math.degrees(slope.high),
            mean=math.degrees(float(row.slopes.mean())),
        ),
    )


def _derive_snow(row: MeasuredRow, grid: str) -> Iterator[DerivedCell]:
    """Longest snow above any post; and whether a row stands above any of them."""
    length = row.upslope.length
    end = say(f"terrain.end_{row.upslope.end}", row=row.upslope.row)
    yield DerivedCell(
        key="upslope_length",
        value=round(_choose(length, CARED_LENGTH), 2),
        note=say(
            "terrain.of_length", grid=grid, low=length.low, high=length.high, end=end
        ),
    )
    if row.has_row_above is not None:  # left empty, a row above alike is taken
        yield DerivedCell(
            key="row_above",
            value="alike" if row.has_row_above else "none",
            note=say("terrain.of_row_above", grid=grid, end=end),
        )


def _choose(band: Band, cared: float) -> float:
    return band.high if band.high - band.low > cared else band.value


def read_other_sheets(path: Path, rows: Sequence[str]) -> tuple[Lines, tuple[str, ...]]:
    """Lines of a workbook's project, ranges, types and row ends, as typed.

    Of sheet Ends those of the rows that the plan has, or of all rows.

    Parameters
    ----------
    path : Path
        Workbook.
    rows : sequence of str
        Names of the plan's rows.

    Returns
    -------
    mapping, tuple of str
        Lines by sheet; names on sheet Ends that the plan does not have.

    Raises
    ------
    SiteDataError
        If one of them cannot be read.
    """
    workbook = read_cells(path)
    findings: list[Finding] = []
    found: dict[str, list[Mapping[str, object]]] = {}
    for plan in (*_TAKEN, ENDS):
        table = find_table(workbook, plan, findings)
        if table is None:
            continue
        if plan is RANGES:  # its units stand in a column of their own
            found[plan.name] = list(_list_as_typed(table))
            continue
        found[plan.name] = [
            {key: one.value for key, one in row.items() if one.state == "given"}
            for row in read_rows(table, findings)
        ]
    errors = [one for one in findings if one.severity == "error"]
    if errors:
        raise SiteDataError(errors)
    ends = found.get(ENDS.name, [])
    found[ENDS.name] = [one for one in ends if _is_of_plan(one, rows)]
    others = (str(one.get("row")) for one in ends if not _is_of_plan(one, rows))
    return found, tuple(dict.fromkeys(others))


def _is_of_plan(line: Mapping[str, object], rows: Sequence[str]) -> bool:
    name = str(line.get("row", ""))
    return name in rows or normalise(name) in ALL_ROWS


def _list_as_typed(table: Table) -> Iterator[Mapping[str, object]]:
    for row in table.rows:
        cells = {
            key: table.sheet.cell(row, column.number)
            for key, column in table.columns.items()
        }
        yield {key: one.value for key, one in cells.items() if not one.is_blank}


def write_workbook(
    rows: Sequence[MeasuredRow], grid: str, others: Lines | None, language: Language
) -> bytes:
    """Site workbook of rows on terrain, its derived cells with their notes.

    Parameters
    ----------
    rows : sequence of MeasuredRow
        In their order.
    grid : str
        Name of the grid's file.
    others : mapping or None
        Lines of the other sheets.
    language : str
        Of sheets, headings and notes.
    """
    lines, notes = [], []
    for row in rows:
        derived = {one.key: one for one in derive_cells(row, rows, grid)}
        typed = dict(row.line.cells)
        if "snow_thickness" in derived:  # says the same, and the template takes one
            del typed["snow_height"]
        values = {key: one.value for key, one in derived.items() if _is_told(one)}
        lines.append({**values, **typed, "id": row.line.id})
        notes.append({key: _tell(one, typed) for key, one in derived.items()})
    content = BytesIO()
    book = start_book(content, language)
    write_notes(book.workbook, language)
    kept = {**list_starting_lines(), **{k: v for k, v in (others or {}).items() if v}}
    columns = {field.key: column for column, field in enumerate(NETS.fields)}
    for plan in SHEETS:
        if plan is not NETS:
            write_sheet(book, plan, kept.get(plan.name, ()))
            continue
        sheet = write_sheet(book, plan, lines)
        for number, of_row in enumerate(notes, start=1):
            for key, note in of_row.items():
                text = render(note, language)
                size = {"x_scale": 2.4, "y_scale": 1.6, "author": ""}
                sheet.write_comment(number, columns[key], text, size)
    book.workbook.close()
    return content.getvalue()


def _is_told(cell: DerivedCell) -> bool:
    """A row without snow above it gets no length: its cell asks for one."""
    is_length = cell.key == "upslope_length" and not isinstance(cell.value, str)
    return not is_length or float(cell.value) >= LEAST_LENGTH


def _tell(cell: DerivedCell, typed: Mapping[str, object]) -> Message:
    """Note on a cell; of one that the row's properties give, what the grid says."""
    if cell.key not in typed:
        return cell.note
    return say("terrain.typed", value=f"{cell.value}", note=cell.note)
