"""Study -> plain rows of strings: what every output shows.

The page and the terminal print these strings; the workbook writes the same
tables with the numbers behind them.
"""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from netdesign.outcome import Verdict
from netdesign.report.view import basis_tables, envelope_tables, row_tables, tables
from netdesign.report.view.check_view import (
    SEVERITY,
    CheckView,
    Worked,
    find_governing,
    find_highest,
    rank_check,
    view_check,
    work_out,
)
from netdesign.report.view.gate import require_consistent
from netdesign.report.view.table import Table
from netdesign.report.words import (
    VERDICTS,
    VerdictWords,
    name_case,
    name_member,
    show_quantity,
    show_text,
)
from netdesign.study.records import ProfileRecord, RowStudy, Study, compute_digest

VERIFY = "netdesign verify"
EXPLANATION = (
    "It solves every case again and compares every value with the study; that ends "
    "with exit code 0 only where nothing differs. Another SHA-256 than this one: the "
    "study is not that of this report, or was altered."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class RowView:
    """One net row in words."""

    anchor: str  # place in the page
    id: str
    verdict: VerdictWords
    counts: str
    governing: CheckView | None
    highest: CheckView | None  # largest utilisation, where that does not govern
    reasons: tuple[str, ...]
    checks: tuple[CheckView, ...]
    worked: Worked | None
    drawn_case: str
    unloaded: str  # members left out of the envelope figure, or ""
    extremes: Table
    searched: str  # how the envelope was found; "" of a grid of cases
    bounds: Table
    drivers: Table
    failed: Table
    inputs: Table
    anchors: Table
    head: Table
    spreads: Table
    changes: Table
    flips: tuple[str, ...]  # the same for the governing check, in short
    independent: Table
    guideline: Table
    guideline_sentence: str
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportView:
    """A whole study in words."""

    identification: tuple[tuple[str, str], ...]
    prepared: str
    checked: str
    revision: str
    date: str
    running_title: str
    verdict: VerdictWords
    verification: tuple[tuple[str, str], ...]  # how a reader finds whether it is true
    governing_row: RowView | None
    counts: tuple[tuple[str, str], ...]
    assumed: Table
    assumed_line: str
    scope: tuple[str, ...]
    assumptions: Table
    checklist: Table
    rows: tuple[RowView, ...]
    ranges: Table
    profile_title: str
    profile: Table
    notes: tuple[str, ...]
    quality: Table
    outcomes: Table
    provenance: Table


def build_view(study: Study) -> ReportView:
    """Everything that the outputs print about ``study``.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    require_consistent(study)
    project = study.project
    assumed = tables.build_profile(study, tables.ASSUMED)
    rows = tuple(_view_row(row, number) for number, row in enumerate(study.rows, 1))
    return ReportView(
        identification=_identify(study),
        prepared=_name_person(project.author),
        checked=_name_person(project.checker),
        revision=show_text(project.revision),
        date=show_text(study.provenance.started[:10]),
        running_title=" · ".join(
            show_text(text)
            for text in (project.number, project.name, project.revision)
            if text
        ),
        verdict=VERDICTS[study.verdict],
        verification=_tell_verification(study),
        governing_row=_find_governing_row(study, rows),
        counts=_count_all(study),
        assumed=assumed,
        assumed_line=_list_assumed(study.profile),
        scope=basis_tables.SCOPE,
        assumptions=basis_tables.build_assumptions(study),
        checklist=basis_tables.build_checklist(study),
        rows=rows,
        ranges=tables.build_inputs(study.range_inputs, "Ranges of the envelope"),
        profile_title=show_text(f"{study.profile.title}, {study.profile.edition}"),
        profile=tables.build_profile(study),
        notes=tuple(show_text(str(note)) for note in study.notes),
        quality=tables.build_quality(study),
        outcomes=tables.build_outcomes(study),
        provenance=tables.build_provenance(study),
    )


def _find_governing_row(study: Study, views: Sequence[RowView]) -> RowView | None:
    def rank(index: int) -> tuple[int, tuple[int, float]]:
        row = study.rows[index]
        governing = find_governing(row.checks)
        return (
            SEVERITY.index(row.verdict),
            rank_check(governing) if governing else (len(SEVERITY), 0.0),
        )

    best = min(range(len(views)), key=rank, default=None)
    return None if best is None else views[best]


def _view_row(row: RowStudy, number: int) -> RowView:
    governing, highest = find_governing(row.checks), find_highest(row.checks)
    shown = governing if governing and governing.utilisation is not None else highest
    return RowView(
        anchor=f"row-{number}",
        id=show_text(row.id),
        verdict=VERDICTS[row.verdict],
        counts=_count_verdicts(check.verdict for check in row.checks),
        governing=view_check(governing) if governing else None,
        highest=view_check(highest) if highest and highest != governing else None,
        reasons=_name_reasons(row),
        checks=tuple(view_check(check) for check in row.checks),
        worked=work_out(shown) if shown else None,
        drawn_case=name_case(row.drawing.case if row.drawing else None),
        unloaded=_name_unloaded(row),
        extremes=tables.build_extremes(row),
        searched=envelope_tables.describe_search(row),
        bounds=envelope_tables.build_bounds(row),
        drivers=envelope_tables.build_drivers(row),
        failed=tables.build_failed(row),
        inputs=tables.build_inputs(row.inputs, "Inputs, with the cell of each"),
        anchors=row_tables.build_anchors(row),
        head=row_tables.build_head(row),
        spreads=row_tables.build_spreads(shown),
        changes=row_tables.build_changes(row),
        flips=row_tables.list_flips(governing),
        independent=row_tables.build_independent(row),
        guideline=row_tables.build_guideline(row),
        guideline_sentence=str(row.guideline.sentence) if row.guideline else "",
        notes=tuple(show_text(str(note)) for note in row.notes),
    )


def _name_reasons(row: RowStudy) -> tuple[str, ...]:
    """Reasons of a row, each under the name of its check instead of its key."""
    return tuple(show_text(str(reason)) for reason in row.reasons)


def _name_unloaded(row: RowStudy) -> str:
    loaded = tables.list_loaded(row)
    names = [name_member(member) for member in tables.MEMBERS if member not in loaded]
    return f"Without force in every case: {', '.join(names)}." if names else ""


def _name_person(name: str) -> str:
    """Name, or room to write one."""
    return show_text(name) if name.strip() else ""


def _identify(study: Study) -> tuple[tuple[str, str], ...]:
    project = study.project
    pairs = (
        ("Project", project.name),
        ("Number", project.number),
        ("Revision", project.revision),
        ("Limit profile", f"{study.profile.title}, {study.profile.edition}"),
        ("Site file", study.provenance.site_file),
        ("Date", study.provenance.started[:10]),
    )
    return tuple((label, show_text(text)) for label, text in pairs)


def _tell_verification(study: Study) -> tuple[tuple[str, str], ...]:
    """Command that shows whether a report is true, and what ties it to its study."""
    site = study.provenance.site_file
    is_built_in = " --example" in study.provenance.command  # verify has it too
    named = f" --site {shlex.quote(site)}" if site and not is_built_in else ""
    return (
        ("To verify this report", show_text(f"{VERIFY} --study study.json{named}")),
        ("What that does", EXPLANATION),
        ("SHA-256 of its study", compute_digest(study)),
    )


def _count_verdicts(verdicts: Iterable[Verdict]) -> str:
    counts = Counter(verdicts)
    words = [
        f"{counts[verdict]} {VERDICTS[verdict].word}"
        for verdict in SEVERITY
        if counts[verdict]
    ]
    return ", ".join(words) or "none"


def _count_all(study: Study) -> tuple[tuple[str, str], ...]:
    cases = sum(len(row.cases) for row in study.rows)
    failed = sum(len(tables.list_failed(row)) for row in study.rows)
    return (
        ("Net rows", _count_verdicts(row.verdict for row in study.rows)),
        (
            "Checks",
            _count_verdicts(c.verdict for row in study.rows for c in row.checks),
        ),
        ("Cases", f"{cases - failed} solved, {failed} without a result"),
    )


def _list_assumed(profile: ProfileRecord) -> str:
    assumed = [v for v in profile.values if v.status == tables.ASSUMED]
    names = [f"{v.id} = {show_quantity(v.value, v.unit)}" for v in assumed]
    return ", ".join(show_text(name) for name in names)
