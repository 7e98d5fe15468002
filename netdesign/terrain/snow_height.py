"""Vertical snow height at places: from a station's altitude, or from a grid."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import TerrainError
from netdesign.terrain.grid import Grid
from netdesign.words.message import say

FindSnow = Callable[[Floats], Floats]
_LEAST, _MOST = 0.1, 20.0  # of snow that rows are proposed for [m]


def follow_altitude(
    ground: Grid, height: float, altitude: float, gradient: float
) -> FindSnow:
    """Snow height that changes with the altitude.

    Parameters
    ----------
    ground : Grid
        Altitudes.
    height, altitude : float
        Vertical snow height, and where it holds [m].
    gradient : float
        Change of the height with the altitude [m/m].
    """

    def find(places: Floats) -> Floats:
        found = height + gradient * (look_up_nearest(ground, places) - altitude)
        _require(places, found)
        return found

    return find


def read_heights(snow: Grid, file: str) -> FindSnow:
    """Snow height of the nearest cell of a grid of snow heights.

    What the grid leaves open is refused where it is asked for.
    """

    def find(places: Floats) -> Floats:
        found = look_up_nearest(snow, places)
        try:
            _require(places, found)
        except TerrainError as error:
            told = say("text.at_place", place=file, text=error.message)
            raise TerrainError(told) from None
        return found

    return find


def _require(places: Floats, found: Floats) -> None:
    wrong = np.flatnonzero(~((found >= _LEAST) & (found <= _MOST)))
    if wrong.size:
        east, north = (float(one) for one in places[wrong[0]])
        value = float(found[wrong[0]])
        if math.isnan(value):
            raise TerrainError(say("layout.snow_unknown", east=east, north=north))
        ends = {"least": _LEAST, "most": _MOST, "value": value}
        raise TerrainError(say("layout.no_snow", east=east, north=north, **ends))


def look_up_nearest(grid: Grid, places: Floats) -> Floats:
    """Values of the nearest cells, shape (n, 2) -> (n,); NaN beyond the grid."""
    lines, columns = grid.heights.shape
    at = np.rint((places - (grid.west, grid.south)) / grid.cell)
    is_on = np.isfinite(at) & (at >= 0) & (at < (columns, lines))
    known = np.asarray(is_on.all(axis=1))
    index = np.where(known[:, None], at, 0).astype(np.int64)
    return np.where(known, grid.heights[index[:, 1], index[:, 0]], np.nan)
