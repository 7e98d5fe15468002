"""A study against its site: what was given, and all that is judged from forces."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Band, CheckResult, Standard, withhold
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.ranges import build_cases
from netdesign.guideline.floor import Floor
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow, Resistance, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, CREEP_LAWS, CreepLaw
from netdesign.structure.members import ROPE_OF, EndMember, Member
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.audit.action_audit import list_bringing
from netdesign.study.audit.check_audit import is_held_back
from netdesign.study.audit.comparing import (
    Pair,
    is_of_steady_states,
    tell_differences,
    tell_unequal,
    tell_value,
)
from netdesign.study.audit.envelope_audit import is_complete
from netdesign.study.audit.opinion_audit import (
    audit_guideline,
    audit_model_form,
    audit_slab,
)
from netdesign.study.audit.panel_audit import audit_panel_inputs
from netdesign.study.calibration import find_doubt, is_calibrated
from netdesign.study.demand import build_demand, tell_governing
from netdesign.study.dependent import Circumstances, settle_resistance
from netdesign.study.effects import RowEffects, find_effects
from netdesign.study.end_note import record_end_effects
from netdesign.study.floor import find_row_floor, record_floor
from netdesign.study.notes import list_judged_notes, list_site_notes
from netdesign.study.pulls import (
    AnchorPull,
    build_pull,
    check_directions,
    find_pull,
    read_pulls,
    record_pulls,
)
from netdesign.study.record_cases import read_point, record_point
from netdesign.study.records import ActionRecord, CheckRecord, RowStudy, Study
from netdesign.study.row_end import find_other_panel, find_unsaid
from netdesign.study.settle import (
    judge_forces,
    list_checked,
    place_check,
    record_geometry,
    record_result,
    settle_check,
)
from netdesign.study.sideways import (
    GUYS,
    MemberLoad,
    Sideways,
    check_sideways,
    find_lack,
)
from netdesign.study.values import compare_values
from netdesign.units import degree_from_radian, newton_from_kilonewton
from netdesign.words.message import Message, say

_UNKNOWN_GAP = say("check.no_case_solved")  # whatever it is: nothing passes with one


@dataclass(frozen=True, slots=True, kw_only=True)
class _Basis:
    """Basis of the checks of a net row, beside its forces."""

    site: Site
    row: NetRow
    standard: Standard
    law: CreepLaw


def audit_site(
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
    given = [row.id for row in site.rows]
    if stored != given:
        yield say("audit.other_rows", stored=repr(stored), given=repr(given))
    parts = (
        ("project", study.project, site.project),
        ("ranges", study.range_inputs, list(site.range_inputs)),
        ("notes", study.notes, list_site_notes(site, law, _find_accuracy(study))),
        ("site_file", study.provenance.site_file, site.file_name),
        ("what_if", study.what_if, list(site.what_if)),
    )
    for name, one, other in parts:
        yield from tell_differences("audit.site_otherwise", {name: one}, {name: other})
    rows = {row.id: row for row in site.rows}
    is_known = standard is not None and standard.sha256 == study.profile.sha256
    for row in study.rows:
        if row.id in rows:
            yield from _audit_row(row, rows[row.id], site, law)
            if standard is not None and is_known:
                basis = _Basis(site=site, row=rows[row.id], standard=standard, law=law)
                yield from _audit_judgement(row, basis, is_steady=is_steady)


def _find_law(study: Study) -> CreepLaw:
    name = study.provenance.settings.get("creep_law", "").partition(" ")[0]
    return CREEP_LAWS.get(name, BOUTILLIER_2004)


def _find_accuracy(study: Study) -> float:
    """Accuracy that a study says; infinite, no cause of a note, if it is none."""
    try:
        return float(study.provenance.settings["accuracy"])
    except (KeyError, ValueError):
        return math.inf


def _audit_row(
    row: RowStudy, given: NetRow, site: Site, law: CreepLaw
) -> Iterator[Message]:
    place = say("audit.row", row=row.id)
    inputs = {"inputs": row.inputs}, {"inputs": list(given.inputs)}
    yield from tell_differences("audit.row_otherwise", *inputs, place=place)
    asked = {"questions": row.questions}, {"questions": list(given.questions)}
    yield from tell_differences("audit.row_otherwise", *asked, place=place)
    yield from audit_panel_inputs(row, given)
    if site.ranges.is_grid:
        points = [record_point(case) for case in build_cases(site.ranges)]
        if [case.case for case in row.cases] != points:
            yield say("audit.other_grid", place=place)
    for number, case in enumerate(row.cases):
        known = is_calibrated(law, given, case.case.density_kg_m3)
        if case.is_calibrated is not known:
            where = say("audit.case", place=place, number=number)
            yield tell_value(where, "is_calibrated", case.is_calibrated, known)
    drawing = row.drawing
    if drawing is not None:
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


def _audit_judgement(
    row: RowStudy, basis: _Basis, *, is_steady: bool
) -> Iterator[Message]:
    """Judge every check again from its action, as if that had just been solved."""
    given, standard = basis.row, basis.standard
    effects = find_effects(given, standard, basis.site.ranges)
    floor = find_row_floor(given, basis.site.ranges, standard)
    pulls = read_pulls(given, row.pulls)
    expected = [
        *_expect_members(row, pulls, effects, basis),
        *_expect_end(row, effects, basis),
        *_expect_directions(row, pulls, basis),
        *record_geometry(basis.site, given, standard),
    ]
    stored, again = (
        [_leave_out_solves(check) for check in checks]
        for checks in (row.checks, expected)
    )
    place = say("audit.row", row=row.id)
    yield from tell_differences("audit.judged_otherwise", stored, again, place=place)
    yield from _audit_pulls(row, given, effects.lateral_share)
    notes = list_judged_notes(
        *(basis.site, given, standard, basis.law),
        effects=effects,
        pulls=pulls,
        checks=row.checks,
        cases=row.cases,
    )
    # of histories more is noted, behind these
    shown = row.notes if is_steady else row.notes[: len(notes)]
    yield from tell_differences("audit.other_notes", shown, notes, place=place)
    ends = record_end_effects(given, basis.site.ranges, basis.law, basis.standard)
    yield from tell_differences(
        "audit.other_end_effects", row.end_effects, ends, place=place
    )
    yield from tell_differences(
        "audit.other_floor", row.floor, record_floor(floor, given), place=place
    )
    yield from _audit_actions(row, effects, floor, basis)
    yield from audit_guideline(row, given)
    yield from audit_slab(row, given, basis.law)
    yield from audit_model_form(row)


def _expect_members(
    row: RowStudy, pulls: Sequence[AnchorPull], effects: RowEffects, basis: _Basis
) -> list[CheckRecord]:
    """Checks of the members of each support, from the actions that are stored."""
    given, members = basis.row, []
    for check, (width, one) in zip(
        row.checks, list_checked(given, effects), strict=False
    ):
        known = Circumstances(
            row=given,
            ranges=basis.site.ranges,
            standard=basis.standard,
            pull=find_pull(pulls, one.member, width.position),
            pressing=_find_pressing(check),
        )
        is_open = _find_unsaid(row, one, width.position, basis) is not None
        settled = one if is_open else settle_resistance(one, known)
        members.append(_judge_again(row, check, width, settled, basis))
    return members


def _audit_actions(
    row: RowStudy, effects: RowEffects, floor: Floor | None, basis: _Basis
) -> Iterator[Message]:
    """Way of each check from its solved force to that on the support."""
    given, place = basis.row, say("audit.row", row=row.id)
    for check in row.checks:
        if check.member in ROPE_OF:
            yield from _audit_end_share(check, given, place)
        elif check.action is not None:
            yield from _audit_share(check, given, effects.lateral_share, place)
            action = _act_again(check, check.action, effects, floor)
            where = say("audit.check", place=place, check=check.id)
            for found in compare_values(check.action, action):
                yield say("audit.other_width", place=where, value=found.message)


def _expect_end(row: RowStudy, effects: RowEffects, basis: _Basis) -> list[CheckRecord]:
    """Checks of the row's end, from the actions that are stored."""
    stored = {check.id: check for check in row.checks}
    end = basis.row.row_end
    width = effects.find_support("edge")
    return [
        _judge_again(row, stored[name], width, given, basis, position="edge")
        for given in (end.resistances if end else ())
        if (name := f"{given.member}.{given.mode}.end") in stored
    ]


