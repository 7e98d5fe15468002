"""Part of a starting zone whose snow no row holds.

Theory: terrain/THEORY.md, (T9).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
from netdesign.terrain.measure import LEAST_STEEP, MeasuredRow
from netdesign.terrain.plan import Plan
from netdesign.terrain.surface import Surface

_MOST_PLACES = 250_000  # looked at in a zone; a larger one is looked at more coarsely


@dataclass(frozen=True, slots=True, kw_only=True)
class Squares:
    """Squares over the starting zones.

    Attributes
    ----------
    corner : ndarray, shape (2,)
        Middle of the first, in the southwest [m].
    side : float
        [m].
    is_steep : ndarray, shape (n_y, n_x)
        Those on steep ground in a zone.
    """

    corner: Floats
    side: float
    is_steep: Mask

    def locate(self, which: Mask) -> Floats:
        """Middles of some squares, shape (n, 2) [m]."""
        return self.corner + self.side * np.argwhere(which)[:, ::-1]

    def find_inside(self, ring: Floats) -> tuple[tuple[slice, slice], Mask]:
        """Part of the squares around a ring, and those of it inside, by even and odd.

        Each line of squares is walked from west to east: an edge of the ring changes
        what lies beyond.
        """
        x0, y0 = ((ring - self.corner) / self.side).T
        most = np.array(self.is_steep.shape) - 1
        south, west = np.maximum(np.ceil((y0.min(), x0.min())), 0).astype(np.int64)
        north, east = np.minimum(np.floor((y0.max(), x0.max())), most).astype(np.int64)
        part = slice(south, max(south, north + 1)), slice(west, max(west, east + 1))
        lines = np.arange(part[0].start, part[0].stop)
        x1, y1 = np.roll((x0, y0), -1, axis=1)
        line, edge = np.nonzero((y0 > lines[:, None]) != (y1 > lines[:, None]))
        share = (lines[line] - y0[edge]) / (y1 - y0)[edge]
        crossing = np.ceil(x0[edge] + share * (x1 - x0)[edge]) - west
        count = part[1].stop - west
        at = np.clip(crossing, 0, count).astype(np.int64)
        changes = np.zeros((len(lines), count + 1), dtype=bool)
        np.logical_xor.at(changes, (line, at), True)
        return part, np.logical_xor.accumulate(changes, axis=1)[:, :-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Coverage:
    """Steep ground of the starting zones, and what of it no row holds.

    Attributes
    ----------
    area, uncovered : float
        In plan [m2].
    side : float
        Of the squares that were looked at [m].
    places : ndarray, shape (n, 2)
        Middles of the squares that no row holds [m].
    """

    area: float
    uncovered: float
    side: float
    places: Floats

    @property
    def share(self) -> float:
        """Part that no row holds, 0 to 1 [-]."""
        return self.uncovered / self.area if self.area else 0.0


def find_coverage(
    surface: Surface,
    plan: Plan,
    rows: Sequence[MeasuredRow],
    reach: Mapping[str, float],
) -> Coverage:
    """Steep ground in the starting zones that lies above no row near enough.

    Parameters
    ----------
    surface : Surface
        Ground.
    plan : Plan
        With the starting zones.
    rows : sequence of MeasuredRow
        All of the plan.
    reach : mapping of str to float
        Largest distance that a row holds, along the ground, by its name [m].
    """
    if not plan.zones:
        nothing = np.empty((0, 2))
        return Coverage(area=0.0, uncovered=0.0, side=surface.step, places=nothing)
    squares = _divide_zones(surface, plan.zones)
    is_open = squares.is_steep.copy()
    for ring in _list_held(plan, rows, reach):
        part, inside = squares.find_inside(ring)
        is_open[part] &= ~inside
    return Coverage(
        area=squares.side**2 * int(squares.is_steep.sum()),
        uncovered=squares.side**2 * int(is_open.sum()),
        side=squares.side,
        places=squares.locate(is_open),
    )


def _list_held(
    plan: Plan, rows: Sequence[MeasuredRow], reach: Mapping[str, float]
) -> Iterator[Floats]:
    """Ground that each bay and each closed gap holds, as rings."""
    for row in rows:
        yield from list_strips(row, reach[row.line.id])
    by_id = {row.line.id: row for row in rows}
    for gap in plan.closed_gaps:
        most = min(reach[one] for one in gap.rows)
        beside = zip(gap.rows, gap.ends, strict=True)
        left, right = (_cut_above(by_id[one], end, most) for one, end in beside)
        yield np.concatenate((left, right[::-1]))


def _divide_zones(surface: Surface, zones: Sequence[Floats]) -> Squares:
    """Squares over zones: steps of the surface, larger where these are too many."""
    corners = np.concatenate(zones)
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = float(np.prod(np.maximum(high - low, surface.step)))
    side = max(surface.step, math.sqrt(size / _MOST_PLACES))
    columns, lines = (max(1, round(one)) for one in (high - low) / side)
    squares = Squares(
        corner=low + 0.5 * side,
        side=side,
        is_steep=np.zeros((lines, columns), dtype=bool),
    )
    is_steep = squares.is_steep.copy()
    for zone in zones:
        part, inside = squares.find_inside(zone)
        is_steep[part] |= inside
    steepness = surface.at(squares.locate(is_steep)).steepness
    is_steep[is_steep] = steepness >= LEAST_STEEP
    return replace(squares, is_steep=is_steep)


def list_strips(row: MeasuredRow, reach: float) -> list[Floats]:
    """Ground that each bay of a row holds, as rings, shape (n, 2) [m]."""
    paths = [_cut_above(row, post, reach) for post in range(len(row.ends))]
    return [np.concatenate((left, right[::-1])) for left, right in pairwise(paths)]


def _cut_above(row: MeasuredRow, post: int, reach: float) -> Floats:
    """Line of fall above a post as far as the row holds, shape (n, 2) [m]."""
    most = min(row.ends[post].length.value, reach)
    points, lengths = row.above.points[:, post], row.above.lengths[:, post]
    known = np.isfinite(lengths)
    points, lengths = points[known], lengths[known]
    end = [np.interp(most, lengths, part) for part in points.T]
    return np.vstack((points[lengths < most], end))
