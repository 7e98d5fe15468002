"""Newton's method on a smooth convex function, globally convergent."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome

_ACCEPTED_CLIMB = 0.5
_SHORTEST_STEP = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Minimum:
    """End of a minimisation.

    Attributes
    ----------
    outcome : Outcome
        Converged, max_iterations, diverged or nonfinite.
    point : ndarray, shape (n,)
        Last iterate.
    gradient_norm : float
        Euclidean norm of the gradient there [unit of the gradient].
    iterations : int
        Newton steps taken.
    """

    outcome: Outcome
    point: Floats
    gradient_norm: float
    iterations: int


def minimise_convex(
    evaluate: Callable[[Floats], tuple[Floats, Floats]],
    start: Floats,
    *,
    tolerance: float,
    max_iterations: int = 100,
) -> Minimum:
    """Minimiser of a strictly convex function by damped Newton steps.

    A step is halved while it climbs again more than half as steeply as it went down
    at its start. Slopes decide, not values: those of a nearly straight cable differ
    by less than their rounding. By convexity a step that still descends at its end
    has lowered the function all the way.

    Parameters
    ----------
    evaluate : callable
        Point (n,) to gradient (n,) and Hessian (n, n).
    start : ndarray, shape (n,)
        First iterate.
    tolerance : float
        Gradient norm that counts as zero; the caller makes it dimensionless.
    max_iterations : int
        Newton steps allowed.

    Returns
    -------
    Minimum
        Never raises for a failed iteration; see its outcome.
    """
    from scipy.linalg import lapack  # here: the compiled core does without

    point = np.asarray(start, dtype=float)
    gradient, hessian = evaluate(point)
    for iteration in range(max_iterations):
        norm = math.sqrt(float(gradient @ gradient))
        if not math.isfinite(norm):
            return _end(Outcome.NONFINITE, point, norm, iteration)
        if norm <= tolerance:
            return _end(Outcome.CONVERGED, point, norm, iteration)
        _, direction, fault = lapack.dposv(hessian, -gradient)
        if fault != 0:  # not convex here
            return _end(Outcome.DIVERGED, point, norm, iteration)
        descent = -float(gradient @ direction)
        step = 1.0
        candidate = point + direction
        gradient, hessian = evaluate(candidate)
        while not float(gradient @ direction) <= _ACCEPTED_CLIMB * descent:
            step /= 2.0
            if step < _SHORTEST_STEP:
                return _end(Outcome.DIVERGED, point, norm, iteration)
            candidate = point + step * direction
            gradient, hessian = evaluate(candidate)
        point = candidate
    norm = math.sqrt(float(gradient @ gradient))
    outcome = Outcome.CONVERGED if norm <= tolerance else Outcome.MAX_ITERATIONS
    return _end(outcome, point, norm, max_iterations)


def _end(outcome: Outcome, point: Floats, norm: float, iterations: int) -> Minimum:
    return Minimum(
        outcome=outcome, point=point, gradient_norm=norm, iterations=iterations
    )
