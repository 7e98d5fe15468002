"""Checks beyond 1 at the best ends of what is assumed, and the value that decides them.

Density, friction and inclination are design ranges: a row must hold over all of them.
What is assumed of the product or the geometry has one true value, which is not known.
A check fails where it does at the best ends of that, too; else it is not proven, and
says from which value on it passes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import product

from netdesign.checks import Check, OpenKind, Rating
from netdesign.envelope.ranges import Case
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Verdict
from netdesign.site.assumed import Assumed
from netdesign.site.model import NetRow
from netdesign.structure.members import ROPE_OF
from netdesign.study.case_records import read_point, record_point
from netdesign.study.member_checks import MemberCheck
from netdesign.study.member_force import MemberForce, RowForces
from netdesign.study.row_to_check import (
    CaseSolver,
    RowToCheck,
    place_variant,
    read_values,
)
from netdesign.study.row_variants import (
    find_forces_alone,
    find_least_forces,
    take_off_truss,
)
from netdesign.study.scopes import is_of_structure
from netdesign.study.worst_checks import find_least
from netdesign.words.message import Message, say

# What is searched with the cases, but is no design range.
SEARCHED = ("slack", "net_stiffness", "glide_factor")
_SAGS = ("ridge_sag", "lower_sag")
_PULLS = frozenset(("T_r", "T_b", "E_t"))  # symbols of what a rope brings to a check
_MANY = 100  # posts: both ends of the row are far from each other
_PARTS = 8  # of a range, among which is the value from which on a check passes
_FindForces = Callable[[RowToCheck, NetRow, RowEnvelope], RowForces]
_TakeOff = Callable[[RowForces], RowForces]
_BETTER = 0.99  # a utilisation below this share of the worst one is told


def settle(
    task: RowToCheck, variants: Sequence[RowForces], judged: Sequence[MemberCheck]
) -> list[MemberCheck]:
    """Checks of a row as they are at the best ends of what is assumed of it.

    Parameters
    ----------
    task : RowToCheck
        The row with what is assumed of it, and what solves its cases.
    variants : sequence of RowForces
        What its cases tell at the corners of its statics.
    judged : sequence of MemberCheck
        Each where it is worst, eased to the best end of the row's statics.

    Verified by
    -----------
    tests/study/test_best_ends.py
    """
    forces_at: dict[object, RowForces | None] = {
        _name(forces.row): forces for forces in variants
    }
    ends = (_BestEnds(task=task, forces_at=forces_at, judged=each) for each in judged)
    return [each.settle() for each in ends]


def _take_off_ropes(forces: RowForces) -> RowForces:
    """The row whose border ropes pull no support along it."""
    end = forces.row.row_end
    row = replace(forces.row, row_end=end and replace(end, ropes_slide=True))
    pulls = tuple(pull for pull in forces.pulls if pull.position != "second")
    return replace(forces, row=row, pulls=pulls, end_guy=None)


def _has_open_truss(row: NetRow) -> bool:
    """The stiffness that shares a pull between ropes and end post is assumed."""
    return row.row_end is not None and len(row.row_end.stiffnesses) > 1


def _leave_to_sags(check: Check) -> Check:
    return check.ease(0.0).with_open(OpenKind.ASSUMED_DECIDES, say("assumed.by_sags"))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Option:
    """An assumed value: what a check is at its other end, and between.

    ``worst`` and ``other`` are the ends in SI units, ``rate`` the upper end of the
    utilisation at a share of the way from the one to the other [-].
    """

    assumed: Assumed
    worst: float
    other: float
    rate: Callable[[float], float]

    def place(self, share: float) -> float:
        """Value at a share of the way to the other end."""
        return _mix(self.worst, self.other, share)

    def show(self, value: float) -> Message:
        """Value in words, with its unit."""
        return replace(self.assumed, low=value, high=value).text


@dataclass(frozen=True, slots=True, kw_only=True)
class _BestEnds:
    """Check of a member at other values of what is assumed of its row.

    ``forces_at`` keeps the forces at each of them, for all checks of the row; ``rates``
    the upper ends of the utilisation by these, each with its place in memory.
    """

    task: RowToCheck
    forces_at: dict[object, RowForces | None]
    judged: MemberCheck
    rates: dict[int, float] = field(default_factory=dict)

    @property
    def searched(self) -> list[Assumed]:
        """What is assumed of the net, and searched with its cases."""
        assumed = (self.task.row.find_assumed(key) for key in SEARCHED)
        return [each for each in assumed if each is not None and each.is_range]

    @property
    def best(self) -> RowForces:
        """Forces of the variant on which the member is least used.

        In a long row, where the number of posts is assumed.
        """
        forces = self.judged.best or self.judged.forces
        if not self._are_posts_open:
            return forces
        row = replace(forces.row, post_count=_MANY)
        key = (_name(row), _MANY)
        if key not in self.forces_at:
            solved = self.task.solved.on_layout(row.layout)
            self.forces_at[key] = find_forces_alone(self.task, row, solved)
        return self.forces_at[key] or forces

    @property
    def _are_posts_open(self) -> bool:
        return self.row.has_end and self.row.post_count is None

    @property
    def row(self) -> NetRow:
        """Variant on which the check is worst."""
        return self.judged.forces.row

    def settle(self) -> MemberCheck:
        """Check at the best ends, with the value that decides it."""
        check = self.judged.check
        high = check.utilisation_band[1]
        is_beyond = check.is_unbounded or (high is not None and high > 1.0)
        if is_beyond and self._is_rope_of_assumed_sag():
            return replace(self.judged, rated=_leave_to_sags(check))
        if self.judged.again is None or not is_beyond:
            return self.judged
        if check.verdict is Verdict.FAIL and self._are_posts_open:
            check = self._ease(lambda forces: forces, "assumed.by_posts")
        for key, take_off in self._list_pulls():
            if check.verdict is Verdict.FAIL:
                check = self._ease(take_off, key)
        if check.verdict is Verdict.FAIL:
            check = check.ease(self._find_least())
        if check.verdict is not Verdict.FAIL and (deciding := self._tell()):
            check = check.with_open(OpenKind.ASSUMED_DECIDES, deciding)
        return replace(self.judged, rated=check)

    @property
    def _are_sags_assumed(self) -> bool:
        return any(map(self.task.row.find_assumed, _SAGS))

    def _is_rope_of_assumed_sag(self) -> bool:
        """A border rope or end guy whose pull follows from a sag that is assumed.

        Such pulls lie far above the one that was measured: they leave a part of the
        structure open, and never make it fail.
        """
        check = self.judged.check
        is_rope = check.member in ROPE_OF and is_of_structure(check)
        return is_rope and self._are_sags_assumed

    def _has_open_pull(self) -> bool:
        """A border rope pulls the member, and its sag or its sliding is assumed."""
        end, check = self.row.row_end, self.judged.check
        if end is None or check.member in ROPE_OF:
            return False
        may_slide = self.judged.width.position == "second" and end.ropes_slide is None
        is_pulled = not _PULLS.isdisjoint(check.step_of)
        return is_pulled and (may_slide or self._are_sags_assumed)

    def _list_pulls(self) -> Iterator[tuple[str, _TakeOff]]:
        """What brings a pull to the member only by what is assumed without a range."""
        if self._has_open_pull():
            yield "assumed.by_ropes", _take_off_ropes
        if _has_open_truss(self.row):
            yield "assumed.by_stiffness", take_off_truss

    def _ease(self, take_off: _TakeOff, key: str) -> Check:
        """Ease the check where it passes without the pull that an assumption brings."""
        check, low = self.judged.check, _find_low(self._judge(take_off(self.best)))
        worst = _rate(check.rating)
        if not 0.0 < low <= 1.0 or math.isinf(worst):
            return check
        deciding = say(key, used=worst, without=low)
        return check.ease(low).with_open(OpenKind.ASSUMED_DECIDES, deciding)

    def _find_least(self) -> float:
        """Low end of the utilisation at the best corner of what is searched [-].

        In the case that governs the check, at its density, friction and inclination:
        over all cases it is no less. Of the panels what any brings at least. 0
        where that cannot be calculated.
        """
        row = self.best.row
        if not self.searched:
            return _find_low(self._judge(self._find_best_panels(row)))
        names = [each.key for each in self.searched]
        corners = product(*((each.low, each.high) for each in self.searched))
        at = (dict(zip(names, corner, strict=True)) for corner in corners)
        at_corners = (self._find_at(row, values, find_least_forces) for values in at)
        return min(_find_low(self._judge(forces)) for forces in at_corners)

    def _find_best_panels(self, row: NetRow) -> RowForces | None:
        """Forces at a corner over all cases, with the best of the assumed panels."""
        key = (_name(row), find_least_forces.__name__)
        if key not in self.forces_at:
            solved = self.task.solved.on_layout(row.layout)
            self.forces_at[key] = find_least_forces(self.task, row, solved)
        return self.forces_at[key]

    def _judge(self, forces: RowForces | None) -> Rating | None:
        if forces is None or self.judged.again is None:
            return None
        return self.judged.again(forces).rating

    def _rate(self, forces: RowForces | None) -> float:
        if id(forces) not in self.rates:
            self.rates[id(forces)] = _rate(self._judge(forces))
        return self.rates[id(forces)]

    def _tell(self) -> Message | None:
        """Name the assumed value that lowers the utilisation most, if one does."""
        worst = _rate(self.judged.rating)
        options = [*self._vary_statics(), *self._vary_searched()]
        rated = [(each.rate(1.0), each) for each in options]
        least, option = min(rated, key=lambda each: each[0], default=(math.inf, None))
        if option is None or not least < _BETTER * worst:
            return self._tell_pull(worst)
        numbers: dict[str, Message | float] = {
            "name": option.assumed.name,
            "at": option.show(option.worst),
            "used": least if math.isinf(worst) else worst,
        }
        if least > 1.0:
            other = option.show(option.other)
            return say("check.assumed_lowers", **numbers, other=other, least=least)
        bound = option.show(_round(option, _find_share(option.rate)))
        if option.other < option.worst:
            return say("check.assumed_decides_up_to", **numbers, bound=bound)
        return say("check.assumed_decides", **numbers, bound=bound)

    def _tell_pull(self, worst: float) -> Message | None:
        """Name what is assumed of ropes without which the check passes.

        Of a check that failed beside it that is told already.
        """
        for key, take_off in self._list_pulls():
            without = _rate(self._judge(take_off(self.judged.forces)))
            fails = self.judged.check.verdict is Verdict.FAIL
            if without <= 1.0 and worst < math.inf and not fails:
                return say(key, used=worst, without=without)
        return None

    def _vary_statics(self) -> Iterator[_Option]:
        """Other ends of what is assumed of the row's statics, each alone."""
        for key, worst in read_values(self.row).items():
            assumed = self.task.row.find_assumed(key)
            if assumed is None or not assumed.is_range:
                continue
            if key == "guy_count" and worst == assumed.high:
                continue  # a single guy holds nothing along the row
            other = assumed.low if worst == assumed.high else assumed.high
            rate = partial(self._rate_statics, key, worst, other)
            yield _Option(assumed=assumed, worst=worst, other=other, rate=rate)

    def _rate_statics(
        self, key: str, worst: float, other: float, share: float
    ) -> float:
        """Utilisation at another value: at the end over all cases, else in proportion.

        That is to the governing case, at the same value of all else.
        """
        values = read_values(self.row)
        values[key] = _mix(worst, other, share)
        if key == "guy_count":
            splay = self.task.row.find_assumed("guy_splay")
            if splay is not None:
                values["guy_splay"] = splay.high
        row, force = place_variant(self.task.row, values), self.judged.force
        if share == 1.0:
            return self._rate(self.forces_at.get(_name(row)))
        if key == "guy_count" or force is None:
            return math.inf
        here, there = (
            self._rate(self._find_alone(at, force)) for at in (self.row, row)
        )
        return _scale(self.judged.rating, here, there)

    def _vary_searched(self) -> Iterator[_Option]:
        """Other ends of what is searched with the cases, each alone."""
        case = self.judged.check.case
        values = read_point(case).values if case else {}
        for assumed in self.searched:
            worst = values.get(assumed.key)
            if worst is None:
                continue
            middle = 0.5 * (assumed.low + assumed.high)
            other = assumed.low if worst > middle else assumed.high
            rate = partial(self._rate_searched, assumed.key, worst, other)
            yield _Option(assumed=assumed, worst=worst, other=other, rate=rate)

    def _rate_searched(
        self, key: str, worst: float, other: float, share: float
    ) -> float:
        """Utilisation at another value, in proportion to that of the governing case."""
        here, there = (
            self._rate(self._find_at(self.row, {key: value}))
            for value in (worst, _mix(worst, other, share))
        )
        return _scale(self.judged.rating, here, there)

    def _find_alone(self, row: NetRow, force: MemberForce) -> RowForces | None:
        """Forces on a variant of the row by the case that governs one force."""
        task, point = self.task, force.largest.case
        key = (_name(row), point)
        if key not in self.forces_at:
            results = task.solved.results
            result = next(x for x in results if record_point(x.case) == point)
            solved = _wrap(task.solved, result).on_layout(row.layout)
            self.forces_at[key] = find_forces_alone(task, row, solved)
        return self.forces_at[key]

    def _find_at(
        self,
        row: NetRow,
        values: Mapping[str, float],
        find: _FindForces = find_forces_alone,
    ) -> RowForces | None:
        """Forces on a variant by the governing case of the check, at other values."""
        point, solver = self.judged.check.case, self.task.solver
        if solver is None or point is None:
            return None
        case = read_point(point)
        for name, value in values.items():
            case = case.with_value(name, value)
        narrowed = tuple(sorted(values.items()))  # the floor's ranges, too
        key = (_name(row), case, narrowed, find.__name__)
        if key not in self.forces_at:
            result = self._solve(case, solver)
            forces = None
            if result.is_converged:
                forces = self._find_in_case(row, result, values, find)
            self.forces_at[key] = forces
        return self.forces_at[key]

    def _solve(self, case: Case, solver: CaseSolver) -> CaseResult:
        task = self.task
        solved = (result for result in task.solved.results if result.case == case)
        return next(solved, None) or solver.solve_all([(task.row, case, task.law)])[0]

    def _find_in_case(
        self,
        row: NetRow,
        result: CaseResult,
        values: Mapping[str, float],
        find: _FindForces,
    ) -> RowForces:
        task = self.task
        ranges = task.site.ranges
        for name, value in values.items():
            ranges = ranges.with_value(name, value)
        at = replace(task, site=replace(task.site, ranges=ranges))
        solved = _wrap(task.solved, result)
        return find(at, row, solved.on_layout(row.layout))


