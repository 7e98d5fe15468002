"""A border rope under the pulls of the strips that hang on it.

Theory: panel/THEORY.md, (P1) to (P3).
"""

from __future__ import annotations

import math

import numpy as np

from netdesign.cable.closed_form import compute_parabola_sag
from netdesign.errors import SolveError
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.panel.inputs import Rope
from netdesign.panel.stations import ROPE_POINTS, ROPE_WEIGHTS
from netdesign.words.message import say

_STILL = 1e-12  # last step of log H
_LONGEST_STEP = 2.0  # of log H
_MOST_STEPS = 100


def compute_excess_length(sag: float) -> float:
    """Length of a parabola over its span, less 1: L_r / span - 1 of (P2).

    Its integral is taken, not its closed form: of a flat parabola that keeps no digits.

    Parameters
    ----------
    sag : float
        s_b, over the span [-].

    Returns
    -------
    float
        [-]; from 0, for a straight rope.
    """
    return float(ROPE_WEIGHTS @ _exceed((4.0 * sag * ROPE_POINTS) ** 2))


def estimate_force_along(load: float, span: float, rope: Rope) -> tuple[float, float]:
    """Force along the row and sag of a rope under a uniform load, (P3).

    Parameters
    ----------
    load : float
        q, mean pull of the net [N/m].
    span : float
        Distance of the rope's supports [m].
    rope : Rope
        Its stiffness and as-built sag.

    Returns
    -------
    float, float
        H [N] and f [m].

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    slack = 8.0 / 3.0 * rope.sag**2
    sag = compute_parabola_sag(load, span, rope.stiffness, slack)
    return load * span**2 / (8.0 * sag), sag


def solve_force_along(shear: Floats, rope: Rope, start: float) -> float:
    """Force along the row for which the rope has its unstressed length, (P2).

    Parameters
    ----------
    shear : ndarray, shape (2, 24)
        V at ``ROPE_POINTS`` [N].
    rope : Rope
        Its stiffness and as-built sag.
    start : float
        Guess, above 0 [N].

    Returns
    -------
    float
        H [N].

    Raises
    ------
    SolveError
        If nothing pulls on the rope, or what pulls is no number.

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    across = np.einsum("ij,ij->j", shear, shear)
    wanted = compute_excess_length(rope.sag)
    point, low, high = math.log(start), -math.inf, math.inf
    for _ in range(_MOST_STEPS):
        gap, slope = _measure_length(across, rope.stiffness, math.exp(point))
        gap -= wanted
        low, high = (point, high) if gap > 0.0 else (low, point)
        step = min(max(-gap / slope, -_LONGEST_STEP), _LONGEST_STEP)
        if abs(step) <= _STILL:
            return math.exp(point + step)
        point += step
        if not low < point < high:
            point = (low + high) / 2.0
    raise SolveError(Outcome.NO_EQUILIBRIUM, say("panel.rope_not_found"))


def _measure_length(
    across: Floats, stiffness: float, along: float
) -> tuple[float, float]:
    """Left side of (P2) over the span, less 1, and its derivative by log H."""
    ratio = across / along**2
    excess = _exceed(ratio)  # w - 1
    strain = along / stiffness * (1.0 + excess)
    give = 1.0 + strain
    slope = -(ratio / (1.0 + excess) + strain * (1.0 + excess)) / give**2
    length = (excess - strain) / give
    return float(ROPE_WEIGHTS @ length), float(ROPE_WEIGHTS @ slope)


def _exceed(ratio: Floats) -> Floats:
    """Length over its projection, less 1, of slopes with these squares."""
    return np.asarray(ratio / (1.0 + np.sqrt(1.0 + ratio)))
