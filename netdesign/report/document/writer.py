"""Document that is written from top to bottom: headings, text, tables, drawings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from netdesign.edge.given_files import make_printable
from netdesign.report.document import styles
from netdesign.report.document.content import (
    Content,
    Grid,
    Piece,
    list_cells,
    small,
)
from netdesign.report.document.markup import (
    parse,
    write_paragraph,
    write_runs,
    write_table,
)
from netdesign.report.document.picture import write_picture
from netdesign.report.view.table import Table
from netdesign.report.words import Words

if TYPE_CHECKING:
    from docx.document import Document

_EMU = 12700  # of a point
_HIGHEST = 0.8  # of a page that a drawing may take


@dataclass(kw_only=True)
class Writer:
    """Writes into a document; text of anybody comes in as text alone."""

    document: Document
    words: Words
    headings: list[tuple[str, str]] = field(default_factory=list)  # mark and text
    pictures: int = 0

    @cached_property
    def width_pt(self) -> float:
        """Width between the margins [pt]."""
        page: Any = self.document.sections[-1]
        return float(page.page_width - page.left_margin - page.right_margin) / _EMU

    @cached_property
    def height_pt(self) -> float:
        """Height between the margins [pt]."""
        page: Any = self.document.sections[-1]
        return float(page.page_height - page.top_margin - page.bottom_margin) / _EMU

    @cached_property
    def _ids(self) -> dict[str, str]:
        return {name: styles.find_id(self.document, name) for name in styles.NAMES}

    def add(self, markup: str) -> None:
        """Put a paragraph or table at the end of the text."""
        self.document.element.body.sectPr.addprevious(parse(markup))

    def paragraph(self, content: Content, style: str = styles.TEXT) -> None:
        """Text in a style."""
        self.add(write_paragraph(write_runs(content), self._ids[style]))

    def text(self, text: str, style: str = styles.TEXT) -> None:
        """Plain text in a style; nothing for an empty one."""
        if text:
            self.paragraph((Piece(text),), style)

    def heading(self, content: Content) -> None:
        """Heading that stands in the contents."""
        mark = f"_Toc{len(self.headings) + 1:08d}"
        number = len(self.headings) + 1
        self.headings.append((mark, "".join(piece.text for piece in content)))
        runs = (
            f'<w:bookmarkStart w:id="{number}" w:name="{mark}"/>{write_runs(content)}'
            f'<w:bookmarkEnd w:id="{number}"/>'
        )
        self.add(write_paragraph(runs, self._ids[styles.HEADING]))

    def subheading(self, key: str) -> None:
        """Heading of a part of a section, by its key."""
        self.text(self.words(key), styles.SUBHEADING)

    def items(self, texts: Sequence[str]) -> None:
        """List of sentences."""
        for text in texts:
            self.text(text, styles.ITEM)

    def none(self, text: str) -> None:
        """Line that stands where there is nothing to show."""
        self.paragraph(small([text]))

    def grid(self, grid: Grid) -> None:
        """Table below its caption; tables never touch, or a reader would join them."""
        self.text(grid.caption or "\u00a0", styles.CAPTION)
        if not grid.lines:
            return
        both = (self._ids[styles.TABLE], self._ids[styles.CELL])
        self.add(write_table(grid, both, self.width_pt))

    def table(self, table: Table, *, hidden: str = "") -> None:
        """Table of the report, or why it is empty."""
        grid = list_cells(table, hidden=hidden)
        if grid.lines:
            self.grid(grid)
        else:
            self.none(table.empty)

    def figure(self, svg: str, caption: str = "") -> None:
        """Drawing with its caption below."""
        self.pictures += 1
        most = (self.width_pt, _HIGHEST * self.height_pt)
        runs = write_picture(self.document, svg, self.pictures, most)
        look = "<w:keepNext/>" if caption else ""
        self.add(write_paragraph(runs, self._ids[styles.TEXT], look))
        self.text(caption, styles.SMALL)

    def contents(self, mark: Any) -> None:
        """Fill in the contents before ``mark``: a field that Word keeps up to date."""
        last = len(self.headings) - 1
        for number, (name, text) in enumerate(self.headings):
            link = (
                f'<w:hyperlink w:anchor="{name}"><w:r><w:t xml:space="preserve">'
                f"{escape(make_printable(text))}</w:t></w:r></w:hyperlink>"
            )
            runs = (_OPEN_CONTENTS if number == 0 else "") + link
            runs += _field("end") if number == last else ""
            line = write_paragraph(runs, self._ids[styles.CONTENTS])
            mark.addprevious(parse(line))


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
