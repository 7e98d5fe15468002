"""Largest value of a quantity at which one case of a check passes."""

from __future__ import annotations

import math
from collections.abc import Mapping

from netdesign.envelope.ranges import Case
from netdesign.study.probe import Probe
from netdesign.study.target import Move, Target
from netdesign.words.message import Message, say

LEAST_POWER = 0.2  # of a force in a quantity, that a secant is taken with
_UNITS = {"density": "kg/m³", "thickness": "m"}  # of what is searched
_MOST_STEPS = 14
_NEAR = 2e-3  # a root is found when the utilisation lies this close below 1
_GOAL = math.log(1.0 - 0.5 * _NEAR)
_APART = 0.03  # logarithms of the points of a curve
_GUESSED_STEPS = 2  # by how the force goes in other cases, before secants


def refuse(key: str, quantity: str, value: float, **more: Message) -> Message:
    """Remark why a value is none, with its unit."""
    return say(key, value=value, unit=_UNITS[quantity], **more)


def round_down(value: float, step: float) -> float:
    """Largest multiple of a step that is not above a value."""
    return round(math.floor(value / step + 1e-9) * step, 6)


class Root:
    """Search for the largest value at which one case passes.

    The force grows about like a power of the value. A bracket keeps every step between
    a value that passes and one that fails. Multiples of a step are tried, since one of
    them is told: the last one that passes.
    """

    def __init__(
        self,
        target: Target,
        probe: Probe,
        quantity: str,
        case: Case,
        limits: tuple[float, float],
        power: float,
        step: float,
    ) -> None:
        """Take what is searched; ``power`` is a first guess.

        Values at which the case was solved before are known, and about how the force
        goes from other cases.
        """
        self._target, self._probe, self._case = target, probe, case
        self._quantity, self._limits, self._step = quantity, limits, step
        self._passes, self._fails = limits
        self._known_pass = self._known_fail = False
        self._power = power
        self._seen: dict[float, float] = {}  # utilisation by value
        self._curve = _Curve(target.list_estimates(probe, quantity))

    def find(self, start: float) -> float | Message:
        """The value, or why there is none."""
        value = self._begin(start)
        for _ in range(_MOST_STEPS):
            used = self._solve(value)
            if isinstance(used, Message):
                return used
            self._seen[value] = used
            self._power = self._find_power(value)
            if used <= 1.0 and self._is_last(value, used):
                return value
            if used <= 1.0:
                self._passes, self._known_pass = value, True
            else:
                self._fails, self._known_fail = value, True
                if value == self._limits[0]:
                    return refuse("change.not_even", self._quantity, value)
            if self._is_narrow():
                return self._passes
            value = self._aim(value)
            if self._known_pass and value < self._passes + self._step:
                return self._passes
        return say("change.not_settled")

    def _begin(self, start: float) -> float:
        """First value: by the curve, else where the search is told to start."""
        if self._curve.rises:
            start = round_down(math.exp(self._curve.read(_GOAL)), self._step)
        return min(max(start, self._passes), self._fails)

    def _solve(self, value: float) -> float | Message:
        move = Move(name=self._quantity, value=value)
        (result,) = self._target.solve(self._probe, [self._case], move)
        used = self._target.utilisation(result, move)
        if used is None:
            return refuse("change.case_without_result", self._quantity, value)
        return used if used > 0.0 else say("change.member_slack")

    def _is_last(self, value: float, used: float) -> bool:
        """One step more would fail, or is none."""
        one_more = used * (1.0 + self._step / value) ** self._power
        return one_more >= 1.0 - _NEAR or value == self._limits[1]

    def _is_narrow(self) -> bool:
        is_bracket = self._known_pass and self._known_fail
        return is_bracket and self._fails - self._passes < 1e-3 * self._fails

    def _aim(self, last: float) -> float:
        """Value to be tried next, by the nearest values on both sides."""
        rise = _GOAL - math.log(self._seen[last])
        aim = self._keep_inside(last * math.exp(rise / self._power))
        told = round_down(aim, self._step)
        return told if self._passes < told < self._fails != aim else aim

    def _find_power(self, last: float) -> float:
        """Power of the utilisation between the last value and the root."""
        others = [value for value in self._seen if value != last]
        at, used = math.log(last), math.log(self._seen[last])
        if len(others) < _GUESSED_STEPS:
            way = self._curve.measure(used, _GOAL)
            power = (_GOAL - used) / way if way else self._power
        else:
            other = others[-1]
            rise = used - math.log(self._seen[other])
            power = rise / (at - math.log(other))
        return power if power > LEAST_POWER else self._power

    def _keep_inside(self, aim: float) -> float:
        """Aim, unless it leaves the bracket: then its middle, or its unproven end."""
        if self._passes < aim < self._fails:
            return aim
        if aim >= self._fails and not self._known_fail:
            return self._fails
        if aim <= self._passes and not self._known_pass:
            return self._passes
        return 0.5 * (self._passes + self._fails)


class _Curve:
    """Logarithm of a value by that of the utilisation there: a parabola, or a line.

    Through the points next to a utilisation of 1 on both sides, and a third one that is
    not close beside them.
    """

    def __init__(self, used: Mapping[float, float]) -> None:
        """Take values with their utilisation."""
        logs = [(math.log(one), math.log(value)) for value, one in used.items() if one]
        logs.sort(key=lambda point: abs(point[0]))
        sides = [
            [p for p in logs if (p[0] > 0.0) is is_above] for is_above in (False, True)
        ]
        nearest = [side[0] for side in sides if side]
        for at, value in logs:
            if len(nearest) < 3 and all(abs(at - p[0]) > _APART for p in nearest):
                nearest.append((at, value))
        self._points = sorted(nearest)
        values = [value for _, value in self._points]
        self.rises = len(values) > 1 and values == sorted(set(values))

    def measure(self, start: float, end: float) -> float:
        """Way of the value from one utilisation to another; 0 if it does not rise."""
        return self.read(end) - self.read(start) if self.rises else 0.0

    def read(self, used: float) -> float:
        """Lagrange's polynomial through the points."""
        total = 0.0
        for place, (at, value) in enumerate(self._points):
            others = [one for k, (one, _) in enumerate(self._points) if k != place]
            total += value * math.prod((used - one) / (at - one) for one in others)
        return total
