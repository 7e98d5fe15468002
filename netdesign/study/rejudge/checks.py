"""Checks of a stored study against its forces, its profile and their own numbers."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from statistics import fmean
from typing import Any

from netdesign.calculation.quantity import Kind, Quantity
from netdesign.calculation.steps import SAME, Step, evaluate, list_steps
from netdesign.checks.check import judge
from netdesign.checks.forces import (
    GUYS_ON_ANCHOR,
    calculate_force,
    calculate_resistance,
    rate,
)
from netdesign.checks.schema import (
    LATERAL_SHARE,
    MODES_WITHOUT_FORCE,
    ROPE_ANGLE,
    TEST_SCATTER,
    list_action_factors,
)
from netdesign.outcome import ModelError, Verdict
from netdesign.resistance.fractile import (
    find_fractile,
    find_fractile_of_known_scatter,
)
from netdesign.resistance.pull_out import SingleTest
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
    ROPE_OF,
    Member,
    NetPart,
    RopeForce,
    name_in_panel,
)
from netdesign.study.check_to_record import UNBOUNDED
from netdesign.study.find_input import find_input, find_word
from netdesign.study.member_force import PARTS, PUSHED, leave_out_governing, lifts
from netdesign.study.records import (
    CheckRecord,
    ProfileRecord,
    RowStudy,
    SingleTestRecord,
)
from netdesign.study.rejudge.cases import (
    Pair,
    guard,
    is_complete,
    name_members,
    report_differences,
    report_unequal,
    report_value,
    report_verdict,
    same_point,
)
from netdesign.study.support_records import HeldSidewaysRecord
from netdesign.units import kilonewton_from_newton, newton_from_kilonewton
from netdesign.words.message import Message, say
from netdesign.words.names import name_check

_NEVER_MET = ("profile.named", "inputs.plausible")  # there while something is open
_REASONS = {
    Verdict.PASS: ("check.passes", "check.slack"),
    Verdict.FAIL: (
        *("check.fails", "check.fails_besides", "check.fails_though_declared"),
        *UNBOUNDED,
    ),
    Verdict.NOT_PROVEN: ("check.not_proven",),
    Verdict.DECLARED: ("check.declared",),
}
_RULES = "end.constant"  # names the rule of the row's end, not a value


def rejudge_checks(
    row: RowStudy, profile: ProfileRecord, *, accepts_law: bool
) -> Iterator[Message]:
    """Sentences on what cannot be true of a row's checks.

    ``accepts_law`` says that the creep law is accepted outside its densities.
    """
    place = say("audit.row", row=row.id)
    yield from _look_for_all(place, row, profile)
    yield from _look_for_floor(place, row, profile)
    values = {value.id: value.value for value in profile.values}
    clauses = {value.id: value.clause for value in profile.values}
    known = _list_known(row)
    for check in row.checks:
        where = say("audit.check", place=place, check=check.id)
        yield from _rejudge_itself(where, check)
        if check.mode in MODES_WITHOUT_FORCE:
            yield from _rejudge_direction(where, check, row, values)
        elif check.member != Member.NET:
            yield from _rejudge_factors(where, check, values, clauses)
            yield from _rejudge_tests(
                where, check, profile.route, values.get(TEST_SCATTER)
            )
            steps = _rejudge_steps(where, check, known, values)
            yield from guard(where, steps)
            if check.is_of_force:
                yield from _rejudge_sources(where, check, row, known, values)
                yield from _rejudge_sharing(where, check, profile.shared_sum)
            yield from _rejudge_force(where, check, row, profile.not_checked)
            if not accepts_law:
                yield from _rejudge_snow(where, check, row)


def _look_for_all(
    place: Message, row: RowStudy, profile: ProfileRecord
) -> Iterator[Message]:
    """Every check that a row has to have, once."""
    counts = Counter(check.id for check in row.checks)
    for twice in (name for name, count in counts.items() if count > 1):
        yield say("audit.check_twice", place=place, check=twice)
    inside = _add_connections((*MEMBER_MODES, *DEPENDENT_MODES), profile)
    wanted = [f"{member}.{mode}" for member, mode in inside]
    if lifts(row.forces, row.floor.forces if row.floor else ()):
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
    return any(one.id == _RULES for one in profile.values) and not _goes_on(row)


def _goes_on(row: RowStudy) -> bool:
    """Absence of an end: the next work goes on without a gap."""
    return find_input(row, "gap") == 0.0 or find_word(row, "row_end") == "continuous"


def _has_ropes(row: RowStudy) -> bool:
    """Ropes between the posts, unless the row says that there are none."""
    system = say("column.Nets.panel_system")
    found = [echo.value for echo in row.inputs if echo.label == system]
    return found != ["none"] and (bool(found) or row.panel is not None)


def _look_for_floor(
    place: Message, row: RowStudy, profile: ProfileRecord
) -> Iterator[Message]:
    """A floor where the profile takes one: a force of every member, or a reason."""
    floor = row.floor
    if (floor is None) is not (profile.floor == "none"):
        yield say("audit.floor_of_profile", place=place, floor=profile.floor)
    if floor is not None:
        named = [one.member for one in floor.forces]
        wanted = [] if floor.reason else [*CARRYING_MEMBERS, NetPart.MESH]
        if sorted(named) != sorted(wanted):
            yield say("audit.floor_of_others", place=place, named=name_members(named))


def _rejudge_itself(place: Message, check: CheckRecord) -> Iterator[Message]:
    """A check of any kind: its name, and a utilisation without a bound."""
    end = ".end" if check.position == "edge" else ""
    is_own = check.id == f"{check.member}.{check.mode}{end}"
    if not is_own and check.member != Member.NET:
        what = name_check(check.member, check.mode, check.position)
        yield say("audit.check_of_other", place=place, what=what)
    if check.id in _NEVER_MET and check.verdict is not Verdict.NOT_PROVEN:
        yield report_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    if check.is_unbounded is not _is_used_up(check):
        yield say("audit.unbounded", place=place)


def _is_used_up(check: CheckRecord) -> bool:
    """Nothing is left of a post or its foot for the force along it, by its reason."""
    has_numbers = check.utilisation is not None or check.resistance_kN is not None
    reason = leave_out_governing(check.reason)
    alone = reason.arguments.get("reason")
    if reason.key == "check.fails_though_declared" and isinstance(alone, Message):
        reason = alone
    return reason.key in UNBOUNDED and not has_numbers


def _rejudge_factors(
    place: Message,
    check: CheckRecord,
    values: Mapping[str, float],
    clauses: Mapping[str, str],
) -> Iterator[Message]:
    general = f"resistance.{check.mode}"
    named = f"{general}.{check.resistance_basis}"
    key = next((one for one in (named, general) if one in values), "")
    on_action = list_action_factors(check.mode)
    factor = next((values[one] for one in on_action if one in values), None)
    yield from report_unequal(
        place,
        [
            ("γ_E", check.read("γ_E"), factor),
            ("γ_R", check.read("γ_R"), values.get(key)),
        ],
    )
    if check.clause != clauses.get(key, "-"):
        yield say("audit.other_clause", place=place, clause=check.clause)


Ends = tuple[float | None, float | None, float | None]


def _list_known(row: RowStudy) -> dict[str, Ends]:
    """Solved quantities that a row states, by their sources: low end, value, high."""
    known: dict[str, Ends] = {
        one.quantity: (one.low_kN, one.value_kN, one.high_kN) for one in row.forces
    }
    for least in row.floor.forces if row.floor else ():
        known[f"floor.{least.member}"] = (least.force_kN,) * 3
    known["tilt"] = (row.tilt,) * 3
    held = row.held_sideways
    if held is not None:
        known["head_pull"] = (held.pull_low_kN, held.pull_kN, held.pull_high_kN)
        known["least_tension"] = (held.least_tension_kN,) * 3
        for part in ("uphill_part", "downhill_part", "post_part"):
            known[part] = (getattr(held, part),) * 3
    return known


def _rejudge_steps(
    place: Message,
    check: CheckRecord,
    known: Mapping[str, Ends],
    values: Mapping[str, float],
) -> Iterator[Message]:
    """Every step from the leaves, and these from forces and profile."""
    again = list_steps(_calculate(evaluate(check.steps)))
    yield from report_differences(
        "audit.other_steps",
        {one.symbol: one for one in check.steps},
        {one.symbol: one for one in again},
        is_exact=True,
        place=place,
    )
    for step in check.steps:
        yield from _rejudge_leaf(place, step, known, values)
    yield from report_unequal(
        place,
        [
            ("demand_kN", check.demand_kN, check.read("E_d")),
            ("resistance_kN", check.resistance_kN, check.read("R_d")),
            ("utilisation", check.utilisation, check.read("μ")),
        ],
    )


def _calculate(found: Mapping[str, Quantity]) -> Quantity:
    """Utilisation from the leaves of a stored calculation, as it was made."""
    leaves = {name: one for name, one in found.items() if one.kind is not Kind.WORKED}
    force = None if "E_k" in leaves else calculate_force(leaves)
    resistance = calculate_resistance(leaves, force)
    action = force.action if force else leaves["E_k"]
    return rate(action, leaves["γ_E"], resistance, leaves["γ_R"])


def _rejudge_sharing(
    place: Message, check: CheckRecord, shared_sum: str
) -> Iterator[Message]:
    """Pulls of two guys on one anchor, added as the profile says."""
    for added, symbol in GUYS_ON_ANCHOR.items():
        if symbol in check.known and added != shared_sum:
            yield report_value(place, "shared_sum", added, shared_sum)


def _rejudge_tests(
    place: Message, check: CheckRecord, route: str, scatter: float | None
) -> Iterator[Message]:
    """Resistance by the way that counts, its leaves by the tests."""
    tests = check.tests
    if tests is None:
        if {"R_m", "R_G"} & set(check.known):
            yield say("audit.no_tests", place=place)
        return
    if tests.route != route:
        yield report_value(place, "route", tests.route, route)
    loads = [one.load_kN for one in tests.singles]
    pairs: list[Pair] = [("R_k", check.read("R_k"), tests.routes.get(route))]
    if "R_m" in check.known:
        pairs.append(("R_m", check.read("R_m"), tests.mean_kN))
        pairs.append(("R_min", check.read("R_min"), tests.least_kN))
    if loads:
        pairs.append(("count", float(tests.count), float(len(loads))))
        pairs.append(("least_kN", tests.least_kN, min(loads)))
        pairs.append(("mean_kN", tests.mean_kN, fmean(loads)))
    singles = [_read_single(one) for one in tests.singles]
    pairs += [
        (key, tests.routes.get(key), one)
        for key, one in _take_fractiles(singles, scatter)
    ]
    yield from report_unequal(place, pairs)


def _read_single(one: SingleTestRecord) -> SingleTest:
    return SingleTest(load=newton_from_kilonewton(one.load_kN), is_held=one.is_held)


def _take_fractiles(
    singles: Sequence[SingleTest], scatter: float | None
) -> Iterator[tuple[str, float | None]]:
    """Fractiles of single tests [kN], by the ways that take them."""
    known = None
    if singles and scatter is not None:
        known = find_fractile_of_known_scatter(singles, scatter).value
    unknown = None
    with suppress(ModelError):
        unknown = find_fractile(singles).value if singles else None
    for key, found in (("scatter_known", known), ("scatter_unknown", unknown)):
        yield key, None if found is None else kilonewton_from_newton(found)


def _rejudge_leaf(
    place: Message,
    step: Step,
    known: Mapping[str, Ends],
    values: Mapping[str, float],
) -> Iterator[Message]:
    if step.kind is Kind.SOLVED and step.value is not None:
        expected: Ends = known.get(step.source, (None, None, None))
        names = (f"{step.symbol}.low", step.symbol, f"{step.symbol}.high")
        yield from report_unequal(
            place, list(zip(names, step.ends, expected, strict=True))
        )
    if step.kind is Kind.PROFILE and step.source in values and step.source != _RULES:
        yield from report_unequal(
            place, [(step.symbol, step.value, values[step.source])]
        )


def _rejudge_sources(
    place: Message,
    check: CheckRecord,
    row: RowStudy,
    known: Mapping[str, Ends],
    values: Mapping[str, float],
) -> Iterator[Message]:
    """Every force that bears on a member is among its leaves, and no other one."""
    expected = _name_sources(check, row, known)
    if check.mode == "sliding":
        expected["t"] = "tilt"
    if check.position == "edge":
        expected["f_R"] = _RULES
    if _is_at_foot(check, row) and LATERAL_SHARE in values:
        expected["k"] = LATERAL_SHARE
    solved = {one.symbol for one in check.steps if one.kind is Kind.SOLVED}
    for symbol in dict.fromkeys((*expected, *sorted(solved))):
        step, follows = check.known.get(symbol), expected.get(symbol, "")
        stored = step.source if step else ""
        if stored != follows:
            yield report_value(place, f"{symbol}.source", stored, follows)


def _name_sources(
    check: CheckRecord, row: RowStudy, known: Mapping[str, Ends]
) -> dict[str, str]:
    """Solved quantities that a member's force follows from, by their symbols."""
    member = check.member
    if member in ROPE_OF:
        return {"T_b" if member in tuple(NetPart) else "T_r": ROPE_OF[member]}
    panel, letter = name_in_panel(member), "V" if check.mode == "sliding" else "E"
    sources = {f"{letter}_p0": panel, f"{letter}_g0": f"floor.{member}"}
    sources = {symbol: one for symbol, one in sources.items() if one in known}
    sources[f"{letter}_s"] = member
    is_pushed = check.position == "edge" and member in PUSHED and panel in known
    if is_pushed and row.panel is not None and row.panel.end_guy_deg is not None:
        sources["T_r"] = RopeForce.UPPER_ALONG
    return sources | _name_sideways(member, row.held_sideways)


