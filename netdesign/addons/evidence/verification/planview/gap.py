"""Load on the ends of two long rows beside a gap, from what slips through it.

A gap is free, or its snow is pulled. Theory: planview/THEORY.md, sections 2 to 4.
Lengths along the row are in l_z, loads in that of an endless wall, velocities in that
far from any wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import (
    erf,
    erfc,
    eval_gegenbauer,
    gamma,
    gammaln,
    iti0k0,
    k1,
    psi,
    roots_gegenbauer,
)

from netdesign.addons.evidence.verification.planview.waves import (
    FEWER,
    FUNCTIONS,
    integrate_root,
    load_bessel,
    load_waves,
    require_opening,
    solve_expansion,
)
from netdesign.numerics.arrays import Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GapFlow:
    """Flow through a gap.

    Attributes
    ----------
    half : float
        h, half the gap [-].
    places : ndarray, shape (m,)
        Points in the gap over h, from -1 to 1 [-].
    velocities, weights : ndarray, shape (m,)
        Velocity v there, and the weights of an integral over the gap [-].
    excess : float
        What one end takes beyond as much of an endless wall [-].
    error : float
        Of ``excess``: its change with fewer functions [-].
    """

    half: float
    places: Floats
    velocities: Floats
    weights: Floats
    excess: float
    error: float


def find_load(gap: GapFlow, distances: Floats) -> Floats:
    """Load on the wall beside the gap, (W8).

    Parameters
    ----------
    gap : GapFlow
        Solved gap.
    distances : ndarray
        From the gap [-]; at 0 the load is infinite.
    """
    reach = distances[..., None] + gap.half * (1.0 - gap.places)
    slipped = gap.weights * gap.velocities
    return np.asarray(1.0 + (k1(reach) / reach) @ slipped / math.pi)


def find_excess_within(gap: GapFlow, distance: float) -> float:
    """Excess on the wall from the gap to a distance, (W9).

    Parameters
    ----------
    gap : GapFlow
        Solved gap.
    distance : float
        From the gap [-].
    """
    reach = distance + gap.half * (1.0 - gap.places)
    beyond = k1(reach) - (0.5 * math.pi - iti0k0(reach)[1])
    return gap.excess - float(beyond @ (gap.weights * gap.velocities)) / math.pi


_FREE_PLACES = 400  # in the gap


def solve_free_gap(half: float, *, functions: int = FUNCTIONS) -> GapFlow:
    """Velocity in the gap and the excess load beside it; (W10) and (W11).

    Parameters
    ----------
    half : float
        h, half the gap over l_z, above 0 and at most ``WIDEST_HALF`` [-].
    functions : int
        Of the expansion, 5 to ``MOST_FUNCTIONS``.

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    require_opening(half, functions)
    coefficients, error = solve_expansion(_build_matrix(half, functions), half / 2.0)
    angles = math.pi * np.arange(1, _FREE_PLACES + 1) / (_FREE_PLACES + 1)
    return GapFlow(
        half=half,
        places=np.cos(angles),
        velocities=_find_velocities(coefficients, angles),
        weights=half * math.pi / (_FREE_PLACES + 1) * np.sin(angles),
        excess=_find_free_excess(half, coefficients),
        error=half * math.pi / 4.0 * error,
    )


def _build_matrix(half: float, functions: int) -> Floats:
    """Power of each pair of functions, (W11); that of h = 0 is a diagonal."""
    waves, each = load_waves(), load_bessel(1.0, functions)
    rest = np.hypot(waves.numbers, half) - waves.numbers
    smooth = (each * (waves.weights * rest / waves.numbers**2)) @ each.T
    return smooth + np.diag(0.5 / (2.0 * np.arange(functions) + 1.0))


def _find_velocities(coefficients: Floats, angles: Floats) -> Floats:
    number = np.arange(coefficients.size)
    order = 2.0 * number + 1.0
    return np.asarray(
        np.sin(np.outer(angles, order)) @ ((-1.0) ** number * coefficients / order)
    )


def _find_free_excess(half: float, coefficients: Floats) -> float:
    """Half of the gap, less half of what slips through it, (W7)."""
    return half - half * math.pi / 4.0 * float(coefficients[0])


def find_isolated_load(distances: Floats) -> Floats:
    """Load beside the end of a long row that stands alone, (W12).

    Parameters
    ----------
    distances : ndarray
        From the end, above 0, over l_z [-].
    """
    return np.asarray(
        np.exp(-distances) / np.sqrt(math.pi * distances) + erf(np.sqrt(distances))
    )


def find_isolated_excess(distance: float) -> float:
    """Excess from the end of a long row that stands alone to a distance, (W12).

    Parameters
    ----------
    distance : float
        Over l_z; infinite for the whole excess [-].
    """
    if math.isinf(distance):
        return 0.5
    root = math.sqrt(distance)
    fading = root * math.exp(-distance) / math.sqrt(math.pi)
    return float(0.5 * erf(root) - distance * erfc(root) + fading)


# Powers of the distance to a gap's end: v goes as r^(1/4), the pull as r^(-3/4).
_VELOCITY, _PULL = 0.75, -0.25
_VELOCITY_MEAN = 1.0 / (2.0**_VELOCITY * float(gamma(1.0 + _VELOCITY)))
_PULL_MEAN = 1.0 / (2.0**_PULL * float(gamma(1.0 + _PULL)))
_PULLED_PLACES = 400  # in the gap


