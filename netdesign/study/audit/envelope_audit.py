"""Cases of a net row against their ranges; largest forces against the cases."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import pairwise

from netdesign.coupling.solution import RELEASED
from netdesign.outcome import Outcome
from netdesign.study.audit.comparing import SAME, is_same, tell_unequal
from netdesign.study.records import (
    BoundRecord,
    CasePoint,
    CaseRecord,
    EnvelopeRecord,
    ExtremeRecord,
    RowStudy,
)

MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
_AXES = ("density_kg_m3", "friction_deg", "inclination_deg")
Spans = Mapping[str, tuple[float, float]]


def audit_envelope(row: RowStudy, spans: Spans, tolerance: float) -> Iterator[str]:
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
    place = f"net row {row.id!r}"
    for number, case in enumerate(row.cases):
        yield from _audit_case(f"{place}, case {number}", case, spans, tolerance)
    counts = Counter(case.case for case in row.cases)
    if any(count > 1 for count in counts.values()):
        yield f"{place}: a case stands there twice"
    yield from _audit_extremes(place, row)
    if row.envelope is not None:
        yield from _audit_record(place, row, row.envelope, spans)


def read_force(case: CaseRecord, member: str) -> float | None:
    """Force of a member in a case [kN]."""
    force: float | None = getattr(case, f"{member}_kN")
    return force


def list_solved(row: RowStudy) -> list[CaseRecord]:
    """Cases with numbers."""
    return [case for case in row.cases if case.outcome is Outcome.CONVERGED]


def find_largest(row: RowStudy, member: str) -> CaseRecord | None:
    """Case of a member's largest force; of equal ones the first point."""

    def rank(case: CaseRecord) -> tuple[float, float, float, float]:
        point = case.case
        at = (point.density_kg_m3, point.friction_deg, point.inclination_deg)
        return (-(read_force(case, member) or 0.0), *at)

    return min(list_solved(row), key=rank, default=None)


def _audit_case(
    place: str, case: CaseRecord, spans: Spans, tolerance: float
) -> Iterator[str]:
    forces = [read_force(case, member) for member in MEMBERS]
    numbers = [*forces]
    if math.isfinite(tolerance):
        numbers += [case.error_percent, case.balance_residual]
    if case.outcome is Outcome.CONVERGED:
        is_whole = all(number is not None and number >= 0.0 for number in numbers)
        if not is_whole or case.reason not in (None, RELEASED):
            yield f"{place} converged, but has a reason, or no numbers of at least 0"
        elif (case.balance_residual or 0.0) > tolerance:
            yield f"{place} converged, but its balance is left open"
    elif any(force is not None for force in forces) or not case.reason:
        yield f"{place} has no result, but forces, or no reason"
    for key in _AXES:
        low, high = spans.get(key, (0.0, math.inf))
        value = getattr(case.case, key)
        if not low * (1.0 - SAME) <= value <= high * (1.0 + SAME):
            yield f"{place}: {key} = {value!r} lies outside {low!r} to {high!r}"


def _audit_extremes(place: str, row: RowStudy) -> Iterator[str]:
    wanted = list(MEMBERS) if list_solved(row) else []
    named = [extreme.quantity for extreme in row.extremes]
    if named != wanted:
        yield f"{place}: largest forces of {named}, not of {wanted}"
    for extreme in row.extremes:
        largest = (
            find_largest(row, extreme.quantity) if extreme.quantity in MEMBERS else None
        )
        if largest is not None:
            yield from _audit_extreme(
                f"{place}, largest {extreme.quantity}", extreme, largest
            )


