"""Study -> docx: the blocks of the page, from top to bottom, as it shows them on paper.

A drawing is SVG, with a PNG for programs that show none. It is named by svgBlip, an
extension of Word (described in Microsoft's Open Specification MS-ODRAWXML).
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from netdesign.edge.input_files import make_printable
from netdesign.report.blocks import (
    HIDDEN,
    STRONG,
    Block,
    Cell,
    Content,
    Figure,
    Figures,
    Heading,
    Items,
    Pairs,
    Paragraph,
    Part,
    Piece,
    Table,
    write_plain,
)
from netdesign.report.document import styles
from netdesign.report.document.markup import (
    KEEP,
    POINT,
    Grid,
    Runs,
    list_runs,
    parse,
    write_paragraph,
    write_runs,
    write_table,
)
from netdesign.report.drawing.raster import read_size, read_title, render_png
from netdesign.report.sections.whole import build_report, list_properties
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from docx.document import Document


_EMU = 12700  # of a point
_DRAWING = "http://schemas.openxmlformats.org/drawingml/2006"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006"
_SPACES = (
    f'xmlns:wp="{_DRAWING}/wordprocessingDrawing" xmlns:a="{_DRAWING}/main" '
    f'xmlns:pic="{_DRAWING}/picture" xmlns:r="{_OFFICE}/relationships"'
)
_SVG_SPACE = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
_SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"


def write_picture(
    document: Document, svg: str, number: int, most_pt: tuple[float, float]
) -> str:
    """Run with a drawing, as WordprocessingML; both files go into the document.

    Parameters
    ----------
    document : docx.document.Document
        Takes the files.
    svg : str
        Of ours.
    number : int
        Of the picture, from 1.
    most_pt : tuple of float
        Largest width and height; the drawing is made smaller, never larger [pt].
    """
    size = read_size(svg)
    scale = min(1.0, most_pt[0] / size[0], most_pt[1] / size[1])
    wide, high = (round(scale * side * _EMU) for side in size)
    png, _ = document.part.get_or_add_image(io.BytesIO(render_png(svg)))
    words = escape(make_printable(read_title(svg)))
    extent = f'cx="{wide}" cy="{high}"'
    return (
        f'<w:r><w:drawing {_SPACES}><wp:inline distT="0" distB="0" distL="0" distR="0">'
        f'<wp:extent {extent}/><wp:docPr id="{number}" name="Picture {number}" '
        f'descr="{words}"/><wp:cNvGraphicFramePr><a:graphicFrameLocks '
        f'noChangeAspect="1"/></wp:cNvGraphicFramePr><a:graphic><a:graphicData '
        f'uri="{_DRAWING}/picture"><pic:pic><pic:nvPicPr><pic:cNvPr id="{number}" '
        f'name="Picture {number}"/><pic:cNvPicPr/></pic:nvPicPr><pic:blipFill>'
        f'<a:blip r:embed="{png}"><a:extLst><a:ext uri="{_SVG_EXTENSION}">'
        f'<asvg:svgBlip xmlns:asvg="{_SVG_SPACE}" '
        f'r:embed="{_add_svg(document, svg, number)}"/></a:ext></a:extLst></a:blip>'
        f"<a:stretch><a:fillRect/></a:stretch></pic:blipFill><pic:spPr><a:xfrm>"
        f'<a:off x="0" y="0"/><a:ext {extent}/></a:xfrm><a:prstGeom prst="rect">'
        f"<a:avLst/></a:prstGeom></pic:spPr></pic:pic></a:graphicData></a:graphic>"
        f"</wp:inline></w:drawing></w:r>"
    )


def _add_svg(document: Document, svg: str, number: int) -> str:
    """Id of the relation to the drawing's own file."""
    from docx.opc.constants import RELATIONSHIP_TYPE
    from docx.opc.packuri import PackURI
    from docx.opc.part import Part

    name = PackURI(f"/word/media/drawing{number}.svg")
    part = Part(name, "image/svg+xml", svg.encode(), document.part.package)
    return document.part.relate_to(part, RELATIONSHIP_TYPE.IMAGE)


