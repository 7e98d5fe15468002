"""Ranges of the uncertain quantities, and the cases that sample them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from netdesign.errors import ModelError
from netdesign.words.message import say

_USUAL_COUNT = 3  # of a range without a count, beside one with a count


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """Closed range of an uncertain quantity, in SI units, with sample count.

    Without a count the range is searched, not sampled.
    """

    low: float
    high: float
    count: int | None = None

    def __post_init__(self) -> None:
        """Refuse reversed and endless ranges, and samples that leave an end out."""
        if not -math.inf < self.low <= self.high < math.inf:
            raise ModelError(say("envelope.range_ends", low=self.low, high=self.high))
        if self.count is None:
            return
        if self.count < 1 or (self.count == 1 and self.low != self.high):
            raise ModelError(say("envelope.range_samples", count=self.count))

    @property
    def samples(self) -> tuple[float, ...]:
        """Equally spaced values, both ends included."""
        if self.low == self.high:
            return (self.low,)
        count = self.count or _USUAL_COUNT
        return tuple(float(v) for v in np.linspace(self.low, self.high, count))


@dataclass(frozen=True, slots=True, kw_only=True)
class Ranges:
    """The uncertain quantities of the envelope."""

    density: Interval  # [kg/m3]
    friction_angle: Interval  # [rad]
    inclination: Interval  # [rad]

    @property
    def is_grid(self) -> bool:
        """Some range has a sample count, or none of them is a range at all."""
        spans = (self.density, self.friction_angle, self.inclination)
        wide = [span for span in spans if span.low < span.high]
        return not wide or any(span.count is not None for span in wide)


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Case:
    """One point of the ranges. SI units; angles in radians.

    ``others`` names further quantities that range, as in ``envelope.parameters``.
    """

    density: float
    friction_angle: float
    inclination: float
    others: tuple[tuple[str, float], ...] = ()


def build_cases(ranges: Ranges) -> tuple[Case, ...]:
    """All cases of the tensor grid, density varying slowest."""
    return tuple(
        Case(density=density, friction_angle=friction, inclination=inclination)
        for density, friction, inclination in itertools.product(
            ranges.density.samples,
            ranges.friction_angle.samples,
            ranges.inclination.samples,
        )
    )