def _audit_extreme(
    place: str, extreme: ExtremeRecord, largest: CaseRecord
) -> Iterator[str]:
    others = [member for member in MEMBERS if member != extreme.quantity]
    yield from tell_unequal(
        place,
        [
            ("max_kN", extreme.max_kN, read_force(largest, extreme.quantity)),
            *(
                (
                    f"coincident {member}",
                    extreme.coincident_kN.get(member),
                    read_force(largest, member),
                )
                for member in others
            ),
        ],
    )
    if extreme.case != largest.case:
        yield f"{place}: stands at another case than its force"
    if set(extreme.coincident_kN) != set(others):
        yield f"{place}: forces of {sorted(extreme.coincident_kN)} beside it"
    upper = extreme.upper_bound_kN
    ends = (0.0, extreme.low_kN, extreme.max_kN, extreme.high_kN)
    bound = (extreme.max_kN, upper or extreme.max_kN, extreme.high_kN)
    if ends != tuple(sorted(ends)) or not _are_ordered(bound):
        yield f"{place}: its band does not hold it, or not what may hide"


def _are_ordered(values: tuple[float, ...]) -> bool:
    return all(one <= other * (1.0 + SAME) for one, other in pairwise(values))


def _audit_record(
    place: str, row: RowStudy, record: EnvelopeRecord, spans: Spans
) -> Iterator[str]:
    failed = len(row.cases) - len(list_solved(row))
    yield from tell_unequal(
        f"{place}, envelope",
        [("cases", record.cases, len(row.cases)), ("failed", record.failed, failed)],
    )
    axes = {axis.key: (axis.low, axis.high) for axis in record.axes}
    for key, (low, high) in spans.items():
        given = axes.get(key, (None, None))
        pairs = ((f"{key}, low", given[0], low), (f"{key}, high", given[1], high))
        yield from tell_unequal(f"{place}, envelope", pairs)
    extremes = {extreme.quantity: extreme for extreme in row.extremes}
    if [bound.quantity for bound in record.bounds] != list(extremes):
        yield f"{place}: bounds of other forces than the largest ones"
    for bound in record.bounds:
        if bound.quantity in extremes:
            yield from _audit_bound(place, bound, extremes[bound.quantity], record)


def _audit_bound(
    place: str, bound: BoundRecord, extreme: ExtremeRecord, record: EnvelopeRecord
) -> Iterator[str]:
    place = f"{place}, bound of {bound.quantity}"
    same = ("max_kN", "upper_bound_kN")
    pairs = [(key, getattr(bound, key), getattr(extreme, key)) for key in same]
    point: dict[str, float | None] = {key: getattr(extreme.case, key) for key in _AXES}
    pairs += [(key, bound.case.get(key), value) for key, value in point.items()]
    pairs += [
        (f"coincident {member}", bound.coincident_kN.get(member), force)
        for member, force in extreme.coincident_kN.items()
    ]
    again = bound.confirmation
    if again is not None and again.confirmed_kN is not None and again.screened_kN:
        change = 100.0 * (again.confirmed_kN / again.screened_kN - 1.0)
        off = abs((again.difference_percent or 0.0) - change)
        if off > 1e-6:
            yield f"{place}: its confirmation differs by {change!r} %, not as it says"
        if again.confirmed_kN > extreme.high_kN * (1.0 + SAME):
            yield f"{place}: confirmed above the band of the largest force"
    yield from tell_unequal(place, pairs)
    gap = bound.upper_bound_kN - bound.max_kN
    known = max(bound.max_kN, *extreme.coincident_kN.values())
    if record.is_closed and gap > record.gap_asked_percent / 100.0 * known * 1.001:
        yield f"{place}: said to be closed, but {gap!r} kN may hide"


def is_complete(row: RowStudy) -> bool:
    """Whether the cases cover the ranges: none failed, nothing was left open."""
    record = row.envelope
    if not row.cases or len(list_solved(row)) < len(row.cases):
        return False
    if record is None:
        return True
    again = [bound.confirmation for bound in record.bounds]
    return record.is_closed and all(
        one is None or one.confirmed_kN is not None for one in again
    )


def same_point(one: CasePoint | None, other: CasePoint | None) -> bool:
    """Whether two cases are one, or both are missing."""
    if one is None or other is None:
        return one is other
    return all(is_same(getattr(one, key), getattr(other, key)) for key in _AXES)
