"""Guess of what the net will carry: where iterations and histories begin."""

from __future__ import annotations

import math

from netdesign.snow.law import FlowProblem


def guess_pressure(problem: FlowProblem, aspect: float) -> float:
    """Mean pressure on the net of the snow that its base does not hold.

    Drag of a sliding ground and creep along X balance over a length that goes with the
    slip length to the power 1 / (n + 1); coupling/THEORY.md, eq. (K0a).

    Parameters
    ----------
    problem : FlowProblem
        Gravity and ground.
    aspect : float
        Upslope length over thickness [-].

    Returns
    -------
    float
        [rho g d].
    """
    felt = math.pow(problem.slip_ratio, 1.0 / (problem.exponent + 1.0))
    length = {"free": aspect, "no-slip": 1.0, "sliding": 1.0 + felt}[problem.ground]
    return max(0.05, problem.gravity[0]) * min(aspect, length)
