"""Gauss-Newton with priors: parameters of any model from what was measured.

Theory: winter/THEORY.md, section 7.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats, Mask

MOST_ROUNDS = 7  # states at which slopes are taken
# A fit has settled once a step gains less than SETTLED (a move by one deviation of the
# posterior costs 0.5), unless the slopes promise as much as DOUBTFUL.
SETTLED = 0.05
DOUBTFUL = 0.5
_HALVINGS = 2
FAR = 3.0  # deviations of the prior: no parameter goes beyond

Response = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """Quantity that a fit may change; units are those of the model.

    Attributes
    ----------
    name : str
        Of the quantity.
    mean, deviation : float
        Of the prior [unit of the model]; the deviation is above 0.
    low, high : float
        Ends that physics sets, whatever the prior [unit of the model].
    step : float
        Difference by which the slopes are taken, above 0 [unit of the model].
    """

    name: str
    mean: float
    deviation: float
    low: float = -np.inf
    high: float = np.inf
    step: float

    @property
    def ends(self) -> tuple[float, float]:
        """Least and largest value of a fit."""
        reach = FAR * self.deviation
        return max(self.low, self.mean - reach), min(self.high, self.mean + reach)

    def is_far(self, value: float) -> bool:
        """A value stands at the end of the prior's reach.

        Parameters
        ----------
        value : float
            [unit of the model].
        """
        reach = FAR * self.deviation
        return abs(value - self.mean) >= reach * (1.0 - 1e-9)

    def is_at_end(self, value: float) -> bool:
        """A value stands at one of its ends: its deviation tells of one side only.

        Parameters
        ----------
        value : float
            [unit of the model].
        """
        low, high = self.ends
        return min(value - low, high - value) <= 1e-9 * self.deviation


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class State:
    """Answer of the model at some parameters, and its slopes.

    Attributes
    ----------
    values : ndarray, shape (n_parameters,)
        In the units of the fit.
    response : ndarray, shape (n_responses,)
        Those that were measured first, then those that are asked for.
    slopes : ndarray, shape (n_responses, n_parameters)
        Derivatives of the response.
    """

    values: Floats
    response: Floats
    slopes: Floats

    @property
    def is_known(self) -> bool:
        """Model and slopes have an answer everywhere."""
        return bool(np.isfinite(self.response).all() and np.isfinite(self.slopes).all())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fit:
    """Posterior of a fit, linearised at its last state.

    Attributes
    ----------
    prior, posterior : State
        First state, at the prior's means, and last.
    covariance : ndarray, shape (n_parameters, n_parameters)
        Of the posterior.
    rounds : int
        States at which slopes were taken.
    is_settled : bool
        A further step would be small.
    """

    prior: State
    posterior: State
    covariance: Floats
    rounds: int
    is_settled: bool

    @property
    def deviations(self) -> Floats:
        """Standard deviation of each parameter after the fit, (n_parameters,)."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    @property
    def correlations(self) -> Floats:
        """Correlation of each with each, (n_parameters, n_parameters) [-]."""
        left = self.deviations
        return np.asarray(self.covariance / np.outer(left, left))


def fit_gauss_newton(
    respond: Response,
    measured: Floats,
    noise: Floats,
    parameters: Sequence[Parameter],
) -> Fit:
    """Posterior of the parameters, eqs (Y12) to (Y14).

    Parameters
    ----------
    respond : callable
        Parameters (n_parameters,) to responses (n_responses,); NaN where the model has
        none.
    measured : ndarray, shape (n_measured,)
        What the first responses are to be.
    noise : ndarray, shape (n_measured, n_measured)
        Covariance of what was measured against the model.
    parameters : sequence of Parameter
        At least one.

    Returns
    -------
    Fit
        With a state that is not known, it is not settled.
    """
    problem = _Problem(measured, noise, parameters)
    values = problem.means
    response = respond(values)
    states: list[State] = []
    is_settled = False
    while len(states) < MOST_ROUNDS:
        state = differentiate(respond, values, response, parameters)
        states.append(state)
        if not state.is_known:
            break
        step = problem.find_step(state)
        expected = problem.expect(state, step)
        values, response, gain = _walk(respond, problem, state, step)
        is_settled = gain < SETTLED and expected < DOUBTFUL
        if gain < SETTLED:
            break
    return Fit(
        prior=states[0],
        posterior=states[-1],
        covariance=problem.find_covariance(states[-1]),
        rounds=len(states),
        is_settled=is_settled,
    )


