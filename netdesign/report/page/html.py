"""Study -> one self-contained page: no script, no other file, ready for A4."""

from __future__ import annotations

from netdesign.report.blocks import link
from netdesign.report.page.render import render_page
from netdesign.report.sections.whole import build_report
from netdesign.report.what_if import mark_verdict, title_pages
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language


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
