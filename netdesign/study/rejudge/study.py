"""All that can be said of a stored study without solving anything again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from netdesign.calculation.steps import is_same
from netdesign.checks import Standard
from netdesign.envelope.parameters import PARAMETERS
from netdesign.envelope.ranges import build_cases
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, CREEP_LAWS, CreepLaw
from netdesign.structure.members import Member
from netdesign.study.case_records import FloorRecord
from netdesign.study.effects import (
    RowEffects,
    find_effects,
    load_guideline,
    record_end_effects,
)
from netdesign.study.judgement import (
    MemberCheck,
    judge_members,
    judge_with_fault,
    record_member,
    record_others,
)
from netdesign.study.member_force import RowForces
from netdesign.study.model_form import span_variants
from netdesign.study.notes import list_judged_notes, list_reasons, list_site_notes
from netdesign.study.parts import list_parts
from netdesign.study.pulls import build_pull_again, record_pulls
from netdesign.study.record_envelope import read_point, record_point
from netdesign.study.record_guideline import compare_case, find_row_floor, record_floor
from netdesign.study.record_independent import compare_slab
from netdesign.study.record_provenance import record_profile
from netdesign.study.record_support import record_panel
from netdesign.study.records import (
    CheckRecord,
    RowStudy,
    Study,
    list_verdicts,
    merge_rows,
)
from netdesign.study.rejudge.cases import (
    Spans,
    find_largest,
    guard,
    is_complete,
    is_of_steady_states,
    rejudge_cases,
    report_differences,
    report_value,
    report_verdict,
    same_point,
)
from netdesign.study.rejudge.checks import is_held_back, rejudge_checks
from netdesign.study.rejudge.statics import rejudge_drawn, rejudge_statics
from netdesign.study.row_to_check import Basis, is_calibrated
from netdesign.study.sideways import find_lack
from netdesign.study.support_records import PanelRecord
from netdesign.study.values import compare_values
from netdesign.units import degree_from_radian, newton_from_kilonewton
from netdesign.words.message import Message, say

_UNKNOWN_GAP = say("check.no_case_solved")  # whatever it is: nothing passes with one


def judge_again(
    study: Study, site: Site, standard: Standard | None
) -> Iterator[Message]:
    """Sentences on where a study is not that of its site file.

    Parameters
    ----------
    study : Study
        As stored.
    site : Site
        From the file with the study's hash.
    standard : Standard or None
        The profile with the study's hash; without it no check is judged again.
    """
    law, is_steady = _find_law(study), is_of_steady_states(study)
    stored = [row.id for row in study.rows]
    if study.left_out:
        site = site.take_rows(stored)
    given = [row.id for row in site.rows]
    if stored != given:
        yield say("audit.other_rows", stored=repr(stored), given=repr(given))
    parts = (
        ("project", study.project, site.project),
        ("ranges", study.range_inputs, list(site.range_inputs)),
        ("notes", study.notes, list_site_notes(site, law, _find_accuracy(study))),
        ("site_file", study.provenance.site_file, site.file_name),
        ("what_if", study.what_if, list(site.what_if)),
        ("left_out", study.left_out, list(site.left_out)),
    )
    for name, one, other in parts:
        yield from report_differences(
            "audit.site_otherwise", {name: one}, {name: other}
        )
    rows = {row.id: row for row in site.rows}
    is_known = standard is not None and standard.sha256 == study.profile.sha256
    for row in study.rows:
        if row.id not in rows:
            continue
        yield from _compare_inputs(row, rows[row.id], site, law)
        if standard is not None and is_known:
            basis = Basis(site=site, row=rows[row.id], standard=standard, law=law)
            place = say("audit.row", row=row.id)
            yield from guard(place, _judge_row(row, basis, is_steady=is_steady))


def _find_law(study: Study) -> CreepLaw:
    name = study.provenance.settings.get("creep_law", "").partition(" ")[0]
    return CREEP_LAWS.get(name, BOUTILLIER_2004)


def _find_accuracy(study: Study) -> float:
    """Accuracy that a study says; infinite, no cause of a note, if it is none."""
    try:
        return float(study.provenance.settings["accuracy"])
    except (KeyError, ValueError):
        return math.inf


def _compare_inputs(
    row: RowStudy, given: NetRow, site: Site, law: CreepLaw
) -> Iterator[Message]:
    """Inputs of a row as they were read, beside what the study shows of them."""
    place = say("audit.row", row=row.id)
    stored = {
        "inputs": row.inputs,
        "questions": row.questions,
        "parts": row.parts,
        "panel": row.panel and _leave_out_forces(row.panel),
    }
    again = {
        "inputs": list(given.inputs),
        "questions": list(given.questions),
        "parts": list_parts(given, site.ranges["inclination"]),
        "panel": record_panel(given),
    }
    yield from report_differences("audit.row_otherwise", stored, again, place=place)
    if site.ranges.is_grid:
        points = [record_point(case) for case in build_cases(site.ranges)]
        if [case.case for case in row.cases] != points:
            yield say("audit.other_grid", place=place)
    for number, case in enumerate(row.cases):
        known = is_calibrated(law, given, case.case.density_kg_m3)
        if case.is_calibrated is not known:
            where = say("audit.case", place=place, number=number)
            yield report_value(where, "is_calibrated", case.is_calibrated, known)
    yield from _compare_section(place, row, given)


def _leave_out_forces(panel: PanelRecord) -> PanelRecord:
    ropes = [replace(one, along_kN=None, tension_kN=None) for one in panel.ropes]
    return replace(
        panel,
        ropes=ropes,
        extremes=[],
        failed=0,
        effective_height_m=None,
        lift_m=None,
        drawing=None,
    )


def _compare_section(place: Message, row: RowStudy, given: NetRow) -> Iterator[Message]:
    """Slope and snow of the drawn section."""
    drawing = row.drawing
    if drawing is None:
        return
    drawn = (drawing.slope_deg, drawing.snow_thickness_m)
    at = given.at(read_point(drawing.case))
    wanted = (degree_from_radian(given.slope_angle), at.held_thickness)
    if any(compare_values(drawn, wanted)):
        yield say(
            "audit.other_section",
            place=place,
            slope=drawn[0],
            thickness=drawn[1],
            given_slope=wanted[0],
            given_thickness=wanted[1],
        )


def _judge_row(row: RowStudy, basis: Basis, *, is_steady: bool) -> Iterator[Message]:
    """Every check from the forces of the study, as if these had just been solved."""
    given, standard, ranges = basis.row, basis.standard, basis.site.ranges
    place = say("audit.row", row=row.id)
    effects = find_effects(given, standard, ranges)
    floor = record_floor(find_row_floor(given, ranges, standard), given)
    known = _know_again(row, basis, effects, floor)
    stored, again = (
        [_leave_out_solves(check) for check in checks]
        for checks in (row.checks, _check_again(row, basis, known))
    )
    notes = list_judged_notes(
        basis,
        effects=effects,
        pulls=known.pulls,
        checks=row.checks,
        cases=row.cases,
        panel=row.panel,
    )
    # of histories more is noted, behind these
    shown = row.notes if is_steady else row.notes[: len(notes)]
    ends = record_end_effects(given, ranges, basis.law, standard)
    for key, one, other in (
        ("audit.judged_otherwise", stored, again),
        ("audit.judged_otherwise", row.pulls, record_pulls(known.pulls)),
        ("audit.other_notes", shown, notes),
        ("audit.other_end_effects", row.end_effects, ends),
        ("audit.other_floor", row.floor, floor),
        *_list_opinions(row, given, basis.law),
    ):
        yield from report_differences(key, one, other, place=place)
    yield from _look_at_guideline(place, row)


def _know_again(
    row: RowStudy, basis: Basis, effects: RowEffects, floor: FloorRecord | None
) -> RowForces:
    """Knowledge of a row by what the study states of its solved cases."""
    panel = row.panel
    is_failed = panel is not None and bool(panel.assumed) and bool(panel.failed)
    return RowForces(
        row=basis.row,
        standard=basis.standard,
        effects=effects,
        largest={one.quantity: one for one in row.forces},
        floor={one.member: one for one in floor.forces} if floor else None,
        held=row.held_sideways or find_lack(basis.row) or _UNKNOWN_GAP,
        tilt=row.tilt,
        pulls=tuple(
            build_pull_again(basis.row, one, effects.lateral_share) for one in row.pulls
        ),
        gap=None if is_complete(row) else _UNKNOWN_GAP,
        floor_gap=floor.reason if floor else None,
        panel_gap=_UNKNOWN_GAP if is_failed else None,
    )


def _check_again(row: RowStudy, basis: Basis, known: RowForces) -> list[CheckRecord]:
    """Checks of a row, judged again; a gap in its own words is one."""
    stored = {check.id: check for check in row.checks}
    judged = [
        _hold_back(basis, one, stored.get(one.id))
        for one in judge_members(basis, known)
    ]
    found = [record_member(basis, known, one) for one in judged]
    found += record_others(basis, known, judged)
    return [_take_reason(one, stored.get(one.id)) for one in found]


def _hold_back(
    basis: Basis, one: MemberCheck, stored: CheckRecord | None
) -> MemberCheck:
    """A pass that the study holds back, for a fault beside its forces."""
    passes = one.result.verdict is Verdict.PASS
    if stored is None or not passes or not is_held_back(stored):
        return one
    return judge_with_fault(basis, one, _UNKNOWN_GAP)


def _take_reason(again: CheckRecord, stored: CheckRecord | None) -> CheckRecord:
    """Reason of the study where a gap stands for it: only a solve tells that one."""
    is_open = _UNKNOWN_GAP in _list_gaps(again.reason)
    return (
        again if stored is None or not is_open else replace(again, reason=stored.reason)
    )


def _list_gaps(reason: Message) -> list[object]:
    """Reason and all that is said in it."""
    found: list[object] = [reason]
    for value in reason.arguments.values():
        for one in value if isinstance(value, tuple) else (value,):
            found += _list_gaps(one) if isinstance(one, Message) else [one]
    return found


def _leave_out_solves(check: CheckRecord) -> CheckRecord:
    """Check without what only a solve can tell."""
    return replace(check, spreads=[], changes=[], holds=[])


def _list_opinions(
    row: RowStudy, given: NetRow, law: CreepLaw
) -> Iterator[tuple[str, object, object]]:
    """Second opinions with themselves worked out again: guideline, slab, model form."""
    slab, form, guideline = row.slab, row.model_form, row.guideline
    if slab is not None:
        again = compare_slab(
            *(given, read_point(slab.case), law),
            newton_from_kilonewton(slab.solved_load_kN_per_m),
            newton_from_kilonewton(slab.solved_foot_anchor_kN),
        )
        yield "audit.other_slab", slab, again
    if form is not None:
        yield "audit.other_model_form", form, span_variants(form)
    if guideline is not None and guideline.sha256 == load_guideline().sha256:
        compared = compare_case(
            *(given, read_point(guideline.case)),
            newton_from_kilonewton(guideline.solved_load_kN_per_m),
            newton_from_kilonewton(guideline.solved_foot_anchor_kN),
        )
        stored = replace(guideline, along_net=[])  # of a solve
        yield "audit.other_guideline", stored, compared


def _look_at_guideline(place: Message, row: RowStudy) -> Iterator[Message]:
    """The comparison with the guideline stands beside the largest force of the foot."""
    stored, largest = row.guideline, find_largest(row, Member.FOOT_ANCHOR)
    if stored is None or largest is None:
        return
    is_its_case = same_point(stored.case, largest.case)
    if not (
        is_its_case and is_same(stored.solved_foot_anchor_kN, largest.foot_anchor_kN)
    ):
        yield say("audit.guideline_case", place=place)


def rejudge(
    study: Study, standard: Standard | None = None, site: Site | None = None
) -> list[Message]:
    """Contradictions of a study, each in a sentence that names the place.

    Parameters
    ----------
    study : Study
        As stored.
    standard : Standard, optional
        The limit profile of that id, where it is at hand.
    site : Site, optional
        What the site file holds, where it is at hand. Files whose hash is not that of
        the study are left out: they say nothing about it.

    Returns
    -------
    list of Message
        Empty where everything follows from everything else. That the forces are those
        of the site's snow and nets is what only a new solve shows.

    Verified by
    -----------
    tests/study/rejudge/test_alterations.py
    """
    found = [*_rejudge_profile(study, standard)]
    spans = _read_spans(study)
    is_steady = is_of_steady_states(study)
    tolerance = _read_number(study, "balance_tolerance") if is_steady else math.inf
    for row in study.rows:
        parts = (
            rejudge_cases(row, spans, tolerance),
            rejudge_checks(row, study.profile),
            rejudge_drawn(row, study.profile, is_steady=is_steady),
            rejudge_statics(row) if is_steady else iter(()),
            _rejudge_verdict(row),
        )
        place = say("audit.row", row=row.id)
        for part in parts:
            found += guard(place, part)
    if site is not None and site.sha256 == study.provenance.site_sha256:
        found += judge_again(study, site, standard)
    verdict = merge_rows(study.rows, study.left_out)
    if study.verdict is not verdict:
        found.append(report_verdict(say("audit.study"), study.verdict, verdict))
    return found


def _rejudge_profile(study: Study, standard: Standard | None) -> Iterator[Message]:
    """Values of the profile against its files, where these are the ones of the hash."""
    ids = [value.id for value in study.profile.values]
    if len(set(ids)) < len(ids):
        yield say("audit.value_twice")
    if standard is None or standard.sha256 != study.profile.sha256:
        return
    again = record_profile(standard)
    stored = {value.id: value for value in study.profile.values}
    listed = {value.id: value for value in again.values}
    for name in dict.fromkeys((*stored, *listed)):
        if stored.get(name) != listed.get(name):
            yield say("audit.other_profile", name=name)
    keys = ("id", "title", "edition", "version", "choice", "choice_text", "floor")
    for key in (*keys, "route", "shared_sum"):
        if getattr(study.profile, key) != getattr(again, key):
            yield say("audit.other_profile", name=key)


def _rejudge_verdict(row: RowStudy) -> Iterator[Message]:
    """Verdict and reasons of a row from its checks and independent checks."""
    place = say("audit.row", row=row.id)
    verdict = merge_verdicts(list_verdicts(row.checks, row.independent))
    if row.verdict is not verdict:
        yield report_verdict(place, row.verdict, verdict)
    reasons = list_reasons(row.checks, row.independent)
    if row.reasons != reasons:
        yield say("audit.other_reasons", place=place)


def _read_spans(study: Study) -> Spans:
    """Ranges as they were understood, by the keys of a case."""
    spans = {}
    for quantity, parameter in PARAMETERS.items():
        if quantity == "slope_angle":
            continue  # of a row, and no range of a site
        name = say(f"column.quantities.{quantity}")
        ends = [
            echo.value
            for end in ("low", "high")
            for echo in study.range_inputs
            if echo.label == say(f"column.{end}_end", name=name)
        ]
        if len(ends) == 2 and all(isinstance(end, float) for end in ends):
            spans[parameter.key] = (float(ends[0]), float(ends[1]))
    return spans


def _read_number(study: Study, setting: str) -> float:
    """Number of a setting; nothing is known without it."""
    try:
        return float(study.provenance.settings.get(setting, math.inf))
    except ValueError:
        return math.inf
