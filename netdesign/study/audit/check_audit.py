"""Checks against the largest forces, the profile's factors and their own bands."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from netdesign.checks.check import judge
from netdesign.checks.schema import (
    ACTION_FACTOR,
    BAR_ANGLE,
    LATERAL_SHARE,
    MODES_WITHOUT_FORCE,
    ROPE_ANGLE,
)
from netdesign.outcome import Verdict
from netdesign.site.model import DEPENDENT_MODES, END_MODES, MEMBER_MODES
from netdesign.structure.members import (
    BROUGHT_BY,
    CARRYING_MEMBERS,
    ROPE_OF,
    Member,
    name_in_panel,
)
from netdesign.structure.row_position import compute_lateral_factor
from netdesign.study.audit.comparing import (
    SAME,
    Pair,
    is_same,
    tell_unequal,
    tell_verdict,
)
from netdesign.study.audit.end_audit import audit_end
from netdesign.study.audit.envelope_audit import (
    is_complete,
    name_members,
    same_point,
)
from netdesign.study.case_records import ExtremeRecord
from netdesign.study.demand import leave_out_governing, tell_governing
from netdesign.study.guideline_records import FloorForceRecord
from netdesign.study.records import ActionRecord, CheckRecord, ProfileRecord, RowStudy
from netdesign.study.values import show_value
from netdesign.words.message import Message, say
from netdesign.words.names import name_check

_REASONS = {
    Verdict.PASS: ("check.passes", "check.slack"),
    Verdict.FAIL: (
        *("check.fails", "check.fails_besides", "check.fails_though_declared"),
        "post_bending.too_much",
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
    if row.panel is not None and not _goes_on(row):
        wanted += [f"{member}.{mode}.end" for member, mode in END_MODES]
    wanted.append(f"{Member.POST}.lateral")
    lost = [name for name in (*wanted, "geometry.inclination") if name not in counts]
    if lost:
        yield say("audit.no_check", place=place, checks=tuple(lost))
    yield from _audit_floor(place, row, profile)
    factors = {value.id: value.value for value in profile.values}
    clauses = {value.id: value.clause for value in profile.values}
    for check in row.checks:
        where = say("audit.check", place=place, check=check.id)
        end = ".end" if check.position == "edge" else ""
        is_own = check.id == f"{check.member}.{check.mode}{end}"
        if not is_own and check.member != Member.NET:
            what = name_check(check.member, check.mode, check.position)
            yield say("audit.check_of_other", place=where, what=what)
        if check.mode in MODES_WITHOUT_FORCE:
            yield from _audit_direction(where, check, row, factors)
        elif check.member != Member.NET:
            yield from _audit_factors(where, check, factors, clauses)
            if check.member in ROPE_OF:
                yield from audit_end(where, check, row)
            else:
                yield from _audit_action(where, check, row, factors)
            yield from _audit_verdict(where, check, row)
            if not accepts_law:
                yield from _audit_snow(where, check, row)
            yield from _audit_spreads(where, check)


def _has_end(row: RowStudy, profile: ProfileRecord) -> bool:
    """Presence of a last support that a rule of the profile loads."""
    is_ruled = any(one.id == "end.constant" for one in profile.values)
    return is_ruled and not _goes_on(row)


def _goes_on(row: RowStudy) -> bool:
    """Absence of an end: the next work goes on without a gap."""
    gap = say("column.Nets.gap")
    return any(echo.label == gap and echo.value == 0.0 for echo in row.inputs)


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


def _audit_action(
    place: Message, check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> Iterator[Message]:
    """Follow the largest force of the cases to the demand."""
    record, extreme = check.action, _find_extreme(check, row)
    if extreme is None or record is None:
        if check.action_kN is not None or (extreme is None) is not (record is None):
            yield say("audit.action_or_force", place=place)
        return
    is_part = check.member == Member.POST_BASE
    lateral = _find_lateral(check, row, factors)
    on_row = record.loaded_width_m / record.post_spacing_m * record.lateral_factor
    least = _find_floor(check, row)
    on_support = None
    if least is not None:
        on_support = (record.share * least.force_kN + record.added_kN) * on_row
    factor, floor = check.action_factor or 0.0, on_support or 0.0
    solved = (record.share * record.solved_kN + record.added_kN) * on_row
    beside = _find_panel(check, row)
    by_panel = _find_by_panel(record, on_row)
    pairs: list[Pair] = [
        ("lateral_factor", record.lateral_factor, lateral),
        ("floor_kN", record.floor_kN, least.force_kN if least else None),
        ("guideline_kN", record.guideline_kN, on_support),
        (
            "floor_inclination_deg",
            record.floor_inclination_deg,
            least.inclination_deg if least else None,
        ),
        ("action_kN", check.action_kN, max(solved, by_panel, floor)),
    ]
    if check.action_factor is not None:
        high = max(record.coupled_kN, record.panel_support_kN or 0.0, floor) * factor
        pairs.append(("demand_high_kN", check.demand_high_kN, high))
        low = record.share * (record.solved_low_kN or 0.0) + record.added_low_kN
        by_panel_low = _find_low_by_panel(record, beside, on_row)
        low = max(low * on_row, floor, by_panel_low) * factor
        pairs.append(("demand_low_kN", check.demand_low_kN, low))
    if not is_part:
        pairs.append(("solved_kN", record.solved_kN, extreme.max_kN))
        pairs.append(("solved_low_kN", record.solved_low_kN, extreme.low_kN))
        high_end = record.coupled_kN
        yield from _audit_high_end(place, record, extreme, on_row, high_end)
        larger = beside if beside is not None and record.is_by_panel else extreme
        if not same_point(check.case, larger.case):
            yield say("audit.other_case", place=place)
    elif record.solved_kN > extreme.max_kN * (1.0 + SAME):
        yield say("audit.more_on_base", place=place)
    elif record.coupled_kN < solved * (1.0 - SAME):
        told = show_value(record.coupled_kN)
        yield say("audit.too_low_end", place=place, high=told, least=solved)
    yield from _audit_panel(place, record, beside, on_row)
    yield from tell_unequal(place, pairs)
    yield from _audit_governing(place, check, record, least)
    yield from _audit_width(place, check, record)


def _find_panel(check: CheckRecord, row: RowStudy) -> ExtremeRecord | None:
    """Largest force of the check's member by the panel between posts."""
    name = name_in_panel(check.member)
    found = row.panel.extremes if row.panel else []
    return next((one for one in found if one.quantity == name), None)


