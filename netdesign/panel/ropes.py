"""A border rope under the pulls of the strips that hang on it.

Theory: panel/THEORY.md, (P1) to (P3).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from netdesign.cable.closed_form import compute_parabola_sag
from netdesign.numerics.arrays import Floats
from netdesign.panel.inputs import Rope
from netdesign.panel.stations import ROPE_POINTS, ROPE_WEIGHTS


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


class RopeLengths(NamedTuple):
    """Unstressed lengths of ropes over their spans, less 1, and their derivatives.

    Attributes
    ----------
    excess : ndarray, shape (2,)
        Left side of (P2) over the span, less 1 [-].
    by_log_along : ndarray, shape (2,)
        By log H: negative [-].
    by_shear : ndarray, shape (2, 2, 24)
        By V at ``ROPE_POINTS`` [1/N].
    """

    excess: Floats
    by_log_along: Floats
    by_shear: Floats


def measure_lengths(shear: Floats, stiffness: Floats, along: Floats) -> RopeLengths:
    """Lengths that ropes would have without their tension, (P2).

    Parameters
    ----------
    shear : ndarray, shape (2, 2, 24)
        V of each rope, (x, y) at ``ROPE_POINTS`` [N].
    stiffness, along : ndarray, shape (2,)
        EA and H of each [N].

    Verified by
    -----------
    tests/panel/test_ropes.py
    """
    square = np.einsum("rcg,rcg->rg", shear, shear) / along[:, None] ** 2
    excess = _exceed(square)  # w - 1
    strain = (along / stiffness)[:, None] * (1.0 + excess)
    give = 1.0 + strain
    slope = (square / (1.0 + excess) + strain * (1.0 + excess)) / give**2
    each = ROPE_WEIGHTS / ((along**2)[:, None] * (1.0 + excess) * give**2)
    return RopeLengths(
        excess=((excess - strain) / give) @ ROPE_WEIGHTS,
        by_log_along=-slope @ ROPE_WEIGHTS,
        by_shear=shear * each[:, None],
    )


def _exceed(ratio: Floats) -> Floats:
    """Length over its projection, less 1, of slopes with these squares."""
    return np.asarray(ratio / (1.0 + np.sqrt(1.0 + ratio)))
