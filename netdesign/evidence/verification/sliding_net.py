"""The net as a polygon: capstan ratio, and the paper's increments against exact."""

from __future__ import annotations

import math

import numpy as np

from netdesign.cable.closed_form import compute_capstan_ratio
from netdesign.cable.incremental import advance_increment, build_cable_state
from netdesign.cable.sliding import solve_sliding
from netdesign.cable.tension import (
    compute_ratio_bounds,
    compute_segment_lengths,
    compute_turning_angles,
)
from netdesign.errors import SolveError
from netdesign.evidence.verification.case import VerificationCase, observe_order
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome

_STIFFNESS = 2e7  # [N/m]
_WRAP, _FRICTION_ANGLE = math.radians(60.0), math.radians(30.0)
_COUNTS = (8, 16, 32)
_INCREMENTS = (16, 32, 64)


def list_sliding_net() -> list[VerificationCase]:
    """Sliding in both directions over an arc; increments of the paper's cable."""
    exact = compute_capstan_ratio(_WRAP, _FRICTION_ANGLE)
    cases = []
    for name, expected, is_reversed in (
        ("capstan-to-head", exact, False),
        ("capstan-to-foot", 1.0 / exact, True),
    ):
        ratios = [_end_ratio(count, is_reversed=is_reversed) for count in _COUNTS]
        errors = [abs(ratio / expected - 1.0) for ratio in ratios]
        cases.append(
            VerificationCase(
                id=name,
                kind="closed form",
                reference="Euler-Eytelwein exp(tan phi angle), 60 degrees, phi 30",
                expected=expected,
                got=ratios[-1],
                tolerance=1e-3,
                order=observe_order([1.0 / n for n in _COUNTS], errors),
                least_order=1.9,
            )
        )
    pairs = [_bulge_tensions(count) for count in _INCREMENTS]
    errors = [abs(paper / ours - 1.0) for paper, ours in pairs]
    cases.append(
        VerificationCase(
            id="paper-increments",
            kind="cross model",
            reference="the paper's Eqs 5 to 14 against the exact convex form",
            expected=pairs[-1][1],
            got=pairs[-1][0],
            tolerance=1e-2,
            order=observe_order([1.0 / n for n in _INCREMENTS], errors),
            least_order=0.9,
        )
    )
    return cases


def _end_ratio(count: int, *, is_reversed: bool) -> float:
    """Tension at the head over that at the foot when every node glides."""
    angles = np.linspace(0.0, _WRAP, count + 1)
    # from the foot downslope, then round the snow towards the head, with tangent ends
    arc = np.array([np.sin(angles), 1.0 - np.cos(angles)])
    foot = np.array([[-0.5], [0.0]])
    head = arc[:, -1:] + 0.5 * np.array([[math.cos(_WRAP)], [math.sin(_WRAP)]])
    points = np.hstack([foot, arc, head])
    final = compute_segment_lengths(points)
    strain = np.full(final.size, 1e-5)
    strain[0 if is_reversed else -1] = 0.05  # a pull at one end that starts it all
    step = solve_sliding(
        final,
        final / (1.0 + strain),
        compute_ratio_bounds(compute_turning_angles(points), math.tan(_FRICTION_ANGLE)),
        stiffness=_STIFFNESS,
    )
    _require(step.outcome)
    return float(step.tensions[-1] / step.tensions[0])


def _bulge_tensions(count: int) -> tuple[float, float]:
    """Foot tension [N/m] after ``count`` increments: the paper's, the exact one."""
    friction = math.tan(math.radians(5.0))
    unstressed = compute_segment_lengths(_bulge(0.0))
    points = _bulge(0.5)
    bounds = compute_ratio_bounds(compute_turning_angles(points), friction)
    final = compute_segment_lengths(points)
    first = solve_sliding(final, unstressed, bounds, stiffness=_STIFFNESS)
    _require(first.outcome)
    exact = first.lengths
    paper = build_cable_state(final, exact, _STIFFNESS)
    tensions = first.tensions
    for share in np.linspace(0.5, 1.0, count + 1)[1:]:
        points = _bulge(float(share))
        angles = compute_turning_angles(points)
        final = compute_segment_lengths(points)
        bounds = compute_ratio_bounds(angles, friction)
        step = solve_sliding(final, exact, bounds, stiffness=_STIFFNESS)
        _require(step.outcome)
        exact, tensions = step.lengths, step.tensions
        moved = advance_increment(
            paper, final, angles, friction=friction, stiffness=_STIFFNESS
        )
        _require(moved.outcome)
        paper = moved.state
    return float(paper.tensions[0]), float(tensions[0])


def _bulge(share: float) -> Floats:
    """Net of 12 nodes that bulges downslope, more below than above."""
    height = np.linspace(0.0, 1.0, 14)
    return np.array([2.0 * share * height * (1.0 - height) ** 2, height])


def _require(outcome: Outcome) -> None:
    if outcome is not Outcome.CONVERGED:
        raise SolveError(outcome)
