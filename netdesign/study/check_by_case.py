"""One check as a function of a solved case, and of what is moved in its row.

A moved quantity is moved everywhere: in the cases, in the ranges that the guideline's
load is searched over, and in the row, whose end effect may follow it.

The value at which a check turns (`CheckLine`): a force grows about like a power of the
value. Two points bracket it, one that passes and one that fails; it is found in the
governing case, then confirmed in every case near to governing. A case that fails there
takes over.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count

from netdesign.envelope.parameters import PARAMETERS, Parameter
from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import Message

TRIED_DENSITIES = (150.0, 600.0)  # [kg/m3], of snow that a search may try
# Quantities that a glide factor follows from.
_ON_GLIDE = ("thickness", "snow_height", "slip_length", "glide_factor")
# What the load of a support follows beside the forces of its cases: the width at an end
# goes with the glide factor, the tilt of a post with the net's inclination.
_WIDENING = (*_ON_GLIDE, "inclination")
# What the guideline's load does not know; it has densities of its own.
_NOT_IN_FLOOR = ("density", "friction_angle", "upslope_length")
_RIVAL = 0.9  # share of the governing force from which a case may take over
_BESIDE = 0.13  # of every range: an eighth, and its rounding


@dataclass(frozen=True, slots=True, kw_only=True)
class Setting:
    """Another single value of a quantity, named as in ``parameters.PARAMETERS``, SI."""

    name: str
    value: float

    def at(self, case: Case) -> Case:
        """Case with the quantity at this value."""
        return case.with_value(self.name, self.value)

    def on(self, ranges: Ranges) -> Ranges:
        """Ranges with the quantity at this value."""
        return ranges.with_value(self.name, self.value)


@dataclass(frozen=True, slots=True, kw_only=True)
class Push:
    """A rope's pull along the row that adds to a force, by the guy of its end.

    Attributes
    ----------
    force, rope : str
        What it adds to, and whose pull it is.
    ratio : float
        Of what it adds to the rope's pull [-].
    """

    force: str
    rope: str
    ratio: float


@dataclass(frozen=True, kw_only=True)
class CheckByCase:
    """One check as a function of a solved case.

    Attributes
    ----------
    row, ranges : NetRow, Ranges
        What is checked, and over what.
    member : str
        Whose force.
    scale : float
        Utilisation for each N of the upper end of the solved force [1/N].
    added, rise : float
        Utilisation by what is added to the largest force [-], and what that grows by
        for each such force more. Another force brings it: it is taken to stay where
        the member's falls, and to grow as the member's does.
    beside : tuple of (str, float)
        Another force of the same member, by the section or by the panel between posts,
        with its ``scale``: the larger utilisation counts.
    governing : Case
        Case of the largest force.
    results : sequence of CaseResult
        Of the whole grid, or of the search.
    use_floor : callable
        Utilisation by the guideline's load alone, over some ranges of the row, on a
        support as wide as now, 0 without a floor [-].
    bound_floor : callable
        Two ends between which what ``use_floor`` finds lies, at a part of its cost.
    widen : callable
        Load of the support over some ranges of the row, in any unit: the end effect
        grows with the glide factor, the force along a base with the tilt of its post.
    push : Push or None
        What a rope adds to one of the forces.
    """

    row: NetRow
    ranges: Ranges
    member: str
    scale: float
    governing: Case
    results: Sequence[CaseResult]
    use_floor: Callable[[Ranges], float] = lambda _: 0.0
    bound_floor: Callable[[Ranges], tuple[float, float]] = lambda _: (0.0, math.inf)
    widen: Callable[[Ranges], float] = lambda _: 1.0
    added: float = 0.0
    rise: float = 0.0
    beside: tuple[tuple[str, float], ...] = ()
    push: Push | None = None

    @cached_property
    def largest(self) -> float:
        """Largest force of the member over the solved cases [N]."""
        return max(self.force(one) for one in self.results if self.has_result(one))

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """Names of all forces that the check follows."""
        beside = tuple(name for name, _ in self.beside)
        rope = (self.push.rope,) if self.push is not None else ()
        return (self.member, *beside, *rope)

    def has_result(self, result: CaseResult) -> bool:
        """All forces are known that the check follows."""
        return all(name in result.member_forces for name in self._names)

    def force(self, result: CaseResult) -> float:
        """Upper end of the member's force in a case [N]."""
        return self._read(result, self.member)

    def _read(self, result: CaseResult, name: str) -> float:
        """Upper end of a force in a case, with what a rope adds to it [N]."""
        force, push = result.member_forces[name].high, self.push
        if push is None or push.force != name:
            return force
        return force + push.ratio * result.member_forces[push.rope].high

    @property
    def is_slack(self) -> bool:
        """Slackness: the member carries nothing in any solved case."""
        return all(not self.utilisation(result) for result in self.results)

    def solve(self, solver: CaseSolver, case: Case, setting: Setting) -> CaseResult:
        """Result of a case of the row with what is moved.

        What a move leaves as it is was solved in the search: it is not solved again.
        """
        known = self._find_unmoved(case, setting)
        if known is not None:
            return known
        (solved,) = solver.solve_all([(self.row, setting.at(case), solver.law)])
        return solved

    def _find_unmoved(self, case: Case, setting: Setting) -> CaseResult | None:
        """Result of a solved case that already has the value; None of any other."""
        if self.find_value(case, setting.name) != setting.value:
            return None
        same = (one for one in self.results if one.case == case)
        return next((one for one in same if self.has_result(one)), None)

    def utilisation(
        self, result: CaseResult, setting: Setting | None = None
    ) -> float | None:
        """Upper end of the utilisation in a case [-]; None if it has no result.

        ``setting`` is what was moved in the case.
        """
        if not self.has_result(result):
            return None
        used = self.use(self.force(result))
        for name, scale in self.beside:
            used = max(used, scale * self._read(result, name) + self.added)
        return used * self._compare_width(setting)

    def find_value(self, case: Case, name: str) -> float | None:
        """Value that a case has, or the row in it as far as it may be asked for."""
        if name == "thickness":  # or the snow height ranges, which is the same
            return self.row.at(case).snow_thickness
        return case.values.get(name)

    def use_least(self, setting: Setting | None = None) -> float:
        """Utilisation by the guideline's load alone [-], of what is moved."""
        return self.use_floor(self._range_floor(setting)) * self._compare_width(setting)

    def use_about(self, setting: Setting) -> float:
        """Utilisation by the guideline's load alone, on the same side of 1 [-].

        As exact as its lower end, where its two ends tell that side.
        """
        width = self._compare_width(setting)
        least, most = (
            width * one for one in self.bound_floor(self._range_floor(setting))
        )
        return least if most <= 1.0 or least > 1.0 else self.use_least(setting)

    def use_more(self, used: float, setting: Setting) -> float:
        """Larger one of a utilisation and that by the guideline's load [-].

        Which floor a check beyond 1 has is not asked.
        """
        return used if used > 1.0 else max(used, self.use_about(setting))

    def _range_floor(self, setting: Setting | None) -> Ranges:
        """Ranges that the guideline's load is searched over."""
        is_still = setting is None or setting.name in _NOT_IN_FLOOR
        return self.ranges if is_still or setting is None else setting.on(self.ranges)

    def use(self, force: float) -> float:
        """Utilisation by a force of the member [-]."""
        added = self.added
        if self.rise and self.largest:
            added += self.rise * max(0.0, force / self.largest - 1.0)
        return self.scale * force + added

    def _compare_width(self, setting: Setting | None) -> float:
        """Load of the moved row's support by its end over that of the row as is."""
        if setting is None or setting.name not in _WIDENING:
            return 1.0
        now, moved = self.widen(self.ranges), self.widen(setting.on(self.ranges))
        if now == 0.0:
            return math.inf if moved else 1.0
        return moved / now


