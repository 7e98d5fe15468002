"""Laws that no stored net row breaks, whatever its other numbers are."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise

from netdesign.calculation.steps import SAME
from netdesign.coupling.solution import RELEASED
from netdesign.outcome import Outcome, Verdict
from netdesign.site.model import (
    CONNECTED,
    DEPENDENT_MODES,
    END_MODES,
    LIFTED_MODE,
    MEMBER_MODES,
    NET_MODES,
)
from netdesign.structure.members import (
    CARRYING_MEMBERS,
    REPORTED_MEMBERS,
    Member,
    NetPart,
)
from netdesign.study.case_records import (
    BoundRecord,
    CaseRecord,
    EnvelopeRecord,
    ExtremeRecord,
    ForceRecord,
)
from netdesign.study.check_to_record import UNBOUNDED
from netdesign.study.member_force import leave_out_governing, lifts
from netdesign.study.records import (
    CheckRecord,
    ProfileRecord,
    RowStudy,
    Study,
    find_input,
    find_word,
)
from netdesign.study.rejudge.again import is_used_up
from netdesign.study.rejudge.stored import (
    ALONE,
    RULES,
    Spans,
    find_drawn,
    is_of_steady_states,
    list_extremes,
    list_solved,
    measure_pull,
    read_force,
    read_number,
    read_spans,
)
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

_REASONS = {
    Verdict.PASS: ("check.passes", "check.slack"),
    Verdict.FAIL: (
        *("check.fails", "check.fails_besides", "check.fails_though_declared"),
        *UNBOUNDED,
    ),
    Verdict.NOT_PROVEN: ("check.not_proven",),
    Verdict.DECLARED: ("check.declared",),
}
_LAWS = ("global_balance", "friction_excess", "end_direction", "tension_share")
_END_SHARE = 0.005  # of the chord: the drawn points are rounded to a tenth of a mm
_BESIDE_NET = 0.15  # rad, over so short a piece of a net that sags


def list_broken(row: RowStudy, study: Study) -> Iterator[Message]:
    """A sentence for each law that a row breaks."""
    place = say("audit.row", row=row.id)
    yield from _look_at_cases(place, row, study)
    yield from _look_at_forces(place, row)
    if row.envelope is not None:
        yield from _look_at_bounds(place, row, row.envelope)
    yield from _look_for_all(place, row, study.profile)
    for check in row.checks:
        where = say("audit.check", place=place, check=check.id)
        yield from _look_at_check(where, check)
    yield from _look_at_drawn(place, row, is_steady=is_of_steady_states(study))


def _are_ordered(*values: float) -> bool:
    return all(one <= other * (1.0 + SAME) for one, other in pairwise(values))


def _look_at_cases(place: Message, row: RowStudy, study: Study) -> Iterator[Message]:
    """Cases within their ranges, each once, with forces or a reason.

    Histories have another measure of their balance.
    """
    spans, is_steady = read_spans(study), is_of_steady_states(study)
    tolerance = read_number(study, "balance_tolerance") if is_steady else math.inf
    for number, case in enumerate(row.cases):
        where = say("audit.case", place=place, number=number)
        yield from _look_at_outcome(where, case, tolerance)
        yield from _look_at_point(where, case, spans)
    counts = Counter(case.case for case in row.cases)
    if any(count > 1 for count in counts.values()):
        yield say("audit.case_twice", place=place)


def _look_at_outcome(
    place: Message, case: CaseRecord, tolerance: float
) -> Iterator[Message]:
    forces = [read_force(case, member) for member in REPORTED_MEMBERS]
    numbers = [*forces]
    if math.isfinite(tolerance):
        numbers += [case.error_percent, case.balance_residual]
    is_whole = all(number is not None and number >= 0.0 for number in numbers)
    if case.outcome is not Outcome.CONVERGED:
        if any(force is not None for force in forces) or not case.reason:
            yield say("audit.forces_without_result", place=place)
    elif not is_whole or case.reason not in (None, RELEASED):
        yield say("audit.converged_without_numbers", place=place)
    elif (case.balance_residual or 0.0) > tolerance:
        yield say("audit.balance_open", place=place)


def _look_at_point(place: Message, case: CaseRecord, spans: Spans) -> Iterator[Message]:
    values = case.case.values
    for key in dict.fromkeys((*values, *spans)):
        low, high = spans.get(key, (0.0, math.inf))
        value = values.get(key, math.nan)
        if not low * (1.0 - SAME) <= value <= high * (1.0 + SAME):
            ends = {"value": value, "low": low, "high": high}
            yield say("audit.outside", place=place, key=key, **ends)


def _look_at_forces(place: Message, row: RowStudy) -> Iterator[Message]:
    """Largest forces and those that the checks rest on: all, each within its band."""
    for extreme in row.extremes:
        where = say("audit.part", place=place, part=name_member(extreme.quantity))
        most, high = extreme.max_kN, extreme.high_kN
        is_in = _are_ordered(0.0, extreme.low_kN, most, high)
        upper = most if extreme.upper_bound_kN is None else extreme.upper_bound_kN
        if not (is_in and _are_ordered(most, upper, high)):
            yield say("audit.outside_band", place=where)
    by_panel = [one for one in list_extremes(row) if one.startswith("panel")]
    wanted = [*CARRYING_MEMBERS, NetPart.MESH, *by_panel] if list_solved(row) else []
    named = [one.quantity for one in row.forces]
    if sorted(named) != sorted(wanted):
        lists = {"named": tuple(named), "wanted": tuple(wanted)}
        yield say("audit.largest_of_others", place=place, **lists)
    for force in row.forces:
        if force.quantity in ALONE:
            where = say("audit.part", place=place, part=name_member(force.quantity))
            yield from _look_at_alone(where, force, row)
    held, states = row.held_sideways, [x for x in row.statics if x.load is None]
    least = min((x.uphill_guy_kN + x.downhill_guy_kN for x in states), default=math.inf)
    if held and not _are_ordered(held.solved_tension_kN, least):
        yield say("audit.guys_above_state", place=place)


def _look_at_alone(
    place: Message, force: ForceRecord, row: RowStudy
) -> Iterator[Message]:
    """A force that no case tells beside its others, against those told."""
    post = next((x.max_kN for x in row.extremes if x.quantity == Member.POST), 0.0)
    solved = [one for one in row.statics if one.load is None]
    foot = max((one.post_foot_kN for one in solved), default=0.0)
    pulls = [measure_pull(one) for one in solved if not one.is_by_panel]
    least, value = max(pulls, default=0.0), force.value_kN
    if not _are_ordered(0.0, force.low_kN, value, force.high_kN):
        yield say("audit.outside_band", place=place)
    if all(one.case != force.case for one in list_solved(row)):
        yield say("audit.of_no_case", place=place)
    for key, kind, ends in (
        ("audit.more_on_base", Member.POST_BASE, (value, post)),
        ("audit.less_than_pull", NetPart.MESH, (least, value)),
        ("audit.too_low_end", Member.POST_FOOT, (foot, force.high_kN)),
    ):
        if force.quantity == kind and not _are_ordered(*ends):
            yield say(key, place=place)


def _look_at_bounds(
    place: Message, row: RowStudy, record: EnvelopeRecord
) -> Iterator[Message]:
    """Bounds of a search, which is closed only where little may hide."""
    extremes = {one.quantity: one for one in row.extremes}
    for bound in record.bounds:
        where = say("audit.bound", place=place, member=name_member(bound.quantity))
        extreme = extremes[bound.quantity]
        if _is_confirmed_above(bound, extreme):
            yield say("audit.confirmed_above", place=where)
        gap = bound.upper_bound_kN - bound.max_kN
        known = max(bound.max_kN, *bound.coincident_kN.values())
        if record.is_closed and gap > record.gap_asked_percent / 100.0 * known * 1.001:
            yield say("audit.not_closed", place=where, gap=gap)


def _is_confirmed_above(bound: BoundRecord, extreme: ExtremeRecord) -> bool:
    again = bound.confirmation
    found = again.confirmed_kN if again else None
    return found is not None and not _are_ordered(found, extreme.high_kN)


def _look_for_all(
    place: Message, row: RowStudy, profile: ProfileRecord
) -> Iterator[Message]:
    """Every check that a row has to have, once."""
    counts = Counter(check.id for check in row.checks)
    for twice in (name for name, count in counts.items() if count > 1):
        yield say("audit.check_twice", place=place, check=twice)
    inside = _add_connections((*MEMBER_MODES, *DEPENDENT_MODES), profile)
    wanted = [f"{member}.{mode}" for member, mode in inside]
    if lifts(row.forces, row.floor):
        wanted.append(".".join(LIFTED_MODE))
    if _has_end(row, profile):
        wanted += [f"{one}.end" for one in wanted]
    if _has_ropes(row) and not _goes_on(row):
        ends = _add_connections(END_MODES, profile)
        wanted += [f"{member}.{mode}.end" for member, mode in ends]
    if "mesh" not in profile.not_checked:
        end = ".end" if _has_end(row, profile) else ""
        of_net = NET_MODES if _has_ropes(row) else NET_MODES[:1]
        parts = _add_connections(of_net, profile)
        wanted += [f"{member}.{mode}{end}" for member, mode in parts]
    wanted += [f"{Member.POST}.lateral", "geometry.inclination"]
    wanted += ["profile.named"] if profile.is_default else []
    wanted += ["inputs.plausible"] if row.questions else []
    lost = [one for one in wanted if one not in counts]
    if lost:
        yield say("audit.no_check", place=place, checks=tuple(lost))


def _add_connections(
    modes: Sequence[tuple[str, str]], profile: ProfileRecord
) -> list[tuple[str, str]]:
    """Modes, and beside those of ropes the chains of their links."""
    if "connections" in profile.not_checked:
        return list(modes)
    members = dict.fromkeys(one for one, _ in modes if one in CONNECTED)
    return [*modes, *((one, "connection") for one in members)]


def _has_end(row: RowStudy, profile: ProfileRecord) -> bool:
    """Presence of a last support that a rule of the profile loads."""
    return any(one.id == RULES for one in profile.values) and not _goes_on(row)


def _goes_on(row: RowStudy) -> bool:
    """Absence of an end: the next work goes on without a gap."""
    return find_input(row, "gap") == 0.0 or find_word(row, "row_end") == "continuous"


def _has_ropes(row: RowStudy) -> bool:
    """Ropes between the posts, unless the row says that there are none."""
    system = say("column.Nets.panel_system")
    found = [echo.value for echo in row.inputs if echo.label == system]
    return found != ["none"] and (bool(found) or row.panel is not None)


def _look_at_check(place: Message, check: CheckRecord) -> Iterator[Message]:
    """Words of a check that fit its verdict, and a bound of its utilisation."""
    if check.is_unbounded is not is_used_up(check):
        yield say("audit.unbounded", place=place)
    told = leave_out_governing(check.reason).key
    if check.steps and told not in _REASONS[check.verdict]:
        verdict = say(f"verdict.{check.verdict}")
        yield say("audit.other_reason", place=place, verdict=verdict)


def _look_at_drawn(
    place: Message, row: RowStudy, *, is_steady: bool
) -> Iterator[Message]:
    """A solved case is drawn, whose net pulls along itself, with all its laws."""
    drawing, drawn = row.drawing, find_drawn(row)
    parts = (row.anchors, row.head, row.independent)
    is_solved = drawn is not None and all(parts)
    if drawing is None and (any(parts) or bool(list_solved(row))):
        yield say("audit.no_drawing", place=place)
    if drawing is not None and not is_solved:
        yield say("audit.drawn_without_result", place=place)
    if drawing is None or not is_solved:
        return
    foot, pull = row.anchors[0], row.head[0]
    for name, points, force in (
        ("foot", drawing.net_m, (foot.force_x_kN, foot.force_y_kN)),
        ("head", drawing.net_m[::-1], (pull.x_kN, pull.y_kN)),
    ):
        angle = _find_angle(points, force)
        if angle is None or angle > _BESIDE_NET:
            yield say("audit.beside_net", place=place, end=name_member(name))
    wanted = {*_LAWS, *(["capstan_ratio"] if is_steady else [])}
    wanted |= {"head_balance"} if len(row.head) > 1 else set()
    named = [law.name for law in row.independent]
    if len(set(named)) < len(named) or not wanted <= set(named):
        lists = {"named": tuple(named), "wanted": tuple(sorted(wanted))}
        yield say("audit.other_laws", place=place, **lists)


def _find_angle(
    points: Sequence[tuple[float, float]], force: tuple[float, float]
) -> float | None:
    """Angle between a force and the curve that leaves the first point [rad]."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    least = _END_SHARE * math.hypot(x1 - x0, y1 - y0)
    for x, y in points[1:]:
        if math.hypot(x - x0, y - y0) >= least:
            turn = math.atan2(y - y0, x - x0) - math.atan2(force[1], force[0])
            return abs(math.remainder(turn, 2.0 * math.pi))
    return None
