"""Input workbook that rows on terrain give, with a note on each cell of theirs.

The gap beside a row is that to the nearest work along it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
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
from netdesign.cable.net import find_sag, find_slack
from netdesign.outcome import SiteDataError, TerrainError
from netdesign.site.cells.findings import Finding
from netdesign.site.cells.spreadsheet import read_workbook
from netdesign.site.columns.office import Column, load_columns, load_plan
from netdesign.site.office.project import read_lines
from netdesign.site.office.sheets import find_office_tables
from netdesign.site.readings import Reading, Row
from netdesign.site.template.office_workbook import render_input
from netdesign.words.catalogue import Language

Line = Mapping[str, object]
_PARTS = ("ropes", "posts", "links", "soils")
_TAKEN = ("project", "net_types", "anchor_types", "tests", *_PARTS)


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedSheets:
    """Project, net types, anchors, tests and parts of another workbook.

    Attributes
    ----------
    tables : mapping of str to sequence of mapping
        Lines by table and column, as the workbook shows them.
    measure : str
        Of the net types: ``sag`` or ``slack``.
    """

    tables: Mapping[str, Sequence[Line]] = field(default_factory=dict)
    measure: str = "slack"


def read_typed_sheets(path: Path) -> TypedSheets:
    """Lines of a workbook's project, net types, anchors, tests and parts.

    Raises
    ------
    SiteDataError
        If one of them cannot be read.
    """
    plans = tuple(map(load_plan, _TAKEN))

    def is_wanted(name: str) -> bool:
        return any(plan.matches(name) for plan in plans)

    workbook = read_workbook(path, is_wanted)
    findings: list[Finding] = []
    alone = tuple(table for table in _TAKEN if table not in _PARTS)
    office = find_office_tables(workbook, findings, alone)
    project = read_lines(
        office.tables["project"], list(office.lines["project"]), findings
    )
    errors = [finding for finding in findings if finding.severity == "error"]
    if errors:
        raise SiteDataError(errors)
    lines = {**office.lines, "project": [project]}
    tables = {
        table: [_show_line(table, line) for line in lines[table]] for table in _TAKEN
    }
    measure = office.find_measure("net_types", "slack") or "slack"
    return TypedSheets(tables=tables, measure=measure)


def _show_line(table: str, line: Row) -> dict[str, object]:
    """Cells that are filled in, in the units that the workbook shows."""
    columns = {column.field.key: column for column in load_columns(table)}
    return {
        key: _show(columns[key], reading)
        for key, reading in line.items()
        if reading.state == "given"
    }


def _show(column: Column, reading: Reading) -> object:
    if reading.span is not None:
        low, high = (column.show(end) for end in reading.span)
        return f"{low:g} to {high:g}"
    value = reading.value
    return column.show(value) if isinstance(value, float) else value


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
    tests/addons/terrain/test_measure.py
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
    """A cell of sheet Rows that follows from the terrain, and how.

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
    """Cells of a row: slope, upslope length, altitude, posts, gap.

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
        _derive_length(row, grid),
        DerivedCell(
            key="altitude",
            value=round(float(row.posts[:, 2].max()), 1),
            note=f"From {grid}: the highest post.",
        ),
        DerivedCell(
            key="post_count",
            value=len(row.posts),
            note=f"From {grid}: posts at their spacing along the ground.",
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


def _derive_length(row: MeasuredRow, grid: str) -> DerivedCell:
    """Longest snow above any post."""
    length, end = row.upslope.length, describe_end(row.upslope)
    return DerivedCell(
        key="upslope_length",
        value=round(_choose(length, CARED_LENGTH), 2),
        note=f"From {grid}: along the line of fall, {end}; the longest of the posts. "
        f"{length.low:.1f} to {length.high:.1f} m by the rule of 25°. "
        "Where the band is wider than 0.1 m its upper end stands here.",
    )


def _choose(band: Band, cared: float) -> float:
    return band.high if band.high - band.low > cared else band.value


_ROW_KEYS = {"snow_thickness": "snow"}
_ROWS = frozenset(column.field.key for column in load_columns("rows"))
_NETS = {x.field.key: x for x in load_columns("net_types") if x.field.key != "id"}


def write_workbook(
    rows: Sequence[MeasuredRow],
    grid: str,
    others: TypedSheets,
    language: Language,
) -> bytes:
    """Input workbook of rows on terrain, its derived cells with their notes.

    Parameters
    ----------
    rows : sequence of MeasuredRow
        In their order.
    grid : str
        Name of the grid's file.
    others : TypedSheets
        Of another workbook; empty without one.
    language : str
        Of sheets and headings.

    Raises
    ------
    TerrainError
        Of rows that say of their net type something else than that workbook.
    """
    tables = dict(others.tables)
    nets = {str(net.get("id")): net for net in tables.get("net_types", ())}
    lines, notes, faults = [], [], list[str]()
    for row in rows:
        derived = {cell.key: cell for cell in derive_cells(row, rows, grid)}
        typed = dict(row.line.cells)
        values = {key: cell.value for key, cell in derived.items() if _is_told(cell)}
        named = str(typed.get("net_type", ""))
        net = _name_net(_take_net(typed, others.measure), named, nets)
        if isinstance(net, str):
            lines.append(_take_row({**values, **typed, "net_type": net}, row.line.id))
        else:
            faults += [f"row {row.line.id}: {fault}" for fault in net]
        notes.append(
            {_ROW_KEYS.get(key, key): _tell(x, typed) for key, x in derived.items()}
        )
    if faults:
        raise TerrainError("\n".join(faults))
    tables |= {"rows": lines, "net_types": list(nets.values())}
    measures = {("rows", "snow"): "normal", ("net_types", "slack"): others.measure}
    return render_input(tables, language, (), measures, notes)


def _take_row(cells: Mapping[str, object], name: str) -> dict[str, object]:
    """Cells of sheet Rows, the snow normal to the slope."""
    named = {_ROW_KEYS.get(key, key): value for key, value in cells.items()}
    return {key: value for key, value in named.items() if key in _ROWS} | {"id": name}


def _take_net(cells: Mapping[str, float | str], measure: str) -> dict[str, object]:
    """Cells of the row's net type, as the workbook shows them."""
    typed, turn = dict(cells), {"sag": find_sag, "slack": find_slack}[measure]
    other = typed.pop("slack" if measure == "sag" else "sag", None)
    own = typed.pop(measure, None)
    if isinstance(own, float) or isinstance(other, float):
        typed["slack"] = own if isinstance(own, float) else turn(float(other or 0.0))
    return {
        key: _NETS[key].show(value) if isinstance(value, float) else value
        for key, value in typed.items()
        if key in _NETS
    }


def _name_net(
    net: Mapping[str, object], named: str, nets: dict[str, Line]
) -> str | list[str]:
    """Id of a row's net type among those so far, or how it differs from that."""
    if not named:
        stem = f"D_K {net['net_height']:g}"
        alike = [name for name in nets if name == stem or name.startswith(f"{stem} ")]
        same = (name for name in alike if nets[name] == {"id": name, **net})
        named = next(same, f"{stem} {len(alike) + 1}" if alike else stem)
    listed = nets.setdefault(named, {"id": named, **net})
    return [
        f"{key} is {value!r:.40}, and {listed.get(key)!r:.40} of net type {named!r:.40}"
        for key, value in net.items()
        if listed.get(key) != value
    ] or named


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
