"""One check as a function of a solved case, and of what is moved in its row.

A moved quantity is moved everywhere: in the cases, in the ranges that the guideline's
load is searched over, and in the row, whose end effect may follow it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.study.case_solver import CaseSolver

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
        return self._largest[self.member]

    @cached_property
    def _largest(self) -> dict[str, float]:
        """Largest forces that the check follows, over the solved cases [N]."""
        known = [one for one in self.results if self.has_result(one)]
        names = (self.member, *(name for name, _ in self.beside))
        return {name: max(self._read(one, name) for one in known) for name in names}

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """Names of all forces that the check follows."""
        beside = tuple(name for name, _ in self.beside)
        rope = (self.push.rope,) if self.push is not None else ()
        return (self.member, *beside, *rope)

    def has_result(self, result: CaseResult) -> bool:
        """All forces are known that the check follows."""
        return all(name in result.member_forces for name in self._names)

    def share(self, result: CaseResult) -> float:
        """Share of their largest values that its forces have in a case, the least [-].

        1 where they have none in any case, below 0 in a case without a result.
        """
        if not self.has_result(result):
            return -1.0
        largest = self._largest
        return min(
            self._read(result, name) / largest[name] if largest[name] else 1.0
            for name in largest
        )

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

    def solve(
        self, solver: CaseSolver, cases: Sequence[Case], setting: Setting
    ) -> list[CaseResult]:
        """Results of some cases of the row with what is moved.

        What a move leaves as it is was solved in the search: it is not solved again.
        """
        known = {case: self._find_unmoved(case, setting) for case in cases}
        moved = [case for case in cases if known[case] is None]
        solved = solver.solve_all(
            [(self.row, setting.at(case), solver.law) for case in moved]
        )
        found = known | dict(zip(moved, solved, strict=True))
        return [one for case in cases if (one := found[case]) is not None]

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
