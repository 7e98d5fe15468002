"""Ground between the cells of a grid: a quadratic fitted around each point.

Theory: addons/terrain/THEORY.md, (T1) to (T3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from netdesign.addons.terrain.grid import Grid
from netdesign.numerics.arrays import Floats, Ints

WINDOWS = (3, 5, 7)  # cells on a side
_AT_ONCE = 8192  # points whose windows are held at once: a quarter of the time of all
_LONGEST_STEP = 2.0  # less than what rows and zones are told apart by [m]
# Median of the misfit of noise alone over its standard deviation, by window.
_MEDIANS = {3: 0.888, 5: 0.982, 7: 0.992}
_RELIEF_SAFETY = 2.0
_ENOUGH = math.radians(0.25)  # standard error of a slope at which a window serves


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground:
    """Ground at some points; NaN where a window leaves the grid or has a hole.

    Attributes
    ----------
    height : ndarray, shape (n,)
        [m].
    gradient : ndarray, shape (n, 2)
        Rise towards east and north [-].
    """

    height: Floats
    gradient: Floats

    @property
    def steepness(self) -> Floats:
        """Slope angle, shape (n,) [rad]."""
        return np.arctan(np.hypot(self.gradient[:, 0], self.gradient[:, 1]))


@dataclass(frozen=True, slots=True)
class Surface:
    """A grid with the window of its fits.

    Attributes
    ----------
    grid : Grid
        Heights.
    window : int
        Cells on a side of the window.
    noise : float
        Standard deviation of a height [m].
    """

    grid: Grid
    window: int
    noise: float

    @property
    def step(self) -> float:
        """Between places at which the ground is looked at, in plan [m]."""
        return min(self.grid.cell, _LONGEST_STEP)

    @property
    def slope_error(self) -> float:
        """Standard error of the slope at one point by the noise, (T3) [rad]."""
        return self.noise * _gain(self.window) / self.grid.cell

    @property
    def relief_share(self) -> float:
        """Error of a slope over its difference from the other window, (T6) [-]."""
        own, other = _spread(self.window), _spread(self.reopen().window)
        return _RELIEF_SAFETY * own / abs(own - other)

    def reopen(self) -> Surface:
        """Surface of the same grid by the other window: the difference shows relief."""
        return replace(self, window=5 if self.window != 5 else 3)

    def at(self, points: Floats) -> Ground:
        """Ground at points, shape (n, 2) [m]."""
        parts = np.array_split(points, 1 + len(points) // _AT_ONCE)
        grounds = [fit(self.grid, part, self.window) for part in parts]
        return Ground(
            height=np.concatenate([ground.height for ground in grounds]),
            gradient=np.concatenate([ground.gradient for ground in grounds]),
        )


def choose_window(grid: Grid, points: Floats) -> Surface:
    """Surface with the least window whose noise tells a slope well enough.

    Parameters
    ----------
    grid : Grid
        Heights.
    points : ndarray, shape (n, 2)
        Where the noise is looked at [m].
    """
    noise = min(_find_noise(grid, points, window) for window in WINDOWS)
    surfaces = [Surface(grid, window, noise) for window in WINDOWS]
    enough = (surface for surface in surfaces if surface.slope_error <= _ENOUGH)
    return next(enough, surfaces[-1])


def _find_noise(grid: Grid, points: Floats, window: int) -> float:
    """Median misfit of a window [m]: that of noise alone grows with none of them."""
    misfits = find_misfits(grid, points, window)
    finite = misfits[np.isfinite(misfits)]
    return float(np.median(finite)) / _MEDIANS[window] if finite.size else 0.0


def fit(grid: Grid, points: Floats, window: int) -> Ground:
    """Quadratic around the cell next to each point, at the point.

    Parameters
    ----------
    grid : Grid
        Heights.
    points : ndarray, shape (n, 2)
        East and north [m].
    window : int
        Cells on a side.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    place, middle, centre, relative = _cut_windows(grid, points, window)
    _, solve = _prepare(window)
    quadratic = relative @ solve.T
    u, v = (place - middle).T
    _, c1, c2, c3, c4, c5 = quadratic.T
    east, north = c1 + 2.0 * c3 * u + c4 * v, c2 + c4 * u + 2.0 * c5 * v
    return Ground(
        height=centre + np.einsum("nk,nk->n", quadratic, _list_terms(u, v)),
        gradient=np.stack((east, north), axis=1) / grid.cell,
    )


def find_misfits(grid: Grid, points: Floats, window: int) -> Floats:
    """Standard deviations of heights from the quadratics at points, shape (n,) [m].

    Parameters are those of `fit`; NaN where a window leaves the grid or has a hole.
    """
    relative = _cut_windows(grid, points, window)[-1]
    terms, solve = _prepare(window)
    off = relative - relative @ solve.T @ terms.T
    free = max(1, window**2 - terms.shape[1])
    return np.asarray(np.sqrt((off**2).sum(axis=1) / free))


def _cut_windows(
    grid: Grid, points: Floats, window: int
) -> tuple[Floats, Ints, Floats, Floats]:
    """Points and their cells [cells], heights there and, above these, of the windows.

    Shapes (n, 2), (n, 2), (n,), (n, window squared) [m]. NaN off the grid.
    """
    half = window // 2
    lines, columns = grid.heights.shape
    place = (points - (grid.west, grid.south)) / grid.cell
    is_known = np.isfinite(place).all(axis=1, keepdims=True)
    middle = np.rint(np.where(is_known, place, -1.0)).astype(np.int64)
    last = np.array((columns, lines)) - half
    is_inside = ((middle >= half) & (middle < last)).all(axis=1)
    steps = np.arange(-half, half + 1)
    around = (columns * steps[:, None] + steps).ravel()
    at = np.where(is_inside, middle @ (1, columns), around[-1])
    heights = grid.heights.ravel()
    centre = np.where(is_inside, heights[at], math.nan)
    return place, middle, centre, heights[at[:, None] + around] - centre[:, None]


@lru_cache(maxsize=len(WINDOWS))
def _prepare(window: int) -> tuple[Floats, Floats]:
    """Terms of a quadratic at the cells of a window, and what solves for them."""
    steps = np.arange(window) - window // 2
    v, u = (
        axis.ravel().astype(np.float64)
        for axis in np.meshgrid(steps, steps, indexing="ij")
    )
    terms = _list_terms(u, v)
    return terms, np.asarray(np.linalg.pinv(terms), dtype=np.float64)


def _list_terms(u: Floats, v: Floats) -> Floats:
    return np.stack((np.ones_like(u), u, v, u * u, u * v, v * v), axis=-1)


def _spread(window: int) -> float:
    """Bias of a slope for each cubic term of the ground, in cells squared [-]."""
    steps = np.arange(window) - window // 2
    return float((steps**4).sum() / (steps**2).sum())


def _gain(window: int) -> float:
    """Standard error of a slope for each of the noise, in cells [-]."""
    steps = np.arange(window) - window // 2
    return 1.0 / math.sqrt(window * float((steps**2).sum()))
