"""What a workbook holds before net rows are built."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from netdesign.checks import Approval
from netdesign.site.cells.cells import Workbook
from netdesign.site.headings import Table
from netdesign.site.lines import Lines
from netdesign.site.model import Project
from netdesign.site.readings import Row


@dataclass(frozen=True, slots=True, kw_only=True)
class Content:
    """Lines of all sheets, and the tables that are read once rows are known.

    Attributes
    ----------
    workbook : Workbook
        Its sheets that are read.
    project, project_cells : Project, mapping of str to str
        Of the cover sheet, and the cells of its items.
    lines : Lines
        Of net rows, their ends and types.
    nets : Table or None
        The first table of net rows.
    declared : sequence of Row
        Lines of sheet Declared.
    further : mapping of str to Table or None
        Sheets of add-ons, by name.
    approvals : mapping of str to Approval
        Of the net types, by net row.
    library : tuple of str
        File of further net types, and its hash; empty without one.
    """

    workbook: Workbook
    project: Project
    project_cells: Mapping[str, str]
    lines: Lines
    nets: Table | None
    declared: Sequence[Row]
    further: Mapping[str, Table | None]
    approvals: Mapping[str, Approval] = field(default_factory=dict)
    library: tuple[str, str] = ("", "")
