"""One comparison with truth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

Kind = Literal[
    "closed form", "manufactured", "invariant", "limit", "cross model", "published"
]


@dataclass(frozen=True, slots=True)
class VerificationCase:
    """Result of one comparison.

    Attributes
    ----------
    id : str
        Short name.
    kind : str
        What the truth is.
    reference : str
        Where the expected value comes from.
    expected, got : float
        In the same unit.
    error : float
        |got - expected| over |expected|; absolute where 0 is expected.
    tolerance : float
        Largest error that passes.
    order : float or None
        Observed order of convergence.
    least_order : float or None
        Smallest order that passes.
    """

    id: str
    kind: Kind
    reference: str
    expected: float
    got: float
    tolerance: float
    order: float | None = None
    least_order: float | None = None

    @property
    def error(self) -> float:
        """Relative error; absolute where 0 is expected."""
        difference = abs(self.got - self.expected)
        return difference / abs(self.expected) if self.expected else difference

    @property
    def passes(self) -> bool:
        """Error and order are as demanded; NaN never passes."""
        if not self.error <= self.tolerance:
            return False
        if self.least_order is None:
            return True
        return self.order is not None and self.order >= self.least_order


def expect_zero(
    name: str, reference: str, got: float, tolerance: float = 1e-8
) -> VerificationCase:
    """Invariant whose expected value is 0."""
    return VerificationCase(name, "invariant", reference, 0.0, got, tolerance)


def observe_order(sizes: Sequence[float], errors: Sequence[float]) -> float:
    """Slope of log(error) over log(size) between the two finest; sizes descend."""
    ratio = math.log(errors[-2] / errors[-1])
    return ratio / math.log(sizes[-2] / sizes[-1])


def largest_difference(first: object, second: object) -> float:
    """Largest absolute difference of two arrays."""
    return float(np.abs(np.asarray(first) - np.asarray(second)).max())