def differentiate(
    respond: Response,
    values: Floats,
    response: Floats,
    parameters: Sequence[Parameter],
) -> State:
    """State of a model with slopes by one-sided differences.

    Parameters
    ----------
    respond : callable
        As in ``fit_gauss_newton``.
    values : ndarray, shape (n_parameters,)
        Where.
    response : ndarray, shape (n_responses,)
        There.
    parameters : sequence of Parameter
        Their steps and ends; no difference goes beyond an end.

    Returns
    -------
    State
        With NaN where the model has no answer on either side.
    """
    slopes = np.full((response.size, values.size), np.nan)
    if np.isfinite(response).all():
        for k, parameter in enumerate(parameters):
            slopes[:, k] = _find_slope(respond, values, response, k, parameter)
    return State(values=values, response=response, slopes=slopes)


def _find_slope(
    respond: Response, values: Floats, response: Floats, k: int, parameter: Parameter
) -> Floats:
    """Difference upwards; downwards where that leaves the ends or has no answer."""
    low, high = parameter.ends
    slope = np.full(response.size, np.nan)
    for step in (parameter.step, -parameter.step):
        if not low <= values[k] + step <= high:
            continue
        moved = values.copy()
        moved[k] += step
        slope = (respond(moved) - response) / step
        if np.isfinite(slope).all():
            break
    return slope


class _Problem:
    """Measurements and priors: what a state is worth, and where to go from it."""

    def __init__(
        self, measured: Floats, noise: Floats, parameters: Sequence[Parameter]
    ) -> None:
        self._measured, self._weights = measured, np.linalg.inv(noise)
        self._parameters = parameters
        self._tightness = np.array([1.0 / one.deviation**2 for one in parameters])
        self.means: Floats = np.array([one.mean for one in parameters])

    def measure(self, values: Floats, response: Floats) -> float:
        """Objective (Y12) [-]; NaN where the model has no answer."""
        misfit = self._measured - response[: self._measured.size]
        away = values - self.means
        return float(
            0.5 * (misfit @ self._weights @ misfit + self._tightness @ away**2)
        )

    def find_step(self, state: State) -> Floats:
        """Step of (Y13) from a state, inside the ends of all parameters."""
        n = self._measured.size
        misfit = self._measured - state.response[:n]
        pull = state.slopes[:n].T @ self._weights @ misfit
        pull -= self._tightness * (state.values - self.means)
        return _step_inside(
            self._find_curvature(state), pull, state.values, self._parameters
        )

    def expect(self, state: State, step: Floats) -> float:
        """Gain that a step would bring if all were linear [-]."""
        return float(0.5 * step @ self._find_curvature(state) @ step)

    def find_covariance(self, state: State) -> Floats:
        """Covariance (Y14) at a state; NaN where that is not known."""
        if not state.is_known:
            return np.full((self.means.size, self.means.size), np.nan)
        return np.asarray(np.linalg.inv(self._find_curvature(state)))

    def _find_curvature(self, state: State) -> Floats:
        slopes = state.slopes[: self._measured.size]
        return np.asarray(slopes.T @ self._weights @ slopes + np.diag(self._tightness))


def _walk(
    respond: Response, problem: _Problem, state: State, step: Floats
) -> tuple[Floats, Floats, float]:
    """Values, response and gain after a step, halved while it brings nothing."""
    before = problem.measure(state.values, state.response)
    for _ in range(_HALVINGS + 1):
        values = state.values + step
        response = respond(values)
        gain = before - problem.measure(values, response)
        if gain > 0.0:
            return values, response, gain
        step = step / 2.0
    return state.values, state.response, 0.0


def _step_inside(
    curvature: Floats, pull: Floats, values: Floats, parameters: Sequence[Parameter]
) -> Floats:
    """Step of (Y13); what would leave its ends stops there, the others follow.

    No parameter moves by more than one deviation of its prior.
    """
    lows, highs = np.array([one.ends for one in parameters]).T
    most = np.array([one.deviation for one in parameters])
    step: Floats = np.zeros(values.size)
    is_free: Mask = np.ones(values.size, dtype=bool)
    for _ in parameters:
        rest = pull - curvature @ np.where(is_free, 0.0, step)
        inner = curvature[np.ix_(is_free, is_free)]
        step[is_free] = np.linalg.solve(inner, rest[is_free])
        held = np.clip(values + step, lows, highs) - values
        leaves = is_free & (np.abs(held - step) > 1e-12)
        step[leaves] = held[leaves]
        is_free &= ~leaves
        if not leaves.any() or not is_free.any():
            break
    return np.asarray(step / max(1.0, float(np.max(np.abs(step) / most))))