def _audit_end_share(
    check: CheckRecord, given: NetRow, row: Message
) -> Iterator[Message]:
    """Share of a rope's pull in an end guy, by its angle to the row."""
    angle = given.row_end.guy_angle if given.row_end else None
    if check.action is None or check.member == EndMember.LATERAL_ANCHOR:
        return
    place = say("audit.check", place=row, check=check.id)
    expected = 1.0 / math.cos(angle or 0.0)
    yield from tell_unequal(place, [("share", check.action.share, expected)])


def _find_pressing(check: CheckRecord) -> float:
    """Characteristic force across the base plate, from what slides it [N]."""
    action = check.action
    if check.mode != "sliding" or action is None or not action.share:
        return 0.0
    return newton_from_kilonewton((check.action_kN or 0.0) / action.share)


def _expect_directions(
    row: RowStudy, pulls: Sequence[AnchorPull], basis: _Basis
) -> list[CheckRecord]:
    """Checks of the load along the row and of directions, from what is stored."""
    given, standard = basis.row, basis.standard
    gap = _find_open(row, basis)
    stored = {check.id: check for check in row.checks}
    lateral = stored.get(f"{Member.POST}.lateral")
    value = standard.find(LATERAL_SHARE)
    lack = find_lack(given) if value else say("check.no_case_solved")
    is_open = lateral is not None and lateral.verdict in (
        Verdict.NOT_PROVEN,
        Verdict.DECLARED,
    )
    sideways = Sideways(
        share=value.value if value else 0.0,
        # only a solve can tell why else it is not held
        gap=_UNKNOWN_GAP if lack is None and is_open else lack,
    )

    def settle(result: CheckResult, position: Position | None = None) -> CheckRecord:
        return record_result(settle_check(basis.site, given, result, position))

    found = [
        settle(check_sideways(given, sideways, gap)),
        *(
            place_check(settle(one, position), position)
            for position, one in check_directions(pulls, standard, gap)
        ),
    ]
    if value is None or is_open or gap is not None:  # a gap in its own words is one
        return [
            replace(one, reason=stored[one.id].reason) if one.id in stored else one
            for one in found
        ]
    return found


