"""Lines of a sheet of types, each with the resistances that its dimensions give."""

from __future__ import annotations

from netdesign.site.cells.findings import Finding
from netdesign.site.headings import Table
from netdesign.site.lines import index_lines
from netdesign.site.readings import Row, refuse_misfits
from netdesign.site.type_lines import fill_in_section
from netdesign.site.type_resistances import (
    check_ends,
    check_section,
    check_tests,
    fill_in_resistances,
)
from netdesign.words.message import say


def read_types(
    table: Table | None, rows: list[Row], findings: list[Finding]
) -> dict[str, Row] | None:
    """Lines of a type sheet by id; a faulty line keeps its id known.

    None without the sheet, its headings or its column of ids.
    """
    if table is None:
        return None
    rows = [fill_in_section(row) for row in rows]
    for row in rows:
        refuse_misfits(row, findings)
    filled = [fill_in_resistances(row, findings) for row in rows]
    for row in filled:  # a computed resistance beside tests is one too many, too
        check_tests(row, findings)
        check_ends(row, findings)
        check_section(row, findings)
    by_id = index_lines(filled, "id", say("nets.ids_once"), findings)
    return by_id if "id" in table.columns else None