_SHEET = "sheet"  # look of a part that begins a page
_KEPT = ("row",)  # looks of parts that stand on one page if they can
_HIGHEST = 0.8  # of a page that a drawing may take
_BETWEEN = 6.0  # drawings in one line [pt]
_STYLES = {
    "kind": styles.SMALL,
    "meta": styles.SMALL,
    "word": styles.VERDICT,
}  # of looks; else plain text
_SMALL_LOOKS = ("small", "none", "key", "meaning")


@dataclass(kw_only=True)
class Writer:
    """Writes blocks into a document; text of anybody comes in as text alone."""

    document: Document
    words: Words
    pictures: int = 0
    begins_page: bool = False  # the next heading
    keeps: bool = False  # what is written now stays with what follows

    @property
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
        return {x: str(self.document.styles[x].style_id) for x in styles.NAMES}

    def write(self, blocks: Sequence[Block]) -> None:
        """All blocks."""
        for block in blocks:
            self._write_block(block)

    def _write_block(self, block: Block) -> None:
        if isinstance(block, Heading) and block.look == HIDDEN:
            return
        writers: dict[type, Callable[[Any], None]] = {
            Heading: self._write_heading,
            Paragraph: self._write_text,
            Items: self._write_items,
            Pairs: lambda pairs: self._add_grid((), _list_pairs(pairs)),
            Table: self._write_table,
            Figure: self._write_figure,
            Figures: self._write_figures,
            Part: self._write_part,
        }
        writers[type(block)](block)

    def _write_part(self, block: Part) -> None:
        self.begins_page = self.begins_page or _SHEET in block.look.split()
        begins = not self.keeps and (block.look in _KEPT or _is_worked(block))
        self.keeps = self.keeps or begins
        self.write(block.blocks)
        if begins:
            self._end_kept()

    def _end_kept(self) -> None:
        """Let the last lines of a kept part stand apart from what follows."""
        self.keeps = False
        last = self.document.element.body.sectPr.getprevious()
        line = last.findall(".//w:tr", last.nsmap)[-1] if _is_table(last) else last
        for kept in line.findall(".//w:keepNext", line.nsmap):
            kept.getparent().remove(kept)

    def _write_items(self, block: Items) -> None:
        for item in block.items:
            self._add_paragraph(list_runs(item), styles.ITEM)

    def _write_heading(self, block: Heading) -> None:
        names = {1: styles.TITLE, 2: styles.HEADING}
        style = names.get(block.level, styles.SUBHEADING)
        look = ""
        if block.level == 2 and self.begins_page:
            look = "<w:pageBreakBefore/>"
        runs = write_runs(list_runs(block.text))
        self._add(write_paragraph(runs, self._ids[style], look))
        self.begins_page = False

    def _write_text(self, block: Paragraph) -> None:
        is_small = True if block.look in _SMALL_LOOKS else None
        text = block.text
        if block.look == "meta" and isinstance(text, str):  # beside a title there
            text = " · ".join(text.split("\n"))
        runs = write_runs(list_runs(text), is_small=is_small)
        style = _STYLES.get(block.look, styles.TEXT)
        look = KEEP if self.keeps else ""
        self._add(write_paragraph(runs, self._ids[style], look))

    def _write_table(self, table: Table) -> None:
        if table.look == "ranges" and table.rows:  # short lines would fill the page
            self._write_text(Paragraph(text=_join_lines(table), look="small"))
        elif table.rows:
            of_headings = table.symbols == "headings"
            caption = list_runs(table.caption, has_symbols=of_headings)
            self._add_grid(caption, _list_cells(table))
        else:
            text = table.describe_empty(self.words)
            self._write_text(Paragraph(text=text, look="none"))

    def _write_figure(self, block: Figure) -> None:
        self._write_figures(Figures(figures=(block,)))

    def _write_figures(self, block: Figures) -> None:
        """Drawings in one line, smaller where that is too narrow; captions below."""
        sizes = [read_size(figure.svg) for figure in block.figures]
        room = self.width_pt - _BETWEEN * (len(sizes) - 1)
        share = min(1.0, room / sum(width for width, _ in sizes))
        runs = ""
        for figure, (width, _) in zip(block.figures, sizes, strict=True):
            self.pictures += 1
            most = (share * width, _HIGHEST * self.height_pt)
            runs += write_picture(self.document, figure.svg, self.pictures, most)
        captions = [figure.caption for figure in block.figures if figure.caption]
        look = KEEP if captions else ""
        self._add(write_paragraph(runs, self._ids[styles.TEXT], look))
        texts = tuple(
            x for figure in captions for x in (*list_runs(figure), Piece(" "))
        )
        if texts:
            look = KEEP if self.keeps else ""
            self._add(write_paragraph(write_runs(texts), self._ids[styles.SMALL], look))

    def _add(self, markup: str) -> None:
        """Put a paragraph or table at the end of the text."""
        self.document.element.body.sectPr.addprevious(parse(markup))

    def _add_paragraph(self, runs: Runs, style: str) -> None:
        look = KEEP if self.keeps else ""
        self._add(write_paragraph(write_runs(runs), self._ids[style], look))

    def _add_grid(self, caption: Runs, grid: Grid) -> None:
        """Table below its caption; tables never touch, or a reader would join them."""
        last = self.document.element.body.sectPr.getprevious()
        if (last is not None and _is_table(last)) or any(
            piece.text for piece in caption
        ):
            self._add_paragraph(caption or (Piece("\u00a0"),), styles.CAPTION)
        both = (self._ids[styles.TABLE], self._ids[styles.CELL])
        self._add(write_table(grid, both, self.width_pt, keeps=self.keeps))


