"""Made-up responses over the unit cube, and a search driven by them."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

from netdesign.search.maxima import Maxima, MaximaSearch, SearchSettings

Response = Callable[[np.ndarray], np.ndarray]  # of one place (d,) or of many (d, n)


def drive(response: Response, dimension: int, **settings: float) -> Maxima:
    """End of a search whose questions the response answers; NaN is a failed case."""
    search = MaximaSearch(dimension, SearchSettings(**settings))
    while points := search.ask():
        search.tell(np.array([response(np.array(point)) for point in points]))
    return search.result


def drive_roughly(
    response: Response, dimension: int, share: float, seed: int
) -> Maxima:
    """The same, but values of the first design below 0.9 of the largest are rough.

    They are wrong by up to that share, which is told.
    """
    rng, search = np.random.default_rng(seed), MaximaSearch(dimension, SearchSettings())
    while points := search.ask():
        values = np.array([response(np.array(point)) for point in points])
        doubts = np.zeros_like(values)
        if not search.points:
            far = (values < 0.9 * values.max(axis=0)).all(axis=1)
            doubts[far] = share * np.abs(values[far])
        values += rng.uniform(-1.0, 1.0, values.shape) * doubts
        search.tell(values, doubts=doubts)
    return search.result


def true_maxima(response: Response, dimension: int, samples: int = 21) -> np.ndarray:
    """Largest values on a dense grid, all of it asked at once."""
    axis = np.linspace(0.0, 1.0, samples)
    grid = np.array(list(itertools.product(axis, repeat=dimension)))
    return response(grid.T).max(axis=1)


def add(numbers: np.ndarray, values: np.ndarray) -> np.ndarray:
    """A number added to each quantity, at one place or at many: (q,) or (q, n)."""
    return (numbers + values.T).T


def smooth(seed: int) -> Response:
    """Three quantities: a random quadratic and a sine wave, about half as large."""
    rng = np.random.default_rng(seed)
    slope, bend = rng.normal(size=(3, 3)), rng.normal(size=(3, 3, 3))
    wave, phase = rng.uniform(0.5, 3.0, (3, 3)), rng.uniform(0.0, 6.0, 3)
    return lambda u: (
        10.0
        + 2.5 * slope @ u
        + 1.2 * np.einsum("ijk,k...,j...->i...", bend, u, u)
        + 1.5 * np.sin(add(phase, wave @ u))
    )


def valley(seed: int) -> Response:
    """The larger of two planes: a kink that the maximum does not lie on."""
    rng = np.random.default_rng(seed)
    slopes, base = rng.normal(size=(2, 3, 3)), 0.3 * rng.normal(size=(2, 3))
    return lambda u: 10.0 + 3.0 * np.maximum(add(base[0], slopes[0] @ u), slopes[1] @ u)


def ridge(seed: int) -> Response:
    """The smaller of two planes: the maximum may lie on the kink, inside the box.

    As steep as a stick/slip switch makes a guy's force, and twice that.
    """
    rng = np.random.default_rng(seed)
    slopes, base = rng.normal(size=(2, 2, 3)), 0.3 * rng.normal(size=(2, 2))
    return lambda u: 10.0 + np.minimum(add(base[0], slopes[0] @ u), slopes[1] @ u)


def peak(seed: int, width: float) -> Response:
    """A tilted plane and an interior peak, ``width`` wide at half its height."""
    rng = np.random.default_rng(seed)
    top, height = rng.uniform(0.0, 1.0, (3, 3)), rng.uniform(1.0, 10.0, 3)
    slope, sigma = 1.5 * rng.normal(size=(3, 3)), width / 2.3548
    return lambda u: (
        10.0
        + slope @ u
        + (height * np.exp(-measure_apart(u, top) / (2.0 * sigma**2))).T
    )


def measure_apart(u: np.ndarray, tops: np.ndarray) -> np.ndarray:
    """Squares of the distances of one place, or of many, from some tops."""
    return np.sum((u.T[..., None, :] - tops) ** 2, axis=-1)