def _name_sideways(member: str, held: HeldSidewaysRecord | None) -> dict[str, str]:
    """Solved quantities by which the load along the row adds to a member's force."""
    stiff = (Member.FOOT_ANCHOR, Member.POST_FOOT, NetPart.MESH)
    if held is None or member in stiff:
        return {}
    if member in PARTS:
        return {"c": PARTS[member], "P": "head_pull"}
    splay = math.radians(held.splay_deg)
    if held.share * held.pull_high_kN / math.tan(splay) <= held.least_tension_kN:
        return {}  # what the guys hold anyway
    return {"w": "post_part", "P": "head_pull", "T_min": "least_tension"}


def _is_at_foot(check: CheckRecord, row: RowStudy) -> bool:
    """The load along the row acts on that anchor at the net's foot."""
    is_shared = any(one.uphill_x_m == 0.0 for one in row.statics)
    at_foot = {Member.FOOT_ANCHOR, *([Member.UPHILL_ANCHOR] if is_shared else [])}
    return check.member in at_foot


def is_left_open(check: CheckRecord, row: RowStudy) -> bool:
    """A check without a force, for want of inputs that its force depends on."""
    of_end = check.member in ROPE_OF or (
        check.position == "edge" and check.member in (Member.POST, Member.POST_BASE)
    )
    is_open = check.verdict in (Verdict.NOT_PROVEN, Verdict.DECLARED)
    panel = row.panel
    is_assumed = panel is not None and panel.assumed and panel.failed
    is_empty = not check.is_of_force and check.read("E_k") is None
    return is_open and is_empty and bool(row.unsaid or of_end or is_assumed)


