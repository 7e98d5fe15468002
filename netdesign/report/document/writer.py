"""Blocks -> text of a document, from top to bottom."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from netdesign.edge.given_files import make_printable
from netdesign.report.blocks import (
    Block,
    Cell,
    Contents,
    Figure,
    Heading,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Table,
    Text,
)
from netdesign.report.document import styles
from netdesign.report.document.markup import (
    Grid,
    Run,
    Runs,
    list_runs,
    parse,
    write_paragraph,
    write_runs,
    write_table,
)
from netdesign.report.document.picture import write_picture
from netdesign.report.words import VERDICTS, Words

if TYPE_CHECKING:
    from docx.document import Document

_EMU = 12700  # of a point
_HIGHEST = 0.8  # of a page that a drawing may take
_VERDICTS = tuple(signs.symbol for signs in VERDICTS.values())
_STYLES = {"kind": styles.SMALL, "word": styles.VERDICT}  # of looks; else plain text
_SMALL_LOOKS = ("small", "none", "caption")


@dataclass(kw_only=True)
class Writer:
    """Writes blocks into a document; text of anybody comes in as text alone."""

    document: Document
    words: Words
    headings: list[tuple[str, str]] = field(default_factory=list)  # mark and text
    pictures: int = 0
    is_wide: bool = False  # on pages that stand across
    place_of_contents: Any = None

    @property
    def width_pt(self) -> float:
        """Width between the margins [pt]."""
        page: Any = self.document.sections[-1]
        across = page.page_height if self.is_wide else page.page_width
        return float(across - page.left_margin - page.right_margin) / _EMU

    @cached_property
    def height_pt(self) -> float:
        """Height between the margins [pt]."""
        page: Any = self.document.sections[-1]
        return float(page.page_height - page.top_margin - page.bottom_margin) / _EMU

    @cached_property
    def _ids(self) -> dict[str, str]:
        return {name: styles.find_id(self.document, name) for name in styles.NAMES}

    def write(self, blocks: Sequence[Block]) -> None:
        """All blocks, and the contents, which are known at the end."""
        for block in blocks:
            self._write_block(block)
        self._fill_contents()

    def _write_block(self, block: Block) -> None:
        if not isinstance(block, Contents) and block.on == "page":
            return
        writers: dict[type, Callable[[Any], None]] = {
            Heading: self._write_heading,
            Paragraph: self._write_text,
            Items: self._write_items,
            Pairs: lambda pairs: self._add_grid("", _list_pairs(pairs)),
            Table: self._write_table,
            Figure: self._write_figure,
            Contents: self._open_contents,
            Part: self._write_part,
        }
        writers[type(block)](block)

    def _write_part(self, block: Part) -> None:
        if block.fold:
            return
        if block.look == "wide":
            self._end_section()
            self.is_wide = True
        for one in block.blocks:
            self._write_block(one)
        if block.look == "wide":
            self._end_section()
            self.is_wide = False

    def _write_items(self, block: Items) -> None:
        for number, item in enumerate(block.items, 1):
            runs = list_runs(item)
            if block.look == "numbered":
                self._add_paragraph((Run(f"{number}. "), *runs), styles.TEXT)
            else:
                self._add_paragraph(runs, styles.ITEM)

    def _open_contents(self, block: Contents) -> None:
        """Heading of the contents, and a line in whose place they come."""
        self._add_paragraph(list_runs(block.heading), styles.CONTENTS_HEADING)
        self._add_paragraph((), styles.CONTENTS)
        self.place_of_contents = self.document.element.body.sectPr.getprevious()

    def _write_heading(self, block: Heading) -> None:
        runs = list_runs(block.text)
        if block.level != 2:
            style = styles.TITLE if block.level == 1 else styles.SUBHEADING
            self._add_paragraph(runs, style)
            return
        number = len(self.headings) + 1
        mark = f"_Toc{number:08d}"
        self.headings.append((mark, "".join(one.text for one in runs)))
        marked = (
            f'<w:bookmarkStart w:id="{number}" w:name="{mark}"/>{write_runs(runs)}'
            f'<w:bookmarkEnd w:id="{number}"/>'
        )
        self._add(write_paragraph(marked, self._ids[styles.HEADING]))

    def _write_text(self, block: Paragraph) -> None:
        runs = list_runs(block.text)
        if block.look in _SMALL_LOOKS:
            runs = tuple(replace(one, is_small=True) for one in runs)
        self._add_paragraph(runs, _STYLES.get(block.look, styles.TEXT))

    def _write_table(self, table: Table) -> None:
        if table.rows:
            self._add_grid(table.caption, _list_cells(table))
            return
        told = table.empty
        if table.symbols:
            told = self.words("show.label", label=table.caption, text=told)
        self._write_text(Paragraph(text=told, look="none"))

    def _write_figure(self, block: Figure) -> None:
        self.pictures += 1
        most = (self.width_pt, _HIGHEST * self.height_pt)
        runs = write_picture(self.document, block.svg, self.pictures, most)
        look = "<w:keepNext/>" if block.caption else ""
        self._add(write_paragraph(runs, self._ids[styles.TEXT], look))
        if block.caption:
            self._add_paragraph(list_runs(block.caption), styles.SMALL)

    def _add(self, markup: str) -> None:
        """Put a paragraph or table at the end of the text."""
        self.document.element.body.sectPr.addprevious(parse(markup))

    def _end_section(self) -> None:
        """End of pages that stand upright, or across."""
        from docx.oxml.ns import qn

        page = deepcopy(self.document.element.body.sectPr)
        size = page.find(qn("w:pgSz"))
        if self.is_wide and size is not None:
            width, height = (size.get(qn(f"w:{one}")) for one in ("w", "h"))
            size.set(qn("w:w"), height)
            size.set(qn("w:h"), width)
            size.set(qn("w:orient"), "landscape")
        last = parse(write_paragraph("", self._ids[styles.SMALL]))
        last.get_or_add_pPr().append(page)
        self.document.element.body.sectPr.addprevious(last)

    def _add_paragraph(self, runs: Runs, style: str) -> None:
        self._add(write_paragraph(write_runs(runs), self._ids[style]))

    def _add_grid(self, caption: Text, grid: Grid) -> None:
        """Table below its caption; tables never touch, or a reader would join them."""
        runs = list_runs(caption)
        named = any(one.text for one in runs)
        self._add_paragraph(runs if named else (Run("\u00a0"),), styles.CAPTION)
        both = (self._ids[styles.TABLE], self._ids[styles.CELL])
        self._add(write_table(grid, both, self.width_pt))

    def _fill_contents(self) -> None:
        """Lines of the contents: a field that Word keeps up to date."""
        mark, last = self.place_of_contents, len(self.headings) - 1
        if mark is None:
            return
        for number, (name, text) in enumerate(self.headings):
            link = (
                f'<w:hyperlink w:anchor="{name}"><w:r><w:t xml:space="preserve">'
                f"{escape(make_printable(text))}</w:t></w:r></w:hyperlink>"
            )
            runs = (_OPEN_CONTENTS if number == 0 else "") + link
            runs += _field("end") if number == last else ""
            line = write_paragraph(runs, self._ids[styles.CONTENTS])
            mark.addprevious(parse(line))
        mark.getparent().remove(mark)


def _list_pairs(block: Pairs) -> Grid:
    return Grid(
        numbers=(False, False),
        lines=tuple(
            ((Run(pair.name, is_bold=True),), _list_pair(pair)) for pair in block.pairs
        ),
    )


def _list_pair(pair: Pair) -> Runs:
    runs = list_runs(pair.text)
    items = "\n".join(pair.items)
    if not items:
        return runs
    return (*runs, Run(f"\n{items}" if runs else items))


def _list_cells(table: Table) -> Grid:
    """Grid of a table."""
    of_headings = table.symbols == "headings"
    return Grid(
        headings=tuple(
            list_runs(column.heading, has_symbols=of_headings)
            for column in table.columns
        ),
        numbers=tuple(column.is_number for column in table.columns),
        lines=tuple(
            tuple(_list_cell(cell, table) for cell in cells) for cells in table.rows
        ),
    )


def _list_cell(cell: Cell, table: Table) -> Runs:
    """Text of a cell; that of a verdict is bold: its symbol comes first."""
    if cell.content:
        return list_runs(cell.content)
    if table.symbols == "cells":
        return (Run(cell.text, has_symbols=True),)
    starts = tuple(f"{one} " for one in _VERDICTS)
    is_verdict = cell.text in _VERDICTS or cell.text.startswith(starts)
    shown = cell.text.replace(" ", "\u00a0", int(is_verdict))
    return (Run(shown, is_bold=is_verdict),)


def _field(kind: str, more: str = "") -> str:
    return f'<w:r><w:fldChar w:fldCharType="{kind}"{more}/></w:r>'


def _instruct(text: str) -> str:
    return f'<w:r><w:instrText xml:space="preserve"> {text} </w:instrText></w:r>'


_OPEN_CONTENTS = (
    _field("begin", ' w:dirty="true"')
    + _instruct(r'TOC \o "1-1" \h \z')
    + _field("separate")
)


def write_field(instruction: str, shown: str = "") -> str:
    """Runs of a field that a word processor works out, as PAGE."""
    cached = f"<w:r><w:t>{escape(shown)}</w:t></w:r>" if shown else ""
    return (
        _field("begin")
        + _instruct(instruction)
        + _field("separate")
        + cached
        + _field("end")
    )
