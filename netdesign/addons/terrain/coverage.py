"""Part of a starting zone whose snow no row holds.

Theory: addons/terrain/THEORY.md, (T9).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from netdesign.addons.terrain.measure import LEAST_STEEP, MeasuredRow
from netdesign.addons.terrain.plan import Plan
from netdesign.addons.terrain.surface import Surface
from netdesign.numerics.arrays import Floats

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

    @property
    def sentence(self) -> str:
        """Both areas in words."""
        total = f"Starting zone: {self.area:.0f} m² steeper than 25° in plan;"
        part = f"{self.uncovered:.0f} m² ({100.0 * self.share:.0f} %)"
        return f"{total} {part} that no row holds"


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
    side, places = _list_squares(surface, shapely.union_all(plan.zones))
    held = shapely.union_all(
        [
            shapely.make_valid(shapely.Polygon(ring))
            for ring in _list_held(plan, rows, reach)
            if len(ring) > 2
        ]
    )
    shapely.prepare(held)
    is_open = ~shapely.contains_xy(held, *places.T)
    return Coverage(
        area=side**2 * len(places),
        uncovered=side**2 * int(is_open.sum()),
        side=side,
        places=places[is_open],
    )


def _list_squares(surface: Surface, zones: shapely.Geometry) -> tuple[float, Floats]:
    """Side of squares over zones, and the middles of those on steep ground in them [m].

    They are steps of the surface, larger where these are too many.
    """
    west, south, east, north = zones.bounds
    size = max(east - west, surface.step) * max(north - south, surface.step)
    side = max(surface.step, math.sqrt(size / _MOST_PLACES))
    mesh = np.meshgrid(
        np.arange(west + 0.5 * side, east, side),
        np.arange(south + 0.5 * side, north, side),
    )
    places = np.column_stack([axis.ravel() for axis in mesh])
    shapely.prepare(zones)
    places = places[shapely.contains_xy(zones, *places.T)]
    return side, places[surface.at(places).steepness >= LEAST_STEEP]


def _list_held(
    plan: Plan, rows: Sequence[MeasuredRow], reach: Mapping[str, float]
) -> Iterator[Floats]:
    """Ground that each bay and each closed gap holds, as rings."""
    for row in rows:
        most = reach[row.line.id]
        paths = [_cut_above(row, post, most) for post in range(len(row.ends))]
        for left, right in pairwise(paths):
            yield np.concatenate((left, right[::-1]))
    by_id = {row.line.id: row for row in rows}
    for gap in plan.closed_gaps:
        most = min(reach[name] for name in gap.rows)
        beside = zip(gap.rows, gap.ends, strict=True)
        left, right = (_cut_above(by_id[name], end, most) for name, end in beside)
        yield np.concatenate((left, right[::-1]))


def _cut_above(row: MeasuredRow, post: int, reach: float) -> Floats:
    """Line of fall above a post as far as the row holds, shape (n, 2) [m]."""
    most = min(row.ends[post].length.value, reach)
    points, lengths = row.above.points[:, post], row.above.lengths[:, post]
    is_known = np.isfinite(lengths)
    points, lengths = points[is_known], lengths[is_known]
    end = [np.interp(most, lengths, part) for part in points.T]
    return np.vstack((points[lengths < most], end))
