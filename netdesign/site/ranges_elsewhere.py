"""Ranges of a workbook that has no sheet for them: on its cover sheet, or answered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from netdesign.site.cells.cells import Cell, Sheet, Workbook
from netdesign.site.cells.numbers import split_range
from netdesign.site.columns.all_tables import NETS, RANGES
from netdesign.site.columns.lexicon import UNANSWERED, Lexicon
from netdesign.site.headings import Table
from netdesign.site.titles import Title, list_meant, understand

_HEADINGS = ("quantity", "range", "unit")


# Of one range its row on the cover, if it stands there, and its cells: name, value and,
# perhaps, unit.
_Line = tuple[int | None, tuple[Cell, ...]]


def gather_ranges(
    workbook: Workbook, cover: Table | None
) -> tuple[Workbook, Table | None]:
    """Workbook with a sheet Ranges, and its cover without the lines that went there.

    Both are the same where it has that sheet, or nothing for it.
    """
    if list_meant(workbook, RANGES):
        return workbook, cover
    lines = [*_list_answered(workbook), *_list_on_cover(cover)]
    if not lines:
        return workbook, cover
    sheet = RANGES.name
    file = lines[0][1][0].file
    head = {
        n: Cell(file=file, sheet=sheet, row=1, column=n, value=value)
        for n, value in enumerate(_HEADINGS, 1)
    }
    rows = {
        number: dict(enumerate(cells, 1)) for number, (_, cells) in enumerate(lines, 2)
    }
    made = Sheet(file=file, name=sheet, rows={1: head, **rows})
    taken = {row for row, _ in lines}
    if cover:
        kept = tuple(row for row in cover.rows if row not in taken)
        cover = replace(cover, rows=kept)
    return replace(workbook, sheets=(*workbook.sheets, made)), cover


def _list_answered(workbook: Workbook) -> Iterator[_Line]:
    """Ranges of the file of answers; an open one is none."""
    answers = workbook.answers
    for row, (name, answer) in enumerate(answers.ranges.items(), 1):
        if UNANSWERED in answer:
            continue
        made = Cell(file=answers.file, sheet="ranges", row=row, column=1, value=name)
        yield None, (made, replace(made, column=2, value=answer))


def _list_on_cover(cover: Table | None) -> Iterator[_Line]:
    """Lines of the cover that name a range; a single value of all rows is none."""
    if cover is None:
        return
    lexicon = Lexicon.of(RANGES.items, RANGES)
    for row in cover.rows:
        cells = cover.sheet.row(row)
        if len(cells) < 2 or not isinstance(cells[0].value, str):
            continue
        field = understand(Title(cells[0]), lexicon, cover.sheet.answers).field
        is_range = split_range(cells[1].text) is not None
        if field and (is_range or field.key not in {one.key for one in NETS.fields}):
            yield row, cells[:3]
