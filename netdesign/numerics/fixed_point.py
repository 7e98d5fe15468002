"""Acceleration of rounds between two models (Anderson mixing)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def mix_anderson(points: list[Floats], images: list[Floats], depth: int = 12) -> Floats:
    """Next iterate of a fixed-point iteration from its history.

    The combination of past steps whose residual image - point is least, applied to
    the images. With one entry it is the plain step.

    Parameters
    ----------
    points, images : list of ndarray, each shape (n,)
        Iterates and what the map made of them, oldest first; at least one.
    depth : int
        How many of the last entries are used.

    Returns
    -------
    ndarray, shape (n,)
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
    differences = np.array([residuals[-1] - r for r in residuals[-used:-1]]).T
    image_steps = np.array([images[-1] - image for image in images[-used:-1]]).T
    weights, *_ = np.linalg.lstsq(differences, residuals[-1], rcond=1e-10)
    return np.asarray(images[-1] - image_steps @ weights)
