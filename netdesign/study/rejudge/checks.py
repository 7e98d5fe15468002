"""Checks of a stored study: their own arithmetic, from the forces that it states.

None may be missing. That each is by the right rule and of the right resistance is what
judging again from site and profile shows: ``study.py``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from netdesign.calculation.quantity import Kind, Quantity
from netdesign.calculation.steps import Step, evaluate, list_steps
from netdesign.checks.check import judge
from netdesign.checks.forces import calculate_force, calculate_resistance, rate
from netdesign.outcome import Verdict
from netdesign.site.model import (
    CONNECTED,
    DEPENDENT_MODES,
    END_MODES,
    LIFTED_MODE,
    MEMBER_MODES,
    NET_MODES,
)
from netdesign.structure.members import Member
from netdesign.study.check_to_record import UNBOUNDED
from netdesign.study.member_force import leave_out_governing, lifts
from netdesign.study.records import (
    CheckRecord,
    ProfileRecord,
    RowStudy,
    find_input,
    find_word,
)
from netdesign.study.rejudge.cases import (
    Pair,
    guard,
    is_complete,
    report_differences,
    report_unequal,
    report_verdict,
)
from netdesign.words.message import Message, say

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

Ends = tuple[float | None, float | None, float | None]


def rejudge_checks(row: RowStudy, profile: ProfileRecord) -> Iterator[Message]:
    """Sentences on what cannot be true of a row's checks, by their own numbers."""
    place = say("audit.row", row=row.id)
    values = {value.id: value.value for value in profile.values}
    known = _list_known(row)
    yield from _look_for_all(place, row, profile)
    for check in row.checks:
        where = say("audit.check", place=place, check=check.id)
        if check.is_unbounded is not _is_used_up(check):
            yield say("audit.unbounded", place=where)
        if check.steps:
            yield from guard(where, _rejudge_steps(where, check, known, values))
            yield from _rejudge_verdict(where, check, row)
            yield from _rejudge_spreads(where, check)


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


def _is_used_up(check: CheckRecord) -> bool:
    """Nothing is left of a post or its foot for the force along it, by its reason."""
    has_numbers = check.utilisation is not None or check.resistance_kN is not None
    reason = leave_out_governing(check.reason)
    alone = reason.arguments.get("reason")
    if reason.key == "check.fails_though_declared" and isinstance(alone, Message):
        reason = alone
    return reason.key in UNBOUNDED and not has_numbers


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
        yield from report_unequal(place, _compare_leaf(step, known, values))
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


def _compare_leaf(
    step: Step, known: Mapping[str, Ends], values: Mapping[str, float]
) -> list[Pair]:
    """A solved or profile's value beside that of its source."""
    if step.kind is Kind.SOLVED and step.value is not None:
        expected: Ends = known.get(step.source, (None, None, None))
        names = (f"{step.symbol}.low", step.symbol, f"{step.symbol}.high")
        return list(zip(names, step.ends, expected, strict=True))
    if step.kind is Kind.PROFILE and step.source in values and step.source != _RULES:
        return [(step.symbol, step.value, values[step.source])]
    return []


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
