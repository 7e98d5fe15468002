"""Blocks of which every report is made: page, document, and whatever prints next.

A block says what it is and where it stands; how that looks is the writer's. ``look``
names what a style sheet may set apart, ``on`` where the block is shown.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from netdesign.report.blocks.table import Medium, Table
from netdesign.report.blocks.text import Content, Text


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Heading of a level from 1; level 2 stands in the contents of a document."""

    text: Text
    level: int
    look: str = ""
    on: Medium = "all"


@dataclass(frozen=True, slots=True, kw_only=True)
class Paragraph:
    """Text."""

    text: Text
    look: str = ""
    on: Medium = "all"


@dataclass(frozen=True, slots=True, kw_only=True)
class Items:
    """List of sentences."""

    items: tuple[Text, ...]
    look: str = ""
    on: Medium = "all"


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Name, and what stands beside it: a text, and sentences below it."""

    name: str
    text: Text = ""
    items: tuple[str, ...] = ()
    look: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pairs:
    """Names with what stands beside them."""

    pairs: tuple[Pair, ...]
    look: str = ""
    on: Medium = "all"


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """Drawing of ours as SVG, with its caption below."""

    svg: str
    caption: Text = ""
    id: str = ""
    look: str = ""
    on: Medium = "all"


@dataclass(frozen=True, slots=True, kw_only=True)
class Contents:
    """Links to parts of the page by lines; a document lists its headings instead."""

    heading: str
    lines: tuple[Content, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """Blocks that belong together; a link leads to their ``id``.

    Those below a ``fold`` are out of sight until a reader opens it.
    """

    blocks: tuple[Block, ...]
    id: str = ""
    look: str = ""
    kind: Literal["section", "article", "header", "div"] = "section"
    fold: str = ""
    on: Medium = "all"


Block = Heading | Paragraph | Items | Pairs | Table | Figure | Contents | Part


def section(
    anchor: str,
    heading: str,
    *blocks: Block,
    level: int = 2,
    look: str = "",
    on: Medium = "all",
) -> Part:
    """Part of a page below a heading."""
    title = Heading(text=heading, level=level)
    return Part(id=anchor, look=look, on=on, blocks=(title, *blocks))


def masthead(kind: str, title: str, *more: Block) -> Part:
    """Kind and title of a page, and what stands with them."""
    first = (Paragraph(text=kind, look="kind"), Heading(text=title, level=1))
    return Part(kind="header", look="masthead", blocks=(*first, *more))


def notes(*sentences: Text, look: str = "notes") -> Part:
    """Sentences in a frame; ``notes open`` where they are a warning."""
    return Part(kind="div", look=look, blocks=(Items(items=sentences),))
