"""Study -> blocks: one sequence, which page and document print."""

from __future__ import annotations

from netdesign.report.blocks.block import Block
from netdesign.report.drawing.row_drawings import draw_row
from netdesign.report.sections import site
from netdesign.report.sections.row import RowSections
from netdesign.report.view.whole import Detail, ReportView
from netdesign.report.words import Words
from netdesign.study.records import Study


def build_report(
    study: Study, view: ReportView, words: Words, detail: Detail
) -> tuple[Block, ...]:
    """Blocks of a report, from its title to its provenance.

    Parameters
    ----------
    study : Study
        What is shown.
    view : ReportView
        The same in words.
    words : Words
        Of the language.
    detail : str
        ``summary`` leaves out what only a reviewer of a net row needs; ``figures``
        unfolds all figures of the checks, so that paper has them too.
    """
    is_full, is_open = detail != "summary", detail == "figures"
    rows = (
        RowSections(
            shown, draw_row(row, shown.anchor, words, is_full=is_full), detail, words
        ).build()
        for row, shown in zip(study.rows, view.rows, strict=True)
    )
    return (
        site.show_title(view, words),
        site.show_verdict(view, words, is_full=is_full),
        site.list_contents(view, words, is_full=is_full),
        site.show_identification(view, words),
        site.show_summary(view, words),
        site.show_basis(view, words, is_full=is_full),
        *rows,
        *(site.show_annexes(view, words, is_open=is_open) if is_full else ()),
        *site.show_end(view, words),
    )
