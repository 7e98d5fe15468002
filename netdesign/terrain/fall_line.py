"""Lines of fall on a surface, followed up or down from many points at once.

Theory: terrain/THEORY.md, (T4).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.terrain.surface import Surface

_FLAT = 1e-9  # a gradient below it has no direction [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FallLines:
    """Lines of fall from n points, K steps each; NaN beyond their ends.

    Attributes
    ----------
    points : ndarray, shape (K + 1, n, 2)
        East and north [m].
    heights, steepness, lengths : ndarray, shape (K + 1, n)
        Of the ground [m], its angle [rad], length along the ground from the start [m].
    """

    points: Floats
    heights: Floats
    steepness: Floats
    lengths: Floats

    def find_length(self, line: int) -> float:
        """Length of a line up to where it ends on the grid [m]."""
        return float(np.nanmax(self.lengths[:, line], initial=0.0))


def follow_fall(
    surface: Surface, starts: Floats, *, most: float, is_up: bool
) -> FallLines:
    """Follow the line of fall from points, by the midpoint rule.

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
    tests/terrain/test_measure.py
    """
    step = surface.grid.cell
    sign = 1.0 if is_up else -1.0
    ground = surface.at(starts)
    points, heights, angles = [starts], [ground.height], [ground.steepness]
    lengths = [np.where(np.isfinite(ground.height), 0.0, math.nan)]
    for _ in range(math.ceil(most / step) + 1):
        here = points[-1]
        half = surface.at(here + 0.5 * step * sign * _direct(ground.gradient))
        there = here + step * sign * _direct(half.gradient)
        ground = surface.at(there)
        rise = ground.height - heights[-1]
        goes_on = sign * rise > 0.0  # not beyond a top, nor a bottom
        length = np.where(goes_on, lengths[-1] + np.hypot(step, rise), math.nan)
        points.append(np.where(np.isfinite(length)[:, None], there, math.nan))
        heights.append(ground.height)
        angles.append(ground.steepness)
        lengths.append(length)
        if not (length < most).any():
            break
    return FallLines(
        points=np.stack(points),
        heights=np.stack(heights),
        steepness=np.stack(angles),
        lengths=np.stack(lengths),
    )


def _direct(gradient: Floats) -> Floats:
    size = np.hypot(gradient[:, 0], gradient[:, 1])[:, None]
    return np.where(size > _FLAT, gradient / np.maximum(size, _FLAT), math.nan)