def _rejudge_force(
    place: Message, check: CheckRecord, row: RowStudy, not_checked: Collection[str]
) -> Iterator[Message]:
    """A check of a force: its case, governing load, verdict, interval."""
    if is_left_open(check, row):
        return
    if row.unsaid:
        yield report_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    has_force = any(one.quantity == _name_force(check) for one in row.forces)
    if check.is_of_force is not has_force:
        yield say("audit.action_or_force", place=place)
    elif has_force:
        yield from _rejudge_governing(place, check, row)
    yield from _rejudge_verdict(place, check, row)
    if check.verdict is Verdict.PASS and _is_unsure(check, not_checked):
        yield report_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    yield from _rejudge_spreads(place, check)


def _name_force(check: CheckRecord) -> str:
    """Key of the force by the section, or of the rope, that a check rests on."""
    return ROPE_OF.get(check.member, check.member)


def _rejudge_governing(
    place: Message, check: CheckRecord, row: RowStudy
) -> Iterator[Message]:
    """Governing load: the larger one; its case."""
    forces = {one.quantity: one for one in row.forces}
    largest = forces[_name_force(check)]
    if check.is_by_panel and check.member not in ROPE_OF:
        largest = forces[f"panel_{check.member}"]
    if not same_point(check.case, largest.case):
        yield say("audit.other_case", place=place)
    governs, found = "panel", row.floor.forces if row.floor else ()
    least = next((one for one in found if one.member == check.member), None)
    if check.member not in ROPE_OF:
        governs = _find_governing(check)
        if check.load_case != (least.load_case if least else ""):
            yield say("audit.other_load", place=place, load=say(f"load_name.{governs}"))
    if check.governs != governs:
        yield say("audit.other_load", place=place, load=say(f"load_name.{governs}"))


