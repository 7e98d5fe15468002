"""Checks of one solved case against laws that hold whatever the mesh.

Forces sum up to zero, a net pulls along itself and does not push, friction bounds the
ratio of its tensions.
"""

from __future__ import annotations

import math

from netdesign.cable.net import (
    compute_end_directions,
    compute_ratio_bounds,
    compute_turning_angles,
)
from netdesign.envelope.run import CaseResult
from netdesign.solving.solve import SolvedState
from netdesign.study.records import IndependentRecord
from netdesign.study.support_records import HeadForce


def record_independent(
    result: CaseResult | None, head: list[HeadForce]
) -> list[IndependentRecord]:
    """Independent checks of a converged case; none where it has no solution.

    Parameters
    ----------
    result : CaseResult or None
        The drawn case; None where there is none.
    head : list of HeadForce
        As ``record_head`` gives them [kN].
    """
    if result is None or result.solution is None:
        return []
    state = result.solution
    checks = [
        _judge("global_balance", state.balance.relative_residual),
        _judge("friction_excess", state.balance.friction_excess),
        _check_ends(state),
        _check_capstan(state, result.case.friction_angle),
    ]
    share = (state.balance.smallest_tension or 0.0) / state.tension_max
    checks.append(_judge("tension_share", share))  # a net does not push
    if len(head) > 1:
        checks.append(_judge("head_balance", measure_open_head(head)))
    return checks


def _check_ends(state: SolvedState) -> IndependentRecord:
    """Sine of the larger angle between an end's pull and the net's end there [-]."""
    leaving = compute_end_directions(state.net_curve)
    ends = zip((state.foot, state.head), leaving, strict=True)
    sines = [abs(pull.x * y - pull.y * x) / pull.size for pull, (x, y) in ends]
    errors = [
        DIRECTION_ERRORS * pull.error / pull.size for pull in (state.foot, state.head)
    ]
    return _judge("end_direction", max(sines), max(DIRECTION, *errors))


def _check_capstan(state: SolvedState, friction_angle: float) -> IndependentRecord:
    """Largest over smallest tension against what friction can hold, (C12)."""
    turns = compute_turning_angles(state.net_curve)
    bound = float(compute_ratio_bounds(turns, math.tan(friction_angle)).sum())
    limit = math.exp(bound) if bound < 100.0 else None
    smallest = state.balance.smallest_tension or 0.0
    ratio = float(state.tension_max / smallest) if smallest > 0.0 else None
    return _judge("capstan_ratio", ratio, limit)


def measure_open_head(head: list[HeadForce]) -> float:
    """Forces on a post head that are left over, as a share of the largest one [-]."""
    missing = math.hypot(
        sum(force.x_kN for force in head), sum(force.y_kN for force in head)
    )
    return missing / max(math.hypot(force.x_kN, force.y_kN) for force in head)


def _judge(
    name: str, value: float | None, limit: float | None = None
) -> IndependentRecord:
    value = None if value is None else float(value)
    limit = LIMITS.get(name, limit)
    return IndependentRecord(
        name=name, value=value, limit=limit, is_met=is_law_met(name, value, limit)
    )


BALANCE = 1e-3  # of a largest force or of the weight: tight enough for print
DIRECTION = 2e-2  # pulls are those of two meshes, the shape that of the finer one
DIRECTION_ERRORS = 3.0  # or so many times the relative error of the end's pull
RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces

# Largest value of each law whose limit does not depend on the case [-].
LIMITS = {
    "global_balance": BALANCE,
    "friction_excess": BALANCE,
    "head_balance": BALANCE,
    "tension_share": 0.0,  # that one lies above it
}


def is_law_met(name: str, value: float | None, limit: float | None) -> bool:
    """A law is met.

    Parameters
    ----------
    name : str
        As in an ``IndependentRecord``.
    value : float or None
        Share or ratio [-]; None where there is none, which never meets a law.
    limit : float or None
        Its limit [-]; None where nothing bounds a ratio of tensions.
    """
    if value is None or (limit is None and name != "capstan_ratio"):
        return False
    if name == "tension_share":  # a net does not push
        return value > 0.0
    if name == "capstan_ratio":
        return limit is None or value <= limit * (1.0 + RATIO)
    return limit is not None and abs(value) <= limit
