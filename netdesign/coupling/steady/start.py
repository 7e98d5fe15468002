"""Guess of what the net will carry: where iterations and histories begin."""

from __future__ import annotations

import numpy as np

from netdesign.snow.law import FlowProblem


def guess_pressure(problem: FlowProblem, aspect: float) -> float:
    """Mean pressure on the net of the snow that its base does not hold.

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
    length = {
        "free": aspect,
        "no-slip": 1.0,
        "sliding": 1.0 + 2.0 * float(np.sqrt(problem.slip_ratio)),
    }[problem.ground]
    return max(0.05, problem.gravity[0]) * min(aspect, length)
