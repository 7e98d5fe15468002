"""Reliability of a limit state: the index by sampling, explained by FORM.

Sampling goes about the design points. Theory: addons/reliability/THEORY.md, section 4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.addons.reliability.form import (
    NotAvailable,
    approach_design_point,
    find_design_points,
)
from netdesign.addons.reliability.limit_state import LimitState
from netdesign.numerics.arrays import Floats
from netdesign.words.message import say

LARGEST_ERROR = 0.02  # standard error of an index that is stated
_GOAL = 0.018  # at which the sampling ends
_BATCH = 500
_MOST_BATCHES = 150
SEED = 1945


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """Index with its standard error, and the number of samples."""

    beta: float
    standard_error: float
    samples: int

    @property
    def is_sound(self) -> bool:
        """The error is known and small enough to state the index."""
        return self.standard_error < LARGEST_ERROR


def estimate_betas(
    state: LimitState,
    centres: Floats,
    shifts: Sequence[float] = (0.0,),
    seed: int = SEED,
) -> list[Estimate]:
    """Reliability indices by the same samples, (U12) to (U14).

    Parameters
    ----------
    state : LimitState
        Its margins are evaluated.
    centres : ndarray, shape (n, variables)
        Places around which samples are drawn, in standard normal space.
    shifts : sequence of float
        What is added to every margin, for each index.
    seed : int
        Of the samples.
    """
    random = np.random.default_rng(seed)
    values = np.empty((len(shifts), 0))
    estimates: list[Estimate] = []
    for _ in range(_MOST_BATCHES):
        drawn = _sample(state, centres, shifts, random)
        values = np.concatenate([values, drawn], axis=1)
        estimates = [_rate(one) for one in values]
        if all(one.standard_error <= _GOAL for one in estimates):
            break
    return estimates


def _sample(
    state: LimitState,
    centres: Floats,
    shifts: Sequence[float],
    random: np.random.Generator,
) -> Floats:
    """Weights of the failures in one batch, 0 of all others; shape (shifts, n)."""
    drawn = random.integers(len(centres), size=_BATCH)
    u = centres[drawn] + random.standard_normal((_BATCH, centres.shape[1]))
    margins = state.evaluate(np.minimum(u, state.caps))
    fails = np.array([margins + shift < 0.0 for shift in shifts])
    # logarithms of the mixture's density over the standard normal one
    exponents = u @ centres.T - 0.5 * np.sum(centres**2, axis=1)
    most = exponents.max(axis=1)
    ratio = np.exp(exponents - most[:, None]).mean(axis=1)
    weights: Floats = np.where(fails, np.exp(-most) / ratio, 0.0)
    return weights


def _rate(weights: Floats) -> Estimate:
    """Index of the mean weight, which estimates the probability of failure."""
    from scipy.special import ndtri

    probability = float(weights.mean())
    if not 0.0 < probability < 1.0:
        return Estimate(beta=math.nan, standard_error=math.inf, samples=len(weights))
    beta = -float(ndtri(probability))
    error = float(weights.std(ddof=1)) / math.sqrt(len(weights))
    density = math.exp(-0.5 * beta**2) / math.sqrt(2.0 * math.pi)
    return Estimate(beta=beta, standard_error=error / density, samples=len(weights))


@dataclass(frozen=True, slots=True, kw_only=True)
class Reliability:
    """Notional reliability of one limit state.

    Attributes
    ----------
    beta, standard_error : float
        Index by sampling, and its error by sampling alone.
    beta_shifted : float or None
        Index with the margins shifted; None where its error is too large.
    beta_by_form : float
        Distance of the design point.
    alpha_squared : tuple of float
        Shares of the variables in that distance, in their order.
    design_point : tuple of float
        Values of the variables there, each in its unit, at most its cap.
    samples : int
        Number of samples.
    """

    beta: float
    standard_error: float
    beta_shifted: float | None
    beta_by_form: float
    alpha_squared: tuple[float, ...]
    design_point: tuple[float, ...]
    samples: int


def find_reliability(
    state: LimitState, shift: float | None = None
) -> Reliability | NotAvailable:
    """Reliability of a limit state, or the reason why there is none.

    Parameters
    ----------
    state : LimitState
        Its margins, in any unit.
    shift : float, optional
        By which the margins differ from those of another state, whose index is asked
        for too.

    Verified by
    -----------
    tests/verification/test_reliability.py
    """
    points = find_design_points(state)
    if isinstance(points, NotAvailable):
        return points
    nearest, shifts = points[0], [0.0]
    centres = np.array([one.place for one in points])
    if shift is not None:
        beside = approach_design_point(state, nearest, shift)
        if np.isfinite(beside).all():
            centres, shifts = np.vstack([centres, beside]), [0.0, shift]
    estimate, *others = estimate_betas(state, centres, shifts)
    if not estimate.is_sound:
        return NotAvailable(reason=say("reliability.not_sampled"))
    (values,) = state.place(nearest.place[None])
    return Reliability(
        beta=estimate.beta,
        standard_error=estimate.standard_error,
        beta_shifted=next((one.beta for one in others if one.is_sound), None),
        beta_by_form=nearest.beta,
        alpha_squared=tuple(float(one) for one in nearest.alpha_squared),
        design_point=tuple(float(one) for one in np.asarray(values)),
        samples=estimate.samples,
    )
