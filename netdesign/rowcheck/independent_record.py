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
from netdesign.envelope.run import CaseResult
from netdesign.envelope.state import SolvedState
from netdesign.study import HeadForce, IndependentRecord

_BALANCE = 1e-3  # of a largest force or of the weight: tight enough for print
_DIRECTION = 2e-2  # pulls are those of two meshes, the shape that of the finer one
_RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces


def record_independent(
    result: CaseResult, head: list[HeadForce]
) -> list[IndependentRecord]:
    """Independent checks of a converged case; none where it has no solution.

    Parameters
    ----------
    result : CaseResult
        The drawn case.
    head : list of HeadForce
        As ``record_head`` gives them [kN].
    """
    state = result.solution
    if state is None:
        return []
    checks = [
        _at_most("global_balance", state.balance.relative_residual, _BALANCE),
        _at_most("friction_excess", state.balance.friction_excess, _BALANCE),
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
    errors = [3.0 * pull.error / pull.size for pull in (state.foot, state.head)]
    return _at_most("end_direction", max(sines), max(_DIRECTION, *errors))


def _check_capstan(state: SolvedState, friction_angle: float) -> IndependentRecord:
    """Largest over smallest tension against what friction can hold, (C12)."""
    turns = compute_turning_angles(state.net_curve)
    bound = float(compute_ratio_bounds(turns, math.tan(friction_angle)).sum())
    limit = math.exp(bound) if bound < 100.0 else None
    smallest = state.balance.smallest_tension or 0.0
    ratio = float(state.tension_max / smallest) if smallest > 0.0 else None
    is_held = limit is None or (ratio is not None and ratio <= limit * (1.0 + _RATIO))
    return IndependentRecord(
        name="capstan_ratio",
        value=ratio,
        limit=limit,
        is_met=ratio is not None and is_held,
    )


def _check_tension(state: SolvedState) -> IndependentRecord:
    """Smallest over largest tension: a net does not push."""
    share = float((state.balance.smallest_tension or 0.0) / state.tension_max)
    return IndependentRecord(
        name="tension_share", value=share, limit=0.0, is_met=share > 0.0
    )


def _check_head(head: list[HeadForce]) -> IndependentRecord:
    missing = math.hypot(
        sum(force.x_kN for force in head), sum(force.y_kN for force in head)
    )
    largest = max(math.hypot(force.x_kN, force.y_kN) for force in head)
    return _at_most("head_balance", missing / largest, _BALANCE)


def _at_most(name: str, value: float, limit: float) -> IndependentRecord:
    value = float(value)
    return IndependentRecord(
        name=name, value=value, limit=limit, is_met=abs(value) <= limit
    )
