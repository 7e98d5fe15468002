"""Study -> blocks: one sequence, which page and document print."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Any

from netdesign import addon_table
from netdesign.report.blocks import Block
from netdesign.report.sections import annexes, basis, decision, schedule, worked
from netdesign.report.sections.row import RowPage
from netdesign.report.what_if import title_pages
from netdesign.report.words import Words, show_text
from netdesign.study.records import Study


def build_report(
    study: Study,
    words: Words,
    *,
    has_annexes: bool = False,
    is_verified: bool = False,
) -> tuple[Block, ...]:
    """Blocks of a report: decision, schedule, basis, rows, worked checks.

    Parameters
    ----------
    study : Study
        What is shown.
    words : Words
        Of the language.
    has_annexes : bool
        All checks step by step, other laws, cases and profile follow.
    is_verified : bool
        The stored study was solved again in this run.
    """
    further = annexes.list_annexes(study, words) if has_annexes else ()
    return (
        decision.show_decision(study, words, is_verified=is_verified),
        schedule.show_schedule(study, words),
        basis.show_basis(study, words),
        *_list_rows(study, words),
        worked.show_governing(study, words),
        *further,
        *(
            part
            for show in addon_table.load_for_rows(addon_table.ANNEXES, study.rows)
            for part in show(study, words)
        ),
    )


def _list_rows(study: Study, words: Words) -> Iterator[Block]:
    shared = basis.share_notes(study, words)
    anchors = basis.anchor_rows(study)
    rows = {anchors[row.id]: row for row in reversed(study.rows)}
    for anchor in dict.fromkeys(anchors.values()):
        row = rows[anchor]
        ids = [name for name, place in anchors.items() if place == anchor]
        notes = dict.fromkeys(basis.list_row_notes(row, study, words))
        own = tuple(note for note in notes if note not in shared)
        yield RowPage(row, ids, anchor, words, own).build()


def list_properties(study: Study, words: Words) -> dict[str, Any]:
    """Properties of a file of the study; its start is in UTC without a zone."""
    time = datetime(1980, 1, 1)  # of a study that does not say
    if study.provenance.started:
        time = datetime.fromisoformat(study.provenance.started)
    return {
        "title": words("heading.anchor_check"),
        "subject": title_pages(study, words),
        "author": show_text(study.project.author),
        "created": time.astimezone(UTC).replace(tzinfo=None) if time.tzinfo else time,
    }