def list_near(check: CheckByCase) -> list[Case]:
    """Cases whose force is near the largest, that first; of a search some of them."""
    forces = {
        result.case: check.force(result)
        for result in check.results
        if check.has_result(result)
    }
    least = _RIVAL * max(forces.values())
    near = [case for case in forces if forces[case] >= least]
    near.sort(key=lambda case: (-forces[case], case))
    return near if check.ranges.is_grid else _thin_out(near, check.ranges)


def _thin_out(cases: Sequence[Case], ranges: Ranges) -> list[Case]:
    """Cases without those close beside an earlier one.

    A search crowds its cases around the largest force; what lies between those that
    are left is in the margin of the check.
    """
    reach = [_BESIDE * (span.high - span.low) for _, span in ranges.intervals]
    kept: dict[Case, list[float]] = {}
    for case in cases:
        values = case.values
        point = [values[axis] for axis, _ in ranges.intervals]
        if not any(_is_beside(point, other, reach) for other in kept.values()):
            kept[case] = point
    return list(kept)


def _is_beside(
    point: Sequence[float], other: Sequence[float], reach: Sequence[float]
) -> bool:
    sides = zip(point, other, reach, strict=True)
    return all(abs(one - beside) <= most for one, beside, most in sides)


_CLOSE = 0.004  # below a utilisation of 1: near enough
_GOAL = 0.3  # of that: what is aimed at
_GOAL_SHARE, _CLOSE_SHARE = 0.25, 0.6  # or these shares of what the check has left
_LEAST_USED = 1e-3  # of a member that is slack at one end
_MOST_STEPS = 14
_DIGITS = 3  # of a value that is stated
_FINEST = 1e-3  # of the search's length: no value is stated finer than its decade


