"""Settling models delta-snow and HS2SWE: a snowpack from its daily heights.

Theory: addons/winter/THEORY.md. Constants of published fits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.snow.snowpack import GRAVITY

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


def _add_layer(
    before: DayPack, settled: Floats, height: float, density: float
) -> DayPack:
    """Snowpack a day later with a layer of new snow on what has settled."""
    new_mass = density * height
    return DayPack(
        heights=np.append(settled, height),
        masses=np.append(before.masses, new_mass),
        ages=np.append(before.ages + 1, 0),
        new_mass=new_mass,
    )


def sum_overlying(masses: Floats) -> Floats:
    """Mass of each layer and of all above it [kg/m2], (n_layers,).

    Parameters
    ----------
    masses : ndarray, shape (n_layers,)
        From the ground up [kg/m2].
    """
    return np.asarray(masses[::-1].cumsum()[::-1])


# A layer this close to its largest density is no longer pressed by new snow, and one
# this far beyond it hands mass on [kg/m3].
_AT_LIMIT = 1e-10


@dataclass(frozen=True, slots=True, kw_only=True)
class Ageing:
    """Largest density that grows with the age of a layer, eq. (D5).

    Attributes
    ----------
    low, high : float
        Bounds of the density [kg/m3].
    slope : float
        Steepness at the middle [1/d].
    middle : float
        Age there [d].
    """

    low: float
    high: float
    slope: float = 0.0
    middle: float = 0.0

    def find_largest(self, ages: Ints) -> Floats:
        """Largest density of each layer [kg/m3], (n_layers,).

        Parameters
        ----------
        ages : ndarray of int, shape (n_layers,)
            [d].
        """
        turn = np.arctan(self.slope * (ages - self.middle)) / math.pi
        return np.asarray((self.low + self.high) / 2 + (self.high - self.low) * turn)


@dataclass(frozen=True, slots=True, kw_only=True)
class DeltaSnow:
    """Delta-snow with its constants.

    Attributes
    ----------
    name, source : str
        Of the set of constants.
    new_density : float
        rho_0 of new snow [kg/m3].
    largest_density : Ageing
        rho_max; of one value where its bounds are equal.
    viscosity : float
        eta_0 of snow without density [Pa s].
    stiffening : float
        k [m3/kg]; viscosity grows with exp(k rho).
    tolerance : float
        tau [m]; a difference of heights within it is no event.
    overburden : float
        c_ov [1/Pa]; what new snow presses at once.
    overburden_decay : float
        k_ov [-].
    """

    name: str
    source: str
    new_density: float
    largest_density: Ageing
    viscosity: float
    stiffening: float
    tolerance: float
    overburden: float
    overburden_decay: float

    def step(self, before: DayPack, height: float) -> DayPack:
        """Snowpack a day later, whose layers add up to the height observed.

        Parameters
        ----------
        before : DayPack
            Of yesterday, not bare.
        height : float
            Observed today [m], above 0.
        """
        ages = before.ages + 1
        limits = self.largest_density.find_largest(ages)
        settled = self._settle(before, limits)
        gap = height - float(settled.sum())
        if gap > self.tolerance:
            return self._snow(before, settled, limits, height)
        if gap < -self.tolerance:
            return _drench(before, settled, limits, height)
        return _scale(before, limits, height)

    def _settle(self, pack: DayPack, limits: Floats) -> Floats:
        """Heights [m] after a day of dry settling, eq. (D1)."""
        stress = GRAVITY * sum_overlying(pack.masses)
        viscosity = self.viscosity * np.exp(self.stiffening * pack.densities)
        settled = pack.heights / (1.0 + DAY * stress / viscosity)
        return np.asarray(np.maximum(settled, pack.masses / limits))

    def _snow(
        self, before: DayPack, settled: Floats, limits: Floats, height: float
    ) -> DayPack:
        """Snowfall that presses what lies below it, eq. (D2)."""
        densities = before.masses / settled
        room = limits - densities
        soft = room > _AT_LIMIT
        decay = np.full(room.size, np.inf)
        decay[soft] = self.overburden_decay * densities[soft] / room[soft]
        load = self.new_density * GRAVITY * (height - float(settled.sum()))
        pressed = settled * (1.0 - self.overburden * load * np.exp(-decay))
        heights = np.maximum(pressed, before.masses / limits)
        top = height - float(heights.sum())
        return _add_layer(before, heights, top, self.new_density)


def _scale(before: DayPack, limits: Floats, height: float) -> DayPack:
    """Yesterday's layers in proportion to the height, eq. (D3).

    Mass beyond the largest density goes to layers with room, from the top down.
    """
    heights = before.heights * (height / before.height)
    room = heights * limits - before.masses
    excess = np.where(room < -_AT_LIMIT * heights, -room, 0.0)
    left = float(excess.sum())
    masses = before.masses - excess
    if left > 0.0:
        for layer in range(masses.size - 1, -1, -1):
            if excess[layer] == 0.0:
                taken = min(max(float(room[layer]), 0.0), left)
                masses[layer] += taken
                left -= taken
    return DayPack(heights=heights, masses=masses, ages=before.ages + 1, runoff=left)


def _drench(before: DayPack, settled: Floats, limits: Floats, height: float) -> DayPack:
    """Wet snow at its largest density, from the top down, eq. (D4)."""
    heights, dense = settled.copy(), before.masses / limits
    surplus = float(settled.sum()) - height
    for layer in range(heights.size - 1, -1, -1):
        lowered = min(float(settled[layer] - dense[layer]), surplus)
        heights[layer] -= lowered
        surplus -= lowered
        if surplus <= 0.0:
            return DayPack(heights=heights, masses=before.masses, ages=before.ages + 1)
    share = height / float(dense.sum())
    return DayPack(
        heights=dense * share,
        masses=before.masses * share,
        ages=before.ages + 1,
        runoff=float(before.masses.sum()) * (1.0 - share),
    )


DELTA_SNOW = DeltaSnow(
    name="delta-snow",
    source="Winkler et al. (2021)",
    new_density=81.19417,
    largest_density=Ageing(low=401.2588, high=401.2588),
    viscosity=8523356.0,
    stiffening=0.02993175,
    tolerance=0.02362476,
    overburden=5.104722e-4,
    overburden_decay=0.37856737,
)
DELTA_SNOW_AGEING = DeltaSnow(
    name="delta-snow-ageing",
    source="Schroeder et al. (2024); constants as in nixmass 1.3.1",
    new_density=80.73706,
    largest_density=Ageing(low=380.0, high=600.0, slope=0.03, middle=80.0),
    viscosity=8543502.0,
    stiffening=0.029297,
    tolerance=0.02356521,
    overburden=5.170964e-4,
    overburden_decay=0.3782312,
)


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
            Of yesterday, not bare.
        height : float
            Observed today [m], above 0.
        """
        rise = DAY * before.densities * self._find_rates(before)
        settled = self._settle(before, rise)
        gap = height - float(settled.sum())
        if gap > self.tolerance:
            return _add_layer(before, settled, gap, self.new_density)
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
        reached_at = np.flatnonzero(reached | dense)
        return np.asarray(settled[reached_at[0] if reached_at.size else -1])


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


SettlingModel = DeltaSnow | Hs2swe
# The first is the default: addons/winter/THEORY.md, section 15.
MODELS: dict[str, SettlingModel] = {
    model.name: model for model in (DELTA_SNOW_AGEING, HS2SWE, DELTA_SNOW)
}


def follow_heights(
    heights: Sequence[float],
    model: SettlingModel = DELTA_SNOW_AGEING,
    first_density: float | None = None,
) -> tuple[DayPack, ...]:
    """Snowpack of each day of a series.

    Parameters
    ----------
    heights : sequence of float
        Observed snow height of each day [m], no gap, none below 0.
    model : SettlingModel, optional
        Settling model with its constants; by default the first of ``MODELS``.
    first_density : float, optional
        Density of the snow that lies on the first day [kg/m3]; by default new snow.
    """
    first = model.new_density if first_density is None else first_density
    packs: list[DayPack] = []
    before = BARE
    for height in heights:
        if height <= 0.0:
            before = replace(BARE, runoff=before.mass)
        elif not before.heights.size:
            density = model.new_density if packs else first
            before = _add_layer(BARE, BARE.heights, height, density)
        else:
            before = model.step(before, height)
        packs.append(before)
    return tuple(packs)