def _find_open(row: RowStudy, basis: _Basis) -> Message | None:
    """Gap of the forces, else a doubt about the governing snow of any check."""
    if not is_complete(row):
        return _UNKNOWN_GAP
    doubts = (_find_doubt(one, row, basis) for one in row.checks)
    return next((one for one in doubts if one is not None), None)


def _find_doubt(check: CheckRecord, row: RowStudy, basis: _Basis) -> Message | None:
    """Doubt that the creep law holds for the snow that a check rests on."""
    if check.action is None:
        return None
    doubts = (
        find_doubt(
            basis.site,
            basis.row,
            basis.law,
            density=one.case.density_kg_m3,
            largest=max(one.high_kN, one.upper_bound_kN or 0.0),
        )
        for one in list_bringing(check, row)
    )
    return next((one for one in doubts if one is not None), None)


def _audit_pulls(row: RowStudy, given: NetRow, share: float) -> Iterator[Message]:
    """Axes, kinds and angles of the anchors, from the ranges of their pulls."""
    place = say("audit.row", row=row.id)
    expected = record_pulls(
        [
            build_pull(given, one.anchor, one.pulls, share, one.position)
            for one in read_pulls(given, row.pulls)
        ]
    )
    yield from tell_differences(
        "audit.judged_otherwise", row.pulls, expected, place=place
    )


