"""The workbook of a rewriting: only cells that the reader takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from netdesign.outcome import SiteDataError
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.all_tables import FURTHER
from netdesign.site.office.project import read_lines
from netdesign.site.office.rewrite import Rewritten
from netdesign.site.office.sheets import find_office_tables
from netdesign.site.office.told import Told
from netdesign.site.reader import read_cells, read_site
from netdesign.site.readings import Reading, Row
from netdesign.site.tables import find_table, read_rows
from netdesign.site.template.office_workbook import render_input
from netdesign.words.catalogue import Language
from netdesign.words.message import Message

# Columns of which an empty cell says something else than that a value is not known.
_KEPT = ("at_end", "gap", "snow")
_Tables = Mapping[str, Sequence[dict[str, object]]]


def render_rewritten(
    made: Rewritten, language: Language
) -> tuple[bytes, Sequence[Message]]:
    """Input workbook of a rewriting, and what was done.

    A cell that the reader refuses is left empty and listed. One that its line needs
    stays as it is, for the reader to refuse.

    Parameters
    ----------
    made : Rewritten
        As `rewrite` gives it.
    language : str
        Of the workbook.
    """
    told = Told()
    tables: _Tables = {
        name: [{**line} for line in lines if line]
        for name, lines in made.tables.items()
    }
    content = render_input(tables, language, made.sheets, made.measures)
    while _empty_refused(tables, content, told):
        tables = {name: [x for x in of if x] for name, of in tables.items()}
        content = render_input(tables, language, made.sheets, made.measures)
    return content, (*made.done, *told.list_done())


def _empty_refused(tables: _Tables, content: bytes, told: Told) -> bool:
    """Take refused cells out of their lines; whether there was one."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "new.xlsx"
        path.write_bytes(content)
        refused = _list_refused(path)
        lines = _read_lines(path) if refused else {}
    is_found = False
    for table, of_table in tables.items():
        for line, row in zip(of_table, lines.get(table, ()), strict=False):
            for key, finding in _match(line, row, refused):
                del line[key]
                told.empty(row[key], finding.rule)
                is_found = True
    return is_found


def _match(
    line: Mapping[str, object], row: Row, refused: Mapping[str, Finding]
) -> Iterator[tuple[str, Finding]]:
    for key, reading in row.items():
        is_needed = reading.field.required or key in _KEPT
        if key in line and reading.place in refused and not is_needed:
            yield key, refused[reading.place]


def _list_refused(path: Path) -> Mapping[str, Finding]:
    """First fault of each cell that the reader refuses, by its place."""
    try:
        read_site(path)
    except SiteDataError as error:
        faults = [
            one
            for one in error.findings
            if isinstance(one, Finding) and one.severity == "error"
        ]
        return {f"{one.sheet}!{one.cell}": one for one in reversed(faults)}
    return {}


def _read_lines(path: Path) -> Mapping[str, Sequence[Mapping[str, Reading]]]:
    """Lines of every sheet by its table, with the cells that they stand in."""
    workbook = read_cells(path)
    found = find_office_tables(workbook, [])
    project = read_lines(found.tables["project"], [*found.lines["project"]], [])
    further = {x.name: read_rows(find_table(workbook, x, []), []) for x in FURTHER}
    return {**found.lines, "project": [project], **further}
