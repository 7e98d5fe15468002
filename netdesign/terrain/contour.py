"""Contours on a surface, along which rows are drawn."""

from __future__ import annotations

import math

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.terrain.surface import Surface

_STEP = 3.0  # of a drawn line: its bends are those of the ground, not of the noise [m]


def follow_contour(surface: Surface, start: Floats, length: float) -> Floats:
    """Points along the contour through a point, the slope to the left.

    Parameters
    ----------
    surface : Surface
        Ground.
    start : ndarray, shape (2,)
        East and north [m].
    length : float
        In plan [m].

    Returns
    -------
    ndarray, shape (n, 2)
        [m].
    """
    points = [start]
    for _ in range(math.ceil(length / _STEP)):
        here = points[-1]
        middle = here + 0.5 * _STEP * _turn(surface, here)
        points.append(here + _STEP * _turn(surface, middle))
    return np.stack(points)


def _turn(surface: Surface, point: Floats) -> Floats:
    """Direction along the contour, uphill on its left."""
    east, north = surface.at(point[None]).gradient[0]
    return np.array((north, -east)) / math.hypot(east, north)
