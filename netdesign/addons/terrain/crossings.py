"""Lines of fall beside rows and starting zones, in plan."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely

from netdesign.addons.terrain.fall_line import FallLines
from netdesign.numerics.arrays import Floats

Rows = tuple[Sequence[str], Sequence[shapely.LineString]]


def find_first_crossings(
    lines: FallLines, line: int, rows: Rows, *, least: float
) -> dict[str, float]:
    """Lengths at which a line of fall first crosses rows, by their names [m].

    Crossings nearer to the start than ``least`` [m] do not count. Lines of one name are
    one.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    names, shapes = rows
    path, lengths = _trace(lines, line)
    if path is None or not names:
        return {}
    meets = shapely.intersection(path, list(shapes))
    places, which = shapely.get_coordinates(meets, return_index=True)
    at = _measure(path, lengths, places)
    found: dict[str, float] = {}
    for length, row in sorted(zip(at.tolist(), which.tolist(), strict=True)):
        if length > least:
            found.setdefault(names[row], length)
    return found


def find_exit(lines: FallLines, line: int, zones: shapely.Geometry) -> float | None:
    """Length at which a line of fall leaves the first zone that it meets [m].

    Infinite where it does not leave it, None where it meets none.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    path, lengths = _trace(lines, line)
    if path is None:
        return None
    inside = shapely.get_parts(shapely.line_merge(path.intersection(zones)))
    ends = [_measure(path, lengths, shapely.get_coordinates(one)) for one in inside]
    if not ends:
        return None
    first = min(ends, key=lambda one: float(one.min()))
    end = float(first.max())
    return end if end < (1.0 - 1e-9) * float(lengths[-1]) else math.inf


def _trace(lines: FallLines, line: int) -> tuple[shapely.LineString | None, Floats]:
    """Line of fall in plan, and the lengths along the ground of its points [m]."""
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    path = shapely.LineString(points[known]) if known.sum() > 1 else None
    return path, lengths[known]


def _measure(path: shapely.LineString, lengths: Floats, places: Floats) -> Floats:
    """Lengths along the ground of places on a line of fall, shape (n, 2) [m]."""
    if not len(places):
        return np.empty(0)
    at = shapely.line_locate_point(path, shapely.points(places))
    steps = np.diff(shapely.get_coordinates(path), axis=0)
    own = np.concatenate(([0.0], np.cumsum(np.hypot(*steps.T))))
    return np.asarray(np.interp(at, own, lengths))
