"""Where a history of a scene begins, and what (C14) asks of a net that has slid."""

import numpy as np

from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import build_problem, build_start
from netdesign.cable.net import compute_turning_angles


def begin(scene, start="sagged", size=TRANSIENT_LEVELS[0], densifies=True, **given):
    """The scene, dimensionless, and its state at the start."""
    problem = build_problem(scene, densifies=densifies, **given)
    return problem, build_start(scene, problem, size, start)


def bound_ratios(turning, friction):
    """Logarithms of the largest tension ratios that friction holds, (C12)."""
    half = np.maximum(turning, 0.0) / 2.0
    with np.errstate(divide="ignore"):
        return 2.0 * np.arctanh(np.minimum(friction * np.tan(half), 1.0))


def find_breach(points, friction, slides, glides, tensions):
    """Largest breach of (C14): nodes that stick within their bound, others at it."""
    bounds = bound_ratios(compute_turning_angles(points), friction)
    jumps = np.diff(np.log(tensions))
    gliding = np.abs(jumps + np.sign(slides) * bounds)
    sticking = np.maximum(np.abs(jumps) - bounds, 0.0)
    return float(np.where(glides, gliding, sticking).max(initial=0.0))
