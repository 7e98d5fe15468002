"""Density of snow that has deformed: mass goes with the snow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from netdesign.errors import ModelError
from netdesign.snow.creep_law import DENSEST_SNOW, ICE_DENSITY

Floats = NDArray[np.float64]


def compute_density(initial: Floats, jacobian: Floats) -> Floats:
    """Density after a deformation, rho(0) / J.

    Parameters
    ----------
    initial : ndarray, any shape
        Density before [kg/m3].
    jacobian : ndarray, same shape
        J, volume now over volume before [-].

    Returns
    -------
    ndarray
        [kg/m3].

    Raises
    ------
    ModelError
        If snow has turned over (J <= 0) or has become denser than the law allows.
    """
    initial, jacobian = np.asarray(initial, float), np.asarray(jacobian, float)
    if not bool((jacobian > 0.0).all()):
        raise ModelError(f"J = {np.min(jacobian)!r}: must be above 0 everywhere")
    density = initial / jacobian
    densest = DENSEST_SNOW * ICE_DENSITY
    if not bool((density <= densest).all()):
        raise ModelError(
            f"density = {np.max(density):.0f} kg/m3 after settling: the creep law ends "
            f"at {densest:.0f} kg/m3"
        )
    return np.asarray(density)
