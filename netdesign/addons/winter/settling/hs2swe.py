"""Settling model HS2SWE: heights matched by the rate of settling, then by melt.

Theory: addons/winter/settling/THEORY.md, section 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.addons.winter.settling.pack import (
    DAY,
    DayPack,
    build_first_layer,
    sum_overlying,
)
from netdesign.numerics.arrays import Floats
from netdesign.snowpack.model_code import GRAVITY


@dataclass(frozen=True, slots=True, kw_only=True)
class Hs2swe:
    """HS2SWE with its constants, at a snow temperature of 0 C.

    Attributes
    ----------
    name, source : str
        Of the set of constants.
    new_density, largest_density : float
        rho_new, rho_max [kg/m3].
    viscosity : float
        Visc of snow without density [Pa s].
    destruction : float
        c1 [1/s]; settling of new snow without load.
    destruction_decay : float
        c3 [m3/kg].
    stiffening : float
        c5 [m3/kg].
    tolerance : float
        A rise beyond it is a snowfall [m].
    rate_step : float
        Step in which the rate of settling is changed [-].
    rate_steps : int
        Most steps of it.
    """

    name: str = "hs2swe"
    source: str = "Magnusson et al. (2025)"
    new_density: float = 113.7
    largest_density: float = 571.6
    viscosity: float = 6.051e7
    destruction: float = 2.8e-6
    destruction_decay: float = 0.046
    stiffening: float = 0.018
    tolerance: float = 0.02
    rate_step: float = 0.1
    rate_steps: int = 41  # 5.1: rounding carries the authors' loop beyond 5

    def step(self, before: DayPack, height: float) -> DayPack:
        """Snowpack a day later, at the height observed as far as its rate allows.

        Parameters
        ----------
        before : DayPack
            Of yesterday.
        height : float
            Observed today [m], above 0.
        """
        if not before.heights.size:
            return build_first_layer(height, self.new_density)
        rise = DAY * before.densities * self._find_rates(before)
        settled = self._settle(before, rise)
        gap = height - float(settled.sum())
        if gap > self.tolerance:
            return self._snow(before, settled, gap)
        if gap != 0.0:
            settled = self._match(before, rise, height, slower=gap > 0.0)
        if gap < 0.0 and settled.sum() > height:
            return _melt(before, settled, height)
        return DayPack(heights=settled, masses=before.masses, ages=before.ages + 1)

    def _find_rates(self, pack: DayPack) -> Floats:
        """Rates of settling [1/s], (n_layers,), eq. (D6)."""
        overlying = sum_overlying(pack.masses) - pack.masses
        densities = pack.densities
        pressed = (
            overlying * GRAVITY / (self.viscosity * np.exp(self.stiffening * densities))
        )
        beyond = np.maximum(0.0, densities - self.new_density)
        own = self.destruction * np.exp(-self.destruction_decay * beyond)
        return np.asarray(pressed + own)

    def _settle(self, pack: DayPack, rise: Floats) -> Floats:
        """Heights [m] after a rise of the densities, none beyond the largest."""
        densities = np.minimum(pack.densities + rise, self.largest_density)
        return pack.masses / densities

    def _match(
        self, pack: DayPack, rise: Floats, height: float, *, slower: bool
    ) -> Floats:
        """Heights [m] with the first rate that reaches the height, eq. (D7)."""
        rates = 1.0 + self.rate_step * np.arange(self.rate_steps + 1)[:, None]
        settled = self._settle(pack, rise / rates if slower else rise * rates)
        reached = (settled.sum(axis=1) >= height) == slower
        dense = (pack.masses >= self.largest_density * settled).all(axis=1)
        found = np.flatnonzero(reached | dense)
        return np.asarray(settled[found[0] if found.size else -1])

    def _snow(self, before: DayPack, settled: Floats, top: float) -> DayPack:
        new_mass = self.new_density * top
        return DayPack(
            heights=np.append(settled, top),
            masses=np.append(before.masses, new_mass),
            ages=np.append(before.ages + 1, 0),
            new_mass=new_mass,
        )


def _melt(before: DayPack, settled: Floats, height: float) -> DayPack:
    """Snowpack cut off at a height, eq. (D8)."""
    tops = settled.cumsum()
    kept = int(np.searchsorted(tops, height)) + 1
    heights, masses = settled[:kept].copy(), before.masses[:kept].copy()
    heights[-1] = height - (tops[kept - 2] if kept > 1 else 0.0)
    masses[-1] *= heights[-1] / settled[kept - 1]
    runoff = before.masses[kept:].sum() + before.masses[kept - 1] - masses[-1]
    return DayPack(
        heights=heights,
        masses=masses,
        ages=before.ages[:kept] + 1,
        runoff=float(runoff),
    )


HS2SWE = Hs2swe()
