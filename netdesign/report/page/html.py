"""Study -> one self-contained page: no script, no other file, ready for A4."""

from __future__ import annotations

from netdesign.report.blocks.text import link
from netdesign.report.page.render import render_page
from netdesign.report.sections.whole import build_report
from netdesign.report.view.gate import require_sections
from netdesign.report.view.whole import Detail, ReportView, build_view
from netdesign.report.words import Words
from netdesign.study.records import Study
from netdesign.words.catalogue import Language

_PAGE_SECTIONS = (
    "verdict",
    "identification",
    "summary",
    "scope",
    "ranges",
    "notes",
    "checklist",
    "provenance",
)
_FULL_SECTIONS = ("assumptions", "formulas", "profile", "quality")
_SUMMARY_SECTIONS = ("drawing", "checks", "changes")
_ROW_SECTIONS = (
    *_SUMMARY_SECTIONS,
    "worked",
    "figures",
    "uncertainty",
    "envelope",
    "extremes",
    "failed",
    "support",
    "independent",
    "inputs",
)


def render_html(
    study: Study,
    language: Language = "en",
    detail: Detail = "full",
    view: ReportView | None = None,
) -> str:
    """Page of a study: complete, or an error.

    Parameters
    ----------
    study : Study
        What is shown.
    language : str
        ``en``, ``fr`` or ``de``.
    detail : str
        ``summary`` leaves out what only a reviewer of a net row needs; ``figures``
        unfolds all figures of the checks, so that paper has them too.
    view : ReportView, optional
        Of this study in this language, where it is there already.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers or a section would be missing.
    """
    words = Words(language)
    view = view or build_view(study, language)
    title = (view.verdict.word, words("heading.anchor_check"), view.running_title)
    running = _quote_css(view.running_title)
    page = render_page(
        build_report(study, view, words, detail),
        " - ".join(title),
        language,
        skip=link("summary", words("heading.skip_to_summary")),
        style=f"@page {{ @bottom-left {{ content: {running}; }} }}",
        is_report=True,
    )
    require_sections(page, list_sections(view, detail))
    return page


def list_sections(view: ReportView, detail: Detail = "full") -> list[str]:
    """Ids of all sections that a page of ``view`` must have."""
    is_full = detail != "summary"
    wanted = _ROW_SECTIONS if is_full else _SUMMARY_SECTIONS
    of_page = (*_PAGE_SECTIONS, *_FULL_SECTIONS) if is_full else _PAGE_SECTIONS
    of_rows = [f"{row.anchor}-{name}" for row in view.rows for name in wanted]
    if is_full:
        of_rows += [f"{row.anchor}-panel" for row in view.rows if row.panel]
    return [*of_page, *of_rows]


def _quote_css(text: str) -> str:
    """CSS string in which every sign that could end it is a code."""
    safe = "".join(
        sign if sign.isascii() and sign.isalnum() else f"\\{ord(sign):06x}"
        for sign in text
    )
    return f'"{safe}"'
