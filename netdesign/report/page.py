"""Blocks -> one self-contained page: no script, no other file, all text escaped.

The page of a study is ready for A4.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from markupsafe import Markup, escape

from netdesign.edge.input_files import find_resource, make_printable
from netdesign.report.blocks import (
    CODE,
    STRONG,
    Badge,
    Block,
    Cell,
    Column,
    Content,
    Pair,
    Piece,
    Sketch,
    Table,
    Text,
    link,
    list_pieces,
)
from netdesign.report.sections.whole import build_report
from netdesign.report.what_if import mark_verdict, title_pages
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    import jinja2

_LOWERED = re.compile(r"_(\w+)")
_MARKS = re.compile("[&<>'\"\n]")  # what HTML has another sign for
_REPORT, _STUDY = ("report.css",), ("report.css", "study.css")


def render_html(
    study: Study,
    language: Language = "en",
    *,
    has_annexes: bool = False,
    is_verified: bool = False,
) -> str:
    """Page of a study.

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
    running = title_pages(study, words)
    title = (mark_verdict(study, words).word, words("heading.anchor_check"), running)
    blocks = build_report(
        study, words, has_annexes=has_annexes, is_verified=is_verified
    )
    return render_page(
        blocks,
        " - ".join(title),
        language,
        skip=link("todo", words("heading.skip_to_todo")),
        style=f"@page {{ @bottom-left {{ content: {_quote_css(running)}; }} }}",
        is_report=True,
    )


def _quote_css(text: str) -> str:
    """CSS string in which every sign that could end it is a code."""
    safe = "".join(
        sign if sign.isascii() and sign.isalnum() else f"\\{ord(sign):06x}"
        for sign in text
    )
    return f'"{safe}"'


def render_page(
    blocks: Sequence[Block],
    title: str,
    language: Language,
    *,
    skip: Content = (),
    style: str = "",
    is_report: bool = False,
) -> str:
    """Page of some blocks.

    Parameters
    ----------
    blocks : sequence of Block
        From top to bottom.
    title : str
        Of the window.
    language : str
        Of the texts.
    skip : tuple, optional
        Link by which the keyboard gets to the contents.
    style : str
        Rules of this page alone; no typed text may stand here.
    is_report : bool
        The page is a study's report, and has no looks of other pages.
    """
    css = load_style(*(_REPORT if is_report else _STUDY))
    page = (
        build_environment(language)
        .get_template("page.html")
        .render(
            blocks=blocks,
            title=title,
            language=language,
            skip=skip,
            css=css + Markup(style),
        )
    )
    return make_printable(page.lstrip())


@lru_cache(maxsize=8)
def build_environment(language: Language = "en") -> jinja2.Environment:
    """Templates in which all text is escaped and a missing value is an error.

    Kept with what they compile to: a check against several profiles has several pages.
    """
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(find_resource("templates")),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        optimized=False,  # takes longer than it saves in a page or two
    )
    words = Words(language)
    points = tuple(words("page.breaks").split())
    environment.filters |= {
        "kind": lambda block: type(block).__name__,
        "looks": _name_looks,
        "inline": write_inline,
        "drawing": Markup,
        "mark": _mark_column,
        # every row has the same headings
        "heading": lru_cache(maxsize=512)(partial(_write_heading, points)),
        "line": write_line,
        "empty": partial(_describe_empty, words),
    }
    return environment


def _name_looks(block: Block | Pair, look: str = "") -> Markup:
    """Attribute with the classes of a block; "" without any."""
    named = look or getattr(block, "look", "")
    return Markup(' class="{}"').format(named) if named else Markup("")


def write_inline(text: Text, has_symbols: bool = False) -> Markup:
    """Text of a block as HTML."""
    pieces = list_pieces(text, has_symbols=has_symbols)
    return Markup("").join(_write_piece(piece) for piece in pieces)


