"""Logarithm of a check's utilisation as a function of what varies, for samples.

The search's own model over the ranges of the workbook, a parabola along each other
quantity, and one shift by which the model meets a case that was solved. Theory:
addons/reliability/THEORY.md, section 2.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from netdesign.addons.reliability.check_by_case import TRIED_DENSITIES, CheckByCase
from netdesign.envelope.ranges import PARAMETERS, Case, Interval
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError
from netdesign.search.surrogate import (
    Surrogate,
    count_trend_terms,
    fit_surrogate,
    supports_model,
)
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import say

_INWARDS = 1e-4  # step of a tangent, as a share of a range
_TRIES = 3  # of a value without a result
_SPARE = 2  # cases that a model has beyond its trend terms, at least
_ROUNDING = 1e-9
_DENSER = 1.3  # of the largest density in the workbook: at most at a design point
# Beside what ranges: the end effect of a support follows the glide factor.
_WIDENING = ("thickness", "slip_length", "glide_factor")

Values = Mapping[str, Floats]  # by the names of the quantities, each of shape (n,)


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """Parabola of ln mu over the logarithm of one quantity, 0 at its centre; (U7a).

    Attributes
    ----------
    name : str
        The quantity.
    low, centre, high : float
        Least value, that of the governing case, and largest [SI].
    solved : float
        Value at which the slope is found by a solve [SI].
    bend : float
        Coefficient of the second power.
    slope : float
        Coefficient of the first power; NaN before that solve.
    """

    name: str
    low: float
    centre: float
    high: float
    solved: float
    bend: float
    slope: float = math.nan

    def meet(self, value: float, change: float) -> Line:
        """Line with the slope by which it has a change at a value."""
        at = math.log(value / self.centre)
        return replace(self, slope=change / at - self.bend * at)

    def find(self, values: Floats) -> Floats:
        """Change of ln mu at some values; beyond its ends along the tangent."""
        at = np.log(np.maximum(values, 1e-12) / self.centre)
        low, high = (math.log(end / self.centre) for end in (self.low, self.high))
        inside = np.clip(at, low, high)
        steep = self.slope + 2.0 * self.bend * inside
        result: Floats = (
            self.slope * inside + self.bend * inside**2 + steep * (at - inside)
        )
        return result


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Response:
    """Model of ln mu.

    Attributes
    ----------
    axes : tuple of (str, Interval)
        What ranges in the workbook.
    model : Surrogate or None
        Of the solved cases over the unit cube of the axes; None without axes.
    base : float
        ln mu in the governing case; it counts where there is no model.
    ends : ndarray, shape (2, axes)
        Least and largest coordinates that were solved.
    lines : tuple of Line
        Of the other quantities.
    shift : float
        Added everywhere.
    """

    axes: tuple[tuple[str, Interval], ...]
    model: Surrogate | None
    base: float
    ends: Floats
    lines: tuple[Line, ...] = ()
    shift: float = 0.0

    def find(self, values: Values) -> Floats:
        """Values of ln mu, shape (n,), of quantities of shape (n,) each."""
        result = self._find_over_axes(values) + self.shift
        for line in self.lines:
            result = result + line.find(values[line.name])
        return result

    def find_at(self, values: Mapping[str, float]) -> float:
        """Value of ln mu at one place."""
        return float(
            self.find({k: np.array([value]) for k, value in values.items()})[0]
        )

    def _find_over_axes(self, values: Values) -> Floats:
        """Mean of the search's model; beyond the ranges along its tangent."""
        if self.model is None:
            return np.full(1, self.base)
        at = _place(self.axes, values)
        inside = np.clip(at, *self.ends)
        beyond = at - inside
        sizes = np.linalg.norm(beyond, axis=1)
        far = sizes > 0.0
        back = inside[far] - _INWARDS * beyond[far] / sizes[far, None]
        (both,) = self.model.evaluate(np.vstack([inside, back]), 0)
        mean, before = both[: len(at)], both[len(at) :]
        mean[far] += (mean[far] - before) / _INWARDS * sizes[far]
        return mean

    def find_error(self, values: Mapping[str, float]) -> float:
        """Standard error of the search's model at one place [-, of ln mu]."""
        if self.model is None:
            return 0.0
        arrays = {name: np.array([value]) for name, value in values.items()}
        at = _place(self.axes, arrays)
        return float(self.model.predict(np.clip(at, *self.ends)).standard_error[0, 0])

    def find_beyond(self, values: Mapping[str, float]) -> str | None:
        """First quantity whose value lies too far from those that were solved.

        Denser snow than the range has is solved at the design point.
        """
        spans = {
            name: tuple(span.low + end * (span.high - span.low) for end in ends)
            for (name, span), ends in zip(self.axes, self.ends.T, strict=True)
        }
        if "density" in spans:
            low, high = spans["density"]
            spans["density"] = low, max(high, min(_DENSER * high, TRIED_DENSITIES[1]))
        spans |= {line.name: (line.low, line.high) for line in self.lines}
        for name, (low, high) in spans.items():
            room = _ROUNDING * max(abs(low), abs(high))
            if not low - room <= values[name] <= high + room:
                return name
        return None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Rater:
    """Solves cases of a check and rates them: ln mu.

    Attributes
    ----------
    check : CheckByCase
        The check.
    solver : CaseSolver
        Of the cases.
    scale : float
        Factor on a utilisation that takes off the numerical error's upper side [-].
    """

    check: CheckByCase
    solver: CaseSolver
    scale: float = 1.0

    def rate(self, result: CaseResult, moved: Mapping[str, float]) -> float | None:
        """Value of ln mu in a case with some quantities moved; None without a force."""
        used = self.check.utilisation(result)
        if not used or used <= 0.0 or not math.isfinite(used):
            return None
        return math.log(used * self.scale * self._widen(moved))

    def _widen(self, moved: Mapping[str, float]) -> float:
        """Load of the support by its end, of what is moved over that of the row."""
        if self.check.row.ground.kind != "sliding":
            return 1.0
        ranges = self.check.ranges
        now = self.check.widen(ranges)
        for name in _WIDENING:
            if name in moved:
                ranges = ranges.with_value(name, moved[name])
        return self.check.widen(ranges) / now if now else 1.0

    def solve(
        self, case: Case, moved: Sequence[Mapping[str, float]]
    ) -> list[float | None]:
        """Values of ln mu in a case, each with some quantities moved.

        None of a case without a result.
        """
        cases = [move(case, change) for change in moved]
        wanted = [(self.check.row, change, self.solver.law) for change in cases]
        results = self.solver.solve_all(wanted)
        return [
            self.rate(result, change)
            for result, change in zip(results, moved, strict=True)
        ]


