"""Lines of fall beside other lines and rings, in plan."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
from netdesign.terrain.fall_line import FallLines


def find_first_crossings(
    lines: FallLines, line: int, others: Sequence[tuple[str, Floats]], *, least: float
) -> dict[str, float]:
    """Lengths at which a line of fall first crosses other lines, by their names [m].

    Crossings nearer to the start than ``least`` [m] do not count. Lines of one name are
    one.

    Verified by
    -----------
    tests/terrain/test_measure.py
    """
    if not others:
        return {}
    names = [name for name, points in others for _ in points[1:]]
    starts = np.concatenate([points[:-1] for _, points in others])
    ends = np.concatenate([points[1:] for _, points in others])
    found: dict[str, float] = {}
    for length, which in _list_crossings(lines, line, starts, ends):
        if length > least:
            found.setdefault(names[which], length)
    return found


def _list_crossings(
    lines: FallLines, line: int, starts: Floats, ends: Floats
) -> list[tuple[float, int]]:
    """Lengths at which a line of fall crosses segments [m], and which; nearest first.

    Shapes of both (m, 2) [m].
    """
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    points, lengths = points[known], lengths[known]
    if len(points) < 2:
        return []
    start, way = points[:-1, None], np.diff(points, axis=0)[:, None]
    corner, side = starts[None], (ends - starts)[None]
    crossed = _cross(way, side)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = _cross(corner - start, side) / crossed
        beside = _cross(corner - start, way) / crossed
    # half open, so that a crossing at a corner counts once
    meets = (along >= 0.0) & (along < 1.0) & (beside >= 0.0) & (beside < 1.0)
    steps, which = np.nonzero(meets)
    at = lengths[steps] + along[meets] * np.diff(lengths)[steps]
    return sorted(zip(at.tolist(), which.tolist(), strict=True))


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
        crossed = _list_crossings(lines, line, ring, np.roll(ring, -1, axis=0))
        edges = [length for length, _ in crossed]
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


def crosses_itself(ring: Floats) -> bool:
    """Two edges of a ring, shape (n, 2), cross each other, at none of its corners.

    Verified by
    -----------
    tests/terrain/test_plan.py
    """
    edges = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
    edges = edges[np.argsort(edges[:, :, 0].min(axis=1))]
    left, right = edges[:, :, 0].min(axis=1), edges[:, :, 0].max(axis=1)
    # those that begin farther to the right than an edge ends do not cross it
    last = np.searchsorted(left, right, side="right")
    for k, (start, end) in enumerate(edges):
        starts, ends = edges[k + 1 : last[k], 0], edges[k + 1 : last[k], 1]
        way, ways = end - start, ends - starts
        sides = _cross(way, starts - start) * _cross(way, ends - start)
        others = _cross(ways, start - starts) * _cross(ways, end - starts)
        if np.any((sides < 0.0) & (others < 0.0)):
            return True
    return False


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
