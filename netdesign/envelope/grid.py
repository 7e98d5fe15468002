"""Ranges of the uncertain quantities, and the cases that sample them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from netdesign.errors import ModelError


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """Closed range of an uncertain quantity, in SI units, with sample count."""

    low: float
    high: float
    count: int

    def __post_init__(self) -> None:
        """Refuse reversed and endless ranges, and samples that leave an end out."""
        if not -math.inf < self.low <= self.high < math.inf:
            raise ModelError(
                f"range {self.low!r} to {self.high!r}: must run from a finite low end "
                "to a finite high end"
            )
        if self.count < 1 or (self.count == 1 and self.low != self.high):
            raise ModelError(f"range with {self.count} samples: at least 2 are needed")

    @property
    def samples(self) -> tuple[float, ...]:
        """Equally spaced values, both ends included."""
        if self.low == self.high:
            return (self.low,)
        return tuple(float(v) for v in np.linspace(self.low, self.high, self.count))


@dataclass(frozen=True, slots=True, kw_only=True)
class Ranges:
    """The uncertain quantities of the envelope."""

    density: Interval  # [kg/m3]
    friction_angle: Interval  # [rad]
    inclination: Interval  # [rad]


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
