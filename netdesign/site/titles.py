"""One heading, or one item of a line, as its sheet has it: what it is taken for."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from netdesign.site.cells.cells import Cell, Sheet, name_column
from netdesign.site.columns.fields import normalise, split_heading
from netdesign.site.columns.lexicon import (
    IGNORE,
    UNANSWERED,
    Lexicon,
    Meaning,
    find_unit,
)

_COLUMN = re.compile(r"([A-Z]{1,3}): (.*)", re.DOTALL)  # of an answer


@dataclass(frozen=True, slots=True)
class Title:
    """One heading: the cell that holds it and the group that it belongs to."""

    cell: Cell
    group: str = ""

    @property
    def text(self) -> str:
        """Text as typed."""
        return str(self.cell.value)

    @property
    def asked(self) -> str:
        """Group and heading as a file of answers names them."""
        parts = (" ".join(one.split()) for one in (self.group, self.text))
        return " › ".join(part for part in parts if part)

    @property
    def unit(self) -> str:
        """Unit in its brackets, or in those of its group."""
        group = split_heading(self.group)[1]
        return find_unit(self.text) or split_heading(self.text)[1] or group


def understand(title: Title, lexicon: Lexicon, answers: Mapping[str, str]) -> Meaning:
    """Meaning of a heading: as answered, else by its text.

    An answer names a field by its key, or by a heading of any language.
    """
    answer = find_answer(title, answers)
    if not answer:
        return lexicon.match(title.text, title.group)
    if answer in (IGNORE, UNANSWERED):
        return Meaning(answer=answer)
    field = lexicon.fields.get(answer.partition("[")[0].strip())
    meaning = Meaning(field) if field else lexicon.match(answer)
    return replace(meaning, answer=answer, unit=find_unit(answer))


def find_answer(title: Title, answers: Mapping[str, str]) -> str:
    """Answer to a heading; empty where there is none."""
    for key, answer in answers.items():
        if is_asked(title, key):
            return answer
    return ""


def is_asked(title: Title, key: str) -> bool:
    """A key of the answers names this heading."""
    in_column = _COLUMN.fullmatch(key)
    if in_column and in_column[1] != name_column(title.cell.column):
        return False
    asked = normalise(in_column[2] if in_column else key)
    names = (title.text, title.asked, title.text.partition("[")[0])
    return asked in {normalise(one) for one in names} | {split_heading(title.text)[0]}


def list_titles(sheet: Sheet, row: int) -> list[Title]:
    """Headings of a row; a cell merged downwards into it counts as in the row."""
    cells = {cell.column: cell for cell in sheet.row(row)}
    for merged in sheet.merged:
        if merged.row < row <= merged.last_row and merged.column == merged.last_column:
            cell = sheet.cell(merged.row, merged.column)
            if not cell.is_blank:
                cells.setdefault(merged.column, cell)
    return [
        Title(cells[column], _find_group(sheet, row, column))
        for column in sorted(cells)
    ]


def _find_group(sheet: Sheet, row: int, column: int) -> str:
    """Text of a cell just above that is merged across this column and others.

    Across all of them it is the title of the table, and groups nothing.
    """
    columns = [cell.column for cell in sheet.row(row)]
    for merged in sheet.merged:
        is_wide = merged.last_column > merged.column and merged.last_row == row - 1
        is_title = all(merged.covers(row - 1, one) for one in columns[:-1])
        if is_wide and not is_title and merged.covers(row - 1, column):
            return str(sheet.cell(merged.row, merged.column).value or "")
    return ""