def _mix(start: float, end: float, share: float) -> float:
    """Value a share of the way from start to end; exact at both, where it is known."""
    return (1.0 - share) * start + share * end


def _name(row: NetRow) -> object:
    return tuple(sorted(read_values(row).items()))


def _wrap(solved: RowEnvelope, result: CaseResult) -> RowEnvelope:
    """Envelope of one case alone: nothing hides beside it."""
    forces = [result.member_forces.get(member) for member in solved.members]
    sizes = tuple(force.value if force else 0.0 for force in forces)
    maxima = replace(solved.maxima, maximum=sizes, upper_bound=sizes, is_closed=True)
    return replace(
        solved, results=(result,), maxima=maxima, confirmations=(), lifted={}
    )


def _scale(rating: Rating, here: float, there: float) -> float:
    """Utilisation elsewhere, in proportion to one that stands for that of a check."""
    whole = _rate(rating)
    return there * whole / here if 0.0 < here < math.inf > whole else there


def _find_low(rating: Rating | None) -> float:
    """Low end of a utilisation [-]; endless without a bound, 0 of none."""
    return 0.0 if rating is None else find_least(rating)


def _rate(rating: Rating | None) -> float:
    """Upper end of a utilisation [-]; endless where there is none."""
    if rating is None or rating.is_unbounded or rating.high is None:
        return math.inf
    return rating.high


def _find_share(rate: Callable[[float], float]) -> float:
    """Share of the way to a passing end from which on a check passes, in eighths."""
    low, high = 0, _PARTS
    while high - low > 1:
        middle = (low + high) // 2
        if rate(middle / _PARTS) <= 1.0:
            high = middle
        else:
            low = middle
    return high / _PARTS


def _round(option: _Option, share: float) -> float:
    """Value of a share, to three digits and no nearer to the worst end."""
    low, _ = replace(option.assumed, low=option.place(share), high=0.0).shown
    end, _ = replace(option.assumed, low=option.other, high=0.0).shown
    if share >= 1.0 or low == 0.0:
        return option.place(share)
    step = 10.0 ** (math.floor(math.log10(abs(low))) - 1)
    up = math.ceil if end > low else math.floor
    rounded = (
        min(up(low / step) * step, end)
        if end > low
        else max(up(low / step) * step, end)
    )
    return option.place(share) * rounded / low
