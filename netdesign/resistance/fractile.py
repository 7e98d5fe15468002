"""Fractile of 5 % of a pull-out resistance from single tests; EN 1990 D.7, lognormal.

A test that stopped before its anchor gave way says only that the resistance is larger:
it is right-censored, and counts by the likelihood. Theory: THEORY.md, (R15) to (R17).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import NormalDist, fmean

from netdesign.outcome import ModelError
from netdesign.resistance.pull_out import SingleTest
from netdesign.words.message import say

_PROBABILITY = 0.95  # that a further anchor holds more
_ROUNDS = 100  # of Newton's method; a handful is enough
_SAME = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True)
class Fractile:
    """Characteristic resistance as the median over a factor.

    Attributes
    ----------
    median : float
        Of the resistances [N].
    factor : float
        Median over fractile [-].
    """

    median: float
    factor: float

    @property
    def value(self) -> float:
        """Fractile [N]."""
        return self.median / self.factor


def find_fractile_of_known_scatter(
    tests: Sequence[SingleTest], variation: float
) -> Fractile:
    """Fractile where the coefficient of variation is known; (R15), (R16).

    A test whose result is not said counts as pulled out: the smaller of both readings.
    Where none is known to have pulled out no likelihood is largest anywhere: all count
    as pulled out, which is a lower bound.

    Parameters
    ----------
    tests : sequence of SingleTest
        At least one.
    variation : float
        Coefficient of variation of the resistance [-].

    Returns
    -------
    Fractile
        Lower bound of it where no test is known to have pulled out.
    """
    sigma = math.sqrt(math.log1p(variation**2))
    pulled, held = _split(tests)
    if all(test.is_held is not False for test in tests):
        pulled, held = [*pulled, *held], []
    mean, weight = _find_mean(pulled, held, sigma)
    spread = NormalDist().inv_cdf(_PROBABILITY) * math.sqrt(1.0 + 1.0 / weight)
    return Fractile(median=math.exp(mean), factor=math.exp(spread * sigma))


def find_fractile(tests: Sequence[SingleTest]) -> Fractile:
    """Fractile where the scatter is that of the tests themselves; (R15), (R17).

    Parameters
    ----------
    tests : sequence of SingleTest
        Two that pulled out at least; of each its result.

    Raises
    ------
    ModelError
        If a result is not said, too few pulled out, or all at one load: each would
        leave the scatter to be guessed.
    """
    from scipy.special import stdtrit

    if any(test.is_held is None for test in tests):
        raise ModelError(say("tests.result_wanted"))
    pulled, held = _split(tests)
    count = len(pulled)
    if count < 2:
        raise ModelError(say("tests.two_wanted", count=count))
    if max(pulled) - min(pulled) <= _SAME * abs(max(pulled)):
        raise ModelError(say("tests.no_scatter"))
    sigma = _find_scatter(pulled, held)
    mean, _ = _find_mean(pulled, held, sigma)
    sigma *= math.sqrt(count / (count - 1))
    spread = float(stdtrit(count - 1, _PROBABILITY)) * math.sqrt(1.0 + 1.0 / count)
    return Fractile(median=math.exp(mean), factor=math.exp(spread * sigma))


def _split(tests: Sequence[SingleTest]) -> tuple[list[float], list[float]]:
    """Logarithms of the loads of tests that pulled out, or may have, and that held."""
    pulled = [math.log(test.load) for test in tests if not test.is_held]
    return pulled, [math.log(test.load) for test in tests if test.is_held]


def _find_mean(
    pulled: Sequence[float], held: Sequence[float], sigma: float
) -> tuple[float, float]:
    """Mean of largest likelihood, and the number of tests that its information is."""
    mean = fmean(pulled)
    weight = float(len(pulled))
    if not held:
        return mean, weight
    for _ in range(_ROUNDS):
        steps = [(one - mean) / sigma for one in held]
        hazards = [_find_hazard(one) for one in steps]
        score = sum((one - mean) / sigma for one in pulled) + sum(hazards)
        pairs = zip(hazards, steps, strict=True)
        weight = len(pulled) + sum(hazard * (hazard - one) for hazard, one in pairs)
        mean += sigma * score / weight
        if abs(score) < _SAME * weight:
            break
    return mean, weight


def _find_scatter(pulled: Sequence[float], held: Sequence[float]) -> float:
    """Standard deviation of largest likelihood, of the logarithms [-]."""
    if not held:
        mean = fmean(pulled)
        return math.sqrt(fmean((one - mean) ** 2 for one in pulled))
    from scipy.optimize import brentq

    slope = _measure_slope(pulled, held)
    low = high = math.log(max(pulled) - min(pulled))
    while slope(low) < 0.0:
        low -= 1.0
    while slope(high) > 0.0:
        high += 1.0
    return (
        math.exp(brentq(slope, low, high, xtol=1e-13)) if low < high else math.exp(low)
    )


def _measure_slope(
    pulled: Sequence[float], held: Sequence[float]
) -> Callable[[float], float]:
    """Slope of the likelihood over the logarithm of the scatter, the mean its best."""

    def slope(logarithm: float) -> float:
        sigma = math.exp(logarithm)
        mean, _ = _find_mean(pulled, held, sigma)
        steps = [(one - mean) / sigma for one in held]
        squares = sum(((one - mean) / sigma) ** 2 - 1.0 for one in pulled)
        return squares + sum(one * _find_hazard(one) for one in steps)

    return slope


def _find_hazard(step: float) -> float:
    """Density of the normal distribution over what lies beyond [-]."""
    from scipy.special import erfcx

    return math.sqrt(2.0 / math.pi) / float(erfcx(step / math.sqrt(2.0)))
