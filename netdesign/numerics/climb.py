"""Largest values of several cheap functions over a small box: a grid, then climbing.

The functions are worked out at many points at once. What may lie between the points
has no proven bound; the tests of whoever uses it measure that.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from netdesign.numerics.arrays import Floats, Ints

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
    return np.array([one.ravel() for one in np.meshgrid(*axes, indexing="ij")])


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
        found = functions(around).reshape(-1, count.size, offsets.shape[1])
        own = found[peaks.sought, count]
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
