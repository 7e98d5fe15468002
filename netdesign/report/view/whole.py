"""Study -> plain rows of strings: what every output shows.

The page and the terminal print these strings; the workbook writes the same
tables with the numbers behind them.
"""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Container, Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Literal

from netdesign.checks.result import tell_proof
from netdesign.outcome import Verdict
from netdesign.report.blocks.table import Table
from netdesign.report.view import (
    basis_tables,
    end_tables,
    envelope_tables,
    figure_tables,
    formula_tables,
    hold_tables,
    opinion_tables,
    panel_tables,
    row_tables,
    site_tables,
    statics_tables,
    tables,
    what_if,
)
from netdesign.report.view.check_lines import (
    CheckLine,
    choose_lines,
    list_lines,
    list_requirements,
)
from netdesign.report.view.check_view import (
    SEVERITY,
    CheckView,
    find_governing,
    find_highest,
    find_shown,
    pick_view,
    rank_check,
    view_check,
)
from netdesign.report.view.gate import require_consistent
from netdesign.report.view.steps import Worked, work_out
from netdesign.report.words import (
    VerdictWords,
    Words,
    show_check,
    show_member,
    show_text,
    show_verdict,
)
from netdesign.site.model import Project
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.document import compute_digest
from netdesign.study.records import RowStudy, Study
from netdesign.words.catalogue import Language

