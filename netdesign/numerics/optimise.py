"""Least value of a convex function, by Newton; largest ones of several, by climbing.

Newton's method converges from everywhere. What is climbed is cheap and stands over a
small box: a grid of it first. What may lie between the points has no proven bound; the
tests of whoever uses it measure that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import Outcome

_ACCEPTED_CLIMB = 0.5
_SHORTEST_STEP = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Minimum:
    """End of a minimisation.

    Attributes
    ----------
    outcome : Outcome
        Converged, max_iterations, diverged or nonfinite.
    point : ndarray, shape (n,)
        Last iterate.
    iterations : int
        Newton steps taken.
    """

    outcome: Outcome
    point: Floats
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
            return Minimum(Outcome.NONFINITE, point, iteration)
        if norm <= tolerance:
            return Minimum(Outcome.CONVERGED, point, iteration)
        _, direction, fault = lapack.dposv(hessian, -gradient)
        if fault != 0:  # not convex here
            return Minimum(Outcome.DIVERGED, point, iteration)
        descent = -float(gradient @ direction)
        step = 1.0
        candidate = point + direction
        gradient, hessian = evaluate(candidate)
        while not float(gradient @ direction) <= _ACCEPTED_CLIMB * descent:
            step /= 2.0
            if step < _SHORTEST_STEP:
                return Minimum(Outcome.DIVERGED, point, iteration)
            candidate = point + step * direction
            gradient, hessian = evaluate(candidate)
        point = candidate
    norm = math.sqrt(float(gradient @ gradient))
    outcome = Outcome.CONVERGED if norm <= tolerance else Outcome.MAX_ITERATIONS
    return Minimum(outcome, point, max_iterations)


# Points, shape (d, n), to the values of q functions there, shape (q, n).
Functions = Callable[[Floats], Floats]

_NEARLY = 0.05  # share of the highest, by which a peak of the grid may lie lower
# A climb ends when nothing has risen by this share for some rounds in turn.
_SMALL_RISE = 3e-7
_CALM_ROUNDS = 4
_MOST_ROUNDS = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class _Peaks:
    """Places from which larger values are looked for.

    Attributes
    ----------
    sought : ndarray of int, shape (s,)
        Number of the function that is made large there.
    points : ndarray, shape (d, s)
        Where.
    values : ndarray, shape (s,)
        How large it is.
    """

    sought: Ints
    points: Floats
    values: Floats


def find_largest(functions: Functions, axes: Sequence[Floats]) -> tuple[Floats, Floats]:
    """Points at which functions are largest over a box, and how large.

    Parameters
    ----------
    functions : callable
        Points, shape (d, n), to the values of q functions, shape (q, n).
    axes : sequence of d ndarrays
        Ascending values of the grid along each axis, shape (any,), both ends of the
        box included; one value where the box has no width.

    Returns
    -------
    tuple of ndarray, shapes (d, q) and (q,)
        Of each function its point and its value; none on the grid is larger.

    Verified by
    -----------
    tests/numerics/test_climb.py
    """
    grid = build_grid(axes)
    values = functions(grid)
    sought, index = _find_peaks(values.reshape(-1, *(axis.size for axis in axes)))
    peaks = _Peaks(sought=sought, points=grid[:, index], values=values[sought, index])
    peaks = _climb(functions, peaks, axes)
    every = np.arange(len(values))[:, None]
    heights = np.where(peaks.sought == every, peaks.values, -np.inf)
    return peaks.points[:, heights.argmax(axis=1)], heights.max(axis=1)


def build_grid(axes: Sequence[Floats]) -> Floats:
    """Points of a grid, shape (d, n).

    Parameters
    ----------
    axes : sequence of d ndarrays
        Values along each axis, shape (any,); those of the last one run first.
    """
    return np.array([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")])


def _find_peaks(values: Floats) -> tuple[Ints, Ints]:
    """Points of a grid that none beside them exceeds, nearly as high as the highest.

    Parameters
    ----------
    values : ndarray, shape (q, a, b, ...)
        Of each function on the grid.

    Returns
    -------
    tuple of ndarray, shape (s,)
        Number of the function and of the point, of each peak.
    """
    sides = tuple(range(1, values.ndim))
    highest = values.max(axis=sides, keepdims=True)
    is_peak = values >= highest - _NEARLY * np.abs(highest)
    for axis in sides:
        ahead = np.diff(values, axis=axis)
        edge = np.ones_like(values.take([0], axis=axis))
        is_peak &= np.concatenate([edge, ahead], axis=axis) > 0.0  # flats count once
        is_peak &= np.concatenate([ahead, -edge], axis=axis) <= 0.0
    sought, index = np.nonzero(is_peak.reshape(len(values), -1))
    return sought, index


def _climb(functions: Functions, peaks: _Peaks, axes: Sequence[Floats]) -> _Peaks:
    """Higher points beside peaks, until nothing rises.

    Every peak has a step for each axis. It doubles where it was of use, so that narrow
    ridges are followed, and is halved where it was not.
    """
    count = np.arange(peaks.sought.size)
    low, high = (np.array([[axis[end]] for axis in axes]) for end in (0, -1))
    cells = (high - low) / np.array([[max(axis.size - 1, 1)] for axis in axes])
    steps = np.repeat(0.5 * cells, count.size, axis=1)
    sides = [(0.0, -1.0, 1.0) if axis.size > 1 else (0.0,) for axis in axes]
    offsets = np.array(list(product(*sides))).T
    calm = 0
    for _ in range(_MOST_ROUNDS):
        around = peaks.points[:, :, None] + offsets[:, None, :] * steps[:, :, None]
        around = np.clip(around.reshape(len(axes), -1), low, high)
        distinct, at = find_distinct(around.T)  # many peaks lie on one corner
        values = functions(distinct.T)
        own = values[peaks.sought[:, None], at.reshape(count.size, -1)]
        best = own.argmax(axis=1)
        steps *= np.where(offsets[:, best] == 0.0, 0.5, 2.0)
        place = count * offsets.shape[1] + best
        higher = replace(peaks, points=around[:, place], values=own[count, best])
        rise = higher.values - peaks.values
        is_calm = (rise <= _SMALL_RISE * np.abs(higher.values)).all()
        peaks, calm = higher, calm + 1 if is_calm else 0
        if calm == _CALM_ROUNDS:
            break
    return peaks


def find_distinct(places: Floats) -> tuple[Floats, Ints]:
    """Places without repetition, and of each of the given ones which it is.

    As ``np.unique(..., axis=0)``, in a fifth of its time.

    Parameters
    ----------
    places : ndarray, shape (n, d)
        At least one.
    """
    order = np.lexsort(places.T[::-1])
    ordered = places[order]
    is_new = np.any(ordered[1:] != ordered[:-1], axis=1)
    number = np.empty(len(places), dtype=np.intp)
    number[order] = np.concatenate([[0], np.cumsum(is_new)])
    return ordered[np.concatenate([[True], is_new])], number
