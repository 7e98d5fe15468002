"""Cells as somebody typed them, for tools that write a site workbook again."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import ENDS, NETS, RANGES, SHEETS, Lexicon
from netdesign.site.columns.fields import (
    convert_unit,
    normalise,
    normalise_unit,
    split_heading,
)
from netdesign.site.headings import Table
from netdesign.site.lines import ALL_ROWS
from netdesign.site.reader import read_cells
from netdesign.site.tables import find_table, read_rows

Lines = Mapping[str, Sequence[Mapping[str, object]]]
_TAKEN = ("Project", "Ranges", "Anchors", "Ropes", "Posts", "Links", "Tests", "Ends")


@dataclass(frozen=True, slots=True, kw_only=True)
class TypedCells:
    """Cells of a line of sheet Nets.

    Attributes
    ----------
    cells : mapping of str to float or str
        By column, in its first unit.
    faults : tuple of str
        What is given twice, or not understood.
    unread : tuple of str
        Names that are no columns.
    """

    cells: Mapping[str, float | str]
    faults: tuple[str, ...] = ()
    unread: tuple[str, ...] = ()


def read_typed_cells(given: Mapping[str, object]) -> TypedCells:
    """Cells of a line of sheet Nets from values by their headings.

    Parameters
    ----------
    given : mapping of str to object
        Headings in any language, perhaps with a unit; None of an empty cell.
    """
    cells: dict[str, float | str] = {}
    faults, unread = [], []
    lexicon = Lexicon.of(NETS.fields, NETS)
    for heading, value in given.items():
        meaning = lexicon.match(heading)
        if value is None or value == "":
            continue
        if meaning.readings:
            readings = ", ".join(str(one.name) for one in meaning.readings)
            told = f"property {heading!r:.60} may mean: {readings}"
            faults.append(f"{told}; name it as the workbook does")
        elif meaning.field is None:
            unread.append(f"{heading!r:.60}")
        else:
            found = _convert(heading, value, meaning.field.unit)
            if found is None or meaning.field.key in cells:
                told = f"property {heading!r:.60} is given twice, or its value or unit"
                faults.append(f"{told} is not understood")
            else:
                cells[meaning.field.key] = found
    return TypedCells(cells=cells, faults=tuple(faults), unread=tuple(unread))


def _convert(heading: str, value: object, unit: str) -> float | str | None:
    """Number in the column's first unit, or words; None of what is neither."""
    if isinstance(value, str):
        return value.strip() or None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    if not math.isfinite(value):
        return None
    own = normalise_unit(split_heading(heading)[1])
    try:
        return convert_unit(float(value), own, unit) if own and unit else float(value)
    except KeyError:
        return None


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
    found: dict[str, list[Mapping[str, object]]] = {}
    for plan in SHEETS:
        table = find_table(workbook, plan, findings) if plan.name in _TAKEN else None
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
    found[ENDS.name] = [one for one in ends if _is_of_rows(one, rows)]
    others = (str(one.get("row")) for one in ends if not _is_of_rows(one, rows))
    return found, tuple(dict.fromkeys(others))


def _is_of_rows(line: Mapping[str, object], rows: Sequence[str]) -> bool:
    name = str(line.get("row", ""))
    return name in rows or normalise(name) in ALL_ROWS


def _list_as_typed(table: Table) -> Iterator[Mapping[str, object]]:
    for row in table.rows:
        cells = {
            key: table.sheet.cell(row, column.number)
            for key, column in table.columns.items()
        }
        yield {key: one.value for key, one in cells.items() if not one.is_blank}