def _find_by_panel(record: ActionRecord, on_row: float) -> float:
    """Force on the support by the panel between posts; 0 without one [kN]."""
    if record.panel_kN is None:
        return 0.0
    inside = record.share * record.panel_kN + record.added_kN
    return inside * on_row + record.along_kN


def _find_low_by_panel(
    record: ActionRecord, beside: ExtremeRecord | None, on_row: float
) -> float:
    if beside is None:
        return 0.0
    inside = record.share * beside.low_kN + record.added_low_kN
    return inside * on_row + record.along_low_kN


def _audit_panel(
    place: Message, record: ActionRecord, beside: ExtremeRecord | None, on_row: float
) -> Iterator[Message]:
    """The force by the panel between posts against the largest of the cases."""
    yield from tell_unequal(
        place,
        [
            ("panel_kN", record.panel_kN, beside.max_kN if beside else None),
            ("panel_low_kN", record.panel_low_kN, beside.low_kN if beside else None),
        ],
    )
    if beside is not None:
        high = (record.panel_support_kN or 0.0) - record.along_high_kN
        yield from _audit_high_end(place, record, beside, on_row, high)


def _find_floor(check: CheckRecord, row: RowStudy) -> FloorForceRecord | None:
    forces = row.floor.forces if row.floor else []
    return next((one for one in forces if one.member == check.member), None)


