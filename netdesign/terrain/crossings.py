"""Crossings of a line of fall with another line, in plan."""

from __future__ import annotations

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.terrain.fall_line import FallLines


def find_crossing(
    lines: FallLines, line: int, other: Floats, *, least: float
) -> float | None:
    """Length at which a line of fall first crosses another one [m].

    Parameters
    ----------
    lines : FallLines
        Of some points.
    line : int
        Which of them.
    other : ndarray, shape (m, 2)
        Points of the other line [m].
    least : float
        Crossings nearer to the start do not count [m].

    Returns
    -------
    float or None
        Along the ground; None where they do not cross.

    Verified by
    -----------
    tests/terrain/test_measure.py
    """
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    points, lengths = points[known], lengths[known]
    if len(points) < 2:
        return None
    low, high = other.min(axis=0), other.max(axis=0)
    if (points.max(axis=0) < low).any() or (points.min(axis=0) > high).any():
        return None
    start, way = points[:-1, None], np.diff(points, axis=0)[:, None]
    corner, side = other[None, :-1], np.diff(other, axis=0)[None]
    crossed = _cross(way, side)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = _cross(corner - start, side) / crossed
        beside = _cross(corner - start, way) / crossed
    meets = (along >= 0.0) & (along <= 1.0) & (beside >= 0.0) & (beside <= 1.0)
    steps, _ = np.nonzero(meets)
    found = lengths[steps] + along[meets] * np.diff(lengths)[steps]
    found = found[found > least]
    return float(found.min()) if found.size else None


def _cross(one: Floats, other: Floats) -> Floats:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
