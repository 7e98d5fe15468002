"""Gap whose snow is pulled by the snow below, which has come off the nets beside it.

Theory: planview/THEORY.md, section 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.special import (
    eval_gegenbauer,
    gamma,
    gammaln,
    psi,
    roots_gegenbauer,
)

from netdesign.addons.evidence.verification.planview.gap import GapFlow
from netdesign.addons.evidence.verification.planview.waves import (
    FEWER,
    FUNCTIONS,
    integrate_root,
    load_bessel,
    load_waves,
    require_opening,
)
from netdesign.numerics.arrays import Floats

# Powers of the distance to a gap's end: v goes as r^(1/4), the pull as r^(-3/4).
_VELOCITY, _PULL = 0.75, -0.25
_VELOCITY_MEAN = 1.0 / (2.0**_VELOCITY * float(gamma(1.0 + _VELOCITY)))
_PULL_MEAN = 1.0 / (2.0**_PULL * float(gamma(1.0 + _PULL)))
_PLACES = 400  # in the gap


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
    excess = _find_excess(half, velocity, pull)
    coarse = _find_excess(half, *_solve(half, functions - FEWER))
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
    places, weights = roots_gegenbauer(_PLACES, _VELOCITY)
    return places, weights


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Narrow:
    """Parts of (W16) for n functions that no width of the gap changes.

    Attributes
    ----------
    velocity, pull, coupling : ndarray, shape (n, n)
        What a gap of no width has [-].
    polynomials : ndarray, shape (_PLACES, n)
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


def _find_excess(half: float, velocity: Floats, pull: Floats) -> float:
    """Half the gap, less half of what slips through, and half of the pull, (W7)."""
    slipped = half * _VELOCITY_MEAN * float(velocity[0])
    pulled = half * _PULL_MEAN * float(pull[0])
    return float(half - slipped / 2.0 + pulled / 2.0)
