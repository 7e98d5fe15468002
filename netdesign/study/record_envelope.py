"""A row's envelope in the engineer's units, as the documents show it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.checks.check import CasePoint
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.ranges import PARAMETERS, Case
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.case_records import (
    CaseRecord,
    ConfirmationRecord,
    LargestForce,
)
from netdesign.units import kilonewton_from_newton, kilonewton_if_known


def show_case(values: Mapping[str, float]) -> dict[str, float]:
    """Values of a case under their keys, each in the unit of its key."""
    shown = ((PARAMETERS[name], value) for name, value in values.items())
    return {parameter.key: parameter.show(value) for parameter, value in shown}


def record_point(case: Case) -> CasePoint:
    """Case of a site."""
    return CasePoint(**show_case(case.values))


def read_point(point: CasePoint) -> Case:
    """Case of a record, in SI units."""
    values = point.values
    return Case.of(
        {
            name: parameter.read(values[parameter.key])
            for name, parameter in PARAMETERS.items()
            if parameter.key in values
        }
    )


def record_case(result: CaseResult) -> CaseRecord:
    """Outcome and forces of a solved case."""
    forces = {
        f"{member}_kN": kilonewton_if_known(
            result.member_forces[member].value if result.is_converged else None
        )
        for member in REPORTED_MEMBERS
    }
    solution = result.solution
    return CaseRecord(
        case=record_point(result.case),
        outcome=result.outcome,
        reason=result.reason,
        error_percent=_largest_error_percent(result),
        balance_residual=solution.balance.relative_residual if solution else None,
        **forces,
    )


def _largest_error_percent(result: CaseResult) -> float | None:
    """Largest error of the two end pulls over their size, in per cent."""
    if result.solution is None:
        return None
    pulls = (result.solution.foot, result.solution.head)
    return 100.0 * max(pull.error / pull.size for pull in pulls)


def record_largest(extreme: Extreme, envelope: RowEnvelope) -> LargestForce:
    """Largest force, with what may hide between the cases."""
    force = extreme.widened
    return LargestForce(
        quantity=extreme.member,
        low_kN=kilonewton_from_newton(force.low),
        value_kN=kilonewton_from_newton(force.value),
        high_kN=kilonewton_from_newton(force.high),
        bound_kN=kilonewton_from_newton(extreme.upper_bound),
        case=record_point(extreme.governing.case),
        confirmed=_record_confirmation(envelope, extreme.member),
    )


def show_coincident(extreme: Extreme, members: Sequence[str]) -> dict[str, float]:
    """Forces of the other members in the governing case [kN]."""
    forces = extreme.governing.member_forces
    return {
        member: kilonewton_from_newton(forces[member].value)
        for member in members
        if member != extreme.member
    }


def _record_confirmation(
    envelope: RowEnvelope, member: str
) -> ConfirmationRecord | None:
    confirmation = next((c for c in envelope.confirmations if c.member == member), None)
    if confirmation is None:
        return None
    confirmed = confirmation.confirmed.solution
    difference, forces = confirmation.difference, confirmation.confirmed.member_forces
    return ConfirmationRecord(
        confirmed_kN=kilonewton_if_known(forces[member].value if forces else None),
        difference_percent=None if difference is None else 100.0 * difference,
        elements=confirmed.cost.elements if confirmed else None,
        reason=confirmation.confirmed.reason,
    )
