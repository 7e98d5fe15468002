"""Study -> workbook: the page's tables as numbers, steps of checks as formulas.

The first sheet has the verdict, a line for each net row and what is to be done.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from netdesign.outcome import NetDesignError
from netdesign.report.blocks import (
    HIDDEN,
    Block,
    Cell,
    Column,
    Heading,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Table,
    write_plain,
)
from netdesign.report.sections.annexes import build_provenance
from netdesign.report.sections.basis import (
    build_inputs,
    list_row_notes,
    name_cases,
    share_notes,
    show_basis,
    show_profile,
)
from netdesign.report.sections.checks import describe_study_scopes
from netdesign.report.sections.decision import (
    build_matrix,
    list_to_confirm,
)
from netdesign.report.sections.schedule import show_schedule
from netdesign.report.sections.whole import list_properties
from netdesign.report.what_if import build_what_if, mark_title, name_kind, title_pages
from netdesign.report.words import MISSING, Words, show_text
from netdesign.report.workbook.check_sheet import (
    add_check_sheet,
)
from netdesign.report.workbook.writer import (
    BETWEEN_TABLES,
    DEFAULT_FONT,
    Book,
    count_lines,
    find_widths,
    measure_longest,
)
from netdesign.study.document import compute_digest
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

SHEETS = ("decision", "schedule", "checks", "inputs", "profile", "notes")
_HEAD_ROW = 5  # of the matrix, zero-based
_GOVERNING = 40.0  # most that the governing checks are wide, or all is small in print
_LINKS = ((1, 1), (2, 3), (4, 5), (6, 6), (8, 8))  # columns of those to other sheets


def add_decision_sheet(book: Book, study: Study, *, is_verified: bool) -> None:
    """Sheet "Decision": overall verdict, net rows, what is to be done, signatures."""
    words = book.words
    mark = words("what_if.mark") if study.what_if else ""
    titles = (mark, name_kind(study, words, is_verified=is_verified))
    title = " · ".join(filter(None, titles))
    sheet = book.add_sheet("decision", title, is_wide=False)
    table = _add_verdicts(build_matrix(study, words), study, book)
    widths = find_widths([table])
    widths[0] = max(widths[0], measure_longest(words("heading.verdict")))
    widths[-1] = min(widths[-1], _GOVERNING)
    for index, width in enumerate(widths):
        sheet.set_column(index, index, width)
    running = title_pages(study, words)
    book.write_wide(sheet, (1, 0), running or MISSING, widths)
    _write_overall(book, sheet, study, widths)
    line = book.write_table(sheet, table, _HEAD_ROW - 1, widths)
    last = _HEAD_ROW + max(len(study.rows), 1)
    book.colour_verdicts(sheet, (2, 1, last, 1))
    sheet.autofilter(_HEAD_ROW, 0, last, len(table.columns) - 1)
    sheet.freeze_panes(_HEAD_ROW + 1, 1)
    sheet.repeat_rows(_HEAD_ROW)
    blocks = (*list_to_confirm(study, words), *_list_signing(study, words))
    SheetWriter(book=book, sheet=sheet, widths=widths, line=line - 1).write(blocks)


def _add_verdicts(table: Table, study: Study, book: Book) -> Table:
    """The matrix with the word of each row's verdict as a column of its own."""
    heading = Column(heading=book.words("heading.verdict"))
    first, *others = table.columns
    return replace(
        table,
        columns=(first, heading, *others),
        rows=tuple(
            (cells[0], Cell(text=book.word(row.verdict)), *cells[1:])
            for row, cells in zip(study.rows, table.rows, strict=True)
        ),
    )


def _write_overall(
    book: Book, sheet: Any, study: Study, widths: Sequence[float]
) -> None:
    form = book.text(bold=True, font_size=11)
    label = mark_title(study, book.words("heading.verdict"), book.words)
    shown = book.verdicts[study.verdict]
    sheet.write_string(2, 0, label, form)
    sheet.write_string(2, 1, shown.word, book.text(bold=True, shrink=True))
    book.write_wide(sheet, (2, 2), shown.meaning, widths)
    if study.rows:
        scopes = describe_study_scopes(study, book.words)
        book.write_wide(sheet, (3, 0), scopes, widths)


