"""All that can be said of a stored study without solving anything again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from netdesign.checks import Standard
from netdesign.envelope.ranges import build_cases
from netdesign.outcome import NetDesignError, Verdict, merge_verdicts
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, CREEP_LAWS, CreepLaw
from netdesign.study.case_records import GuidelineRecord
from netdesign.study.effects import (
    find_effects,
    load_guideline,
)
from netdesign.study.judgement import (
    MemberCheck,
    judge_members,
    judge_with_fault,
    record_member,
    record_others,
)
from netdesign.study.member_force import RowForces
from netdesign.study.notes import list_judged_notes, list_site_notes
from netdesign.study.parts import list_parts
from netdesign.study.pulls import build_pull
from netdesign.study.record_envelope import read_point, record_point
from netdesign.study.record_guideline import compare_case, find_row_floor, record_floor
from netdesign.study.record_provenance import record_profile
from netdesign.study.record_support import record_panel
from netdesign.study.records import (
    CheckRecord,
    RowStudy,
    Study,
    list_verdicts,
    merge_rows,
)
from netdesign.study.rejudge.again import (
    follow_checks,
    follow_envelope,
    follow_extremes,
    follow_forces,
    follow_opinions,
    follow_reasons,
    is_complete,
    is_held_back,
)
from netdesign.study.rejudge.laws import list_broken
from netdesign.study.rejudge.stored import (
    Fields,
    Follow,
    is_of_steady_states,
    read_number,
)
from netdesign.study.rejudge.support_again import (
    follow_brought,
    follow_drawn,
    follow_laws,
    follow_statics,
)
from netdesign.study.row_to_check import Basis, is_calibrated
from netdesign.study.sideways import find_lack
from netdesign.study.support_records import PanelRecord
from netdesign.study.values import compare_values
from netdesign.units import degree_from_radian, newton_from_kilonewton
from netdesign.words.message import Message, say

_UNKNOWN_GAP = say("check.no_case_solved")  # whatever it is: nothing passes with one
_MOST = 5  # places of one part that are named
# Numbers of the document itself, which follow to their rounding; those of a few sums.
_EXACT: tuple[Follow, ...] = (
    *(follow_reasons, follow_extremes, follow_forces, follow_checks),
)
_ROUNDED: tuple[Follow, ...] = (
    *(follow_envelope, follow_opinions, follow_drawn, follow_laws),
    *(follow_statics, follow_brought),
)


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
    if standard is not None and standard.sha256 != study.profile.sha256:
        standard = None
    found = [*_look_at_profile(study, standard)]
    for row in study.rows:
        merged = merge_verdicts(list_verdicts(row.checks, row.independent))
        found += _compare_verdict(say("audit.row", row=row.id), row.verdict, merged)
        found += _guard(row, list_broken(row, study))
        for follow in (*_EXACT, *_ROUNDED):
            found += _guard(row, _work_out(row, study, follow))
    if site is not None and site.sha256 == study.provenance.site_sha256:
        found += judge_again(study, site, standard)
    merged = merge_rows(study.rows, study.left_out)
    return [*found, *_compare_verdict(say("audit.study"), study.verdict, merged)]


def _compare_verdict(
    place: Message, stored: Verdict, merged: Verdict
) -> Iterator[Message]:
    """A sentence on a verdict that is not that of its parts."""
    if stored is not merged:
        told = {"verdict": say(f"verdict.{stored}"), "merged": say(f"verdict.{merged}")}
        yield say("audit.verdict", place=place, **told)


def _guard(row: RowStudy, sentences: Iterator[Message]) -> Iterator[Message]:
    """Sentences; where numbers are such as no solve gives, one that says so."""
    try:
        yield from sentences
    except (NetDesignError, LookupError, ValueError, TypeError, ArithmeticError):
        yield say("audit.no_calculation", place=say("audit.row", row=row.id))


def _compare(
    key: str,
    place: Message,
    stored: Study | RowStudy,
    again: Fields,
    *,
    is_exact: bool = False,
) -> Iterator[Message]:
    """Sentences on the first places at which stored fields are not what follows."""
    for name, part in again.items():
        pair = ({name: getattr(stored, name)}, {name: part})
        for found in compare_values(*pair, is_exact=is_exact)[:_MOST]:
            yield say(key, place=place, value=found.message)


def _work_out(row: RowStudy, study: Study, follow: Follow) -> Iterator[Message]:
    """Sentences on values of a row that do not follow from others."""
    place, again = say("audit.row", row=row.id), follow(row, study)
    is_exact = follow in _EXACT
    yield from _compare("audit.other_values", place, row, again, is_exact=is_exact)


def _look_at_profile(study: Study, standard: Standard | None) -> Iterator[Message]:
    """Values of the profile against its files, where these are the ones of the hash."""
    ids = [value.id for value in study.profile.values]
    if len(set(ids)) < len(ids):
        yield say("audit.value_twice")
    if standard is not None:
        # whether somebody named it is the command's
        again = replace(record_profile(standard), is_default=study.profile.is_default)
        yield from _compare(
            "audit.other_profile", say("audit.study"), study, {"profile": again}
        )


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
    law = _find_law(study)
    stored = [row.id for row in study.rows]
    if study.left_out:
        site = site.take_rows(stored)
    given = [row.id for row in site.rows]
    if stored != given:
        yield say("audit.other_rows", stored=repr(stored), given=repr(given))
    whole, key = say("audit.study"), "audit.site_otherwise"
    again = {
        "project": site.project,
        "range_inputs": list(site.range_inputs),
        "notes": list_site_notes(site, law, read_number(study, "accuracy")),
        "provenance": replace(study.provenance, site_file=site.file_name),
        "what_if": list(site.what_if),
        "left_out": list(site.left_out),
    }
    yield from _compare(key, whole, study, again)
    rows = {row.id: row for row in site.rows}
    for row in study.rows:
        if row.id not in rows:
            continue
        place = say("audit.row", row=row.id)
        yield from _compare(key, place, row, _read_again(row, rows[row.id], site, law))
        if standard is not None:
            basis = Basis(site=site, row=rows[row.id], standard=standard, law=law)
            yield from _guard(row, _judge_row(row, basis, study))


def _find_law(study: Study) -> CreepLaw:
    name = study.provenance.settings.get("creep_law", "").partition(" ")[0]
    return CREEP_LAWS.get(name, BOUTILLIER_2004)


def _read_again(row: RowStudy, given: NetRow, site: Site, law: CreepLaw) -> Fields:
    """Values of a row that stand in its site file, or follow from it alone."""
    cases = [
        replace(one, is_calibrated=is_calibrated(law, given, one.case.density_kg_m3))
        for one in row.cases
    ]
    if site.ranges.is_grid:
        points = [record_point(case) for case in build_cases(site.ranges)]
        pairs = zip(cases, points, strict=False)  # none is missing: they are counted
        cases = [replace(one, case=point) for one, point in pairs]
    drawing = row.drawing
    if drawing is not None:
        at = given.at(read_point(drawing.case))
        drawing = replace(
            drawing,
            slope_deg=degree_from_radian(given.slope_angle),
            snow_thickness_m=at.held_thickness,
        )
    return {
        "inputs": list(given.inputs),
        "questions": list(given.questions),
        "parts": list_parts(given, site.ranges["inclination"]),
        "panel": _read_panel(row.panel, record_panel(given)),
        "cases": cases,
        "drawing": drawing,
    }


def _read_panel(
    stored: PanelRecord | None, given: PanelRecord | None
) -> PanelRecord | None:
    """Panel as given, with the forces of the stored one."""
    if stored is None or given is None:
        return given
    return replace(
        stored,
        cut=given.cut,
        has_mid_anchors=given.has_mid_anchors,
        assumed=given.assumed,
        end_guy_deg=given.end_guy_deg,
        ropes=[
            replace(rope, along_kN=one.along_kN, tension_kN=one.tension_kN)
            for one, rope in zip(stored.ropes, given.ropes, strict=False)
        ],
    )


def _judge_row(row: RowStudy, basis: Basis, study: Study) -> Iterator[Message]:
    """Every check from the forces of the study, as if these had just been solved."""
    given, known = basis.row, _know_again(row, basis)
    notes = list_judged_notes(known, row.checks, row.cases, row.panel)
    # of histories more is noted, behind these
    more = [] if is_of_steady_states(study) else row.notes[len(notes) :]
    again = {
        "checks": _check_again(row, known),
        "pulls": list(known.pulls),
        "notes": [*notes, *more],
        "floor": known.floor,
        "guideline": row.guideline and _compare_guideline(row.guideline, given),
    }
    place = say("audit.row", row=row.id)
    yield from _compare("audit.judged_otherwise", place, row, again)


def _know_again(row: RowStudy, basis: Basis) -> RowForces:
    """Knowledge of a row by what the study states of its solved cases."""
    given, standard, ranges = basis.row, basis.standard, basis.site.ranges
    effects, panel = find_effects(given, standard, ranges), row.panel
    is_failed = panel is not None and bool(panel.assumed) and bool(panel.failed)
    return RowForces(
        site=basis.site,
        row=given,
        standard=standard,
        law=basis.law,
        effects=effects,
        largest={one.quantity: one for one in row.forces},
        floor=record_floor(find_row_floor(given, ranges, standard), given),
        held=row.held_sideways or find_lack(given) or _UNKNOWN_GAP,
        tilt=row.tilt,
        pulls=tuple(
            build_pull(
                *(given, one.anchor, one.pulls),
                *(effects.lateral_share, one.position),
            )
            for one in row.pulls
        ),
        gap=None if is_complete(row) else _UNKNOWN_GAP,
        panel_gap=_UNKNOWN_GAP if is_failed else None,
    )


def _check_again(row: RowStudy, known: RowForces) -> list[CheckRecord]:
    """Checks of a row, judged again; a gap in its own words is one."""
    stored = {check.id: check for check in row.checks}
    judged = [
        _hold_back(known, one, stored.get(one.id)) for one in judge_members(known)
    ]
    found = [record_member(known, one) for one in judged]
    found += record_others(known, judged)
    return [_take_solves(one, stored.get(one.id)) for one in found]


def _hold_back(
    basis: Basis, one: MemberCheck, stored: CheckRecord | None
) -> MemberCheck:
    """A pass that the study holds back, for a fault beside its forces.

    None passes where the net stands below its snow: that is no fault.
    """
    passes = one.result.verdict is Verdict.PASS and not basis.row.is_overtopped
    if stored is None or not passes or not is_held_back(stored):
        return one
    return judge_with_fault(basis, one, _UNKNOWN_GAP)


def _take_solves(again: CheckRecord, stored: CheckRecord | None) -> CheckRecord:
    """Check with what only a solve can tell: also a reason that a gap stands for."""
    if stored is None:
        return again
    is_open = _UNKNOWN_GAP in _list_gaps(again.reason)
    return replace(
        again,
        reason=stored.reason if is_open else again.reason,
        spreads=stored.spreads,
        changes=stored.changes,
        holds=stored.holds,
    )


def _list_gaps(reason: Message) -> list[object]:
    """Reason and all that is said in it."""
    found: list[object] = [reason]
    for value in reason.arguments.values():
        for one in value if isinstance(value, tuple) else (value,):
            found += _list_gaps(one) if isinstance(one, Message) else [one]
    return found


def _compare_guideline(stored: GuidelineRecord, given: NetRow) -> GuidelineRecord:
    """Guideline's load worked out again, for the forces of its case."""
    if stored.sha256 != load_guideline().sha256:
        return stored
    again = compare_case(
        *(given, read_point(stored.case)),
        newton_from_kilonewton(stored.solved_load_kN_per_m),
        newton_from_kilonewton(stored.solved_foot_anchor_kN),
    )
    return replace(again, along_net=stored.along_net)  # of a solve
