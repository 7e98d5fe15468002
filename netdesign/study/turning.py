"""Value of one quantity at which a check turns, found by solves of the coupled problem.

A force grows about like a power of the value. Two points bracket the value, one that
passes and one that fails; it is found in the governing case, then confirmed in every
case near to governing. A case that fails there takes over.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count

from netdesign.envelope.parameters import PARAMETERS, Parameter
from netdesign.envelope.ranges import Case
from netdesign.study.case_solver import CaseSolver
from netdesign.study.check_by_case import CheckByCase, Setting
from netdesign.words.message import Message

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
            (result,) = self.check.solve(self.solver, [case], setting)
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
