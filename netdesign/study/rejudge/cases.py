"""Cases of a net row against their ranges; largest forces against the cases."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

from netdesign.calculation.steps import SAME, is_same
from netdesign.coupling.solution import RELEASED
from netdesign.outcome import NetDesignError, Outcome, Verdict
from netdesign.structure.members import (
    BROUGHT_BY,
    CARRYING_MEMBERS,
    REPORTED_MEMBERS,
    Member,
    NetPart,
)
from netdesign.study.case_records import (
    BoundRecord,
    CasePoint,
    CaseRecord,
    EnvelopeRecord,
    ExtremeRecord,
    ForceRecord,
)
from netdesign.study.records import RowStudy, Study
from netdesign.study.values import compare_values, show_value
from netdesign.words.message import Message, say
from netdesign.words.names import name_member

_STEADY = "steady"
_MOST = 5  # places of one part that are named

Pair = tuple[str, float | None, float | None]


def is_of_steady_states(study: Study) -> bool:
    """No history had a part in its forces."""
    return study.provenance.settings.get("method") == _STEADY


def report_unequal(place: Message, pairs: Iterable[Pair]) -> Iterator[Message]:
    """A sentence for each name whose stored value is not what follows.

    ``pairs`` are the name in the document, stored value, value that follows from
    others.
    """
    for name, stored, expected in pairs:
        if not is_same(stored, expected):
            yield report_value(place, name, stored, expected)


def guard(place: Message, sentences: Iterator[Message]) -> Iterator[Message]:
    """Sentences; where numbers are such as no solve gives, one that says so."""
    try:
        yield from sentences
    except (NetDesignError, LookupError, ValueError, TypeError, ArithmeticError):
        yield say("audit.no_calculation", place=place)


def report_differences(
    key: str, stored: object, again: object, *, is_exact: bool = False, **given: Message
) -> Iterator[Message]:
    """Sentences on the first places at which a stored part is not what follows."""
    for found in compare_values(stored, again, is_exact=is_exact)[:_MOST]:
        yield say(key, **given, value=found.message)


def _report_other_values(
    place: Message, stored: object, again: object
) -> Iterator[Message]:
    """Sentences on values that are not those of the cases, by their places."""
    key = "audit.other_values"
    yield from report_differences(key, stored, again, is_exact=True, place=place)


def report_value(place: Message, name: str, stored: object, follows: object) -> Message:
    """A sentence on a value, by its name in the document, that is not what follows."""
    one, other = show_value(stored), show_value(follows)
    return say("audit.unequal", place=place, name=name, stored=one, follows=other)


def report_verdict(place: Message, stored: Verdict, follows: Verdict) -> Message:
    """A sentence on a verdict that is not that of its parts."""
    verdict, merged = say(f"verdict.{stored}"), say(f"verdict.{follows}")
    return say("audit.verdict", place=place, verdict=verdict, merged=merged)


Spans = Mapping[str, tuple[float, float]]


def rejudge_cases(row: RowStudy, spans: Spans, tolerance: float) -> Iterator[Message]:
    """Sentences on what cannot be true of the cases and of what follows from them.

    Parameters
    ----------
    row : RowStudy
        As stored.
    spans : mapping of str to (float, float)
        Ranges by the keys of a ``CasePoint``, in their units.
    tolerance : float
        Largest residual of a balance that counts as converged [-]; infinite for
        histories, which have another measure of it.
    """
    place = say("audit.row", row=row.id)
    for number, case in enumerate(row.cases):
        where = say("audit.case", place=place, number=number)
        yield from _rejudge_case(where, case, spans, tolerance)
    counts = Counter(case.case for case in row.cases)
    if any(count > 1 for count in counts.values()):
        yield say("audit.case_twice", place=place)
    yield from _rejudge_extremes(place, row)
    yield from _rejudge_forces(place, row)
    if row.envelope is not None:
        yield from _rejudge_record(place, row, row.envelope, spans)


def read_force(case: CaseRecord, member: str) -> float | None:
    """Force of a member in a case [kN]."""
    force: float | None = getattr(case, f"{member}_kN")
    return force


def name_members(members: Iterable[str]) -> tuple[Message, ...]:
    """Their names, as a list of a message."""
    return tuple(map(name_member, members))


def list_solved(row: RowStudy) -> list[CaseRecord]:
    """Cases with numbers."""
    return [case for case in row.cases if case.outcome is Outcome.CONVERGED]


def find_largest(row: RowStudy, member: str) -> CaseRecord | None:
    """Case of a member's largest force; of equal ones the first point."""

    def rank(case: CaseRecord) -> tuple[float, ...]:
        return (-(read_force(case, member) or 0.0), *case.case.values.values())

    return min(list_solved(row), key=rank, default=None)


