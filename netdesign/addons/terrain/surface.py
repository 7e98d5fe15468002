"""Ground between the cells of a grid, and the lines of fall on it, up or down.

Theory: addons/terrain/THEORY.md, (T1) to (T4).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import shapely

from netdesign.addons.terrain.grid import Grid
from netdesign.numerics.arrays import Floats, Ints, Mask

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


LONGEST_BENCH = 6.0  # of level or opposite ground, across which a line goes on [m]
_LEAST_RISE = (
    0.2  # of a step that leads farther; steps to and fro over a top do not [-]
)
_FLAT = 1e-9  # a gradient below it has no direction [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FallLines:
    """Lines of fall from n points, K steps each; NaN beyond their ends.

    Attributes
    ----------
    points : ndarray, shape (K + 1, n, 2)
        East and north [m].
    heights, steepness, lengths : ndarray, shape (K + 1, n)
        Of the ground [m]; its angle, negative against the line [rad]; length along the
        ground from the start [m].
    is_lost : ndarray of bool, shape (n,)
        Lines that leave the grid or meet a hole before their end.
    """

    points: Floats
    heights: Floats
    steepness: Floats
    lengths: Floats
    is_lost: Mask

    def take(self, lines: slice) -> FallLines:
        """Some of them."""
        return FallLines(
            points=self.points[:, lines],
            heights=self.heights[:, lines],
            steepness=self.steepness[:, lines],
            lengths=self.lengths[:, lines],
            is_lost=self.is_lost[lines],
        )

    def find_length(self, line: int) -> float:
        """Length of a line up to where it ends on the grid [m]."""
        return float(np.nanmax(self.lengths[:, line], initial=0.0))


def follow_fall(
    surface: Surface, starts: Floats, *, most: float, is_up: bool
) -> FallLines:
    """Follow the line of fall from points, by the midpoint rule.

    Each ends with the first step that reaches its length, or at a top or a bottom.
    Over a boulder or a bench it follows the fall of the ground around.

    Parameters
    ----------
    surface : Surface
        Ground.
    starts : ndarray, shape (n, 2)
        [m].
    most : float
        Length along the ground [m].
    is_up : bool
        Upwards, else downwards.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    step, sign = surface.step, 1.0 if is_up else -1.0
    ground = surface.at(starts)
    points, heights, angles = [starts], [ground.height], [ground.steepness]
    lengths, rises = [0.0 * ground.height], [np.isfinite(ground.height)]
    farthest, stalled = sign * ground.height, np.zeros(len(starts))
    least, is_lost = _LEAST_RISE * step, np.zeros(len(starts), dtype=bool)
    for _ in range(math.ceil(most / step) + 1):
        goes_on = (lengths[-1] < most) & (stalled <= LONGEST_BENCH)
        if not goes_on.any():
            break
        start = ground
        half = surface.at(points[-1] + 0.5 * step * sign * _direct(ground.gradient))
        there = points[-1] + step * sign * _direct(half.gradient)
        ground = surface.at(there)
        is_farther = sign * ground.height > farthest + least
        if (goes_on & ~is_farther).any():  # over a boulder or a bench
            around = step * sign * _direct(_find_fall_around(surface, points[-1]))
            there = np.where(is_farther[:, None], there, points[-1] + around)
            ground = surface.at(there)
            is_farther = sign * ground.height > farthest + least
        is_level = _is_level(start.gradient) | _is_level(half.gradient)
        is_lost |= goes_on & ~np.isfinite(ground.height) & ~is_level
        farthest = np.where(is_farther, sign * ground.height, farthest)
        stalled = np.where(is_farther, 0.0, stalled + step * goes_on)
        nothing = np.where(goes_on, 0.0, math.nan)
        rise = ground.height - heights[-1]
        angle = np.where(sign * rise > 0.0, ground.steepness, -ground.steepness)
        points.append(there + nothing[:, None])
        heights.append(ground.height + nothing)
        angles.append(angle + nothing)
        lengths.append(lengths[-1] + np.hypot(step, rise) + nothing)
        rises.append(is_farther)
    # a line that nothing leads farther ended at its last top or bottom
    goes_farther = np.logical_or.accumulate(rises[::-1])[::-1]
    ended = np.where(goes_farther | (stalled <= LONGEST_BENCH), 0.0, math.nan)
    return FallLines(
        points=np.stack(points) + ended[..., None],
        heights=np.stack(heights) + ended,
        steepness=np.stack(angles) + ended,
        lengths=np.stack(lengths) + ended,
        is_lost=is_lost,
    )


def _find_fall_around(surface: Surface, places: Floats) -> Floats:
    """Gradient of the ground over the width of two benches, shape (n, 2) [-]."""
    turns = np.arange(8) * (math.pi / 4.0)
    ring = np.column_stack((np.cos(turns), np.sin(turns)))
    there = places[:, None] + LONGEST_BENCH * ring
    heights = surface.at(there.reshape(-1, 2)).height.reshape(len(places), len(ring))
    return np.asarray(heights @ ring / (0.5 * len(ring) * LONGEST_BENCH))


