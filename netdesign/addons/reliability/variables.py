"""Random variables of a row's governing check, and limit states of them.

``assumed.toml`` has the distributions that count where the workbook gives none. Theory:
addons/reliability/THEORY.md, sections 1 and 2.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from importlib.resources import files

import numpy as np

from netdesign.addons.reliability.check_by_case import CheckByCase
from netdesign.addons.reliability.response import Line
from netdesign.addons.reliability.uncertainty_sheet import (
    UncertainQuantity,
    find_uncertain,
)
from netdesign.checks.check import Check
from netdesign.envelope.ranges import PARAMETERS
from netdesign.numerics.arrays import Floats
from netdesign.outcome import (
    ModelError,
    require_one_of,
    require_positive,
    require_within,
)
from netdesign.site.model import NetRow, Site
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.words.message import Message, say

KINDS = ("gumbel", "lognormal", "normal")
_OF_RANGE = say("source.range")
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
    source : Message
        Where the distribution is from; a range of the workbook unless it is said.
    is_assumed : bool
        No line of sheet Uncertainty gives it.
    """

    name: str
    kind: str
    mean: float
    deviation: float
    cap: float = math.inf
    source: Message = _OF_RANGE
    is_assumed: bool = True

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


@lru_cache(maxsize=1)
def load_assumed() -> Mapping[str, UncertainQuantity]:
    """Assumed distributions by the names of their variables, each for all rows."""
    text = files(__package__).joinpath("assumed.toml").read_text(encoding="utf-8")
    return {
        name: UncertainQuantity(row_id="", name=name, is_assumed=True, **entry)
        for name, entry in tomllib.loads(text).items()
    }


HEIGHT, MODEL, RESISTANCE = "snow_height", "model", "resistance"
_GLIDES = ("glide_factor", "slip_length")
_WITHIN = 1.645  # place of the ends of a range: its middle nine tenths
_CHARACTERISTIC = -1.645  # place of a characteristic resistance: the 5 % fractile
_OF_GROUND = ("pull_out", "bearing", "sliding")  # modes of a resistance
# Shares of the row's value between which a quantity's line holds.
_SHARES: Mapping[str, tuple[float, float]] = {
    "thickness": (0.6, 2.0),
    "glide_factor": (0.7, 1.8),
    "slip_length": (0.4, 2.5),
    "density": (0.75, 1.4),
    "friction_angle": (0.6, 1.5),
}
_LEAST_GLIDE = 1.05
_HEIGHT_BEND = -0.5  # measured: -0.8 to 0; that of the others is 0.1 at most
_TOO_NEAR = 0.1  # to the row's value, in logarithms


# Line of sheet Uncertainty that holds for a quantity of one net row.
_Find = Callable[[str], UncertainQuantity | None]


def list_variables(
    site: Site, check: CheckByCase, record: Check
) -> tuple[Variable, ...]:
    """Random variables of a check; those of its case are in SI units.

    Raises
    ------
    ModelError
        If one has no distribution, neither typed nor assumed.
    """
    find, case = partial(find_uncertain, site, check.row.id), check.governing
    variables = [_find_height(find, check.row)]
    for name, span in check.ranges.intervals:
        if span.low == span.high:
            if name in _SHARES and case.values[name] > 0.0:
                variables.append(_find_single(find, name, case.values[name]))
        elif find(name) is None:
            variables.append(_build_ranged(name, span.low, span.high))
        else:
            variables.append(_find_single(find, name, 0.5 * (span.low + span.high)))
    if not set(_GLIDES) & set(check.ranges.axes):
        variables += _list_glide(find, check.row)
    variables.append(_find_single(find, MODEL, 1.0))
    variables.append(_find_resistance(find, record))
    return tuple(variables)


def _list_glide(find: _Find, row: NetRow) -> list[Variable]:
    """Glide of a row whose ground slides, by the quantity that was typed."""
    if row.glide_factor is not None:
        return [_find_single(find, "glide_factor", row.glide_factor)]
    if row.ground.kind == "sliding":
        return [_find_single(find, "slip_length", row.ground.slip_length)]
    return []


def _complete(find: _Find, name: str, assumed_as: str = "") -> UncertainQuantity:
    """Line of the workbook, completed by the assumed one, which counts without it."""
    typed, assumed = find(name), load_assumed().get(assumed_as or name)
    if typed is not None and assumed is not None:
        return replace(
            typed,
            distribution=typed.distribution or assumed.distribution,
            period=typed.period or assumed.period,
        )
    line = typed or assumed
    if line is None:
        refusal = say("reliability.no_distribution", name=PARAMETERS[name].label)
        raise ModelError(refusal)
    return line


