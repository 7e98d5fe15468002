"""Part of a starting zone whose snow no row holds.

Theory: terrain/THEORY.md, (T9).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.terrain.crossings import is_in_any, is_inside
from netdesign.terrain.measure import LEAST_STEEP, MeasuredRow
from netdesign.terrain.plan import Plan
from netdesign.terrain.surface import Surface

_MOST_PLACES = 250_000  # looked at in a zone; a larger one is looked at more coarsely


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
    nothing = np.empty((0, 2))
    if not plan.zones:
        return Coverage(area=0.0, uncovered=0.0, side=surface.grid.cell, places=nothing)
    side, places = list_steep_places(surface, plan.zones)
    held = np.zeros(len(places), dtype=bool)
    for row in rows:
        strips = list_strips(row, reach[row.line.id])
        corners = np.concatenate(strips)
        is_near = (places >= corners.min(axis=0)) & (places <= corners.max(axis=0))
        near = np.flatnonzero(is_near.all(axis=1))
        held[near] |= is_in_any(places[near], strips)
    by_id = {row.line.id: row for row in rows}
    for gap in plan.closed_gaps:
        most = min(reach[one] for one in gap.rows)
        beside = zip(gap.rows, gap.ends, strict=True)
        left, right = (_cut_above(by_id[one], end, most) for one, end in beside)
        held |= is_inside(places, np.concatenate((left, right[::-1])))
    open_places = places[~held]
    return Coverage(
        area=side**2 * len(places),
        uncovered=side**2 * len(open_places),
        side=side,
        places=open_places,
    )


def list_steep_places(
    surface: Surface, zones: Sequence[Floats]
) -> tuple[float, Floats]:
    """Side of squares over the zones [m], and middles of those on steep ground in them.

    Shape of the middles (n, 2) [m].
    """
    corners = np.concatenate(zones)
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = float(np.prod(np.maximum(high - low, surface.grid.cell)))
    side = max(surface.grid.cell, math.sqrt(size / _MOST_PLACES))
    axes = [np.arange(a + side / 2.0, b, side) for a, b in zip(low, high, strict=True)]
    east, north = np.meshgrid(*axes)
    places = np.column_stack((east.ravel(), north.ravel()))
    places = places[is_in_any(places, zones)]
    return side, places[surface.at(places).steepness >= LEAST_STEEP]


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
