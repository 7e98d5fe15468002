"""Random variables of a row's governing check: typed, assumed, or of a range.

``assumed.toml`` has the distributions that count where the workbook gives none. Theory:
addons/reliability/THEORY.md, section 1.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from importlib.resources import files

from netdesign.addons.reliability.check_by_case import CheckByCase
from netdesign.addons.reliability.limit_state import (
    DistributionKind,
    Variable,
    build_annual_maximum,
    build_by_share,
    read_kind,
)
from netdesign.addons.reliability.response import Line
from netdesign.checks.check import Check
from netdesign.envelope.ranges import PARAMETERS
from netdesign.outcome import ModelError
from netdesign.site.further_sheets import UncertainQuantity
from netdesign.site.model import NetRow, Site
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Assumed:
    """One assumed distribution.

    Attributes
    ----------
    distribution : str
        Its kind.
    variation : float
        Coefficient of variation [-].
    source : str
        Key of the text that says where it is from.
    period : float or None
        Return period of the value of the workbook [a].
    mean_ratio : float or None
        Mean over the characteristic value [-].
    """

    distribution: DistributionKind
    variation: float
    source: str
    period: float | None = None
    mean_ratio: float | None = None

    @property
    def source_in_words(self) -> Message:
        """Its source in words."""
        return say(f"source.{self.source}")


@lru_cache(maxsize=1)
def load_assumed() -> Mapping[str, Assumed]:
    """Assumed distributions by the names of their variables."""
    text = files(__package__).joinpath("assumed.toml").read_text(encoding="utf-8")
    return {name: Assumed(**entry) for name, entry in tomllib.loads(text).items()}


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


@dataclass(frozen=True, slots=True, kw_only=True)
class RowVariable:
    """A random variable, and where its distribution is from."""

    variable: Variable
    source: Message
    is_assumed: bool

    @property
    def name(self) -> str:
        """Key of the variable."""
        return self.variable.name


# Line of sheet Uncertainty that holds for a quantity of one net row.
_Find = Callable[[str], UncertainQuantity | None]


def list_variables(
    site: Site, check: CheckByCase, record: Check
) -> tuple[RowVariable, ...]:
    """Random variables of a check; those of its case are in SI units.

    Raises
    ------
    ModelError
        If one has no distribution, neither typed nor assumed.
    """
    find, case = partial(site.find_uncertain, check.row.id), check.governing
    variables = [_find_height(find, check.row)]
    for name, span in check.ranges.intervals:
        if span.low < span.high:
            variables.append(_find_ranged(find, name, span.low, span.high))
        elif name in _SHARES and case.values[name] > 0.0:
            variables.append(_find_single(find, name, case.values[name]))
    if not set(_GLIDES) & set(check.ranges.axes):
        variables += _list_glide(find, check.row)
    variables.append(_find_single(find, MODEL, 1.0))
    variables.append(_find_resistance(find, record))
    return tuple(variables)


def _list_glide(find: _Find, row: NetRow) -> list[RowVariable]:
    """Glide of a row whose ground slides, by the quantity that was typed."""
    if row.glide_factor is not None:
        return [_find_single(find, "glide_factor", row.glide_factor)]
    if row.ground.kind == "sliding":
        return [_find_single(find, "slip_length", row.ground.slip_length)]
    return []


def _find_height(find: _Find, row: NetRow) -> RowVariable:
    """Annual maximum of the vertical snow height, capped by the net."""
    typed, assumed = find(HEIGHT), load_assumed()[HEIGHT]
    variation = typed.variation if typed else assumed.variation
    cosine = math.cos(row.slope_angle)
    height, cap = row.snow_thickness / cosine, row.net_height / cosine
    if typed and typed.mean_ratio is not None:
        kind = typed.distribution or assumed.distribution
        variable = _build(HEIGHT, kind, typed.mean_ratio * height, variation, cap)
    else:
        period = (typed.period if typed else None) or assumed.period or math.nan
        variable = build_annual_maximum(HEIGHT, height, period, variation, cap)
    return _tell(variable, typed, assumed.source_in_words)


def _tell(
    variable: Variable, typed: UncertainQuantity | None, assumed: Message
) -> RowVariable:
    return RowVariable(
        variable=variable,
        source=say("source.typed", text=typed.source) if typed else assumed,
        is_assumed=typed is None,
    )


def _find_single(find: _Find, name: str, value: float) -> RowVariable:
    """Variable whose mean is a single value of the workbook, or in a ratio to it."""
    typed, assumed = find(name), load_assumed().get(name)
    if typed is not None:
        return _tell(_build_typed(typed, name, value), typed, say("source.range"))
    if assumed is None:
        refusal = say("reliability.no_distribution", name=PARAMETERS[name].label)
        raise ModelError(refusal)
    variable = _build(name, assumed.distribution, value, assumed.variation)
    return _tell(variable, None, assumed.source_in_words)


def _build_typed(typed: UncertainQuantity, name: str, value: float) -> Variable:
    """Variable of a line of the workbook, by the value that its ratio refers to."""
    mean = value * (1.0 if typed.mean_ratio is None else typed.mean_ratio)
    return _build(name, typed.distribution, mean, typed.variation)


def _build(
    name: str, kind: str, mean: float, variation: float, cap: float = math.inf
) -> Variable:
    """Variable by its coefficient of variation; lognormal where ``kind`` is empty."""
    kind, deviation = read_kind(kind or "lognormal"), variation * mean
    return Variable(name=name, kind=kind, mean=mean, deviation=deviation, cap=cap)


def _find_ranged(find: _Find, name: str, low: float, high: float) -> RowVariable:
    """Variable of a range of the workbook: its middle nine tenths, unless typed."""
    typed, middle = find(name), 0.5 * (low + high)
    if typed is not None:
        variable = _build_typed(typed, name, middle)
    elif low > 0.0 and name != "inclination":
        spread = math.log(high / low) / (2.0 * _WITHIN)
        variation = math.sqrt(math.expm1(spread**2))
        variable = build_by_share(name, math.sqrt(low * high), 0.0, variation)
    else:
        deviation = (high - low) / (2.0 * _WITHIN)
        variable = Variable(name=name, kind="normal", mean=middle, deviation=deviation)
    return _tell(variable, typed, say("source.range"))


def _find_resistance(find: _Find, check: Check) -> RowVariable:
    """Resistance over its characteristic value."""
    typed = find(RESISTANCE)
    assumed = load_assumed()["ground" if check.mode in _OF_GROUND else "steel"]
    variation = typed.variation if typed else assumed.variation
    ratio, tests, least = assumed.mean_ratio, check.tests, check.read("R_k")
    if typed is not None and typed.mean_ratio is not None:
        ratio = typed.mean_ratio
    elif tests is not None and least and tests.mean_kN > least:
        # the mean of so few tests is not known exactly
        ratio = tests.mean_kN / least
        variation *= math.sqrt(1.0 + 1.0 / tests.count)
    if ratio is None:
        variable = build_by_share(RESISTANCE, 1.0, _CHARACTERISTIC, variation)
    else:
        kind = typed.distribution if typed else ""
        variable = _build(RESISTANCE, kind, ratio, variation)
    return _tell(variable, typed, assumed.source_in_words)


def list_lines(check: CheckByCase, variables: tuple[RowVariable, ...]) -> list[Line]:
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
        _choose_line(name, values[name], shares, ends.get(name, (0.0, math.inf)))
        for name, shares in _SHARES.items()
        if name in names and name not in check.ranges.axes
    ]


def _choose_line(
    name: str, value: float, shares: tuple[float, float], ends: tuple[float, float]
) -> Line:
    """Line that is solved at its high end, or below the value if that is near it."""
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
