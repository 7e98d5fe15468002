"""One check as a function of a solved case: a limit state follows it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, partial

from netdesign.calculation.quantity import Quantity
from netdesign.checks import OpenKind
from netdesign.envelope.extremes import find_extreme
from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.structure.members import (
    Member,
    RopeForce,
    name_in_panel,
)
from netdesign.study.case_records import LargestForce
from netdesign.study.guideline_load import find_effects
from netdesign.study.member_checks import MemberCheck
from netdesign.study.member_force import (
    MemberForce,
    RowForces,
    find_force,
)
from netdesign.study.row_forces import high_of
from netdesign.study.row_to_check import RowToCheck
from netdesign.units import kilonewton_from_newton

TRIED_DENSITIES = (150.0, 600.0)  # [kg/m3], of snow that a search may try


@dataclass(frozen=True, slots=True, kw_only=True)
class Push:
    """A rope's pull along the row that adds to forces, at the row's end or beside it.

    Attributes
    ----------
    rope : str
        Whose pull it is.
    ratios : mapping of str to float
        What it adds to each of these forces, over the rope's pull [-].
    along : float or None
        k of a foot, whose force has its part along the row, (S11): the pull adds to
        that part alone [-]. None of a member that stands along the pull.
    """

    rope: str
    ratios: Mapping[str, float]
    along: float | None = None

    def add(self, name: str, force: float, pull: float) -> float:
        """Force with what a pull of the rope adds to it, (V1), (P10), (P11) [N]."""
        added = self.ratios.get(name, 0.0) * pull
        if self.along is None:
            return force + added
        across = force / math.hypot(1.0, self.along)
        return math.hypot(across, self.along * across + added)


@dataclass(frozen=True, kw_only=True)
class CheckByCase:
    """One check as a function of a solved case.

    Attributes
    ----------
    row, ranges : NetRow, Ranges
        What is checked, and over what.
    scales : mapping of str to float
        Utilisation for each N of the upper end of the solved force, that which is
        largest first; beside it the member's by the section or by the panel between
        posts: the larger utilisation counts [1/N].
    added : float
        Utilisation by what is added to the largest force [-]. Another force brings it:
        it is taken to stay where the member's falls, and to grow as the member's does.
    governing : Case
        Case of the largest force.
    results : sequence of CaseResult
        Of the whole grid, or of the search.
    widen : callable
        Load of the support over some ranges of the row, in any unit: the end effect
        grows with the glide factor.
    push : Push or None
        What a rope adds to the forces.
    """

    row: NetRow
    ranges: Ranges
    scales: Mapping[str, float]
    governing: Case
    results: Sequence[CaseResult]
    widen: Callable[[Ranges], float] = lambda _: 1.0
    added: float = 0.0
    push: Push | None = None

    @property
    def member(self) -> str:
        """Whose force is followed."""
        return next(iter(self.scales))

    @cached_property
    def largest(self) -> float:
        """Largest force of the member over the solved cases [N]."""
        solved = filter(self.has_result, self.results)
        return max(self._read(case, self.member) for case in solved)

    def has_result(self, result: CaseResult) -> bool:
        """All forces are known that the check follows."""
        ropes = () if self.push is None else (self.push.rope,)
        return result.member_forces.keys() >= {*self.scales, *ropes}

    def _read(self, result: CaseResult, name: str) -> float:
        """Upper end of a force in a case, with what a rope adds to it [N]."""
        force, push = result.member_forces[name].high, self.push
        if push is None:
            return force
        return push.add(name, force, result.member_forces[push.rope].high)

    def utilisation(self, result: CaseResult) -> float | None:
        """Upper end of the utilisation in a case [-]; None if it has no result."""
        if not self.has_result(result):
            return None
        used = self.use(self._read(result, self.member))
        for name, scale in self.scales.items():
            used = max(used, scale * self._read(result, name) + self.added)
        return used

    def use(self, force: float) -> float:
        """Utilisation by a force of the member [-]."""
        growth = max(1.0, force / self.largest) if self.largest else 1.0
        return self.scales[self.member] * force + self.added * growth


def find_check_by_case(
    task: RowToCheck,
    forces: RowForces,
    check: MemberCheck,
    judged: Iterable[MemberCheck],
) -> CheckByCase | None:
    """The check as a function of a solved case; None of one that no solve may turn.

    What the ropes load has to be known as a whole.
    """
    if task.solver is None or task.solved.gap or task.row.is_overtopped:
        return None
    is_followed = _follows_cases(check) and is_worst(check, judged)
    return _build_check(task, forces, check) if is_followed else None


def _follows_cases(check: MemberCheck) -> bool:
    """The check follows from the member's force by numbers that stay as they are.

    A resistance that follows the snow does not, nor what is added to no force at all,
    nor an anchor of two guys, nor a post beside the end, nor the truss: what these add
    may grow while its own force falls.
    """
    force = check.force
    if force is None or check.resistance.dimensions or check.ratio <= 0.0:
        return False
    is_shared = force.load.across is not None
    if is_shared or _is_by_truss(force) or _is_post_beside(force):
        return False
    if check.is_of_end and check.check.has_open(OpenKind.UNSOLVED):
        return False
    return force.largest.high_kN > 0.0 or _find_added(force) == 0.0


def _is_by_truss(force: MemberForce) -> bool:
    """The truss of post, guys and end guy has the largest force."""
    loads = (force.coupled, force.by_panel, force.guideline)
    shared = force.by_truss
    return shared is not None and high_of(shared) >= max(map(high_of, loads))


def _is_post_beside(force: MemberForce) -> bool:
    """A post beside the end: what presses it is worked out together, (P11)."""
    posts = (Member.POST, Member.POST_BASE)
    is_post = force.largest.quantity in (*posts, *map(name_in_panel, posts))
    return is_post and force.support.is_second and force.push is not None


def _find_growth(force: MemberForce) -> float:
    """Force on the support over that inside the row, lateral load included [-]."""
    support, lateral = force.support, force.load.lateral
    if force.largest.quantity in tuple(RopeForce):
        return high_of(force.action) / (force.largest.high_kN or 1.0)
    if support.end_factor is not None and support.width is None:  # of the mesh
        return 1.0 + (support.end_factor.value or 0.0)
    ratio = 1.0
    if support.width is not None and support.spacing is not None:
        ratio = _read_ratio(support.width / support.spacing)
    return ratio * _read_ratio(lateral)


def _find_share(force: MemberForce) -> float:
    """Part of the section's force in the member [-]."""
    return _read_ratio(force.load.share)


