"""Gauss-Newton with priors: closed form, ends, models without an answer."""

import numpy as np
import pytest

from netdesign.winter.gauss_newton import Parameter, fit_gauss_newton

SLOPES = np.array([[0.31, -1.7], [1.13, 0.4], [-0.62, 2.3], [0.9, 0.77]])
NOISE = np.diag([0.04, 0.011, 0.09, 0.023]) + 0.007
MEASURED = np.array([0.37, -1.21, 0.83])


def parameters(**changes):
    first = Parameter(name="a", mean=0.4, deviation=0.7, step=0.01)
    given = {"name": "b", "mean": -0.2, "deviation": 0.3, "step": 0.01}
    return first, Parameter(**(given | changes))


def straight(values):
    return SLOPES @ values + 0.13


def test_of_a_straight_model_it_is_the_closed_form():
    """Mean and covariance of Bayes' theorem for normal distributions."""
    noise = NOISE[:3, :3]
    fit = fit_gauss_newton(straight, MEASURED, noise, parameters())
    prior = np.diag([0.49, 0.09])
    means = np.array([0.4, -0.2])
    seen = SLOPES[:3]
    gain = prior @ seen.T @ np.linalg.inv(seen @ prior @ seen.T + noise)
    mean = means + gain @ (MEASURED - straight(means)[:3])
    assert fit.is_settled
    assert fit.rounds <= 4
    assert fit.posterior.values == pytest.approx(mean, abs=1e-6)
    assert fit.covariance == pytest.approx(prior - gain @ seen @ prior, abs=1e-9)
    assert fit.prior.values == pytest.approx(means)
    assert fit.posterior.response == pytest.approx(straight(mean), abs=1e-6)


def test_of_a_bent_model_it_finds_the_least_misfit():
    def bent(values):
        return np.exp(0.4 * SLOPES @ values)

    measured = bent(np.array([0.9, -0.5]))[:3] + np.array([0.04, -0.07, 0.02])
    fit = fit_gauss_newton(bent, measured, 0.0025 * np.eye(3), parameters())

    def measure(values):
        away = (values - [0.4, -0.2]) / [0.7, 0.3]
        misfit = measured - bent(values)[:3]
        return 0.5 * (misfit @ misfit / 0.0025 + away @ away)

    best = measure(fit.posterior.values)
    spread = np.sqrt(np.diag(fit.covariance))
    rng = np.random.default_rng(7)
    others = [
        fit.posterior.values + 0.5 * spread * rng.normal(size=2) for _ in "x" * 50
    ]
    assert fit.is_settled
    assert min(map(measure, others)) > best - 0.05


def test_what_would_leave_its_ends_stops_and_the_others_follow():
    noise = NOISE[:3, :3]
    free = fit_gauss_newton(straight, MEASURED, noise, parameters())
    high = -0.25  # below where it would go, above where it starts from
    assert free.posterior.values[1] != pytest.approx(high, abs=0.01)
    low = free.posterior.values[1] + 0.05
    held = fit_gauss_newton(
        straight, MEASURED, noise, parameters(low=low, mean=low + 0.1)
    )
    assert held.posterior.values[1] >= low - 1e-12
    assert parameters(low=low, mean=low + 0.1)[1].ends[0] == low


def test_a_parameter_stays_within_three_deviations():
    (_, far) = parameters()
    measured = straight(np.array([0.4, -2.0]))[:3]
    fit = fit_gauss_newton(straight, measured, 1e-6 * np.eye(3), parameters())
    assert fit.posterior.values[1] == pytest.approx(-0.2 - 3 * 0.3)
    assert far.is_far(float(fit.posterior.values[1]))
    assert far.is_at_end(float(fit.posterior.values[1]))
    assert not far.is_far(-1.05)


def test_a_model_without_an_answer_is_not_settled():
    def silent(values):
        is_near = abs(values[0] - 0.4) < 0.005
        return straight(values) if is_near else np.full(4, np.nan)

    fit = fit_gauss_newton(silent, MEASURED, NOISE[:3, :3], parameters())
    assert not fit.is_settled
    assert not fit.posterior.is_known
    assert np.isnan(fit.covariance).all()


def test_a_step_into_nothing_is_halved():
    """The whole step has no answer, half of it has."""
    noise = NOISE[:3, :3]
    free = fit_gauss_newton(straight, MEASURED, noise, parameters())
    whole = abs(free.posterior.values[0] - 0.4)

    def narrow(values):
        is_near = abs(values[0] - 0.4) < 0.6 * whole
        return straight(values) if is_near else np.full(4, np.nan)

    fit = fit_gauss_newton(narrow, MEASURED, noise, parameters())
    assert 0.0 < abs(fit.posterior.values[0] - 0.4) < 0.6 * whole
