"""Checks against the largest forces, the profile's factors and their own bands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from netdesign.checks.check import judge
from netdesign.checks.schema import (
    ACTION_FACTOR,
    MODES_WITHOUT_FORCE,
    ROPE_ANGLE,
)
from netdesign.outcome import Verdict
from netdesign.site.model import DEPENDENT_MODES, END_MODES, MEMBER_MODES
from netdesign.structure.members import CARRYING_MEMBERS, ROPE_OF, Member
from netdesign.study.audit.action_audit import audit_action, list_bringing
from netdesign.study.audit.comparing import SAME, Pair, tell_unequal, tell_verdict
from netdesign.study.audit.end_audit import audit_end
from netdesign.study.audit.envelope_audit import is_complete, name_members, same_point
from netdesign.study.demand import leave_out_governing
from netdesign.study.records import CheckRecord, ProfileRecord, RowStudy
from netdesign.words.message import Message, say
from netdesign.words.names import name_check

_NEVER_MET = ("profile.named", "inputs.plausible")  # there while something is open
# A post of which the snow's moment leaves nothing for the force along it.
_UNBOUNDED = "post_bending.too_much"
_REASONS = {
    Verdict.PASS: ("check.passes", "check.slack"),
    Verdict.FAIL: (
        *("check.fails", "check.fails_besides", "check.fails_though_declared"),
        _UNBOUNDED,
    ),
    Verdict.NOT_PROVEN: ("check.not_proven",),
    Verdict.DECLARED: ("check.declared",),
}


def audit_checks(
    row: RowStudy, profile: ProfileRecord, *, accepts_law: bool
) -> Iterator[Message]:
    """Sentences on what cannot be true of a row's checks.

    ``accepts_law`` says that the creep law is accepted outside its densities.
    """
    place = say("audit.row", row=row.id)
    counts = Counter(check.id for check in row.checks)
    yield from (
        say("audit.check_twice", place=place, check=name)
        for name, count in counts.items()
        if count > 1
    )
    modes = (*MEMBER_MODES, *DEPENDENT_MODES)
    wanted = [f"{member}.{mode}" for member, mode in modes]
    if _has_end(row, profile):
        wanted += [f"{name}.end" for name in wanted]
    if _has_ropes(row) and not _goes_on(row):
        wanted += [f"{member}.{mode}.end" for member, mode in END_MODES]
    wanted.append(f"{Member.POST}.lateral")
    wanted += ["geometry.inclination", *_list_open(row, profile)]
    lost = [name for name in wanted if name not in counts]
    if lost:
        yield say("audit.no_check", place=place, checks=tuple(lost))
    yield from _audit_floor(place, row, profile)
    factors = {value.id: value.value for value in profile.values}
    clauses = {value.id: value.clause for value in profile.values}
    for check in row.checks:
        where = say("audit.check", place=place, check=check.id)
        yield from _audit_itself(where, check)
        if check.mode in MODES_WITHOUT_FORCE:
            yield from _audit_direction(where, check, row, factors)
        elif check.member != Member.NET:
            yield from _audit_factors(where, check, factors, clauses)
            if not is_left_open(check, row):
                yield from _audit_force(where, check, row, factors)
                if not accepts_law:
                    yield from _audit_snow(where, check, row)


def _list_open(row: RowStudy, profile: ProfileRecord) -> Iterator[str]:
    """Checks of a row that are there only while something is open."""
    if profile.is_default:
        yield "profile.named"
    if row.questions:
        yield "inputs.plausible"


def _audit_itself(place: Message, check: CheckRecord) -> Iterator[Message]:
    """A check of any kind: its name, and a utilisation without a bound."""
    end = ".end" if check.position == "edge" else ""
    is_own = check.id == f"{check.member}.{check.mode}{end}"
    if not is_own and check.member != Member.NET:
        what = name_check(check.member, check.mode, check.position)
        yield say("audit.check_of_other", place=place, what=what)
    if check.id in _NEVER_MET and check.verdict is not Verdict.NOT_PROVEN:
        yield tell_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    if check.is_unbounded is not _is_used_up(check):
        yield say("audit.unbounded", place=place)


def _audit_force(
    place: Message, check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> Iterator[Message]:
    """A check of a force from the largest force of the cases to its verdict."""
    if row.unsaid:
        yield tell_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    if check.member in ROPE_OF:
        yield from audit_end(place, check, row)
    else:
        yield from audit_action(place, check, row, factors)
    yield from _audit_verdict(place, check, row)
    yield from _audit_spreads(place, check)


def is_left_open(check: CheckRecord, row: RowStudy) -> bool:
    """A check without numbers, for want of inputs that its force depends on."""
    of_end = check.position == "edge" and check.member in (
        *ROPE_OF,
        *(Member.POST, Member.POST_BASE),
    )
    numbers = (check.action_kN, check.demand_kN, check.utilisation)
    is_open = check.verdict in (Verdict.NOT_PROVEN, Verdict.DECLARED)
    is_empty = check.action is None and all(one is None for one in numbers)
    panel = row.panel
    is_assumed = panel is not None and panel.assumed and panel.failed
    return is_open and is_empty and bool(row.unsaid or of_end or is_assumed)


def _has_end(row: RowStudy, profile: ProfileRecord) -> bool:
    """Presence of a last support that a rule of the profile loads."""
    is_ruled = any(one.id == "end.constant" for one in profile.values)
    return is_ruled and not _goes_on(row)


def _goes_on(row: RowStudy) -> bool:
    """Absence of an end: the next work goes on without a gap."""
    ends = {("gap", 0.0), ("row_end", "continuous")}
    said = {(say(f"column.Nets.{key}"), value) for key, value in ends}
    return any((echo.label, echo.value) in said for echo in row.inputs)


def _has_ropes(row: RowStudy) -> bool:
    """Ropes between the posts, unless the row says that there are none."""
    system = say("column.Nets.panel_system")
    found = [echo.value for echo in row.inputs if echo.label == system]
    return found != ["none"] and (bool(found) or row.panel is not None)


def _audit_floor(
    place: Message, row: RowStudy, profile: ProfileRecord
) -> Iterator[Message]:
    """A floor where the profile takes one: a force of every member, or a reason."""
    floor = row.floor
    if (floor is None) is not (profile.floor == "none"):
        yield say("audit.floor_of_profile", place=place, floor=profile.floor)
    if floor is None:
        return
    named = [one.member for one in floor.forces]
    wanted = [] if floor.reason else list(CARRYING_MEMBERS)
    if sorted(named) != sorted(wanted):
        yield say("audit.floor_of_others", place=place, named=name_members(named))


def _audit_factors(
    place: Message,
    check: CheckRecord,
    factors: dict[str, float],
    clauses: dict[str, str],
) -> Iterator[Message]:
    keys = (f"resistance.{check.mode}.{check.resistance_basis}",
            f"resistance.{check.mode}")  # fmt: skip
    key = next((one for one in keys if one in factors), "")
    yield from tell_unequal(
        place,
        [
            ("action_factor", check.action_factor, factors.get(ACTION_FACTOR)),
            ("resistance_factor", check.resistance_factor, factors.get(key)),
        ],
    )
    if check.clause != clauses.get(key, "-"):
        yield say("audit.other_clause", place=place, clause=check.clause)
    has_parts = check.resistance_characteristic_kN and check.resistance_factor
    if (check.resistance_kN is None) is not (not has_parts):
        yield say("audit.resistance_or_parts", place=place)


def _audit_direction(
    place: Message, check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> Iterator[Message]:
    """Directions against the limits of the profile; where they pass, all is solved."""
    if check.verdict is Verdict.PASS and not is_complete(row):
        yield tell_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    if check.mode != "direction":
        return
    own = [one for one in row.pulls if one.anchor == check.member]
    at_end = [one for one in own if one.position == check.position]
    pull = next(iter(at_end or own), None)
    if pull is None:
        yield say("audit.action_or_force", place=place)
        return
    most = factors.get(ROPE_ANGLE)
    beyond = Verdict.FAIL if most is not None else Verdict.NOT_PROVEN
    is_kept = most is not None and pull.angle_deg <= most * (1.0 + SAME)
    if not pull.is_axis_known and check.verdict is Verdict.PASS:
        yield tell_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    is_declared = check.verdict is Verdict.DECLARED and check.declared is not None
    if _is_information(check, row) or (
        is_declared and (is_kept or beyond is not Verdict.FAIL)
    ):
        return
    if is_kept and check.verdict is Verdict.FAIL:
        yield tell_verdict(place, check.verdict, Verdict.PASS)
    if not is_kept and check.verdict is not beyond:
        yield tell_verdict(place, check.verdict, beyond)


def _audit_verdict(
    place: Message, check: CheckRecord, row: RowStudy
) -> Iterator[Message]:
    """The verdict from the band, as ``checks.check`` gives it."""
    complete = is_complete(row)
    resistance, verdict = check.resistance_kN, Verdict.NOT_PROVEN
    low, high = check.demand_low_kN, check.demand_high_kN
    used_low, used_high = check.utilisation_band
    is_known = low is not None and high is not None and check.demand_kN is not None
    if resistance and used_low is not None and used_high is not None:
        verdict = judge(used_low, used_high, least=0.0, most=1.0, is_complete=complete)
    if check.is_unbounded:
        verdict = Verdict.FAIL
    if bool(resistance and is_known) and check.utilisation is None:
        yield say("audit.no_utilisation", place=place)
    is_open = is_held_back(check) or _is_information(check, row)
    is_declared = check.verdict is Verdict.DECLARED and check.declared is not None
    if is_declared and verdict is not Verdict.FAIL:
        is_open = True
    if check.verdict is not verdict and not is_open:
        yield tell_verdict(place, check.verdict, verdict)
    if leave_out_governing(check.reason).key not in _REASONS[check.verdict]:
        told = say(f"verdict.{check.verdict}")
        yield say("audit.other_reason", place=place, verdict=told)


def _is_used_up(check: CheckRecord) -> bool:
    """A moment leaves nothing of the post for the force along it, by its reason."""
    has_numbers = check.utilisation is not None or check.resistance_kN is not None
    return _find_own_reason(check).key == _UNBOUNDED and not has_numbers


def _find_own_reason(check: CheckRecord) -> Message:
    """The reason of a check without the load that governs and without declarations."""
    reason = leave_out_governing(check.reason)
    alone = reason.arguments.get("reason")
    is_declared = reason.key == "check.fails_though_declared"
    return alone if is_declared and isinstance(alone, Message) else reason


def _is_information(check: CheckRecord, row: RowStudy) -> bool:
    """The check is left open since the net stands below its snow."""
    too_low = any(
        one.id == "geometry.height" and one.verdict is Verdict.FAIL
        for one in row.checks
    )
    return too_low and check.verdict is Verdict.NOT_PROVEN


def _audit_snow(place: Message, check: CheckRecord, row: RowStudy) -> Iterator[Message]:
    """No pass on a force of snow for which the creep law is not given."""
    points = [one.case for one in list_bringing(check, row) if one.high_kN]
    if check.verdict is Verdict.PASS and any(
        same_point(point, case.case)
        for case in row.cases
        if not case.is_calibrated
        for point in points
    ):
        yield say("audit.extrapolated_pass", place=place)


def is_held_back(check: CheckRecord) -> bool:
    """A check that would pass is not proven for a reason beside its numbers.

    Such as a fault of the program in a solve that the check does not rest on.
    """
    high, resistance = check.demand_high_kN, check.resistance_kN
    is_met = high is not None and bool(resistance) and high <= (resistance or 0.0)
    reason = leave_out_governing(check.reason)
    is_told = reason.key in _REASONS[Verdict.NOT_PROVEN]
    return check.verdict is Verdict.NOT_PROVEN and is_met and is_told


def _audit_spreads(place: Message, check: CheckRecord) -> Iterator[Message]:
    """Parts of the interval that count in the verdict make up its band."""
    counted = [spread for spread in check.spreads if spread.in_verdict]
    used, resistance = check.utilisation, check.resistance_kN
    if not counted:
        if used and resistance:
            yield say("audit.no_spread", place=place)
        return
    ends = [(one.low, one.high) for one in counted]
    if not resistance or used is None or any(None in pair for pair in ends):
        yield say("audit.spread_without_numbers", place=place)
        return
    low = min(used, *(one or 0.0 for one, _ in ends))
    high = used + sum((one or 0.0) - used for _, one in ends)
    bands = (check.demand_low_kN or 0.0, check.demand_high_kN or 0.0)
    pairs: list[Pair] = [("spreads.low", low, bands[0] / resistance)]
    if check.member != Member.POST_BASE:
        pairs.append(("spreads.high", high, bands[1] / resistance))
    yield from tell_unequal(place, pairs)