def solve_pulled_gap(half: float, *, functions: int = FUNCTIONS) -> GapFlow:
    """Velocity in the gap and the excess load beside it; (W15) and (W16).

    Parameters
    ----------
    half : float
        h, half the gap over l_z, above 0 and at most ``WIDEST_HALF`` [-].
    functions : int
        Of the expansion, 5 to ``MOST_FUNCTIONS``.

    Raises
    ------
    ModelError
        If a number is out of its range.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    require_opening(half, functions)
    velocity, pull = _solve(half, functions)
    excess = _find_pulled_excess(half, velocity, pull)
    coarse = _find_pulled_excess(half, *_solve(half, functions - FEWER))
    places, weights = _list_places()
    shape = (1.0 - places**2) ** (_VELOCITY - 0.5)
    return GapFlow(
        half=half,
        places=places,
        velocities=shape * _expand(velocity),
        weights=half * weights / shape,
        excess=excess,
        error=abs(excess - coarse),
    )


@lru_cache(maxsize=1)
def _list_places() -> tuple[Floats, Floats]:
    """Points in the gap and weights of Gegenbauer, made once."""
    places, weights = roots_gegenbauer(_PULLED_PLACES, _VELOCITY)
    return places, weights


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Narrow:
    """Parts of (W16) for n functions that no width of the gap changes.

    Attributes
    ----------
    velocity, pull, coupling : ndarray, shape (n, n)
        What a gap of no width has [-].
    polynomials : ndarray, shape (_PULLED_PLACES, n)
        Those whose transforms are Bessel functions, at the points in the gap [-].
    scales : ndarray, shape (n,)
        By which they are added [-].
    """

    velocity: Floats
    pull: Floats
    coupling: Floats
    polynomials: Floats
    scales: Floats


@lru_cache(maxsize=4)
def _load_narrow(functions: int) -> _Narrow:
    """Those parts, made once for each count of functions."""
    number = np.arange(functions)
    order = 2.0 * np.arange(functions, dtype=np.float64)
    scale = gammaln(2.0 * number + 1.0) - gammaln(2.0 * number + 2.0 * _VELOCITY)
    scale = np.exp(scale) * gamma(_VELOCITY) / (math.pi * 2.0 ** (1.0 - _VELOCITY))
    places, _ = _list_places()
    velocity, pull = order + _VELOCITY, order + _PULL
    of_pull = np.empty((functions, functions))
    of_pull[1:] = integrate_root(pull[1:, None], pull)
    of_pull[0, 1:] = integrate_root(pull[0], pull[1:])
    of_pull[0, 0] = _integrate_first()
    return _Narrow(
        velocity=integrate_root(velocity[:, None], velocity),
        pull=of_pull,
        coupling=integrate_root(velocity[:, None], pull),
        polynomials=np.asarray(eval_gegenbauer(2 * number, _VELOCITY, places[:, None])),
        scales=(-1.0) ** number * scale,
    )


def _solve(half: float, functions: int) -> tuple[Floats, Floats]:
    """Coefficients of the velocity and of the pull, (W16)."""
    coupling = half * _load_narrow(functions).coupling
    matrix = np.empty((2 * functions, 2 * functions))
    matrix[:functions, :functions] = _build_velocity_part(half, functions)
    matrix[:functions, functions:] = -coupling
    matrix[functions:, :functions] = coupling.T
    matrix[functions:, functions:] = half**2 * _build_pull_part(half, functions)
    drive = np.zeros(2 * functions)
    drive[0] = math.pi * half * _VELOCITY_MEAN
    drive[functions] = math.pi * half * _PULL_MEAN
    solved = np.asarray(np.linalg.solve(matrix, drive))
    return solved[:functions], solved[functions:]


def _build_velocity_part(half: float, functions: int) -> Floats:
    waves = load_waves()
    each = load_bessel(_VELOCITY, functions)
    rest = (np.hypot(waves.numbers, half) - waves.numbers) / waves.numbers**1.5
    smooth = np.asarray((each * (waves.weights * rest)) @ each.T)
    return smooth + _load_narrow(functions).velocity


def _build_pull_part(half: float, functions: int) -> Floats:
    waves = load_waves()
    each, root = load_bessel(_PULL, functions), np.sqrt(waves.numbers)
    rest = root / np.hypot(waves.numbers, half) - 1.0 / root
    smooth = np.asarray((each * (waves.weights * rest)) @ each.T)
    return smooth + _load_narrow(functions).pull


def _integrate_first() -> float:
    """Integral of J^2 / sqrt(k) whose logarithm at 0 has been taken out, (W17)."""
    waves = load_waves()
    is_long = waves.numbers < 1.0
    numbers, weights = waves.numbers[is_long], waves.weights[is_long]
    start = _PULL_MEAN**2
    finite = math.log(2.0) + float(psi(0.75))
    finite -= (np.euler_gamma + float(psi(0.5))) / 2.0
    return float(start * finite + weights @ (start / numbers))


def _expand(coefficients: Floats) -> Floats:
    """Sum of the polynomials, at the points in the gap."""
    narrow = _load_narrow(coefficients.size)
    return np.asarray(narrow.polynomials @ (narrow.scales * coefficients))


def _find_pulled_excess(half: float, velocity: Floats, pull: Floats) -> float:
    """Half the gap, less half of what slips through, and half of the pull, (W7)."""
    slipped = half * _VELOCITY_MEAN * float(velocity[0])
    pulled = half * _PULL_MEAN * float(pull[0])
    return float(half - slipped / 2.0 + pulled / 2.0)
