"""Checks of one solved case against laws that hold whatever the mesh.

Forces sum up to zero, a net pulls along itself and does not push, friction bounds the
ratio of its tensions.
"""

from __future__ import annotations

import math

from netdesign.cable.tension import (
    compute_end_directions,
    compute_ratio_bounds,
    compute_turning_angles,
)
from netdesign.checks.laws import DIRECTION, DIRECTION_ERRORS, LIMITS, is_law_met
from netdesign.envelope.run import CaseResult
from netdesign.solving.state import SolvedState
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
    ]
    if state.method == "steady":  # forces of a history are its largest, not its last
        checks.append(_check_capstan(state, result.case.friction_angle))
    checks.append(_check_tension(state))
    if len(head) > 1:
        checks.append(_check_head(head))
    return checks


def _check_ends(state: SolvedState) -> IndependentRecord:
    """Sine of the larger angle between an end's pull and the net's end there [-]."""
    is_curved = state.method == "steady"  # a history's net is straight between nodes
    leaving = compute_end_directions(state.net_curve, is_curved=is_curved)
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


def _check_tension(state: SolvedState) -> IndependentRecord:
    """Smallest over largest tension: a net does not push."""
    share = float((state.balance.smallest_tension or 0.0) / state.tension_max)
    return _judge("tension_share", share)


def _check_head(head: list[HeadForce]) -> IndependentRecord:
    missing = math.hypot(
        sum(force.x_kN for force in head), sum(force.y_kN for force in head)
    )
    largest = max(math.hypot(force.x_kN, force.y_kN) for force in head)
    return _judge("head_balance", missing / largest)


def _judge(
    name: str, value: float | None, limit: float | None = None
) -> IndependentRecord:
    value = None if value is None else float(value)
    limit = LIMITS.get(name, limit)
    return IndependentRecord(
        name=name, value=value, limit=limit, is_met=is_law_met(name, value, limit)
    )
