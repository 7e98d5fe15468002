"""Cases of a net row, and the largest forces over them, as records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.envelope.extremes import Extreme
from netdesign.envelope.parameters import PARAMETERS
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.calibration import is_calibrated
from netdesign.study.case_records import CasePoint, CaseRecord, ExtremeRecord
from netdesign.units import kilonewton_from_newton, kilonewton_if_known


def show_parameter(name: str, value: float) -> float:
    """Value of a parameter in the unit of its key."""
    return PARAMETERS[name].show(value)


def show_case(values: Mapping[str, float]) -> dict[str, float]:
    """Values of a case under their keys, each in the unit of its key."""
    return {
        PARAMETERS[name].key: show_parameter(name, value)
        for name, value in values.items()
    }


def record_point(case: Case) -> CasePoint:
    """Case of a site."""
    return CasePoint(**show_case(case.values))


def read_point(point: CasePoint) -> Case:
    """Case of a record, in SI units."""
    found = point.values
    return Case.of(
        {
            name: one.read(found[one.key])
            for name, one in PARAMETERS.items()
            if one.key in found
        }
    )


def record_case(result: CaseResult, law: CreepLaw, row: NetRow) -> CaseRecord:
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
        is_calibrated=is_calibrated(law, row, result.case.density),
        **forces,
    )


def _largest_error_percent(result: CaseResult) -> float | None:
    """Largest error of the two end pulls over their size, in per cent."""
    if result.solution is None:
        return None
    pulls = (result.solution.foot, result.solution.head)
    return 100.0 * max(pull.error / pull.size for pull in pulls)


def record_extreme(extreme: Extreme) -> ExtremeRecord:
    """Largest force of a member; of a search with what may hide between its cases."""
    force = extreme.widened if extreme.is_bounded else extreme.force
    return ExtremeRecord(
        quantity=extreme.member,
        max_kN=kilonewton_from_newton(force.value),
        low_kN=kilonewton_from_newton(force.low),
        high_kN=kilonewton_from_newton(force.high),
        case=record_point(extreme.governing.case),
        coincident_kN=show_coincident(extreme, REPORTED_MEMBERS),
        upper_bound_kN=kilonewton_if_known(extreme.upper_bound),
    )


def show_coincident(extreme: Extreme, members: Sequence[str]) -> dict[str, float]:
    """Forces of the other members in the governing case [kN]."""
    forces = extreme.governing.member_forces
    return {
        member: kilonewton_from_newton(forces[member].value)
        for member in members
        if member != extreme.member
    }