def move(case: Case, moved: Mapping[str, float]) -> Case:
    """Case with some quantities moved, the thickness before the glide."""
    for name in PARAMETERS:
        if name in moved:
            case = case.with_value(name, moved[name])
    return case


def build_response(rater: Rater, lines: Sequence[Line]) -> Response:
    """Model of a check from its solved cases, and one solve along each line.

    Parameters
    ----------
    rater : Rater
        Of the check.
    lines : sequence of Line
        Of the other quantities, without slopes.

    Raises
    ------
    ModelError
        If there are too few cases, or one of a line has no result.
    """
    check = rater.check
    axes = tuple(
        (name, span) for name, span in check.ranges.intervals if span.low < span.high
    )
    rates = [(result, rater.rate(result, {})) for result in check.results]
    rated = {result.case: rate for result, rate in rates if rate is not None}
    if check.governing not in rated:
        raise ModelError(say("reliability.no_case"))
    base = rated[check.governing]
    if len(rated) < count_trend_terms(len(axes)) + _SPARE and axes:
        raise ModelError(say("reliability.few_cases", count=len(rated)))
    solved = _solve_beside(rater, lines)
    model, ends = _fit(axes, rated) if axes else (None, np.zeros((2, 0)))
    fitted = tuple(
        line.meet(value, rate - base)
        for line, (value, rate) in zip(lines, solved, strict=True)
    )
    return Response(axes=axes, model=model, base=base, ends=ends, lines=fitted)


def _solve_beside(rater: Rater, lines: Sequence[Line]) -> list[tuple[float, float]]:
    """Solved value of each line, and ln mu there in the governing case.

    A value without a result comes nearer to that of the governing case.

    Raises
    ------
    ModelError
        If it has none nearby either.
    """
    values = [line.solved for line in lines]
    for _ in range(_TRIES):
        moved = [{line.name: value} for line, value in zip(lines, values, strict=True)]
        rated = rater.solve(rater.check.governing, moved)
        rates = [rate for rate in rated if rate is not None]
        if len(rates) == len(values):
            return list(zip(values, rates, strict=True))
        values = [
            value if rate is not None else math.sqrt(value * line.centre)
            for line, value, rate in zip(lines, values, rated, strict=True)
        ]
    raise ModelError(say("reliability.no_solve"))


def _place(axes: Sequence[tuple[str, Interval]], values: Values) -> Floats:
    """Coordinates (n, axes) in the unit cube of the axes."""
    columns = [
        (values[name] - span.low) / (span.high - span.low) for name, span in axes
    ]
    return np.array(columns).T


def _fit(
    axes: Sequence[tuple[str, Interval]], rated: Mapping[Case, float]
) -> tuple[Surrogate, Floats]:
    """Model over the coordinates of the axes, and the ends of what was solved."""
    columns = {
        name: np.array([case.values[name] for case in rated]) for name, _ in axes
    }
    places = _place(axes, columns)
    if not supports_model(places):
        raise ModelError(say("reliability.few_cases", count=len(rated)))
    rates = np.array(list(rated.values()))
    ends = np.vstack([places.min(axis=0), places.max(axis=0)])
    return fit_surrogate(places, rates[:, None]), ends