def _rejudge_case(
    place: Message, case: CaseRecord, spans: Spans, tolerance: float
) -> Iterator[Message]:
    forces = [read_force(case, member) for member in REPORTED_MEMBERS]
    numbers = [*forces]
    if math.isfinite(tolerance):
        numbers += [case.error_percent, case.balance_residual]
    if case.outcome is Outcome.CONVERGED:
        is_whole = all(number is not None and number >= 0.0 for number in numbers)
        if not is_whole or case.reason not in (None, RELEASED):
            yield say("audit.converged_without_numbers", place=place)
        elif (case.balance_residual or 0.0) > tolerance:
            yield say("audit.balance_open", place=place)
    elif any(force is not None for force in forces) or not case.reason:
        yield say("audit.forces_without_result", place=place)
    values = case.case.values
    for key in dict.fromkeys((*values, *spans)):
        low, high = spans.get(key, (0.0, math.inf))
        value = values.get(key, math.nan)
        if not low * (1.0 - SAME) <= value <= high * (1.0 + SAME):
            yield say(
                "audit.outside",
                place=place,
                key=key,
                value=value,
                low=low,
                high=high,
            )


def _rejudge_extremes(place: Message, row: RowStudy) -> Iterator[Message]:
    wanted = list(REPORTED_MEMBERS) if list_solved(row) else []
    named = [extreme.quantity for extreme in row.extremes]
    if named != wanted:
        yield say(
            "audit.largest_of_others",
            place=place,
            named=name_members(named),
            wanted=name_members(wanted),
        )
    for extreme in row.extremes:
        largest = (
            find_largest(row, extreme.quantity)
            if extreme.quantity in REPORTED_MEMBERS
            else None
        )
        if largest is not None:
            member = name_member(extreme.quantity)
            where = say("audit.largest", place=place, member=member)
            yield from _rejudge_extreme(where, extreme, largest)


def _rejudge_extreme(
    place: Message, extreme: ExtremeRecord, largest: CaseRecord
) -> Iterator[Message]:
    forces: dict[str, float] = {
        one: read_force(largest, one) or 0.0 for one in REPORTED_MEMBERS
    }
    again = replace(
        extreme,
        max_kN=forces.pop(extreme.quantity),
        case=largest.case,
        coincident_kN=forces,
    )
    yield from _report_other_values(place, extreme, again)
    upper = extreme.upper_bound_kN
    ends = (0.0, extreme.low_kN, extreme.max_kN, extreme.high_kN)
    bound = (extreme.max_kN, upper or extreme.max_kN, extreme.high_kN)
    if ends != tuple(sorted(ends)) or not _are_ordered(bound):
        yield say("audit.outside_band", place=place)


def _rejudge_forces(place: Message, row: RowStudy) -> Iterator[Message]:
    """Forces that the checks rest on, against the largest ones of the cases."""
    extremes = {one.quantity: one for one in row.extremes}
    extremes |= {one.quantity: one for one in row.panel.extremes} if row.panel else {}
    named = [one.quantity for one in row.forces]
    by_panel = [one for one in extremes if one.startswith("panel")]
    wanted = [*CARRYING_MEMBERS, NetPart.MESH, *by_panel]
    if sorted(named) != sorted(wanted if list_solved(row) else []):
        yield say(
            "audit.largest_of_others",
            place=place,
            named=tuple(named),
            wanted=tuple(wanted),
        )
        return
    for force in row.forces:
        where = say("audit.part", place=place, part=name_member(force.quantity))
        yield from _rejudge_force(where, force, row, extremes)


def _rejudge_force(
    place: Message,
    force: ForceRecord,
    row: RowStudy,
    extremes: Mapping[str, ExtremeRecord],
) -> Iterator[Message]:
    """One of them: a bound of a search exactly, of a grid with what may hide."""
    if force.quantity in (Member.POST_BASE, Member.POST_FOOT, NetPart.MESH):
        yield from _rejudge_alone(place, force, row, extremes[Member.POST].max_kN)
        return
    largest = extremes[_find_bringing(force.quantity, row)]
    pairs = [
        ("value_kN", force.value_kN, largest.max_kN),
        ("low_kN", force.low_kN, largest.low_kN),
    ]
    if largest.upper_bound_kN is not None:
        pairs.append(("high_kN", force.high_kN, largest.high_kN))
    elif force.high_kN < largest.high_kN * (1.0 - SAME):
        high = show_value(force.high_kN)
        yield say("audit.too_low_end", place=place, high=high, least=largest.high_kN)
    yield from report_unequal(place, pairs)
    if not same_point(force.case, largest.case):
        yield say("audit.other_case", place=place)


