"""Contours on a surface, along which rows are drawn."""

from __future__ import annotations

import math

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.terrain.surface import Surface

STEP = 3.0  # of a drawn line: its bends are those of the ground, not of the noise [m]


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
    for _ in range(math.ceil(length / STEP)):
        points.append(go_along(surface, points[-1][None], STEP)[0])
    return np.stack(points)


def go_along(surface: Surface, here: Floats, step: float | Floats) -> Floats:
    """Places a step farther on their contours, by the midpoint rule.

    Parameters
    ----------
    surface : Surface
        Ground.
    here : ndarray, shape (n, 2)
        [m].
    step : float or ndarray, shape (n, 1)
        With the slope on the left; negative the other way [m].
    """
    middle = here + 0.5 * step * _turn(surface, here)
    return np.asarray(here + step * _turn(surface, middle))


def _turn(surface: Surface, places: Floats) -> Floats:
    """Directions along the contours, uphill on their left; NaN on flat ground."""
    east, north = surface.at(places).gradient.T
    with np.errstate(divide="ignore", invalid="ignore"):
        turned = np.column_stack((north, -east)) / np.hypot(east, north)[:, None]
    return np.asarray(turned)
