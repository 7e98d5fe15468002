"""Smooth curve through points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from netdesign.numerics.arrays import Floats

Point = tuple[float, float]

_LEAST_STEP = 1e-9  # points that are rounded may coincide


def interpolate_curve(places: Floats, points: Floats, wanted: Floats) -> Floats:
    """Points of a smooth curve at other places along it.

    Parameters
    ----------
    places : ndarray, shape (n,)
        Ascending parameter of the points, n at least 2.
    points : ndarray, shape (k, n)
        The curve goes through them.
    wanted : ndarray, shape (m,)
        Parameters between the first and the last.

    Returns
    -------
    ndarray, shape (k, m)
        By cubic Hermite pieces whose slopes are those of the parabolas through
        three neighbours: third order, and local.
    """
    if places.size == 2:
        return np.array([np.interp(wanted, places, axis) for axis in points])
    steps = np.diff(places)
    chords = np.diff(points) / steps
    inner = (chords[:, :-1] * steps[1:] + chords[:, 1:] * steps[:-1]) / (
        steps[1:] + steps[:-1]
    )
    first = 2.0 * chords[:, :1] - inner[:, :1]
    last = 2.0 * chords[:, -1:] - inner[:, -1:]
    slopes = np.concatenate([first, inner, last], axis=1)
    piece = np.clip(np.searchsorted(places, wanted) - 1, 0, steps.size - 1)
    step = steps[piece]
    part = (wanted - places[piece]) / step
    rest = 1.0 - part
    return np.asarray(
        points[:, piece] * rest**2 * (1.0 + 2.0 * part)
        + points[:, piece + 1] * part**2 * (1.0 + 2.0 * rest)
        + step * part * rest * (rest * slopes[:, piece] - part * slopes[:, piece + 1])
    )


def trace_curve(points: Sequence[Point], pieces: int) -> list[list[Point]]:
    """Smooth curve through points, to be drawn: from each of them to the next.

    Parameters
    ----------
    points : sequence of Point
        At least two, in any unit.
    pieces : int
        Straight ones, between two points.

    Returns
    -------
    list of list of Point
        For each pair of neighbours ``pieces`` + 1 points, both included.
    """
    nodes = np.array(points).T
    steps = np.maximum(np.hypot(*np.diff(nodes)), _LEAST_STEP)
    places = np.append(0.0, np.cumsum(steps))
    wanted = places[:-1, None] + steps[:, None] * np.linspace(0.0, 1.0, pieces + 1)
    x, y = interpolate_curve(places, nodes, wanted.ravel()).reshape(2, *wanted.shape)
    return [
        list(zip(*row, strict=True)) for row in zip(x.tolist(), y.tolist(), strict=True)
    ]