def _is_level(gradient: Floats) -> Mask:
    """Ground without a direction; False where there is none."""
    return np.asarray(np.hypot(gradient[:, 0], gradient[:, 1]) <= _FLAT)


def _direct(gradient: Floats) -> Floats:
    size = np.hypot(gradient[:, 0], gradient[:, 1])[:, None]
    return np.where(size > _FLAT, gradient / np.maximum(size, _FLAT), math.nan)


def find_relief(surface: Surface, lines: FallLines) -> FallLines:
    """Lines with the error of the slope by relief in the place of the slope, (T6).

    Where the other window meets a hole, the error is that of the rest of the line.

    Parameters
    ----------
    surface : Surface
        Ground, by the window that serves.
    lines : FallLines
        On it.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    other = surface.reopen()
    points = lines.points.reshape(-1, 2)
    angles = other.at(points).steepness.reshape(lines.steepness.shape)
    off = surface.relief_share * np.abs(angles - np.abs(lines.steepness))
    return replace(lines, steepness=off)


def find_mean(
    above: FallLines, below: FallLines, post: int, up: float, down: float
) -> float:
    """Mean slope angle on a line of fall, from ``down`` below to ``up`` above [rad].

    Parameters
    ----------
    above, below : FallLines
        From the same points up and down.
    post : int
        Which of them.
    up, down : float
        Along the ground [m].

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    sums = [
        _integrate(part.lengths[:, post], part.steepness[:, post], most)
        for part, most in ((above, up), (below, down))
    ]
    length, turned = (sum(parts) for parts in zip(*sums, strict=True))
    return turned / length if length > 0.0 else float(above.steepness[0, post])


def _integrate(lengths: Floats, angles: Floats, most: float) -> tuple[float, float]:
    """Length up to ``most`` and the integral of the angle over it [m, rad m]."""
    is_known = np.isfinite(lengths) & np.isfinite(angles)
    lengths, angles = lengths[is_known], angles[is_known]
    if lengths.size < 2:
        return 0.0, 0.0
    end = min(most, float(lengths[-1]))
    inside = lengths < end
    places = np.append(lengths[inside], end)
    values = np.append(angles[inside], np.interp(end, lengths, angles))
    return end, float(0.5 * ((values[1:] + values[:-1]) * np.diff(places)).sum())


Rows = tuple[Sequence[str], Sequence[shapely.LineString]]


def find_first_crossings(
    lines: FallLines, line: int, rows: Rows, *, least: float
) -> dict[str, float]:
    """Lengths at which a line of fall first crosses rows, by their names [m].

    Crossings nearer to the start than ``least`` [m] do not count. Lines of one name are
    one.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    names, shapes = rows
    path, lengths = _trace(lines, line)
    if path is None or not names:
        return {}
    meets = shapely.intersection(path, list(shapes))
    places, which = shapely.get_coordinates(meets, return_index=True)
    at = _measure(path, lengths, places)
    crossings: dict[str, float] = {}
    for length, row in sorted(zip(at.tolist(), which.tolist(), strict=True)):
        if length > least:
            crossings.setdefault(names[row], length)
    return crossings


def find_exit(lines: FallLines, line: int, zones: shapely.Geometry) -> float | None:
    """Length at which a line of fall leaves the first zone that it meets [m].

    Infinite where it does not leave it, None where it meets none.

    Verified by
    -----------
    tests/addons/terrain/test_measure.py
    """
    path, lengths = _trace(lines, line)
    if path is None:
        return None
    inside = shapely.get_parts(shapely.line_merge(path.intersection(zones)))
    ends = [_measure(path, lengths, shapely.get_coordinates(part)) for part in inside]
    if not ends:
        return None
    first = min(ends, key=lambda places: float(places.min()))
    end = float(first.max())
    return end if end < (1.0 - 1e-9) * float(lengths[-1]) else math.inf


def _trace(lines: FallLines, line: int) -> tuple[shapely.LineString | None, Floats]:
    """Line of fall in plan, and the lengths along the ground of its points [m]."""
    points, lengths = lines.points[:, line], lines.lengths[:, line]
    is_known = np.isfinite(points).all(axis=1) & np.isfinite(lengths)
    path = shapely.LineString(points[is_known]) if is_known.sum() > 1 else None
    return path, lengths[is_known]


def _measure(path: shapely.LineString, lengths: Floats, places: Floats) -> Floats:
    """Lengths along the ground of places on a line of fall, shape (n, 2) [m]."""
    if not len(places):
        return np.empty(0)
    at = shapely.line_locate_point(path, shapely.points(places))
    own = measure_along(shapely.get_coordinates(path))
    return np.asarray(np.interp(at, own, lengths))


def measure_along(points: Floats) -> Floats:
    """Lengths from the first of some points to each, along their line [m]."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(steps)))