def _list_signing(study: Study, words: Words) -> Iterator[Block]:
    """Room for signatures, and what ties them to the study."""
    project = study.project
    yield Paragraph(text=words("show.signed_study", digest=compute_digest(study)))
    people = (
        ("heading.prepared", project.author),
        ("heading.checked", project.checker),
        ("heading.approved", ""),
    )
    yield Heading(text=words("heading.signatures"), level=3)
    yield Pairs(
        pairs=tuple(
            Pair(name=words(key), text=show_text(text) if text.strip() else "")
            for key, text in people
        )
    )


def render_workbook(
    study: Study, language: Language = "en", *, is_verified: bool = False
) -> bytes:
    """Workbook of a study; the same study gives the same bytes.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    is_verified : bool
        The stored study was solved again in this run.
    """
    import xlsxwriter

    words = Words(language)
    buffer = io.BytesIO()
    options = {
        "in_memory": True,
        "strings_to_formulas": False,
        "strings_to_urls": False,
        "strings_to_numbers": False,
        "default_format_properties": dict(DEFAULT_FONT),  # it is altered there
    }
    with xlsxwriter.Workbook(buffer, options) as workbook:
        properties = list_properties(study, words)
        workbook.set_properties(properties)
        workbook.set_size(2400, 1400)
        workbook.set_calc_mode("auto")
        book = Book(workbook, properties["subject"], words)
        _add_sheets(book, study, is_verified=is_verified)
        names = tuple(sheet.get_name() for sheet in workbook.worksheets())
        if names != tuple(map(book.name, SHEETS)):
            raise NetDesignError(f"the workbook is incomplete: it has only {names}")
    return buffer.getvalue()


def _add_sheets(book: Book, study: Study, *, is_verified: bool) -> None:
    words = book.words
    add_decision_sheet(book, study, is_verified=is_verified)
    _add_part(book, "schedule", show_schedule(study, words).blocks)
    first_lines = add_check_sheet(book, study)
    above = (build_what_if(study, words),) if study.what_if else ()
    add_page_sheet(book, "inputs", [*above, build_inputs(study, words)])
    _add_part(book, "profile", show_profile(study, words).blocks)
    _add_notes(book, study)
    _link_sheets(book, study, first_lines)


def _add_part(book: Book, name: str, blocks: Sequence[Block]) -> None:
    """Sheet of a part of the page: its tables first, then its sentences."""
    tables = [block for block in blocks if isinstance(block, Table)]
    others = [block for block in blocks if not isinstance(block, Table | Heading)]
    add_page_sheet(book, name, tables, *others)


def _add_notes(book: Book, study: Study) -> None:
    """Sheet of what the report rests on: limits, documents, tests, notes, origin."""
    words, shared = book.words, share_notes(study, book.words)
    notes = [
        words("show.label", label=show_text(row.id), text=text)
        for row in study.rows
        for text in list_row_notes(row, study, words)
        if text not in shared
    ]
    sentences = tuple(dict.fromkeys((*notes, name_cases(study, words))))
    blocks = show_basis(study, words).blocks
    tests = [block for block in blocks if isinstance(block, Table)]
    add_page_sheet(
        book,
        "notes",
        tests,
        *(block for block in blocks if not isinstance(block, Table | Heading)),
        Heading(text=words("heading.notes"), level=3),
        Items(items=sentences),
        Heading(text=words("heading.provenance"), level=3),
        build_provenance(study, words),
    )