def _is_worked(block: Part) -> bool:
    """A check that is worked out stands on one page."""
    return bool(block.id and block.id.startswith("worked-"))


def _is_table(element: Any) -> bool:
    return bool(element.tag.endswith("}tbl"))


def _list_pairs(block: Pairs) -> Grid:
    return Grid(
        numbers=(False, False),
        lines=tuple(
            ((Piece(pair.name, STRONG),), list_runs(pair.text)) for pair in block.pairs
        ),
    )


def _join_lines(table: Table) -> Content:
    """Lines of a table of names and values, one after the other."""
    joined: list[Piece] = []
    for name, value in table.rows:
        joined += [Piece(name.text, STRONG), Piece(f" {write_plain(value.content)}")]
        joined.append(Piece(" · "))
    return tuple(joined[:-1])


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
    if cell.content:
        return list_runs(cell.content)
    return (Piece(cell.text, has_symbols=table.symbols == "cells"),)


def write_field(instruction: str, shown: str = "") -> str:
    """Field that a word processor works out, as PAGE."""
    cached = f"<w:r><w:t>{escape(shown)}</w:t></w:r>" if shown else ""
    return f'<w:fldSimple w:instr=" {instruction} ">{cached}</w:fldSimple>'


def render_document(
    study: Study,
    language: Language = "en",
    *,
    has_annexes: bool = False,
    is_verified: bool = False,
) -> bytes:
    """Document of a study; the same study gives the same bytes.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    has_annexes : bool
        All checks step by step, other laws, cases and profile follow.
    is_verified : bool
        The stored study was solved again in this run.
    """
    words = Words(language)
    properties = list_properties(study, words)
    document = styles.open_document(language)
    to = Writer(document=document, words=words)
    _write_footer(to, properties["subject"])
    blocks = build_report(
        study, words, has_annexes=has_annexes, is_verified=is_verified
    )
    to.write(blocks)
    styles.set_properties(document, **properties)
    return styles.pack(document)


def _write_footer(to: Writer, running: str) -> None:
    """Running title, section and page."""
    document = to.document
    section: Any = document.sections[-1]
    section.footer.is_linked_to_previous = False
    paragraph = section.footer.paragraphs[0]
    paragraph.style = document.styles[styles.SMALL]
    right = round(POINT * to.width_pt)
    tab = "<w:r><w:tab/></w:r>"
    runs = (
        write_runs(list_runs(running))
        + tab
        + write_field("STYLEREF 1")
        + tab
        + write_field("PAGE", "1")
        + write_runs(list_runs(" / "))
        + write_field("NUMPAGES", "1")
    )
    look = (
        f'<w:tabs><w:tab w:val="center" w:pos="{right // 2}"/>'
        f'<w:tab w:val="right" w:pos="{right}"/></w:tabs>'
    )
    filled = parse(f"<w:p><w:pPr>{look}</w:pPr>{runs}</w:p>")
    named: Any = paragraph._p.get_or_add_pPr()
    named.append(filled[0][0])
    for run in list(filled)[1:]:
        paragraph._p.append(run)
