"""Checks of one solved case that do not use the solver's own tests.

Each compares what was solved with a law that holds whatever the mesh: forces on the
net and on the post head sum up to zero, friction bounds the ratio of the tensions.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from netdesign.cable.tension import compute_ratio_bounds, compute_turning_angles
from netdesign.envelope.run import CaseResult
from netdesign.study import HeadForce, IndependentRecord

if TYPE_CHECKING:
    from netdesign.coupling.solution import Solution

_BALANCE = 1e-3  # of the largest force: looser than the solver's own, tight for print
_RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces
_FRICTION = 1e-3  # of the weight


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
    solution = result.solution
    if solution is None:
        return []
    checks = [_check_net(solution), _check_friction(solution)]
    if solution.history is None:  # forces of a history are its largest, not its last
        checks.append(_check_capstan(solution, result.case.friction_angle))
    checks.append(_check_tension(solution))
    if len(head) > 1:
        checks.append(_check_head(head))
    return checks


def _check_net(solution: Solution) -> IndependentRecord:
    """Snow's forces on the net against the pulls on its ends."""
    snow = solution.net_forces.sum(axis=1)
    missing = math.hypot(
        float(snow[0]) - solution.foot.x - solution.head.x,
        float(snow[1]) - solution.foot.y - solution.head.y,
    )
    return _at_most(
        "net_balance", missing / max(solution.foot.size, solution.head.size), _BALANCE
    )


def _check_friction(solution: Solution) -> IndependentRecord:
    return _at_most(
        "friction_excess", float(solution.balance.friction_excess), _FRICTION
    )


def _check_capstan(solution: Solution, friction_angle: float) -> IndependentRecord:
    """Largest over smallest tension against what friction can hold, (C12)."""
    turns = compute_turning_angles(solution.net_curve)
    bound = float(compute_ratio_bounds(turns, math.tan(friction_angle)).sum())
    limit = math.exp(bound) if bound < 100.0 else None
    if solution.tension_min <= 0.0:
        return IndependentRecord(
            name="capstan_ratio", value=None, limit=limit, is_met=False
        )
    ratio = float(solution.tension_max / solution.tension_min)
    is_met = limit is None or bool(ratio <= limit * (1.0 + _RATIO))
    return IndependentRecord(
        name="capstan_ratio", value=ratio, limit=limit, is_met=is_met
    )


def _check_tension(solution: Solution) -> IndependentRecord:
    """Smallest over largest tension: a net does not push."""
    share = float(solution.tension_min / solution.tension_max)
    return IndependentRecord(
        name="tension_share", value=share, limit=0.0, is_met=bool(share > 0.0)
    )


def _check_head(head: list[HeadForce]) -> IndependentRecord:
    missing = math.hypot(
        sum(force.x_kN for force in head), sum(force.y_kN for force in head)
    )
    largest = max(math.hypot(force.x_kN, force.y_kN) for force in head)
    return _at_most("head_balance", missing / largest, _BALANCE)


def _at_most(name: str, value: float, limit: float) -> IndependentRecord:
    return IndependentRecord(
        name=name, value=value, limit=limit, is_met=bool(abs(value) <= limit)
    )
