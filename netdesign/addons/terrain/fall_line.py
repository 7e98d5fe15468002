"""Lines of fall on a surface, followed up or down, beside rows and starting zones.

Theory: addons/terrain/THEORY.md, (T4).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from netdesign.addons.terrain.surface import Surface
from netdesign.numerics.arrays import Floats, Mask

LONGEST_BENCH = 6.0  # of level or opposite ground, across which a line goes on [m]
_LEAST_RISE = (
    0.2  # of a step that leads farther; steps to and fro over a top do not [-]
)
_FLAT = 1e-9  # a gradient below it has no direction [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FallLines:
    """Lines of fall from n points, K steps each; NaN beyond their ends.

    Attributes
    ----------
    points : ndarray, shape (K + 1, n, 2)
        East and north [m].
    heights, steepness, lengths : ndarray, shape (K + 1, n)
        Of the ground [m]; its angle, negative against the line [rad]; length along the
        ground from the start [m].
    is_lost : ndarray of bool, shape (n,)
        Lines that leave the grid or meet a hole before their end.
    """

    points: Floats
    heights: Floats
    steepness: Floats
    lengths: Floats
    is_lost: Mask

    def take(self, lines: slice) -> FallLines:
        """Some of them."""
        return FallLines(
            points=self.points[:, lines],
            heights=self.heights[:, lines],
            steepness=self.steepness[:, lines],
            lengths=self.lengths[:, lines],
            is_lost=self.is_lost[lines],
        )

    def find_length(self, line: int) -> float:
        """Length of a line up to where it ends on the grid [m]."""
        return float(np.nanmax(self.lengths[:, line], initial=0.0))


def follow_fall(
    surface: Surface, starts: Floats, *, most: float, is_up: bool
) -> FallLines:
    """Follow the line of fall from points, by the midpoint rule.

    Each ends with the first step that reaches its length, or at a top or a bottom.
    Over a boulder or a bench it follows the fall of the ground around.

    Parameters
    ----------
    surface : Surface
        Ground.
    starts : ndarray, shape (n, 2)
        [m].
    most : float
        Length along the ground [m].
    is_up : bool
        Upwards, else downwards.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    step, sign = surface.step, 1.0 if is_up else -1.0
    ground = surface.at(starts)
    points, heights, angles = [starts], [ground.height], [ground.steepness]
    lengths, rises = [0.0 * ground.height], [np.isfinite(ground.height)]
    farthest, stalled = sign * ground.height, np.zeros(len(starts))
    least, is_lost = _LEAST_RISE * step, np.zeros(len(starts), dtype=bool)
    for _ in range(math.ceil(most / step) + 1):
        goes_on = (lengths[-1] < most) & (stalled <= LONGEST_BENCH)
        if not goes_on.any():
            break
        start = ground
        half = surface.at(points[-1] + 0.5 * step * sign * _direct(ground.gradient))
        there = points[-1] + step * sign * _direct(half.gradient)
        ground = surface.at(there)
        is_farther = sign * ground.height > farthest + least
        if (goes_on & ~is_farther).any():  # over a boulder or a bench
            around = step * sign * _direct(_find_fall_around(surface, points[-1]))
            there = np.where(is_farther[:, None], there, points[-1] + around)
            ground = surface.at(there)
            is_farther = sign * ground.height > farthest + least
        is_level = _is_level(start.gradient) | _is_level(half.gradient)
        is_lost |= goes_on & ~np.isfinite(ground.height) & ~is_level
        farthest = np.where(is_farther, sign * ground.height, farthest)
        stalled = np.where(is_farther, 0.0, stalled + step * goes_on)
        nothing = np.where(goes_on, 0.0, math.nan)
        rise = ground.height - heights[-1]
        angle = np.where(sign * rise > 0.0, ground.steepness, -ground.steepness)
        points.append(there + nothing[:, None])
        heights.append(ground.height + nothing)
        angles.append(angle + nothing)
        lengths.append(lengths[-1] + np.hypot(step, rise) + nothing)
        rises.append(is_farther)
    # a line that nothing leads farther ended at its last top or bottom
    goes_farther = np.logical_or.accumulate(rises[::-1])[::-1]
    ended = np.where(goes_farther | (stalled <= LONGEST_BENCH), 0.0, math.nan)
    return FallLines(
        points=np.stack(points) + ended[..., None],
        heights=np.stack(heights) + ended,
        steepness=np.stack(angles) + ended,
        lengths=np.stack(lengths) + ended,
        is_lost=is_lost,
    )