def _find_governing(check: CheckRecord) -> str:
    """Largest one of the loads on a support; solved ones count with upper ends."""
    coupled, by_panel, least = (
        check.read_band(check.name_force(one))[1] or 0.0 for one in "cpg"
    )
    if least and least >= max(coupled, by_panel):
        return "guideline"
    return "panel" if by_panel > coupled else "coupled"


def _rejudge_verdict(
    place: Message, check: CheckRecord, row: RowStudy
) -> Iterator[Message]:
    """The verdict from the band, as ``checks.check`` gives it."""
    low, high = check.utilisation_band
    verdict = Verdict.NOT_PROVEN
    if low is not None and high is not None:
        verdict = judge(low, high, least=0.0, most=1.0, is_complete=is_complete(row))
    if check.is_unbounded:
        verdict = Verdict.FAIL
    is_open = is_held_back(check) or _is_information(check, row)
    is_declared = check.verdict is Verdict.DECLARED and check.declared is not None
    if is_declared and verdict is not Verdict.FAIL:
        is_open = True
    if check.verdict is not verdict and not is_open:
        yield report_verdict(place, check.verdict, verdict)
    if leave_out_governing(check.reason).key not in _REASONS[check.verdict]:
        told = say(f"verdict.{check.verdict}")
        yield say("audit.other_reason", place=place, verdict=told)