def _audit_share(
    check: CheckRecord, given: NetRow, along_row: float, row: Message
) -> Iterator[Message]:
    """Share and addition of a force by the splay of the guys, from what is stored."""
    action, splay = check.action, given.guys.splay
    if action is None or check.member == Member.POST_BASE:
        return
    place = say("audit.check", place=row, check=check.id)
    is_guy = check.member in (*GUYS, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
    load, share, added = action.sideways, 1.0, 0.0
    if load is not None and splay is not None:
        loaded = load.part * along_row * load.pull_kN
        if is_guy:
            share, added = 0.5 / math.cos(splay), loaded / math.sin(splay)
        else:
            held = load.part * (load.least_tension_kN or 0.0)
            added = loaded / math.tan(splay) - held
    pairs: list[Pair] = [
        ("share", action.share, share),
        ("added_kN", action.added_kN, max(added, 0.0)),
    ]
    if action.foot_part_kN is not None and action.guy_part_kN is not None:
        both = action.foot_part_kN + action.guy_part_kN
        name = "panel_kN" if action.is_by_panel else "solved_kN"
        pairs.append((name, action.larger_force, both))
    yield from tell_unequal(place, pairs)


def _judge_again(
    row: RowStudy,
    check: CheckRecord,
    width: LoadedWidth,
    given: Resistance,
    basis: _Basis,
    *,
    position: Position | None = None,
) -> CheckRecord:
    factor = check.action_factor
    ends = (check.demand_low_kN, check.demand_high_kN)
    action = None
    if check.action_kN is not None:
        low, high = (
            check.action_kN if end is None or not factor else end / factor
            for end in ends
        )
        sizes = sorted((low, check.action_kN, high))
        low, middle, high = map(newton_from_kilonewton, sizes)
        action = Band(low=low, value=middle, high=high)
    place = position or width.position
    unsaid = _find_unsaid(row, given, place, basis)
    is_whole = is_complete(row) and not is_held_back(check)
    gap = unsaid or (None if is_whole else _UNKNOWN_GAP)
    gap = gap or find_other_panel(basis.row, given, place)
    doubt = _find_doubt(check, row, basis) if action else None
    result = judge_forces(action, given, basis.standard, gap=gap, doubt=doubt)
    if unsaid:
        result = withhold(result, unsaid)
    settled = settle_check(basis.site, basis.row, result, place)
    again = place_check(record_result(settled, given), place)
    # a gap in its own words is one
    if not is_whole and (unsaid is None or unsaid is _UNKNOWN_GAP):
        return replace(again, reason=check.reason)
    if check.action is None:
        return again
    return replace(again, reason=tell_governing(again.reason, check.action))


def _find_unsaid(
    row: RowStudy, given: Resistance, place: Position, basis: _Basis
) -> Message | None:
    """Lack of what a force depends on; only a solve tells why a panel fails."""
    panel = row.panel
    is_failed = panel is not None and bool(panel.assumed) and bool(panel.failed)
    if is_failed and not basis.row.unsaid:
        return _UNKNOWN_GAP
    return find_unsaid(basis.row, given, place)


def _act_again(
    check: CheckRecord, stored: ActionRecord, effects: RowEffects, floor: Floor | None
) -> ActionRecord:
    """The action from its solved force, with what may hide as the study states it."""
    width = effects.find_support(check.position)
    value = newton_from_kilonewton(stored.solved_kN)
    high = newton_from_kilonewton(stored.coupled_kN)
    high /= effects.factor(check.member, width)
    load = _read_load(stored)
    high = (high - load.added.high) / load.share if load.share else value
    low = newton_from_kilonewton(stored.solved_low_kN or 0.0)
    solved = Band(low=min(max(low, 0.0), value), value=value, high=max(value, high))
    least = floor.find(check.member) if floor else None
    panel = _read_panel(stored, effects.factor(check.member, width), load)
    along = _read_along(stored)
    demand = build_demand(
        effects, check.member, width, solved, least, load, panel, along
    )
    return replace(
        demand.record(effects, check.member),
        foot_part_kN=stored.foot_part_kN,
        guy_part_kN=stored.guy_part_kN,
    )


def _read_panel(stored: ActionRecord, factor: float, load: MemberLoad) -> Band | None:
    """Force by the panel between posts, inside the row [N]."""
    if stored.panel_kN is None:
        return None
    value = newton_from_kilonewton(stored.panel_kN)
    high = newton_from_kilonewton(stored.panel_support_kN or 0.0)
    high = (high - _read_along(stored).high) / factor
    high = (high - load.added.high) / load.share if load.share else value
    low = newton_from_kilonewton(stored.panel_low_kN or 0.0)
    return Band(low=min(low, value), value=value, high=max(value, high))


def _read_along(stored: ActionRecord) -> Band:
    """Push of the end guy on the post at the row's end [N]."""
    low, value, high = sorted(
        newton_from_kilonewton(max(one, 0.0))
        for one in (stored.along_low_kN, stored.along_kN, stored.along_high_kN)
    )
    return Band(low=low, value=value, high=high)


def _read_load(stored: ActionRecord) -> MemberLoad:
    low, value, high = sorted(
        newton_from_kilonewton(one)
        for one in (stored.added_low_kN, stored.added_kN, stored.added_high_kN)
    )
    return MemberLoad(
        share=stored.share,
        added=Band(low=max(low, 0.0), value=max(value, 0.0), high=max(high, 0.0)),
        sideways=stored.sideways,
    )


def _leave_out_solves(check: CheckRecord) -> CheckRecord:
    """Check without what only a solve can tell."""
    return replace(check, case=None, action=None, spreads=[], changes=[], holds=[])
