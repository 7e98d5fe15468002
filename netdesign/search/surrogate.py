"""A model of the responses between the solved cases, with its standard error.

Universal kriging: a quadratic trend plus a residual whose correlation falls with
distance. Each solved case is also predicted from all others. These held-out errors
scale the standard error, more so nearby: a kink in one corner of the ranges raises it
there. Theory: search/THEORY.md, eq. (M1) to (M5a).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats

Point = tuple[float, ...]  # of the unit cube, each coordinate a share of its range

# Lengths as shares of a range. Beyond CORRELATION the residual of the trend is free;
# within REACH a held-out error counts in full, far away by FAR_SHARE.
CORRELATION = 1.0
REACH = 0.35
FAR_SHARE = 0.5
DENSE_DIMENSIONS = 3  # up to so many parameters every score counts far away in full
_ROUGHNESS = 1.5  # by what power of the distance a kink is rougher than the model
# Rounding and mesh noise, as a share of the residual's variance; less where cases
# crowd around a maximum, whose scores it would multiply.
_NUGGET, _SMALL_NUGGET = 1e-6, 1e-9
_AXIS_WEIGHTS = (0.6, 0.3)  # that an axis may have instead of 1
_ENOUGH = 0.1  # of a tolerance: held-out errors below are as good as none


class Prediction(NamedTuple):
    """Prediction of the model at some places."""

    mean: Floats  # shape (n, quantities)
    standard_error: Floats  # shape (n, quantities), never negative
    sway: Floats  # most by which errors of the values move the mean, eq. (M3a)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surrogate:
    """Fitted model of several quantities on the unit cube.

    Attributes
    ----------
    places : ndarray, shape (n, dimension)
        Solved cases, each coordinate a share of its range.
    held_out : ndarray, shape (n, quantities)
        Error of each case predicted from all others, in the quantity's unit.
    scores : ndarray, shape (n, quantities)
        Size of those errors over what the model expected of them.
    spacings : ndarray, shape (n,)
        From each case to its nearest neighbour [-], which its score tells of; endless
        up to three parameters.
    axis_weights : ndarray, shape (dimension,)
        Of the axes in a distance [-].
    doubts : ndarray, shape (n, quantities)
        Errors of the values themselves, in the quantity's unit; mostly 0.
    """

    places: Floats
    held_out: Floats
    scores: Floats
    spacings: Floats
    axis_weights: Floats
    doubts: Floats
    _everywhere: Floats  # score that counts at every place, shape (quantities,)
    _least_near: Floats  # correlation from which on a case's own scores count, (n,)
    _inverse: Floats
    _trend_of_cases: Floats
    _trend_covariance: Floats
    _trend_weights: Floats
    _weights: Floats

    def select(self, quantities: Sequence[int]) -> Surrogate:
        """The model of some quantities, in the order given."""
        chosen = list(quantities)
        scores = self.scores[:, chosen]
        everywhere, least_near = _find_far(scores, self.spacings)
        return replace(
            self,
            held_out=self.held_out[:, chosen],
            scores=scores,
            doubts=self.doubts[:, chosen],
            _everywhere=everywhere,
            _least_near=least_near,
            _trend_weights=self._trend_weights[:, chosen],
            _weights=self._weights[:, chosen],
        )

    def predict(self, at: Floats, near: Floats | None = None) -> Prediction:
        """Mean and standard error at places of shape (n, dimension).

        What `correlate` gives of the places may be given, too.
        """
        near = self.correlate(at) if near is None else near
        trend = _build_trend(at)
        mean = trend @ self._trend_weights + near @ self._weights
        carried = near @ self._inverse
        lack = trend - near @ self._trend_of_cases.T
        in_trend = lack @ self._trend_covariance
        variance = (
            1.0
            - np.einsum("ij,ij->i", carried, near)
            + np.einsum("ij,ij->i", in_trend, lack)
        )
        spread = np.sqrt(np.maximum(variance, 0.0))
        return Prediction(
            mean=mean,
            standard_error=self._fade(at, near) * spread[:, None],
            sway=self._find_sway(carried, in_trend),
        )

    def correlate(self, at: Floats, first: int = 0) -> Floats:
        """Correlation of places with the cases from a first one on [-]."""
        weights = self.axis_weights
        return _correlate(
            measure_distances(at * weights, self.places[first:] * weights)
        )

    def _find_sway(self, carried: Floats, in_trend: Floats) -> Floats:
        """Most by which errors of the values move the mean, eq. (M3a)."""
        rough = np.flatnonzero(self.doubts.any(axis=1))
        shares = carried[:, rough] + in_trend @ self._trend_of_cases[:, rough]
        return np.asarray(np.abs(shares) @ self.doubts[rough])

    def _fade(self, at: Floats, near: Floats) -> Floats:
        """Largest held-out score around each place, eq. (M5)."""
        place, case = np.nonzero(near > self._least_near)
        off = (at[place] - self.places[case]) * self.axis_weights
        apart = np.sqrt(np.einsum("ij,ij->i", off, off))
        with np.errstate(divide="ignore"):
            rough = np.minimum(1.0, self.spacings[case] / apart) ** _ROUGHNESS
        share = rough * np.exp(-((apart / REACH) ** 2))
        scale = np.tile(self._everywhere, (len(at), 1))
        firsts = np.flatnonzero(np.diff(place, prepend=-1))
        if len(firsts):
            largest = np.maximum.reduceat(share[:, None] * self.scores[case], firsts)
            scale[place[firsts]] = np.maximum(scale[place[firsts]], largest)
        return scale

    def evaluate(self, at: Floats, *quantities: int) -> list[Floats]:
        """Mean of some quantities at places of shape (n, dimension), n values each."""
        trend, near = _build_trend(at), self.correlate(at)
        return [
            trend @ self._trend_weights[:, quantity] + near @ self._weights[:, quantity]
            for quantity in quantities
        ]


def fit_surrogate(
    places: Floats,
    values: Floats,
    noise: Floats | float = 0.0,
    doubts: Floats | None = None,
    axis_weights: Floats | None = None,
) -> Surrogate:
    """Model through solved cases; more cases than trend terms are needed.

    Parameters
    ----------
    places : ndarray, shape (n, dimension)
        Distinct points of the unit cube [-].
    values : ndarray, shape (n, quantities)
        Responses there, each in a unit of its own.
    noise : float or ndarray, shape (quantities,)
        Held-out errors up to this size, in the unit of the quantity, are no evidence
        of a feature: meshes change from case to case. Close cases would otherwise
        take that for a steep one.
    doubts : ndarray, shape (n, quantities), optional
        Errors of values that are known roughly only, 0 of the others; none by default.
    axis_weights : ndarray, shape (dimension,), optional
        Of the axes in a distance [-]; 1 by default.

    Returns
    -------
    Surrogate
        It passes through the values up to the noise that is allowed for.

    Verified by
    -----------
    tests/search/test_surrogate.py
    """
    weights = np.ones(places.shape[1]) if axis_weights is None else axis_weights
    distances = measure_distances(places * weights, places * weights)
    is_dense = places.shape[1] <= DENSE_DIMENSIONS
    nugget = _NUGGET if is_dense else _SMALL_NUGGET
    inverse = _invert(_correlate(distances) + nugget * np.eye(len(places)))
    trend = _build_trend(places)
    covariance = _invert(trend.T @ inverse @ trend)
    trend_weights = covariance @ (trend.T @ (inverse @ values))
    case_weights = inverse @ (values - trend @ trend_weights)
    # Leaving case i out changes its prediction by (Q y)_i / Q_ii (Dubrule 1983).
    carried = inverse @ trend
    diagonal = np.diag(inverse - carried @ covariance @ carried.T)
    diagonal = np.maximum(diagonal, 1e-12)[:, None]
    held_out = case_weights / diagonal
    scores = np.maximum(np.abs(held_out) - noise, 0.0) * np.sqrt(diagonal)
    spacings = _find_spacings(distances, is_dense=is_dense)
    everywhere, least_near = _find_far(scores, spacings)
    return Surrogate(
        places=places,
        held_out=held_out,
        scores=scores,
        spacings=spacings,
        axis_weights=weights,
        doubts=np.zeros_like(values) if doubts is None else doubts,
        _everywhere=everywhere,
        _least_near=least_near,
        _inverse=inverse,
        _trend_of_cases=carried.T,
        _trend_covariance=covariance,
        _trend_weights=trend_weights,
        _weights=case_weights,
    )


def _find_spacings(distances: Floats, *, is_dense: bool) -> Floats:
    """Distance from each case to its nearest neighbour; endless of dense cases."""
    if is_dense:
        return np.full(len(distances), np.inf)
    to_others = distances + np.diag(np.full(len(distances), np.inf))
    return np.asarray(to_others.min(axis=1))


def _find_far(scores: Floats, spacings: Floats) -> tuple[Floats, Floats]:
    """Scores that count everywhere; correlation from which on a case's own are more."""
    far = FAR_SHARE * np.minimum(1.0, spacings / REACH) ** _ROUGHNESS
    everywhere = np.max(scores * far[:, None], axis=0)
    over = (scores / np.maximum(everywhere, np.finfo(float).tiny)).max(axis=1)
    furthest = REACH * np.sqrt(np.log(np.maximum(over, 1.0)))
    return everywhere, _correlate(furthest)