def _write_piece(piece: Piece | Badge | Sketch) -> Markup:
    if isinstance(piece, Sketch):
        return Markup(piece.svg)
    if isinstance(piece, Badge):
        return _write_badge(piece)
    text = write_subscripts(piece.text) if piece.has_symbols else escape(piece.text)
    text = text.replace("\n", Markup("<br>"))
    if piece.link:
        text = Markup('<a href="#{}">{}</a>').format(piece.link, text)
    if piece.look in (STRONG, CODE):
        return Markup("<{0}>{1}</{0}>").format(piece.look, text)
    if piece.look:
        return Markup('<span class="{}">{}</span>').format(piece.look, text)
    return text


def _write_badge(badge: Badge) -> Markup:
    """Verdict: its symbol says the same as its word to who sees it."""
    shown = badge.verdict
    if badge.look == "sign":
        form = (
            '<span class="sign-of {}" aria-hidden="true">{}</span>'
            '<span class="hidden">{}</span> '
        )
        return Markup(form).format(shown.style, shown.symbol, shown.word)
    inside = Markup('<span aria-hidden="true">{}</span>{}{}').format(
        shown.symbol, " " if badge.look == "word" else "\u00a0", shown.word
    )
    if badge.look == "word":
        return inside
    return Markup('<span class="badge {}">{}</span>').format(shown.style, inside)


def write_subscripts(symbols: str) -> Markup:
    """``E_d`` with a lowered d; everything else is escaped."""
    shown = str(escape(symbols))
    return Markup(_LOWERED.sub(r"<sub>\1</sub>", shown) if "_" in shown else shown)


def write_line(cells: Sequence[Cell], table: Table) -> Markup:
    """Row of a table; the first cell names it.

    A template that writes cell by cell takes three times as long, and a page has
    20,000 of them.
    """
    if len(cells) == 1 < len(table.columns):
        form = '<tr class="more"><td colspan="{}">{}</td></tr>'
        return Markup(form).format(len(table.columns), _write_cell(cells[0], table))
    is_card = "cards" in table.look
    looks = [
        f"{_mark_column(column)}{_name_cell(column) if is_card else ''}>"
        for column in table.columns
    ]
    texts = [_write_cell(cell, table) for cell in cells]
    written = [
        f"<td{look}{text}</td>" for look, text in zip(looks[1:], texts[1:], strict=True)
    ]
    first = f'<th scope="row"{looks[0]}{texts[0]}</th>' if texts[0] else "<td></td>"
    return Markup(f"<tr>{first}{''.join(written)}</tr>")


def _name_cell(column: Column) -> Markup:
    """Heading of a cell, for screens on which its column has none."""
    heading = column.heading.replace("\n", " ").replace("_", "")
    return Markup(' data-h="{}"').format(heading)


def _write_cell(cell: Cell, table: Table) -> str:
    if cell.content:
        return write_inline(cell.content)
    if table.symbols == "cells":
        return write_subscripts(cell.text)
    return write_inline(cell.text) if _MARKS.search(cell.text) else cell.text


def _mark_column(column: Column) -> Markup:
    """Class of a column: ``n`` of numbers."""
    return Markup(' class="n"') if column.is_number else Markup("")


def _write_heading(points: tuple[str, ...], heading: str, has_symbols: bool) -> Markup:
    """Heading whose long words may be broken at their joints, in narrow columns.

    Not every browser knows the hyphens of a language; without them it would break a
    word anywhere.
    """
    shown = str(write_inline(heading, has_symbols))
    for point in () if has_symbols else points:
        shown = shown.replace(point.replace("|", ""), point.replace("|", "&shy;"))
    return Markup(shown)


def _describe_empty(words: Words, table: Table) -> Markup:
    text = table.describe_empty(words)
    return write_subscripts(text) if table.symbols else escape(text)


def load_style(*names: str) -> Markup:
    """Style sheets of the templates, one after the other."""
    folder = find_resource("templates")
    return Markup("\n".join((folder / n).read_text(encoding="utf-8") for n in names))