def _is_unsure(check: CheckRecord, not_checked: Collection[str]) -> bool:
    """Nobody says in which ground a resistance holds, or how long its steel lasts."""
    if check.mode == "pull_out":
        return not check.resistance_ground
    is_steel = check.mode in ("tendon", "rope", "bending")
    return is_steel and "corrosion" not in not_checked and not check.resistance_years


def is_held_back(check: CheckRecord) -> bool:
    """A check that would pass is not proven for a reason beside its numbers.

    Such as a fault of the program in a solve that the check does not rest on.
    """
    _, high = check.utilisation_band
    is_met = high is not None and high <= 1.0
    is_told = leave_out_governing(check.reason).key in _REASONS[Verdict.NOT_PROVEN]
    return check.verdict is Verdict.NOT_PROVEN and is_met and is_told


def _is_information(check: CheckRecord, row: RowStudy) -> bool:
    """The check is left open since the net stands below its snow."""
    too_low = any(
        one.id == "geometry.height" and one.verdict is Verdict.FAIL
        for one in row.checks
    )
    return too_low and check.verdict is Verdict.NOT_PROVEN


def _rejudge_spreads(place: Message, check: CheckRecord) -> Iterator[Message]:
    """Parts of the interval that count in the verdict make up its band."""
    counted = [spread for spread in check.spreads if spread.in_verdict]
    used, band = check.utilisation, check.utilisation_band
    if not counted:
        if used:
            yield say("audit.no_spread", place=place)
        return
    ends = [(one.low, one.high) for one in counted]
    if used is None or any(None in pair for pair in ends):
        yield say("audit.spread_without_numbers", place=place)
        return
    low = min(used, *(one or 0.0 for one, _ in ends))
    high = used + sum((one or 0.0) - used for _, one in ends)
    pairs: list[Pair] = [("spreads.low", low, band[0]), ("spreads.high", high, band[1])]
    yield from report_unequal(place, pairs)


def _rejudge_snow(
    place: Message, check: CheckRecord, row: RowStudy
) -> Iterator[Message]:
    """No pass on a force of snow for which the creep law is not given."""
    if check.verdict is not Verdict.PASS:
        return
    names = [_name_force(check), f"panel_{check.member}"]
    names += [Member.POST] if check.read_band("A")[1] else []
    points = [one.case for one in row.forces if one.quantity in names and one.high_kN]
    light = [case.case for case in row.cases if not case.is_calibrated]
    if any(same_point(point, case) for case in light for point in points):
        yield say("audit.extrapolated_pass", place=place)


def _rejudge_direction(
    place: Message, check: CheckRecord, row: RowStudy, values: Mapping[str, Any]
) -> Iterator[Message]:
    """Directions against the limits of the profile; where they pass, all is solved."""
    if check.verdict is Verdict.PASS and not is_complete(row):
        yield report_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    if check.mode != "direction":
        return
    own = [one for one in row.pulls if one.anchor == check.member]
    at_end = [one for one in own if one.position == check.position]
    pull = next(iter(at_end or own), None)
    if pull is None:
        yield say("audit.action_or_force", place=place)
        return
    most = values.get(ROPE_ANGLE)
    beyond = Verdict.FAIL if most is not None else Verdict.NOT_PROVEN
    is_kept = most is not None and pull.angle_deg <= most * (1.0 + SAME)
    if not pull.is_axis_known and check.verdict is Verdict.PASS:
        yield report_verdict(place, check.verdict, Verdict.NOT_PROVEN)
    is_declared = check.verdict is Verdict.DECLARED and check.declared is not None
    if _is_information(check, row) or (
        is_declared and (is_kept or beyond is not Verdict.FAIL)
    ):
        return
    if is_kept and check.verdict is Verdict.FAIL:
        yield report_verdict(place, check.verdict, Verdict.PASS)
    if not is_kept and check.verdict is not beyond:
        yield report_verdict(place, check.verdict, beyond)
