"""Layers of one day's snowpack, and those of a whole series of days."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from netdesign.numerics.arrays import Floats, Ints

DAY = 86400.0  # [s]; both models were fitted to daily heights


@dataclass(frozen=True, kw_only=True, eq=False)
class DayPack:
    """Snowpack of a flat station at the end of one day, from the ground up.

    Attributes
    ----------
    heights : ndarray, shape (n_layers,)
        h [m], vertical.
    masses : ndarray, shape (n_layers,)
        m [kg/m2], of horizontal area.
    ages : ndarray of int, shape (n_layers,)
        Days since the layer fell; 0 on that day.
    new_mass : float
        Mass that fell on this day [kg/m2].
    runoff : float
        Mass that left on this day, as water or as snow [kg/m2].
    """

    heights: Floats
    masses: Floats
    ages: Ints
    new_mass: float = 0.0
    runoff: float = 0.0

    @cached_property
    def height(self) -> float:
        """Height of all layers [m]."""
        return float(self.heights.sum())

    @cached_property
    def mass(self) -> float:
        """Snow water equivalent of all layers [kg/m2]."""
        return float(self.masses.sum())

    @property
    def densities(self) -> Floats:
        """Density of each layer [kg/m3], (n_layers,)."""
        return self.masses / self.heights

    @property
    def density(self) -> float:
        """Mean density [kg/m3]; 0 of bare ground."""
        return self.mass / self.height if self.heights.size else 0.0


BARE = DayPack(
    heights=np.empty(0), masses=np.empty(0), ages=np.empty(0, dtype=np.int64)
)


def build_first_layer(height: float, density: float) -> DayPack:
    """Snowpack of a day that follows bare ground: one layer of new snow.

    Parameters
    ----------
    height : float
        [m].
    density : float
        Of new snow [kg/m3].
    """
    mass = density * height
    return DayPack(
        heights=np.array([height]),
        masses=np.array([mass]),
        ages=np.array([0]),
        new_mass=mass,
    )


def sum_overlying(masses: Floats) -> Floats:
    """Mass of each layer and of all above it [kg/m2], (n_layers,).

    Parameters
    ----------
    masses : ndarray, shape (n_layers,)
        From the ground up [kg/m2].
    """
    return np.asarray(masses[::-1].cumsum()[::-1])