def _find_fall_around(surface: Surface, places: Floats) -> Floats:
    """Gradient of the ground over the width of two benches, shape (n, 2) [-]."""
    turns = np.arange(8) * (math.pi / 4.0)
    ring = np.column_stack((np.cos(turns), np.sin(turns)))
    there = places[:, None] + LONGEST_BENCH * ring
    heights = surface.at(there.reshape(-1, 2)).height.reshape(len(places), len(ring))
    return np.asarray(heights @ ring / (0.5 * len(ring) * LONGEST_BENCH))


def _is_level(gradient: Floats) -> Mask:
    """Ground without a direction; False where there is none."""
    return np.asarray(np.hypot(gradient[:, 0], gradient[:, 1]) <= _FLAT)


def _direct(gradient: Floats) -> Floats:
    size = np.hypot(gradient[:, 0], gradient[:, 1])[:, None]
    return np.where(size > _FLAT, gradient / np.maximum(size, _FLAT), math.nan)


def find_relief(surface: Surface, lines: FallLines) -> FallLines:
    """Lines with the error of the slope by relief in the place of the slope, (T6).

    Where the other window meets a hole, the error is that of the rest of the line.

    Parameters
    ----------
    surface : Surface
        Ground, by the window that serves.
    lines : FallLines
        On it.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    other = surface.reopen()
    points = lines.points.reshape(-1, 2)
    angles = other.at(points).steepness.reshape(lines.steepness.shape)
    off = surface.relief_share * np.abs(angles - np.abs(lines.steepness))
    return replace(lines, steepness=off)


def find_mean(
    above: FallLines, below: FallLines, post: int, up: float, down: float
) -> float:
    """Mean slope angle on a line of fall, from ``down`` below to ``up`` above [rad].

    Parameters
    ----------
    above, below : FallLines
        From the same points up and down.
    post : int
        Which of them.
    up, down : float
        Along the ground [m].

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    sums = [
        _integrate(part.lengths[:, post], part.steepness[:, post], most)
        for part, most in ((above, up), (below, down))
    ]
    length, turned = (sum(parts) for parts in zip(*sums, strict=True))
    return turned / length if length > 0.0 else float(above.steepness[0, post])


def _integrate(lengths: Floats, angles: Floats, most: float) -> tuple[float, float]:
    """Length up to ``most`` and the integral of the angle over it [m, rad m]."""
    is_known = np.isfinite(lengths) & np.isfinite(angles)
    lengths, angles = lengths[is_known], angles[is_known]
    if lengths.size < 2:
        return 0.0, 0.0
    end = min(most, float(lengths[-1]))
    inside = lengths < end
    places = np.append(lengths[inside], end)
    values = np.append(angles[inside], np.interp(end, lengths, angles))
    return end, float(0.5 * ((values[1:] + values[:-1]) * np.diff(places)).sum())


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
    crossings: dict[str, float] = {}
    for length, row in sorted(zip(at.tolist(), which.tolist(), strict=True)):
        if length > least:
            crossings.setdefault(names[row], length)
    return crossings


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
    ends = [_measure(path, lengths, shapely.get_coordinates(part)) for part in inside]
    if not ends:
        return None
    first = min(ends, key=lambda places: float(places.min()))
    end = float(first.max())
    return end if end < (1.0 - 1e-9) * float(lengths[-1]) else math.inf


def _trace(lines: FallLines, line: int) -> tuple[shapely.LineString | None, Floats]:
    """Line of fall in plan, and the lengths along the ground of its points [m]."""
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    is_known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    path = shapely.LineString(points[is_known]) if is_known.sum() > 1 else None
    return path, lengths[is_known]


def _measure(path: shapely.LineString, lengths: Floats, places: Floats) -> Floats:
    """Lengths along the ground of places on a line of fall, shape (n, 2) [m]."""
    if not len(places):
        return np.empty(0)
    at = shapely.line_locate_point(path, shapely.points(places))
    steps = np.diff(shapely.get_coordinates(path), axis=0)
    own = np.concatenate(([0.0], np.cumsum(np.hypot(*steps.T))))
    return np.asarray(np.interp(at, own, lengths))