def _rejudge_alone(
    place: Message, force: ForceRecord, row: RowStudy, post: float
) -> Iterator[Message]:
    """A force that no case tells beside its others; ``post`` is the post's [kN]."""
    if not _are_ordered((0.0, force.low_kN, force.value_kN, force.high_kN)):
        yield say("audit.outside_band", place=place)
    if force.quantity == Member.POST_BASE:  # part of the post's, whose largest is told
        if force.value_kN > post * (1.0 + SAME):
            yield say("audit.more_on_base", place=place)
    elif force.quantity == NetPart.MESH:
        least = _find_largest_pull(row)
        if force.value_kN < least * (1.0 - SAME):
            yield say("audit.less_than_pull", place=place, least=least)
    else:
        pulls = [one.post_foot_kN for one in row.statics if one.load is None]
        least = max(pulls, default=0.0)
        if least > force.high_kN * (1.0 + SAME):
            high = show_value(force.high_kN)
            yield say("audit.too_low_end", place=place, high=high, least=least)


def _find_largest_pull(row: RowStudy) -> float:
    """Largest pull of the net on its ends, of the solved states told [kN/m]."""
    states = [one for one in row.statics if one.load is None and not one.is_by_panel]
    pulls = [
        *((one.foot_x_kN_per_m, one.foot_y_kN_per_m) for one in states),
        *((one.head_x_kN_per_m, one.head_y_kN_per_m) for one in states),
    ]
    return max((math.hypot(*pull) for pull in pulls), default=0.0)


def _find_bringing(quantity: str, row: RowStudy) -> str:
    """Largest force that it is: an anchor has that of its guy, or of the net's foot."""
    drawing = row.drawing
    is_at_foot = drawing is not None and drawing.uphill_anchor_m == (0.0, 0.0)
    if quantity == Member.UPHILL_ANCHOR and is_at_foot:
        return Member.FOOT_ANCHOR  # one anchor carries both, (S7)
    if quantity in (Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR):
        return BROUGHT_BY[quantity]
    return quantity


def _are_ordered(values: tuple[float, ...]) -> bool:
    return all(one <= other * (1.0 + SAME) for one, other in pairwise(values))


def _rejudge_record(
    place: Message, row: RowStudy, record: EnvelopeRecord, spans: Spans
) -> Iterator[Message]:
    failed = len(row.cases) - len(list_solved(row))
    where = say("audit.envelope", place=place)
    yield from report_unequal(
        where,
        [("cases", record.cases, len(row.cases)), ("failed", record.failed, failed)],
    )
    axes = {axis.key: (axis.low, axis.high) for axis in record.axes}
    for key, (low, high) in spans.items():
        given = axes.get(key, (None, None))
        pairs = ((f"{key}.low", given[0], low), (f"{key}.high", given[1], high))
        yield from report_unequal(where, pairs)
    extremes = {extreme.quantity: extreme for extreme in row.extremes}
    if [bound.quantity for bound in record.bounds] != list(extremes):
        yield say("audit.bounds_of_others", place=place)
    for bound in record.bounds:
        if bound.quantity in extremes:
            yield from _rejudge_bound(place, bound, extremes[bound.quantity], record)


def _rejudge_bound(
    place: Message, bound: BoundRecord, extreme: ExtremeRecord, record: EnvelopeRecord
) -> Iterator[Message]:
    place = say("audit.bound", place=place, member=name_member(bound.quantity))
    upper = extreme.upper_bound_kN
    follows = replace(
        bound,
        max_kN=extreme.max_kN,
        upper_bound_kN=math.nan if upper is None else upper,
        case=extreme.case.values,
        coincident_kN=extreme.coincident_kN,
    )
    yield from _report_other_values(place, bound, follows)
    again = bound.confirmation
    if again is not None and again.confirmed_kN is not None and again.screened_kN:
        change = 100.0 * (again.confirmed_kN / again.screened_kN - 1.0)
        off = abs((again.difference_percent or 0.0) - change)
        if off > 1e-6:
            yield say("audit.other_confirmation", place=place, change=change)
        if again.confirmed_kN > extreme.high_kN * (1.0 + SAME):
            yield say("audit.confirmed_above", place=place)
    gap = bound.upper_bound_kN - bound.max_kN
    known = max(bound.max_kN, *extreme.coincident_kN.values())
    if record.is_closed and gap > record.gap_asked_percent / 100.0 * known * 1.001:
        yield say("audit.not_closed", place=place, gap=gap)


def is_complete(row: RowStudy) -> bool:
    """Completeness: every case solved, nothing left open, the floor known."""
    record = row.envelope
    if row.unsaid:
        return False
    if row.floor is not None and row.floor.reason is not None:
        return False
    if not row.cases or len(list_solved(row)) < len(row.cases):
        return False
    if row.panel is not None and row.panel.failed:
        return False
    if record is None:
        return True
    again = [bound.confirmation for bound in record.bounds]
    return record.is_closed and all(
        one is None or one.confirmed_kN is not None for one in again
    )


def same_point(one: CasePoint | None, other: CasePoint | None) -> bool:
    """Two cases are one, or both are missing."""
    if one is None or other is None:
        return one is other
    mine, others = one.values, other.values
    return mine.keys() == others.keys() and all(
        is_same(value, others[key]) for key, value in mine.items()
    )