class NoResultError(Exception):
    """A case has no result at a value."""

    def __init__(self, value: float, reason: Message | str | None) -> None:
        """Keep the value [SI] and the reason of the failed case."""
        super().__init__(f"no result at {value}: {reason}")
        self.value = value


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """A value [SI] and the utilisation there [-]."""

    value: float
    used: float

    @property
    def passes(self) -> bool:
        """The check passes there."""
        return self.used <= 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckLine:
    """One check along one quantity, in the cases near to governing.

    Attributes
    ----------
    check : CheckByCase
        The check.
    quantity : str
        Name as in ``parameters.PARAMETERS``.
    cases : sequence of Case
        Cases in which a value is confirmed, the governing one first.
    ends : (float, float)
        Between which the quantity is searched [SI].
    solver : CaseSolver
        Solves each case once.
    close : float
        A value is near enough to where the check turns with a utilisation so far below
        1 [-].
    """

    check: CheckByCase
    quantity: str
    cases: Sequence[Case]
    ends: tuple[float, float]
    solver: CaseSolver
    close: float = _CLOSE

    @property
    def parameter(self) -> Parameter:
        """The quantity, with its unit."""
        return PARAMETERS[self.quantity]

    def find_use(self, value: float) -> Point:
        """Largest utilisation at a value; once it exceeds 1, that of the first cases.

        Raises
        ------
        NoResultError
            If a case has no result there.
        """
        used = 0.0
        for case in self._list_cases(value):
            used = max(used, self.find_case_use(value, case))
            if used > 1.0:
                break
        return Point(value=value, used=used)

    def find_case_use(self, value: float, case: Case) -> float:
        """Utilisation at a value in one case, by the guideline's load too [-]."""
        setting, used = Setting(name=self.quantity, value=value), 0.0
        if not self.check.is_slack:
            result = self.check.solve(self.solver, case, setting)
            known = self.check.utilisation(result, setting)
            if known is None:
                raise NoResultError(value, result.reason or result.outcome.message)
            used = known
        return self.check.use_more(used, setting)

    def find_turn(self, passing: Point, failing: Point) -> float | None:
        """Last value that passes, on the way from one that does to one that fails [SI].

        It is rounded to the side that passes. The passing one that was given where no
        rounded value lies between; None if that fails in some case.

        Raises
        ------
        NoResultError
            If a case has no result on the way.
        """
        active = self.cases[0]
        while True:
            found = self._approach(active, passing, failing)
            failing_case = self._find_failing(found)
            if failing_case is None:
                return found
            if found == passing.value:
                return None
            active, failing = failing_case

    def _find_failing(self, value: float) -> tuple[Case, Point] | None:
        """First case that fails at a value, and its utilisation there."""
        for case in self._list_cases(value):
            used = self.find_case_use(value, case)
            if used > 1.0:
                return case, Point(value=value, used=used)
        return None

    def _approach(self, case: Case, passing: Point, failing: Point) -> float:
        """Last rounded value of a bracket that passes in one case."""
        left = 1.0 - passing.used
        goal = 1.0 - min(_GOAL * self.close, _GOAL_SHARE * left)
        close = 1.0 - min(self.close, _CLOSE_SHARE * left)
        for step in count():
            # a kink misleads a secant: every third step halves the bracket
            share = 0.5 if step % 3 == 2 else _find_share(passing, failing, goal)
            value = self._round(_place(passing.value, failing.value, share), passing)
            least, most = sorted((passing.value, failing.value))
            if not least < value < most:
                break
            point = Point(value=value, used=self.find_case_use(value, case))
            if point.passes:
                passing = point
            else:
                failing = point
            if (point.passes and point.used >= close) or step == _MOST_STEPS:
                break
        return passing.value

    def _list_cases(self, value: float) -> list[Case]:
        """Cases that differ at a value; of those that it makes equal the first."""
        at = Setting(name=self.quantity, value=value)
        unlike = {at.at(case): case for case in reversed(self.cases)}
        return list(reversed(unlike.values()))

    def _round(self, value: float, passing: Point) -> float:
        """Value rounded to the side that passes, in the unit of its key [SI]."""
        show = self.parameter.show
        step = self.find_step(show(value))
        shown = show(value) / step
        is_up = value < passing.value
        whole = math.ceil(shown - 1e-9) if is_up else math.floor(shown + 1e-9)
        return self.parameter.read(round(whole * step, 12))

    def find_step(self, shown: float) -> float:
        """Power of ten to whose multiples a value is rounded."""
        low, high = (self.parameter.show(end) for end in self.ends)
        finest = math.floor(math.log10(_FINEST * (high - low)))
        if shown == 0.0:
            return float(10.0**finest)
        of_digits = math.floor(math.log10(abs(shown))) - _DIGITS + 1
        return float(10.0 ** max(of_digits, finest))


def _find_share(passing: Point, failing: Point, goal: float) -> float:
    """Share of the way from a passing point at which a utilisation is expected [-]."""
    low = max(passing.used, _LEAST_USED)
    return math.log(goal / low) / math.log(failing.used / low)


def _place(passing: float, failing: float, share: float) -> float:
    """Value at a share of the way between two.

    A force goes as a power of the value; where that may be zero, as an exponential of
    its root: the sag of a net goes like the root of its slack.
    """
    if min(passing, failing) > 0.0:
        return passing * math.pow(failing / passing, share)
    root = math.sqrt(passing) * (1.0 - share) + math.sqrt(failing) * share
    return root**2