def weigh_axes(places: Floats, values: Floats, tolerance: Floats) -> Floats:
    """Weights of the axes that predict held-out cases best, shape (dimension,).

    An axis that hardly matters has a small one: cases apart along it are neighbours.

    Parameters
    ----------
    places, values : ndarray, shape (n, dimension), (n, quantities)
        As in `fit_surrogate`.
    tolerance : ndarray, shape (quantities,)
        Error that does not matter, in the unit of each quantity.
    """

    def judge(weights: Floats) -> float:
        errors = fit_surrogate(places, values, axis_weights=weights).held_out
        size = np.sqrt(np.mean(errors * errors, axis=0)) / tolerance
        return float(np.sum(np.log(size + _ENOUGH)))

    weights = np.ones(places.shape[1])
    least = judge(weights)
    for axis, weight in product(range(len(weights)), _AXIS_WEIGHTS):
        tried = weights.copy()
        tried[axis] = weight
        misfit = judge(tried)
        if misfit < least:
            least, weights = misfit, tried
    return weights


def count_trend_terms(dimension: int) -> int:
    """Terms of the quadratic trend: the fewest cases that a model needs, less one."""
    return (dimension + 1) * (dimension + 2) // 2


def supports_model(places: Floats) -> bool:
    """Sufficiency of cases for a model: of their number, and of where they lie.

    Where cases failed, those left may lie on a face on which the trend is not known.

    Parameters
    ----------
    places : ndarray, shape (n, dimension)
        Of the solved cases, in the unit cube [-].
    """
    terms = count_trend_terms(places.shape[1])
    if len(places) <= terms:
        return False
    return int(np.linalg.matrix_rank(_build_trend(places))) == terms


def _invert(matrix: Floats) -> Floats:
    return np.asarray(np.linalg.inv(matrix), dtype=np.float64)


def _build_trend(at: Floats) -> Floats:
    """Constant, linear and quadratic terms, shape (n, terms)."""
    centred = 2.0 * at - 1.0
    first, second = np.triu_indices(at.shape[1])
    products = centred[:, first] * centred[:, second]
    return np.concatenate([np.ones((len(at), 1)), centred, products], axis=1)


def measure_distances(a: Floats, b: Floats) -> Floats:
    """Distances of places of shape (n, dimension) from others, shape (n, m)."""
    square: Floats = np.sum(a * a, axis=1)[:, None] + np.sum(b * b, axis=1)
    square -= 2.0 * a @ b.T
    np.maximum(square, 0.0, out=square)
    return np.sqrt(square, out=square)


def _correlate(distances: Floats) -> Floats:
    """Matern 5/2: twice differentiable, so that a kink shows as held-out error."""
    scaled = distances * (np.sqrt(5.0) / CORRELATION)
    return np.asarray((1.0 + scaled * (1.0 + scaled / 3.0)) * np.exp(-scaled))