def _link_sheets(book: Book, study: Study, first_lines: Sequence[int]) -> None:
    """Lead from the first sheet to every other sheet, and from a net row to its checks.

    ``first_lines`` are those of the net rows on the sheet of checks.
    """
    sheet = book.workbook.get_worksheet_by_name(book.name("decision"))
    line = _HEAD_ROW - 1
    for (first, last), name in zip(_LINKS, SHEETS[1:], strict=True):
        if last > first:
            sheet.merge_range(line, first, line, last, "")
        book.link(sheet, (line, first), book.refer(name, "A1"), book.name(name))
    for number, (row, to) in enumerate(zip(study.rows, first_lines, strict=True)):
        target, place = book.refer("checks", f"A{to + 1}"), _HEAD_ROW + 1 + number
        book.link(sheet, (place, 0), target, show_text(row.id))


_LABEL = 24.0  # least width of the names of pairs, in digits


@dataclass(slots=True, kw_only=True)
class SheetWriter:
    """Writes blocks below a line; a drawing has no place in a sheet.

    Attributes
    ----------
    widths : sequence of float
        Widths of the columns, in digits of the default font.
    line : int
        Next free line, zero-based.
    """

    book: Book
    sheet: Any
    widths: Sequence[float]
    line: int

    def write(self, blocks: Iterable[Block]) -> None:
        """All blocks, those of parts as well."""
        for block in blocks:
            if isinstance(block, Part):
                self.write(block.blocks)
            elif isinstance(block, Heading) and block.look != HIDDEN:
                self.line += 1
                self._write_line(write_plain(block.text), bold=True)
            elif isinstance(block, Paragraph):
                self._write_line(write_plain(block.text))
            elif isinstance(block, Items):
                for item in block.items:
                    self._write_line(f"– {write_plain(item)}")
            elif isinstance(block, Pairs):
                self._write_pairs(
                    [(pair.name, write_plain(pair.text)) for pair in block.pairs]
                )
            elif isinstance(block, Table):
                self._write_table(block)

    def _write_line(self, text: str, **look: Any) -> None:
        self.book.write_wide(self.sheet, (self.line, 0), text, self.widths, **look)
        self.line += 1

    def _write_table(self, table: Table) -> None:
        """A table of names and values stands in the columns of another table."""
        if len(table.columns) == 2:
            shown = [[x.text or write_plain(x.content) for x in y] for y in table.rows]
            self._write_pairs([(name, value) for name, value in shown])
            return
        self.line = self.book.write_table(self.sheet, table, self.line, self.widths)

    def _write_pairs(self, pairs: Sequence[tuple[str, str]]) -> None:
        """Names in the first columns, and beside each its text, over all others."""
        first, wide = 0, 0.0
        while wide < _LABEL and first < len(self.widths) - 1:
            wide += self.widths[first]
            first += 1
        rest = sum(self.widths[first:])
        form = self.book.text(text_wrap=True, valign="top")
        spans = ((0, first - 1), (first, len(self.widths) - 1))
        for pair in pairs:
            for text, (start, end) in zip(pair, spans, strict=True):
                if end > start:
                    self.sheet.merge_range(self.line, start, self.line, end, "", form)
                self.sheet.write_string(self.line, start, text, form)
            count = max(
                sum(count_lines([one], [room]) for one in text.split("\n"))
                for text, room in zip(pair, (wide, rest), strict=True)
            )
            self.book.set_height(self.sheet, self.line, count)
            self.line += 1


def add_page_sheet(
    book: Book, name: str, tables: Sequence[Table], *blocks: Block
) -> Any:
    """Sheet of tables that are read by number, and other blocks of a page below them.

    Parameters
    ----------
    book : Book
        That gets the sheet.
    name : str
        Key of the sheet, whose heading is its title.
    tables : sequence of Table
        They set the widths of the columns.
    blocks : Block
        What follows, as on the page.
    """
    title = book.words(f"heading.{name}")
    sheet = book.add_table_sheet(name, title, tables, has_more=bool(blocks))
    line = 2 + sum(BETWEEN_TABLES + len(table.rows) for table in tables)
    widths = find_widths(tables)
    SheetWriter(book=book, sheet=sheet, widths=widths, line=line).write(blocks)
    return sheet
