"""Acceleration of rounds between two models (Anderson mixing)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from netdesign.numerics.arrays import Floats


def mix_anderson(
    points: Sequence[Floats],
    images: Sequence[Floats],
    *,
    depth: int = 20,
    damping: float = 0.5,
) -> Floats:
    """Next iterate of a fixed-point iteration from its history.

    The combination of past iterates whose residual, image - point, is least, moved
    on by a share of what is left of that residual. The first step goes all the way.

    Parameters
    ----------
    points, images : sequence of ndarray, all of one shape
        Iterates and what the map made of them, oldest first; at least one.
    depth : int
        How many of the last entries are used.
    damping : float
        Share of the remaining residual that is added, 0 to 1 [-]. One half converges
        also where the map alone would circle round its fixed point.

    Returns
    -------
    ndarray, of that shape
        The next iterate.

    Source
    ------
    Walker and Ni (2011), Anderson acceleration for fixed-point iterations, SIAM J.
    Numer. Anal. 49, type II.
    """
    residuals = [image - point for point, image in zip(points, images, strict=True)]
    used = min(len(points), depth)
    if used == 1:
        return images[-1]
    differences = np.array([residuals[-1] - r for r in residuals[-used:-1]])
    steps = np.array([points[-1] - point for point in points[-used:-1]])
    columns = differences.reshape(used - 1, -1).T
    weights, *_ = np.linalg.lstsq(columns, residuals[-1].ravel(), rcond=1e-10)
    left = residuals[-1] - np.tensordot(weights, differences, 1)
    step = damping * left - np.tensordot(weights, steps, 1)
    return np.asarray(points[-1] + step)