def _read_ratio(quantity: Quantity | None) -> float:
    """Value of a ratio that stands in a force [-]; 1 where it does not."""
    return (quantity.value if quantity else None) or 1.0


def _find_added(force: MemberForce) -> float:
    """Upper end of what the load along the row adds, inside the row [kN]."""
    added, across = force.load.added, force.load.across
    return high_of(added) + high_of(across)


def _compare_load(force: MemberForce, now: MemberForce) -> float:
    """Load of its support over that of another [-].

    The larger growth of width and of what the end guy brings counts for both.
    """
    growth, push = _find_growth(force) / _find_growth(now), high_of(now.push)
    return max(growth, high_of(force.push) / push) if push else growth


def _build_check(
    task: RowToCheck, forces: RowForces, check: MemberCheck
) -> CheckByCase:
    """The check as a function of a solved case and of the row.

    Of section and panel that one which is larger is followed, the other beside it.
    """
    force = check.force
    if force is None:
        raise ValueError("a check without a force has no target")
    results, followed = task.solved.results, force.largest.quantity
    factor, design = map(check.check.read, ("γ_E", "R_d"))
    use = _find_growth(force) * (factor or 0.0) / (design or math.inf)
    scales = {
        record.quantity: use * _find_share(force) * _widen(record, results) / 1e3
        for record in force.solved
    }
    return CheckByCase(
        row=task.row,
        ranges=task.site.ranges,
        scales={followed: scales.pop(followed), **scales},
        added=use * _find_added(force),
        governing=task.solved.extremes[followed].governing.case,
        results=results,
        widen=cache(partial(_find_load, forces, check, force)),
        push=_find_push(task, check, force),
    )


def _find_push(task: RowToCheck, check: MemberCheck, force: MemberForce) -> Push | None:
    """Part of the force that a rope brings; None of a member that none pulls."""
    push, results = force.push, task.solved.results
    if push is None or not push.high:
        return None
    is_foot = check.resistance.member == Member.FOOT_ANCHOR
    rope = RopeForce.LOWER_ALONG if is_foot else RopeForce.UPPER_ALONG
    pull = kilonewton_from_newton(find_extreme(rope, results).force.high)
    inside = _find_growth(force) * _find_share(force)
    ratios = {
        record.quantity: push.high / pull / (inside * _widen(record, results))
        for record in force.solved
    }
    along = force.load.along.value if force.load.along else None
    return Push(rope=rope, ratios=ratios, along=along)


def _find_load(
    forces: RowForces,
    check: MemberCheck,
    now: MemberForce,
    ranges: Ranges,
) -> float:
    """Load of a support over ranges in which something was moved, over that now [-]."""
    effects = find_effects(forces.row, forces.standard, ranges)
    width = effects.find_support(check.width.position)
    moved = find_force(forces, check.resistance, width) or now
    return _compare_load(moved, now)


def _widen(force: LargestForce, results: Sequence[CaseResult]) -> float:
    """Upper end with what may hide, over the largest one of the solved cases [-]."""
    at_cases = kilonewton_from_newton(find_extreme(force.quantity, results).force.high)
    return force.high_kN / at_cases if at_cases else 1.0


def is_worst(check: MemberCheck, judged: Iterable[MemberCheck]) -> bool:
    """No other support uses the member more."""
    rivals = [other for other in judged if other.name == check.name]
    return check is max(rivals, key=lambda other: other.ratio)
