"""A model of the responses between the solved cases, and how far to trust it.

Universal kriging: a quadratic trend plus a residual whose correlation falls with
distance. Every solved case is also predicted from all the others; these held-out
errors set the scale of the standard error, more so nearby, so that a kink in one
corner of the ranges raises it there. Theory: search/THEORY.md, eq. (M1) to (M5a).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats

Point = tuple[float, ...]  # of the unit cube, each coordinate a share of its range

# Lengths as shares of a range. Beyond CORRELATION the residual of the trend is free;
# within REACH a held-out error counts in full, far away by FAR_SHARE.
CORRELATION = 1.0
REACH = 0.35
FAR_SHARE = 0.5
_DENSE_DIMENSIONS = 3  # up to so many parameters every score counts far away in full
_ROUGHNESS = 1.5  # by what power of the distance a kink is rougher than the model
_NUGGET = 1e-6  # rounding and mesh noise, as a share of the residual's variance


class Prediction(NamedTuple):
    """Prediction of the model at some places."""

    mean: Floats  # shape (n, quantities)
    standard_error: Floats  # shape (n, quantities), never negative


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
    far_shares : ndarray, shape (n,)
        Share of each score that counts far away.
    doubts : ndarray, shape (n, quantities)
        Errors of the values themselves, in the quantity's unit; mostly 0.
    """

    places: Floats
    held_out: Floats
    scores: Floats
    far_shares: Floats
    doubts: Floats
    _inverse: Floats
    _trend: Floats
    _trend_covariance: Floats
    _trend_weights: Floats
    _weights: Floats

    def predict(
        self, at: Floats, quantities: Sequence[int] | None = None
    ) -> Prediction:
        """Mean and standard error at places of shape (n, dimension).

        They are those of some quantities, in the order given, or of all.
        """
        chosen = slice(None) if quantities is None else list(quantities)
        distances = _measure_distances(at, self.places)
        near = _correlate(distances)
        trend = _build_trend(at)
        mean = trend @ self._trend_weights[:, chosen] + near @ self._weights[:, chosen]
        carried = near @ self._inverse
        lack = trend - carried @ self._trend
        variance = (
            1.0
            - np.sum(carried * near, axis=1)
            + np.sum((lack @ self._trend_covariance) * lack, axis=1)
        )
        spread = np.sqrt(np.maximum(variance, 0.0))
        scale = _fade_scores(distances, self.scores[:, chosen], self.far_shares)
        return Prediction(mean=mean, standard_error=scale * spread[:, None])

    def find_sway(self, at: Floats, quantities: Sequence[int]) -> Floats:
        """Most by which errors of the values move the mean, eq. (M3a).

        Of some quantities, shape (n, len(quantities)).
        """
        errs = self.doubts.any(axis=1)
        if not errs.any():
            return np.zeros((len(at), len(quantities)))
        near = _correlate(_measure_distances(at, self.places))
        lack = _build_trend(at) - near @ self._inverse @ self._trend
        by_trend = self._trend_covariance @ (self._trend.T @ self._inverse[:, errs])
        shares = near @ self._inverse[:, errs] + lack @ by_trend
        result: Floats = np.abs(shares) @ self.doubts[errs][:, list(quantities)]
        return result

    def evaluate(self, at: Floats, *quantities: int) -> list[Floats]:
        """Mean of some quantities at places of shape (n, dimension), n values each."""
        trend, near = _build_trend(at), _correlate(_measure_distances(at, self.places))
        return [
            trend @ self._trend_weights[:, one] + near @ self._weights[:, one]
            for one in quantities
        ]


def _fade_scores(distances: Floats, scores: Floats, far_shares: Floats) -> Floats:
    """Largest held-out score around each place, faded with distance."""
    marked = scores.any(axis=1)  # of most cases they are 0
    near = np.exp(-((distances[:, marked] / REACH) ** 2))
    share = np.maximum(near, far_shares[marked])
    by_case = np.ascontiguousarray(share.T)  # largest over rows: half the time
    each = [
        np.max(by_case * column[:, None], axis=0, initial=0.0)
        for column in scores[marked].T
    ]
    return np.stack(each, axis=1)


def fit_surrogate(
    places: Floats,
    values: Floats,
    noise: Floats | float = 0.0,
    doubts: Floats | None = None,
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

    Returns
    -------
    Surrogate
        It passes through the values up to the noise that is allowed for.

    Verified by
    -----------
    tests/search/test_surrogate.py
    """
    distances = _measure_distances(places, places)
    inverse = _invert(_correlate(distances) + _NUGGET * np.eye(len(places)))
    trend = _build_trend(places)
    covariance = _invert(trend.T @ inverse @ trend)
    trend_weights = covariance @ (trend.T @ (inverse @ values))
    weights = inverse @ (values - trend @ trend_weights)
    # Leaving case i out changes its prediction by (Q y)_i / Q_ii (Dubrule 1983).
    carried = inverse @ trend
    diagonal = np.diag(inverse - carried @ covariance @ carried.T)
    diagonal = np.maximum(diagonal, 1e-12)[:, None]
    return Surrogate(
        places=places,
        held_out=weights / diagonal,
        scores=np.maximum(np.abs(weights) / diagonal - noise, 0.0) * np.sqrt(diagonal),
        far_shares=_share_far(distances, places.shape[1]),
        doubts=np.zeros_like(values) if doubts is None else doubts,
        _inverse=inverse,
        _trend=trend,
        _trend_covariance=covariance,
        _trend_weights=trend_weights,
        _weights=weights,
    )


def _share_far(distances: Floats, dimension: int) -> Floats:
    """Share of each case's score far away: search/THEORY.md, eq. (M5a)."""
    shares = np.full(len(distances), FAR_SHARE)
    if dimension <= _DENSE_DIMENSIONS:
        return shares
    to_others = distances + np.diag(np.full(len(distances), np.inf))
    result: Floats = shares * np.minimum(1.0, to_others.min(axis=1) / REACH) ** (
        _ROUGHNESS
    )
    return result


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
    pairs = combinations_with_replacement(range(at.shape[1]), 2)
    products = [centred[:, i] * centred[:, j] for i, j in pairs]
    return np.column_stack([np.ones(len(at)), centred, *products])


def _measure_distances(a: Floats, b: Floats) -> Floats:
    square = (
        np.sum(a * a, axis=1)[:, None] + np.sum(b * b, axis=1)[None] - 2.0 * a @ b.T
    )
    result: Floats = np.sqrt(np.maximum(square, 0.0))
    return result


def _correlate(distances: Floats) -> Floats:
    """Matern 5/2: twice differentiable, so that a kink shows as held-out error."""
    scaled = np.sqrt(5.0) * distances / CORRELATION
    result: Floats = (1.0 + scaled + scaled**2 / 3.0) * np.exp(-scaled)
    return result


def follow_axis(
    model: Surrogate, through: Point, axis: int, quantity: int, count: int
) -> tuple[Floats, Floats, Floats]:
    """Shares of a parameter, forces and their standard errors along it."""
    shares = np.linspace(0.0, 1.0, count)
    line = np.tile(np.array(through), (count, 1))
    line[:, axis] = shares
    mean, standard_error = model.predict(line, (quantity,))
    return shares, mean[:, 0], standard_error[:, 0]