def _find_height(find: _Find, row: NetRow) -> Variable:
    """Annual maximum of the vertical snow height, capped by the net."""
    line, cosine = _complete(find, HEIGHT), math.cos(row.slope_angle)
    height, cap = row.snow_thickness / cosine, row.net_height / cosine
    if line.mean_ratio is not None:
        return _build(HEIGHT, line, line.mean_ratio * height, cap)
    period = line.period or math.nan
    variable = build_annual_maximum(HEIGHT, height, period, line.variation, cap)
    return _note_source(variable, line)


def _note_source(variable: Variable, line: UncertainQuantity) -> Variable:
    return replace(variable, source=line.source_in_words, is_assumed=line.is_assumed)


def _find_single(find: _Find, name: str, value: float) -> Variable:
    """Variable whose mean is a single value of the workbook, or in a ratio to it."""
    line = _complete(find, name)
    ratio = 1.0 if line.mean_ratio is None else line.mean_ratio
    return _build(name, line, value * ratio)


def _build(
    name: str, line: UncertainQuantity, mean: float, cap: float = math.inf
) -> Variable:
    """Variable by its coefficient of variation; lognormal where no kind is typed."""
    variable = Variable(
        name=name,
        kind=line.distribution or "lognormal",
        mean=mean,
        deviation=line.variation * mean,
        cap=cap,
    )
    return _note_source(variable, line)


def _build_ranged(name: str, low: float, high: float) -> Variable:
    """Variable of which a range of the workbook is the middle nine tenths."""
    if low > 0.0 and name != "inclination":
        spread = math.log(high / low) / (2.0 * _WITHIN)
        variation = math.sqrt(math.expm1(spread**2))
        return build_by_share(name, math.sqrt(low * high), 0.0, variation)
    middle, deviation = 0.5 * (low + high), (high - low) / (2.0 * _WITHIN)
    return Variable(name=name, kind="normal", mean=middle, deviation=deviation)


def _find_resistance(find: _Find, check: Check) -> Variable:
    """Resistance over its characteristic value."""
    kind = "ground" if check.mode in _OF_GROUND else "steel"
    line = _complete(find, RESISTANCE, kind)
    ratio, tests, least = line.mean_ratio, check.tests, check.read("R_k")
    if ratio is None or line.is_assumed:
        ratio = load_assumed()[kind].mean_ratio
        if tests is not None and least and tests.mean_kN > least:
            # the mean of so few tests is not known exactly
            ratio = tests.mean_kN / least
            variation = line.variation * math.sqrt(1.0 + 1.0 / tests.count)
            line = replace(line, variation=variation)
    if ratio is not None:
        return _build(RESISTANCE, line, ratio)
    variable = build_by_share(RESISTANCE, 1.0, _CHARACTERISTIC, line.variation)
    return _note_source(variable, line)


def list_lines(check: CheckByCase, variables: tuple[Variable, ...]) -> list[Line]:
    """Lines to be solved.

    That is every variable but those over which the search went.
    """
    row = check.row
    names = {
        "thickness" if variable.name == HEIGHT else variable.name
        for variable in variables
    }
    values = {"thickness": row.snow_thickness, "slip_length": row.ground.slip_length}
    values |= check.governing.values
    if row.glide_factor is not None:
        values["glide_factor"] = row.glide_factor
    ends = {"thickness": (0.0, row.net_height)}
    ends["glide_factor"] = (_LEAST_GLIDE, LARGEST_GLIDE_FACTOR)
    return [
        _choose_line(name, values[name], ends.get(name, (0.0, math.inf)))
        for name in _SHARES
        if name in names and name not in check.ranges.axes
    ]


def _choose_line(name: str, value: float, ends: tuple[float, float]) -> Line:
    """Line that is solved at its high end, or below the value if that is near it."""
    shares = _SHARES[name]
    low, high = max(shares[0] * value, ends[0]), min(shares[1] * value, ends[1])
    is_near = math.log(high / value) < _TOO_NEAR
    return Line(
        name=name,
        low=low,
        centre=value,
        high=high,
        solved=math.sqrt(low * value) if is_near else high,
        bend=_HEIGHT_BEND if name == "thickness" else 0.0,
    )
