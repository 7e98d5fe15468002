"""Nets that may be built, from the lines of a workbook, and lines of proposed rows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from netdesign.outcome import SiteDataError, TerrainError
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ANCHORS, ENDS, NETS, POSTS, ROPES
from netdesign.site.headings import Table
from netdesign.site.reader import read_cells
from netdesign.site.tables import find_table, read_field
from netdesign.terrain.layout import Construction, ProposedRow
from netdesign.terrain.measure import MeasuredRow
from netdesign.terrain.plan import NetLine
from netdesign.terrain.site_lines import Lines, read_other_sheets
from netdesign.words.message import say

Cells = Mapping[str, float | str]
Types = Mapping[str, Mapping[str, str]]
_NEEDED = ("id", "net_height", "post_spacing")
# What a place decides, not what is built there.
_OF_PLACE = (
    *("id", "slope_angle", "snow_thickness", "snow_height", "upslope_length"),
    *("gap", "altitude", "neighbour", "row_above"),
    *("row_length", "post_count", "post_spacing"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """Nets of a workbook.

    Attributes
    ----------
    constructions : tuple of Construction
        The lowest first.
    cells : mapping
        Columns of sheet Nets by construction, without those of a place.
    ends : mapping
        Lines of sheet Ends by construction.
    """

    constructions: tuple[Construction, ...]
    cells: Mapping[str, Cells]
    ends: Mapping[str, Sequence[Cells]]

    def draw(self, row: ProposedRow, name: str) -> NetLine:
        """Line of a proposed row with what is built there."""
        built = row.construction
        cells = {
            **self.cells[built.id],
            "id": name,
            "net_height": built.net_height,
            "post_spacing": row.spacing,
            "snow_height": row.snow,
        }
        return NetLine(id=name, points=row.points, cells=cells)

    def list_ends(self, rows: Mapping[str, str]) -> list[Cells]:
        """Lines of sheet Ends of rows, by their names and constructions."""
        return [
            {**line, "row": name}
            for name, built in rows.items()
            for line in self.ends.get(built, ())
        ]


def read_catalogue(path: Path) -> Catalogue:
    """Nets that the lines of sheet Nets describe; where those stand does not count.

    Raises
    ------
    SiteDataError
        If the sheets cannot be read.
    TerrainError
        If no line has a name, a net height and a post spacing.
    """
    workbook = read_cells(path)
    findings: list[Finding] = []
    nets, ends = (
        list(_read_lines(find_table(workbook, plan, findings), findings))
        for plan in (NETS, ENDS)
    )
    errors = [one for one in findings if one.severity == "error"]
    if errors:
        raise SiteDataError(errors)
    whole = [one for one in nets if all(key in one for key in _NEEDED)]
    if not whole:
        raise TerrainError(say("layout.no_net", file=path.name))
    names = Counter(str(one["id"]) for one in whole)
    twice = tuple(name for name, count in names.items() if count > 1)
    if twice:
        raise TerrainError(say("layout.net_twice", file=path.name, nets=twice))
    found = [
        Construction(
            id=str(one["id"]),
            net_height=float(str(one["net_height"])),
            post_spacing=float(str(one["post_spacing"])),
        )
        for one in whole
    ]
    return Catalogue(
        constructions=tuple(sorted(found, key=lambda one: one.net_height)),
        cells={
            str(one["id"]): {k: v for k, v in one.items() if k not in _OF_PLACE}
            for one in whole
        },
        ends={
            one.id: [line for line in ends if str(line.get("row")) == one.id]
            for one in found
        },
    )


def list_types(path: Path) -> tuple[str, ...]:
    """Names of all types of a workbook's sheets."""
    lines, _ = read_other_sheets(path, ())
    names = (
        str(line["id"])
        for plan in (ANCHORS, ROPES, POSTS)
        for line in lines.get(plan.name, ())
        if "id" in line
    )
    return tuple(dict.fromkeys(names))


def put_types(
    rows: Sequence[MeasuredRow], lines: Lines, of_nets: Types, of_ends: Types
) -> tuple[list[MeasuredRow], Lines]:
    """Rows, and lines of the other sheets, with other types in some cells.

    Parameters
    ----------
    rows : sequence of MeasuredRow
        Of the plan.
    lines : mapping
        Lines of the other sheets.
    of_nets, of_ends : mapping of str to mapping of str to str
        Types by column, by row, on sheet Nets and on sheet Ends.
    """
    drawn = [
        replace(
            row,
            line=replace(
                row.line, cells={**row.line.cells, **of_nets.get(row.line.id, {})}
            ),
        )
        for row in rows
    ]
    ends = [
        {**line, **of_ends.get(str(line["row"]), {})}
        for line in lines.get(ENDS.name, ())
    ]
    return drawn, {**lines, ENDS.name: ends}


def _read_lines(table: Table | None, findings: list[Finding]) -> Iterator[Cells]:
    """Given cells of a sheet's lines, but those that a place decides."""
    if table is None:
        return
    keys = [
        field.key
        for field in table.plan.fields
        if field.key in _NEEDED or field.key not in _OF_PLACE
    ]
    for row in table.rows:
        found = {key: read_field(table, key, row, findings) for key in keys}
        yield {
            key: _take(one.value) for key, one in found.items() if one.state == "given"
        }


def _take(value: object) -> float | str:
    return float(value) if isinstance(value, int | float) else str(value)
