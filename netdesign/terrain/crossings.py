"""Lines of fall beside other lines and rings, in plan."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
from netdesign.terrain.fall_line import FallLines


def find_crossing(
    lines: FallLines, line: int, other: Floats, *, least: float
) -> float | None:
    """Length at which a line of fall first crosses another one [m].

    Crossings nearer to the start than ``least`` [m] do not count. None without any.

    Verified by
    -----------
    tests/terrain/test_measure.py
    """
    found = list_crossings(lines, line, other)
    return next((one for one in found if one > least), None)


def list_crossings(lines: FallLines, line: int, other: Floats) -> list[float]:
    """Lengths along the ground at which a line of fall crosses another one [m].

    Parameters
    ----------
    lines : FallLines
        Of some points.
    line : int
        Which of them.
    other : ndarray, shape (m, 2)
        Points of the other line [m].
    """
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    points, lengths = points[known], lengths[known]
    if len(points) < 2:
        return []
    low, high = other.min(axis=0), other.max(axis=0)
    if (points.max(axis=0) < low).any() or (points.min(axis=0) > high).any():
        return []
    start, way = points[:-1, None], np.diff(points, axis=0)[:, None]
    corner, side = other[None, :-1], np.diff(other, axis=0)[None]
    crossed = _cross(way, side)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = _cross(corner - start, side) / crossed
        beside = _cross(corner - start, way) / crossed
    # half open, so that a crossing at a corner counts once
    meets = (along >= 0.0) & (along < 1.0) & (beside >= 0.0) & (beside < 1.0)
    steps, _ = np.nonzero(meets)
    return sorted((lengths[steps] + along[meets] * np.diff(lengths)[steps]).tolist())


def find_exit(lines: FallLines, line: int, rings: Sequence[Floats]) -> float | None:
    """Length at which a line of fall leaves the first rings that it meets [m].

    Rings that overlap there are one; infinite where it does not leave them, None where
    it meets none.

    Verified by
    -----------
    tests/terrain/test_measure.py
    """
    spans: list[tuple[float, float]] = []
    for ring in rings:
        edges = list_crossings(lines, line, np.vstack((ring, ring[:1])))
        if is_inside(lines.points[:1, line], ring)[0]:
            edges = [0.0, *edges]
        spans += zip(edges[::2], [*edges[1::2], math.inf], strict=False)
    if not spans:
        return None
    first, *others = sorted(spans)
    end = first[1]
    for start, other in others:
        end = max(end, other) if start <= end else end
    return end


def _cross(one: Floats, other: Floats) -> Floats:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def is_in_any(places: Floats, rings: Sequence[Floats]) -> Mask:
    """Places inside any of some rings, shape (n,)."""
    found = np.zeros(len(places), dtype=bool)
    for ring in rings:
        found |= is_inside(places, ring)
    return found


def is_inside(places: Floats, ring: Floats) -> Mask:
    """Places inside a ring by the even-odd rule, shape (n,)."""
    found = np.zeros(len(places), dtype=bool)
    low, high = ring.min(axis=0), ring.max(axis=0)
    near = np.flatnonzero(((places >= low) & (places <= high)).all(axis=1))
    if not near.size:
        return found
    x, y = places[near, 0][:, None], places[near, 1][:, None]
    x0, y0 = ring.T
    x1, y1 = np.roll(ring, -1, axis=0).T
    spans = (y0 > y) != (y1 > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    found[near] = ((x < crossing) & spans).sum(axis=1) % 2 == 1
    return found