VERIFY = "netdesign verify"
_FACTORS = ("action", "resistance")  # subjects whose values stand on the first page
_FEW = 3  # values of another subject that still do
# Of the page: the least, all, and all with every figure of the checks unfolded.
Detail = Literal["summary", "full", "figures"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Figures:
    """Tables of all figures of a row's checks."""

    statics: Table
    floor_statics: Table
    sideways: Table
    widths: Table
    actions: Table
    panel_actions: Table
    checks: Table
    resistances: Table
    tests: Table
    turns: Table


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
    lines: tuple[CheckLine, ...]  # those of forces, inside and end beside each other
    main_lines: tuple[CheckLine, ...]  # those that do not pass, and the most used
    requirements: tuple[CheckView, ...]  # those without a force
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
    pulls: Table
    head: Table
    spreads: Table
    changes: Table
    holds: Table
    held: tuple[str, ...]  # the same for the governing check, in short
    flips: tuple[str, ...]  # the same for the governing check, in short
    independent: Table
    laws_met: str  # how many of those are met, where all of them are; else ""
    guideline: Table
    guideline_sentence: str
    floor: Table
    floor_governs: bool  # in a check at least
    slab: Table
    slab_line: str  # the same in short; "" without
    model_form: Table
    model_form_line: str  # "" where nothing governs
    figures: Figures
    panel: panel_tables.PanelView | None
    end_effects: Table
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
    mark: str  # of a what-if; "" of a site as built
    what_if: Table
    verification: tuple[tuple[str, str], ...]  # how a reader can verify the report
    governing_row: RowView | None
    counts: tuple[tuple[str, str], ...]
    declared: tuple[str, ...]  # checks that are said to be proven elsewhere
    assumed: Table
    assumed_line: str
    defaults_line: str  # inputs that nobody typed, or ""
    scope: tuple[str, ...]
    assumptions: Table
    checklist: Table
    matrix: Table  # rows by members
    site_inputs: tuple[Table, ...]  # of all rows, some beside each other
    rows: tuple[RowView, ...]
    ranges: Table
    profile_title: str
    profile: Table
    numbered_profile: Table  # the same, with numbers for sources that recur
    sources: tuple[str, ...]  # those sources, each with its number
    notes: tuple[str, ...]
    shared_notes: tuple[str, ...]  # of several rows, each with the rows it is about
    formulas: Table
    figure_tables: Table  # what each of a row's tables of figures holds
    quality: Table
    outcomes: Table
    legend: str  # of the numbers of a case
    reading: tuple[str, ...]  # what is said once of all rows
    provenance: Table


def build_view(study: Study, language: Language = "en") -> ReportView:
    """Everything that the outputs print about ``study``, in a language.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers.
    """
    require_consistent(study)
    words, project = Words(language), study.project
    assumed = tables.build_profile(study, words, tables.ASSUMED)
    profile = tables.build_profile(study, words)
    numbered, sources = tables.number_sources(profile)
    shared = _share_notes(study, words)
    rows = tuple(
        _view_row(row, number, words, shared)
        for number, row in enumerate(study.rows, 1)
    )
    return ReportView(
        identification=_identify(study, words),
        prepared=_name_person(project.author),
        checked=_name_person(project.checker),
        revision=show_text(project.revision),
        date=show_text(study.provenance.started[:10]),
        running_title=what_if.mark_title(study, _title_pages(project), words),
        verdict=what_if.mark_verdict(study, words),
        mark=words("what_if.mark") if study.what_if else "",
        what_if=what_if.build_what_if(study, words),
        verification=_tell_verification(study, words),
        governing_row=_find_governing_row(study, rows),
        counts=_count_all(study, words),
        declared=_list_declared(study, words),
        assumed=assumed,
        assumed_line=_list_assumed(study, words),
        defaults_line=basis_tables.list_defaults(study, words),
        scope=basis_tables.list_scope(words),
        assumptions=basis_tables.build_assumptions(study, words),
        checklist=basis_tables.build_checklist(study, words),
        matrix=site_tables.build_matrix(study, words),
        site_inputs=site_tables.build_site_inputs(study, words),
        rows=rows,
        ranges=tables.build_inputs(
            study.range_inputs, words("heading.ranges_of_envelope"), words
        ),
        profile_title=tables.name_profile(study, words),
        profile=profile,
        numbered_profile=numbered,
        sources=sources,
        notes=_list_notes(study, words),
        shared_notes=tuple(
            words("show.label", label=", ".join(ids), text=note)
            for note, ids in shared.items()
        ),
        formulas=formula_tables.build_formulas(words),
        figure_tables=formula_tables.build_holding(words),
        quality=tables.build_quality(study, words),
        outcomes=tables.build_outcomes(study, words),
        legend=basis_tables.name_cases(study, words),
        reading=basis_tables.list_reading(study, words),
        provenance=tables.build_provenance(study, words),
    )


def _title_pages(project: Project) -> str:
    """Line that runs along with the pages of a print."""
    texts = (project.number, project.name, project.revision)
    return " · ".join(show_text(text) for text in texts if text)


def _list_notes(study: Study, words: Words) -> tuple[str, ...]:
    """Notes on the whole study, and factors of its profile below one."""
    own = (words.show(note) for note in study.notes)
    return (*own, *tables.list_below_one(study.profile, words))


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


def _share_notes(study: Study, words: Words) -> dict[str, list[str]]:
    """Notes that several rows have, word by word, with the rows: told once."""
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        for note in dict.fromkeys(words.show(note) for note in row.notes):
            rows.setdefault(note, []).append(show_text(row.id))
    return {note: ids for note, ids in rows.items() if len(ids) > 1}


def _view_row(
    row: RowStudy, number: int, words: Words, told: Container[str]
) -> RowView:
    """One row in words, but for the notes that are ``told`` elsewhere."""
    governing, highest = find_governing(row.checks), find_highest(row.checks)
    checks = tuple(view_check(check, words) for check in row.checks)
    shown, lines = find_shown(row), list_lines(row.checks, words, checks)
    return RowView(
        anchor=f"row-{number}",
        id=show_text(row.id),
        verdict=show_verdict(row.verdict, words),
        counts=_count_verdicts((check.verdict for check in row.checks), words),
        governing=pick_view(governing, row.checks, checks),
        highest=pick_view(highest, row.checks, checks)
        if highest != governing
        else None,
        reasons=tuple(words.show(reason) for reason in row.reasons),
        checks=checks,
        lines=lines,
        main_lines=choose_lines(lines),
        requirements=list_requirements(row.checks, words, checks),
        worked=work_out(shown, words) if shown else None,
        drawn_case=words.name_case(row.drawing.case if row.drawing else None),
        unloaded=_name_unloaded(row, words),
        extremes=tables.build_extremes(row, words),
        searched=envelope_tables.describe_search(row, words),
        bounds=envelope_tables.build_bounds(row, words),
        drivers=envelope_tables.build_drivers(row, words),
        failed=tables.build_failed(row, words),
        inputs=tables.build_inputs(
            row.inputs, words("heading.inputs_with_cells"), words
        ),
        anchors=row_tables.build_anchors(row, words),
        pulls=row_tables.build_pulls(row, words),
        head=row_tables.build_head(row, words),
        spreads=row_tables.build_spreads(shown, words),
        changes=row_tables.build_changes(row, words),
        holds=hold_tables.build_holds(row, words),
        held=hold_tables.list_limits(governing, words),
        flips=row_tables.list_flips(governing, words),
        independent=row_tables.build_independent(row, words),
        laws_met=_count_laws(row, words),
        guideline=row_tables.build_guideline(row, words),
        guideline_sentence=words.show(row.guideline.sentence) if row.guideline else "",
        floor=row_tables.build_floor(row, words),
        floor_governs=_is_governed_by_floor(row),
        slab_line=opinion_tables.tell_slab(row, words),
        slab=opinion_tables.build_slab(row, words),
        model_form=opinion_tables.build_model_form(row, words),
        model_form_line=opinion_tables.tell_model_form(row.model_form, words),
        figures=_view_figures(row, words),
        panel=panel_tables.view_panel(row, words),
        end_effects=end_tables.build_end_effects(row, words),
        notes=tuple(note for one in row.notes if (note := words.show(one)) not in told),
    )


def _is_governed_by_floor(row: RowStudy) -> bool:
    """The guideline's load governs some check."""
    return any(check.governs == "guideline" for check in row.checks)


def _view_figures(row: RowStudy, words: Words) -> Figures:
    return Figures(
        statics=statics_tables.build_statics(row, words),
        floor_statics=statics_tables.build_floor_statics(row, words),
        sideways=statics_tables.build_sideways(row, words),
        widths=figure_tables.build_widths(row, words),
        actions=figure_tables.build_actions(row, words),
        panel_actions=figure_tables.build_panel_actions(row, words),
        checks=figure_tables.build_check_figures(row, words),
        resistances=figure_tables.build_resistances(row, words),
        tests=figure_tables.build_tests(row, words),
        turns=statics_tables.build_turns(row, words),
    )


def _count_laws(row: RowStudy, words: Words) -> str:
    """Count of the independent laws that the drawn case obeys, if it is all of them."""
    count = len(row.independent)
    if not count or not all(one.is_met for one in row.independent):
        return ""
    return words("show.laws_counted", met=count, count=count)


def _name_unloaded(row: RowStudy, words: Words) -> str:
    loaded = tables.list_loaded(row)
    missing = [member for member in REPORTED_MEMBERS if member not in loaded]
    names = ", ".join(show_member(words, member) for member in missing)
    return words("show.unloaded", members=names) if names else ""


def _name_person(name: str) -> str:
    """Name, or room to write one."""
    return show_text(name) if name.strip() else ""


def _identify(study: Study, words: Words) -> tuple[tuple[str, str], ...]:
    project = study.project
    pairs = (
        ("project", project.name),
        ("number", project.number),
        ("revision", project.revision),
        ("limit_profile", tables.name_profile(study, words)),
        ("site_file", study.provenance.site_file),
        ("date", study.provenance.started[:10]),
    )
    return tuple((words(f"heading.{key}"), show_text(text)) for key, text in pairs)


def _tell_verification(study: Study, words: Words) -> tuple[tuple[str, str], ...]:
    """Command that shows whether a report is true, and what ties it to its study."""
    site = study.provenance.site_file
    is_built_in = " --example" in study.provenance.command  # verify has it too
    named = f" --site {shlex.quote(site)}" if site and not is_built_in else ""
    return (
        (
            words("heading.verify_report"),
            show_text(f"{VERIFY} --study {what_if.name_study(study)}{named}"),
        ),
        (words("heading.what_that_does"), words("heading.verify_explained")),
        (words("heading.study_hash"), compute_digest(study)),
    )


def _count_verdicts(verdicts: Iterable[Verdict], words: Words) -> str:
    counts = Counter(verdicts)
    shown = [
        words(
            "show.count_verdict",
            count=counts[verdict],
            verdict=words(f"verdict.{verdict}"),
        )
        for verdict in SEVERITY
        if counts[verdict]
    ]
    return ", ".join(shown) or words("show.none")


def _count_all(study: Study, words: Words) -> tuple[tuple[str, str], ...]:
    law = basis_tables.tell_accepted_law(study, words)
    accepted = [(words("column.items.accepted_law"), law)] if law else []
    cases = sum(len(row.cases) for row in study.rows)
    failed = sum(len(tables.list_failed(row)) for row in study.rows)
    return (
        (
            words("heading.net_rows"),
            _count_verdicts((row.verdict for row in study.rows), words),
        ),
        (
            words("heading.checks"),
            _count_verdicts(
                (c.verdict for row in study.rows for c in row.checks), words
            ),
        ),
        (
            words("heading.cases"),
            words("show.cases_solved", solved=cases - failed, failed=failed),
        ),
        (words("heading.floor"), _tell_floor(study, words)),
        *accepted,
    )


def _tell_floor(study: Study, words: Words) -> str:
    """Floor of the demands, and how often it governs."""
    told = _count_by_floor(study, words)
    if not study.profile.is_floor_overruled:
        return told
    return words.join([words("floor.overruled", profile=study.profile.id), told])


def _count_by_floor(study: Study, words: Words) -> str:
    if study.profile.floor == "none":
        is_own = not study.profile.is_floor_overruled
        return words("floor.none" if is_own else "floor.none_chosen")
    checks = [one for row in study.rows for one in row.checks if one.is_of_force]
    governed = sum(one.governs == "guideline" for one in checks)
    profiles = {row.floor.profile for row in study.rows if row.floor}
    named = show_text(", ".join(sorted(profiles)))
    return words("floor.told", profile=named, count=governed, all=len(checks))


def _list_declared(study: Study, words: Words) -> tuple[str, ...]:
    """Checks that count as declared, each with its row and where it is proven."""
    return tuple(
        words(
            "show.declared",
            row=show_text(row.id),
            check=show_check(words, check),
            proof=words.show(tell_proof(**asdict(check.declared))),
        )
        for row in study.rows
        for check in row.checks
        if check.declared and check.verdict is Verdict.DECLARED
    )


def _fold_keys(values: Sequence[tuple[str, str]]) -> list[str]:
    """``key = value`` of factors; of other subjects with many values their count."""
    counts = Counter(key.partition(".")[0] for key, _ in values)
    told = []
    for key, value in values:
        subject = key.partition(".")[0]
        is_many = counts[subject] > _FEW and subject not in _FACTORS
        told.append(
            f"{subject}.* ({counts[subject]})" if is_many else f"{key} = {value}"
        )
    return list(dict.fromkeys(told))


def _list_assumed(study: Study, words: Words) -> str:
    """Values of the profile and axes of anchors that nobody has confirmed."""
    assumed = [v for v in study.profile.values if v.status == tables.ASSUMED]
    names = _fold_keys([(v.id, words.show_quantity(v.value, v.unit)) for v in assumed])
    panels = [row.id for row in study.rows if row.panel and row.panel.assumed]
    if panels:
        rows = basis_tables.name_rows(panels, study, words)
        names.append(words("show.assumed_panels", rows=rows))
    return ", ".join(show_text(name) for name in names)