def _audit_governing(
    place: Message,
    check: CheckRecord,
    record: ActionRecord,
    least: FloorForceRecord | None,
) -> Iterator[Message]:
    """Governing load: the larger one, which the reason names."""
    governs = record.governing
    case = least.load_case if least else ""
    reason = tell_governing(leave_out_governing(check.reason), record)
    if (record.governs, record.floor_case) != (governs, case) or reason != check.reason:
        yield say("audit.other_load", place=place, load=say(f"load_name.{governs}"))


def _audit_width(
    place: Message, check: CheckRecord, record: ActionRecord
) -> Iterator[Message]:
    """Width of the support that the check names; of two near a threshold the wider."""
    width, spacing = record.loaded_width_m, record.post_spacing_m
    ends = record.end_factor * record.end_length_m
    expected = 0.5 * spacing + ends if record.position == "edge" else spacing
    is_known = record.position in ("intermediate", "edge")
    is_wider = record.other_width_m is None or record.other_width_m <= width
    if (
        not (is_known and is_wider and is_same(width, expected))
        or record.position != check.position
    ):
        yield say("audit.position", place=place, width=width, spacing=spacing)


def _audit_high_end(
    place: Message,
    record: ActionRecord,
    extreme: ExtremeRecord,
    on_row: float,
    high: float,
) -> Iterator[Message]:
    """The high end: of a search exactly, of a grid with what is estimated between."""
    least = (record.share * extreme.high_kN + record.added_high_kN) * on_row
    if extreme.upper_bound_kN is not None:
        yield from tell_unequal(place, [("coupled_kN", high, least)])
    elif high < least * (1.0 - SAME):
        yield say("audit.too_low_end", place=place, high=show_value(high), least=least)


def _find_extreme(check: CheckRecord, row: RowStudy) -> ExtremeRecord | None:
    extremes = {extreme.quantity: extreme for extreme in row.extremes}
    if _is_shared(check, row):
        return extremes.get(Member.FOOT_ANCHOR)  # one anchor carries both, (S7)
    if check.member in extremes:
        return extremes[check.member]
    return extremes.get(BROUGHT_BY.get(check.member, Member.NET))  # its guy's or post's


def list_bringing(check: CheckRecord, row: RowStudy) -> list[ExtremeRecord]:
    """Largest forces that a check rests on: its member's, and what adds to it.

    The net's pull on the head brings what is added, as it does the post's force.
    """
    own = _find_extreme(check, row)
    by_panel = _find_panel(check, row)
    found = [one for one in (own, by_panel) if one is not None]
    if check.action is not None and check.action.added_high_kN > 0.0:
        found += [one for one in row.extremes if one.quantity == Member.POST]
    return found


def _find_lateral(
    check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> float:
    """Factor of the load along the row at the net's foot; 1 elsewhere."""
    if check.member == Member.FOOT_ANCHOR or _is_shared(check, row):
        return compute_lateral_factor(factors.get(LATERAL_SHARE, 0.0))
    return 1.0


def _is_shared(check: CheckRecord, row: RowStudy) -> bool:
    """True of a check of an uphill anchor that lies at the net's foot."""
    drawing = row.drawing
    is_at_foot = drawing is not None and drawing.uphill_anchor_m == (0.0, 0.0)
    return check.member == Member.UPHILL_ANCHOR and is_at_foot


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
    is_rope = pull.kind == "rope anchor"
    most = factors.get(ROPE_ANGLE if is_rope else BAR_ANGLE)
    beyond = Verdict.FAIL if is_rope and most is not None else Verdict.NOT_PROVEN
    is_kept = most is not None and pull.angle_deg <= most * (1.0 + SAME)
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
    if _find_own_reason(check).key == "post_bending.too_much":
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
        same_point(point, case.case) and not case.is_calibrated
        for point in points
        for case in row.cases
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
