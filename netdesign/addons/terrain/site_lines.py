"""Lines of the site workbook that rows on terrain give, with a note on each cell.

The gap beside a row is that to the nearest work along it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from netdesign.addons.terrain.measure import (
    CARED_ANGLE,
    CARED_LENGTH,
    LEAST_LENGTH,
    Band,
    MeasuredRow,
    describe_end,
)
from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ENDS, RANGES, SHEETS
from netdesign.site.columns.fields import (
    normalise,
)
from netdesign.site.headings import Table
from netdesign.site.lines import ALL_ROWS
from netdesign.site.reader import read_cells
from netdesign.site.tables import find_table, read_rows
from netdesign.site.template.workbook import list_starting_lines, render_workbook
from netdesign.words.catalogue import Language

Lines = Mapping[str, Sequence[Mapping[str, object]]]
_TAKEN = ("Project", "Ranges", "Anchors", "Ropes", "Posts", "Links", "Tests", "Ends")


def read_typed_sheets(path: Path, rows: Sequence[str]) -> tuple[Lines, tuple[str, ...]]:
    """Lines of a workbook's project, ranges, types and row ends, as typed.

    Of sheet Ends those of some rows, or of all rows.

    Parameters
    ----------
    path : Path
        Workbook.
    rows : sequence of str
        Names of these rows.

    Returns
    -------
    mapping, tuple of str
        Lines by sheet; names on sheet Ends that are left out.

    Raises
    ------
    SiteDataError
        If one of them cannot be read.
    """
    workbook = read_cells(path)
    findings: list[Finding] = []
    lines: dict[str, list[Mapping[str, object]]] = {}
    for plan in SHEETS:
        table = find_table(workbook, plan, findings) if plan.name in _TAKEN else None
        if table is None:
            continue
        if plan is RANGES:  # its units stand in a column of their own
            lines[plan.name] = list(_list_as_typed(table))
            continue
        lines[plan.name] = [
            {key: cell.value for key, cell in row.items() if cell.state == "given"}
            for row in read_rows(table, findings)
        ]
    errors = [finding for finding in findings if finding.severity == "error"]
    if errors:
        raise SiteDataError(errors)
    ends = lines.get(ENDS.name, [])
    lines[ENDS.name] = [line for line in ends if _is_of_rows(line, rows)]
    others = (str(line.get("row")) for line in ends if not _is_of_rows(line, rows))
    return lines, tuple(dict.fromkeys(others))


def _is_of_rows(line: Mapping[str, object], rows: Sequence[str]) -> bool:
    name = str(line.get("row", ""))
    return name in rows or normalise(name) in ALL_ROWS


def _list_as_typed(table: Table) -> Iterator[Mapping[str, object]]:
    for row in table.rows:
        cells = {
            key: table.sheet.cell(row, column.number)
            for key, column in table.columns.items()
        }
        yield {key: cell.value for key, cell in cells.items() if not cell.is_blank}


_FARTHEST = 20.0  # from a row's end; beyond it the next work counts as none [m]


def find_gap(row: MeasuredRow, rows: Sequence[MeasuredRow]) -> float | None:
    """Free distance from a row's ends to the next row beside it [m].

    The larger one of its two ends, along which the end effect is larger; None where
    no row stands beside one of them.

    Parameters
    ----------
    row : MeasuredRow
        The row.
    rows : sequence of MeasuredRow
        All rows.

    Verified by
    -----------
    tests/addons/terrain/test_coverage.py
    """
    gaps = [_find_beside(row, rows, end) for end in (0, -1)]
    on_both_sides = [gap for gap in gaps if gap is not None]
    return max(on_both_sides) if len(on_both_sides) == len(gaps) else None


def _find_beside(
    row: MeasuredRow, rows: Sequence[MeasuredRow], end: int
) -> float | None:
    """Distance from an end along the row to the nearest row that stands there [m]."""
    start = row.posts[end, :2]
    outward = start - row.posts[1 if end == 0 else -2, :2]
    outward = outward / np.linalg.norm(outward)
    across = np.array((-outward[1], outward[0]))
    distances = []
    for other in rows:
        if other is row:
            continue
        away = other.posts[:, :2] - start
        along, aside = away @ outward, np.abs(away @ across)
        beside = (along > 0.0) & (along <= _FARTHEST) & (aside <= row.line.net_height)
        distances += [float(distance) for distance in along[beside]]
    return min(distances, default=None)


@dataclass(frozen=True, slots=True, kw_only=True)
class DerivedCell:
    """A cell of sheet Nets that follows from the terrain, and how.

    Attributes
    ----------
    key : str
        Of the column.
    value : float, int or str
        In the column's first unit, or a word of the column.
    note : str
        Stretch, band, and what was typed instead.
    """

    key: str
    value: float | int | str
    note: str


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
    of_row = f"From {grid}: posts at their spacing along the ground."
    cells = [
        _derive_slope(row, grid),
        *_derive_snow(row, grid),
        DerivedCell(
            key="altitude",
            value=round(float(row.posts[:, 2].max()), 1),
            note=f"From {grid}: the highest post.",
        ),
        DerivedCell(
            key="row_length",
            value=round(row.length, 2),
            note=of_row,
        ),
        DerivedCell(
            key="post_count",
            value=len(row.posts),
            note=of_row,
        ),
    ]
    if "snow_height" in row.line.cells and "snow_thickness" not in row.line.cells:
        cells.append(_derive_thickness(row, grid))
    gap = find_gap(row, rows)
    if gap is not None:
        note = f"From {grid}: to the row beside, the larger of both ends."
        cells.append(DerivedCell(key="gap", value=round(gap, 2), note=note))
    return cells


def _derive_thickness(row: MeasuredRow, grid: str) -> DerivedCell:
    """Snow normal to the slope of a vertical height, on the flattest ground of a post.

    The row's slope is that of its snow: where its foot is flatter, snow is deeper.
    """
    height = float(row.line.cells["snow_height"])
    note = f"From {grid}: {height:g} m of vertical snow height, normal to the flattest"
    return DerivedCell(
        key="snow_thickness",
        value=round(height * math.cos(row.flattest), 3),
        note=f"{note} ground at a post, {math.degrees(row.flattest):.1f}°.",
    )


def _derive_slope(row: MeasuredRow, grid: str) -> DerivedCell:
    slope = row.slope
    low, high, mean = map(math.degrees, (slope.low, slope.high, row.slopes.mean()))
    return DerivedCell(
        key="slope_angle",
        value=round(math.degrees(_choose(slope, CARED_ANGLE)), 2),
        note=f"From {grid}: mean on the line of fall of each post, over the snow of "
        f"the row; the steepest of {len(row.posts)} posts. {low:.1f}° to {high:.1f}° "
        f"by the grid's noise; mean of the posts {mean:.1f}°. "
        "Where the band is wider than 0.5° its upper end stands here.",
    )


def _derive_snow(row: MeasuredRow, grid: str) -> Iterator[DerivedCell]:
    """Longest snow above any post; and whether a row stands above any of them."""
    length, end = row.upslope.length, describe_end(row.upslope)
    yield DerivedCell(
        key="upslope_length",
        value=round(_choose(length, CARED_LENGTH), 2),
        note=f"From {grid}: along the line of fall, {end}; the longest of the posts. "
        f"{length.low:.1f} to {length.high:.1f} m by the rule of 25°. "
        "Where the band is wider than 0.1 m its upper end stands here.",
    )
    if row.has_row_above is not None:  # left empty, a row above alike is taken
        yield DerivedCell(
            key="row_above",
            value="alike" if row.has_row_above else "none",
            note=f"From {grid}: the upslope length goes {end}; "
            "its anchors may stand near.",
        )


def _choose(band: Band, cared: float) -> float:
    return band.high if band.high - band.low > cared else band.value


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
        Of sheets and headings.
    """
    lines, notes = [], []
    for row in rows:
        derived = {cell.key: cell for cell in derive_cells(row, rows, grid)}
        typed = dict(row.line.cells)
        if "snow_thickness" in derived:  # says the same, and the template takes one
            del typed["snow_height"]
        values = {key: cell.value for key, cell in derived.items() if _is_told(cell)}
        lines.append({**values, **typed, "id": row.line.id})
        notes.append({key: _tell(cell, typed) for key, cell in derived.items()})
    kept = {name: own for name, own in (others or {}).items() if own}
    sheets = {**list_starting_lines(), **kept, "Nets": lines}
    return render_workbook(sheets, language, notes={"Nets": notes})


def _is_told(cell: DerivedCell) -> bool:
    """A row without snow above it gets no length: its cell asks for one."""
    is_length = cell.key == "upslope_length" and not isinstance(cell.value, str)
    return not is_length or float(cell.value) >= LEAST_LENGTH


def _tell(cell: DerivedCell, typed: Mapping[str, object]) -> str:
    """Note on a cell; of one that the row's properties give, what the grid says."""
    if cell.key not in typed:
        return cell.note
    typed_note = "Typed as a property of the row. The terrain gives"
    return f"{typed_note} {cell.value}. {cell.note}"
