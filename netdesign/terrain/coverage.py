"""Part of a starting zone whose snow no row holds.

Theory: terrain/THEORY.md, (T9).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
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
    side, places = _list_places(surface, plan)
    is_in_zone = _is_in_any(places, plan.zones)
    places = places[is_in_zone]
    steep = surface.at(places).steepness >= LEAST_STEEP
    places = places[steep]
    held = np.zeros(len(places), dtype=bool)
    for row in rows:
        for strip in list_strips(row, reach[row.line.id]):
            held |= is_inside(places, strip)
    open_places = places[~held]
    return Coverage(
        area=side**2 * len(places),
        uncovered=side**2 * len(open_places),
        side=side,
        places=open_places,
    )


def _list_places(surface: Surface, plan: Plan) -> tuple[float, Floats]:
    """Side of squares over the zones, and their middles."""
    corners = np.concatenate(plan.zones)
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = float(np.prod(np.maximum(high - low, surface.grid.cell)))
    side = max(surface.grid.cell, math.sqrt(size / _MOST_PLACES))
    axes = [np.arange(a + side / 2.0, b, side) for a, b in zip(low, high, strict=True)]
    east, north = np.meshgrid(*axes)
    return side, np.column_stack((east.ravel(), north.ravel()))


def _is_in_any(places: Floats, rings: Sequence[Floats]) -> Mask:
    found = np.zeros(len(places), dtype=bool)
    for ring in rings:
        found |= is_inside(places, ring)
    return found


def list_strips(row: MeasuredRow, reach: float) -> list[Floats]:
    """Ground that each bay of a row holds, as rings, shape (n, 2) [m]."""
    paths = []
    for post, end in enumerate(row.ends):
        most = min(end.length.value, reach)
        paths.append(_cut(row, post, most))
    return [np.concatenate((left, right[::-1])) for left, right in pairwise(paths)]


def _cut(row: MeasuredRow, post: int, most: float) -> Floats:
    """Line of fall above a post up to a length, shape (n, 2) [m]."""
    points, lengths = row.above.points[:, post], row.above.lengths[:, post]
    known = np.isfinite(lengths)
    points, lengths = points[known], lengths[known]
    end = [np.interp(most, lengths, part) for part in points.T]
    return np.vstack((points[lengths < most], end))


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
