"""Random variables, and limit states of them in standard normal space.

Theory: addons/reliability/THEORY.md, sections 1 and 2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_one_of, require_positive, require_within

DistributionKind = Literal["gumbel", "lognormal", "normal"]
KINDS: tuple[DistributionKind, ...] = ("gumbel", "lognormal", "normal")
_STEP = 1e-4  # in standard normal space, of central differences


@dataclass(frozen=True, slots=True, kw_only=True)
class Variable:
    """One random variable.

    Attributes
    ----------
    name : str
        Key of the variable.
    kind : str
        ``gumbel`` (largest values), ``lognormal`` or ``normal``.
    mean, deviation : float
        In the unit of the variable; deviation 0 is a constant.
    cap : float
        Value beyond which the variable has no more effect; infinite for none.
    """

    name: str
    kind: DistributionKind
    mean: float
    deviation: float
    cap: float = math.inf

    def __post_init__(self) -> None:
        """Refuse a distribution that does not exist."""
        require_one_of("distribution", self.kind, KINDS)
        require_within("standard deviation", self.deviation, 0.0, 1e12)
        if self.kind == "lognormal":
            require_positive("mean", self.mean)

    def place(self, u: Floats) -> Floats:
        """Values at standard normal places, (U1) to (U3); same shape."""
        if self.kind == "normal":
            return self.mean + self.deviation * u
        if self.kind == "lognormal":
            spread = _find_log_deviation(self.deviation / self.mean)
            value: Floats = self.mean * np.exp(spread * u - 0.5 * spread**2)
            return value
        from scipy.special import log_ndtr

        scale = math.sqrt(6.0) / math.pi * self.deviation
        mode = self.mean - np.euler_gamma * scale
        largest: Floats = mode - scale * np.log(-log_ndtr(u))
        return largest

    def find_place(self, value: float) -> float:
        """Standard normal place of a value, the inverse of ``place``."""
        if math.isinf(value):
            return value
        if self.deviation == 0.0:
            return math.copysign(math.inf, value - self.mean)
        if self.kind == "normal":
            return (value - self.mean) / self.deviation
        if self.kind == "lognormal":
            if value <= 0.0:
                return -math.inf
            spread = _find_log_deviation(self.deviation / self.mean)
            return math.log(value / self.mean) / spread + 0.5 * spread
        from scipy.special import ndtri_exp

        scale = math.sqrt(6.0) / math.pi * self.deviation
        mode = self.mean - np.euler_gamma * scale
        return float(ndtri_exp(-math.exp(-(value - mode) / scale)))


def read_kind(name: str) -> DistributionKind:
    """Kind of distribution of a name in a document.

    Raises
    ------
    ModelError
        If no kind has it.
    """
    require_one_of("distribution", name, KINDS)
    return next(kind for kind in KINDS if kind == name)


def _find_log_deviation(variation: float) -> float:
    """Standard deviation of the logarithm [-], of a coefficient of variation."""
    return math.sqrt(math.log1p(variation**2))


def build_annual_maximum(
    name: str, value: float, period: float, variation: float, cap: float = math.inf
) -> Variable:
    """Gumbel distribution of annual maxima by one of its return values, (U4).

    Parameters
    ----------
    name : str
        Key of the variable.
    value : float
        Return value, in the unit of the variable.
    period : float
        T, above 1 [a].
    variation : float
        Coefficient of variation of the annual maxima [-].
    cap : float
        As of ``Variable``.
    """
    require_within("return period", period, 1.1, 1e6, "a")
    require_within("coefficient of variation", variation, 0.0, 2.0)
    reduced = -math.log(-math.log1p(-1.0 / period))
    factor = math.sqrt(6.0) / math.pi * (reduced - float(np.euler_gamma))
    mean = value / (1.0 + variation * factor)
    return Variable(
        name=name, kind="gumbel", mean=mean, deviation=variation * mean, cap=cap
    )


def build_by_share(name: str, value: float, place: float, variation: float) -> Variable:
    """Lognormal variable of which one value has a known standard normal place, (U5).

    Such as -1.645 of a characteristic value that is the 5 % fractile.
    """
    require_positive("value", value)
    spread = _find_log_deviation(variation)
    mean = value * math.exp(0.5 * spread**2 - place * spread)
    return Variable(name=name, kind="lognormal", mean=mean, deviation=variation * mean)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LimitState:
    """Limit state of independent variables.

    Attributes
    ----------
    variables : tuple of Variable
        In the order of the columns of what ``margin`` takes.
    margin : callable
        Values of shape (n, variables) to margins of shape (n,): failure below 0. It is
        smooth, as if no variable had a cap.
    """

    variables: tuple[Variable, ...]
    margin: Callable[[Floats], Floats]

    @property
    def caps(self) -> Floats:
        """Standard normal places of the caps, shape (variables,)."""
        return np.array(
            [variable.find_place(variable.cap) for variable in self.variables]
        )

    def place(self, u: Floats) -> Floats:
        """Values at standard normal places, both of shape (n, variables)."""
        columns = [variable.place(u[:, k]) for k, variable in enumerate(self.variables)]
        return np.column_stack(columns)

    def evaluate(self, u: Floats) -> Floats:
        """Margins at standard normal places of shape (n, variables), caps left out."""
        return self.margin(self.place(u))

    def differentiate(self, u: Floats) -> tuple[Floats, Floats]:
        """Margins (n,) and their gradients at places, both of shape (n, variables)."""
        count, size = u.shape
        steps = _STEP * np.vstack([np.zeros(size), np.eye(size), -np.eye(size)])
        places = (u[:, None] + steps).reshape(-1, size)
        margins = self.evaluate(places).reshape(count, -1)
        up, down = np.split(margins[:, 1:], 2, axis=1)
        return margins[:, 0], (up - down) / (2.0 * _STEP)
