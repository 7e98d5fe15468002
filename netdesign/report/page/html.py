"""Study -> one self-contained page: no script, no other file, ready for A4."""

from __future__ import annotations

from typing import TYPE_CHECKING

from netdesign.report.blocks import link
from netdesign.report.page.render import render_page
from netdesign.report.sections.whole import (
    Detail,
    build_report,
    title_pages,
)
from netdesign.report.what_if import mark_verdict
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

if TYPE_CHECKING:
    from netdesign.files.rows_map import RowsMap

# Its names are read on paper and on a telephone, and seen to be links.
_OF_MAP = """
#map a text { text-decoration: underline; }
@media screen and (max-width: 620px) { #map figure svg { width: 640px; } }
@media print { #map figure svg { width: 100%; } }
"""


def render_html(
    study: Study,
    language: Language = "en",
    detail: Detail = "full",
    places: RowsMap | None = None,
    *,
    is_verified: bool = False,
) -> str:
    """Page of a study.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    detail : str
        ``summary`` leaves out the pages of net rows and the annexes.
    places : RowsMap, optional
        Net rows in plan, for a map of them.
    is_verified : bool
        The stored study was solved again in this run.
    """
    words = Words(language)
    running = title_pages(study, words)
    title = (mark_verdict(study, words).word, words("heading.anchor_check"), running)
    blocks = build_report(study, words, detail, places, is_verified=is_verified)
    return render_page(
        blocks,
        " - ".join(title),
        language,
        skip=link("todo", words("heading.skip_to_todo")),
        style=f"@page {{ @bottom-left {{ content: {_quote_css(running)}; }} }}"
        + (_OF_MAP if places else ""),
        is_report=True,
    )


def _quote_css(text: str) -> str:
    """CSS string in which every sign that could end it is a code."""
    safe = "".join(
        sign if sign.isascii() and sign.isalnum() else f"\\{ord(sign):06x}"
        for sign in text
    )
    return f'"{safe}"'
