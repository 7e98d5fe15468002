"""Lines of sheet Declared that confirm a number: ``Posts!C2 = 3175`` as the check."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from netdesign.site.cells.cells import Cell, Workbook
from netdesign.site.cells.findings import Finding
from netdesign.site.readings import Row, refuse
from netdesign.site.replaced import find_cell, split_replacement
from netdesign.site.tables import Table, read_rows
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Confirmation:
    """A number that looks like a slip of the pen, and is none.

    Attributes
    ----------
    cell, value : str
        Its place, such as ``Posts!C2``, and what is typed there.
    document, author, date : str
        What confirms it, who, and when.
    """

    cell: str
    value: str
    document: str
    author: str
    date: str

    @property
    def message(self) -> Message:
        """The sentence on it in the reports."""
        return say(
            "plausible.confirmed",
            cell=self.cell,
            value=self.value,
            document=self.document,
            author=self.author,
            date=self.date,
        )


def is_confirmation(line: Row) -> bool:
    """Presence of a cell and its value in the place of a check."""
    return split_replacement(line["check"].word) is not None


def read_confirmed(
    table: Table | None, workbook: Workbook, findings: list[Finding]
) -> tuple[Confirmation, ...]:
    """Confirmed numbers of sheet Declared.

    Parameters
    ----------
    table : Table or None
        Sheet Declared, if there is one.
    workbook : Workbook
        As read; a number that is no longer there is not confirmed.
    findings : list of Finding
        Appended to: cells that hold something else, lines without a date.
    """
    return tuple(_read(table, workbook, findings)) if table else ()


def _read(
    table: Table, workbook: Workbook, findings: list[Finding]
) -> Iterator[Confirmation]:
    sheets = {sheet.name.casefold(): sheet for sheet in workbook.sheets}
    for line in read_rows(table, []):  # its faults are told with the declarations
        found = split_replacement(line["check"].word)
        if found is None:
            continue
        sheet_name, _, address = found[0].rpartition("!")
        sheet = sheets.get(sheet_name.casefold())
        cell = find_cell(sheet, address) if sheet else None
        if cell is None or not _holds(cell, found[1]):
            held = show_value(cell) if cell else ""
            rule = say("plausible.holds_other", cell=found[0], held=held)
            refuse(line["check"], rule, say("plausible.such_as"), findings)
        elif not line["date"].word:
            refuse(line["date"], say("cell.empty"), say("declared.such_as"), findings)
        else:
            yield Confirmation(
                cell=cell.place,
                value=show_value(cell),
                document=line["document"].word,
                author=line["author"].word,
                date=line["date"].word,
            )


def show_value(cell: Cell) -> str:
    """Content of a cell as text; of a formula its result."""
    is_number = isinstance(cell.value, int | float)
    return f"{cell.value:.10g}" if is_number else cell.text


def _holds(cell: Cell, typed: str) -> bool:
    """A cell holds what is confirmed, as text or as number."""
    if typed in (cell.text, show_value(cell)):
        return True
    try:
        return float(typed.replace(",", ".")) == float(show_value(cell))
    except ValueError:
        return False
