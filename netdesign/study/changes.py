"""Limits of single values of a check of forces, and changes that mend it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache, partial

from netdesign.checks import (
    Band,
    CheckResult,
)
from netdesign.envelope.extremes import find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Verdict
from netdesign.site.model import BaseFriction, Resistance
from netdesign.structure.members import RopeForce, name_in_panel
from netdesign.study.calibration import find_doubt
from netdesign.study.demand import Demand
from netdesign.study.effects import RowEffects, find_effects
from netdesign.study.flips import (
    CLOSE,
    find_density_change,
    find_friction_change,
    find_height_change,
    find_spacing_change,
)
from netdesign.study.holds import find_holds
from netdesign.study.member_check import MemberCheck, RowCheck, is_worst
from netdesign.study.records import (
    ChangeRecord,
    CheckRecord,
    HoldRecord,
)
from netdesign.study.row_end import EndLoads, compute_end_factor
from netdesign.study.sideways import MemberLoad
from netdesign.study.stronger_types import find_type_change
from netdesign.study.target import Push, Target
from netdesign.units import (
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.message import Message, say

# Changes that are limits of single values, too, and the names of these.
_SOLVED = {"change.snow_density": "density", "change.snow_thickness": "thickness"}


def list_targets(task: RowCheck, judged: Sequence[MemberCheck]) -> list[Target | None]:
    """Checks as functions of a solved case; None of those that no solve may turn.

    Of several supports that one which uses a member most: where that holds, the
    others do.
    """
    if task.probe is None or task.solved.gap or task.row.is_overtopped:
        return [None] * len(judged)
    return [
        _build_target(task, one) if _has_target(one) and is_worst(one, judged) else None
        for one in judged
    ]


def find_row_holds(
    task: RowCheck,
    checks: Sequence[CheckRecord],
    targets: Sequence[Target | None],
    ends: Mapping[str, Target],
) -> dict[str, list[HoldRecord]]:
    """Limits of single values for the checks that follow from forces, by their ids.

    ``targets`` are those of the checks in their order, ``ends`` those of what holds
    the row along itself.
    """
    if task.probe is None:
        return {}
    held = {
        check.id: target
        for check, target in zip(checks, targets, strict=True)
        if target is not None
    }
    told = {check.id: _list_told(check) for check in checks}
    return find_holds(held | dict(ends), task.probe, told)


def _list_told(check: CheckRecord) -> dict[str, float]:
    """Largest values up to which a check passes, by the quantity's name [SI]."""
    found = {}
    for change in check.changes:
        quantity = change.quantity
        key = quantity.key if isinstance(quantity, Message) else ""
        if key in _SOLVED and change.bound is not None:
            found[_SOLVED[key]] = change.bound
    return found


def build_end_target(
    task: RowCheck, given: Resistance, end: EndLoads, result: CheckResult
) -> Target | None:
    """Check of a member that holds the row along itself as a function of a case.

    None where a solve tells nothing of it.
    """
    factor, design = result.action_factor, result.design_resistance
    is_open = task.probe is None or task.solved.gap or task.row.is_overtopped
    if is_open or given.dimensions or not (factor and design):
        return None
    extreme = end.find_extreme(given.member)
    if not extreme.widened.high > 0.0:
        return None
    use = factor / design * end.share(given.member) * end.factor
    return Target(
        row=task.row,
        ranges=task.site.ranges,
        member=extreme.member,
        scale=use * _widen(extreme.member, extreme.widened, task.solved.results),
        governing=extreme.governing.case,
        results=task.solved.results,
        widen=cache(partial(_find_end_factor, task)),
    )


def list_end_changes(
    task: RowCheck, given: Resistance, result: CheckResult, target: Target | None
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check of such a member."""
    used = result.utilisation
    if result.demand is None or result.demand.high == 0.0 or task.row.is_overtopped:
        return []
    is_close = used is not None and used.high >= CLOSE
    if not is_close and (result.verdict is Verdict.PASS or used is not None):
        return []
    changes = _list_resistance_changes(task, given, result)
    return changes + (_list_solved_changes(task, target) if target else [])


def _find_end_factor(task: RowCheck, ranges: Ranges) -> float:
    """Factor of the end effect on a rope's pull, over some ranges [-]."""
    effects = find_effects(task.row, task.standard, ranges)
    edge = effects.find_support("edge")
    return compute_end_factor(edge, effects.post_spacing)


def list_changes(
    task: RowCheck, one: MemberCheck, effects: RowEffects, target: Target | None
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check.

    What needs a solve is looked for where there is a ``target``.
    """
    result, used = one.result, one.result.utilisation
    if result.demand is None or result.demand.high == 0.0 or task.row.is_overtopped:
        return []
    is_close = used is not None and used.high >= CLOSE
    gap = one.gap
    if not is_close and (
        result.verdict is Verdict.PASS or (used and (gap or one.doubt))
    ):
        return []  # neither a missing result nor a doubt is mended by any change
    if isinstance(one.given.dimensions, BaseFriction):
        return []  # in proportion to what presses the base
    changes = _list_resistance_changes(task, one.given, result)
    if used is None or result.design_resistance is None:
        return changes
    if task.row.panel is None:  # its forces are in no proportion to the spacing
        changes.append(find_spacing_change(effects.post_spacing, one.width, used.high))
    if gap or one.doubt:
        note = say("change.as_far_as_solved" if gap else "change.if_law_accepted")
        return [replace(change, note=note) for change in changes]
    return changes + (_list_solved_changes(task, target) if target else [])


def _list_solved_changes(task: RowCheck, target: Target) -> list[ChangeRecord]:
    """Changes of snow and friction, each found by solves."""
    if task.probe is None:
        return []
    found = (
        _doubt_density(task, find_density_change(target, task.probe)),
        find_height_change(target, task.probe),
        find_friction_change(target, task.probe),
    )
    return [change for change in found if change is not None]


def _has_target(one: MemberCheck) -> bool:
    """The check follows from the member's force by numbers that stay as they are.

    A resistance that follows the snow does not, nor what is added to no force at all.
    """
    demand = one.demand
    if demand is None or one.given.dimensions or one.use is None or one.ratio <= 0.0:
        return False
    return demand.largest.high > 0.0 or demand.load.added.high == 0.0


def _build_target(task: RowCheck, one: MemberCheck) -> Target:
    """The check as a function of a solved case and of the row.

    Of section and panel that one which is larger is followed, the other beside it.
    """
    extreme, demand, use = one.extreme, one.demand, one.use
    if extreme is None or demand is None or use is None:
        raise ValueError("a check without a demand has no target")
    member, load = one.given.member, demand.load

    pair: list[tuple[str, Band]] = [(member, demand.solved)]
    if demand.panel is not None:
        pair.append((name_in_panel(member), demand.panel))
    scales = {
        name: use * load.share * _widen(name, band, task.solved.results)
        for name, band in pair
    }
    followed = extreme.member
    widen = _find_load if demand.along.high else _find_width
    return Target(
        row=task.row,
        ranges=task.site.ranges,
        member=followed,
        scale=scales.pop(followed),
        beside=tuple(scales.items()),
        added=use * load.added.high,
        rise=use * load.rise,
        governing=extreme.governing.case,
        results=task.solved.results,
        use_floor=partial(_use_floor, task, member, load, use),
        bound_floor=partial(_bound_floor, task, member, load, use),
        widen=cache(partial(widen, task, one)),
        push=_find_push(task, one, demand),
    )


def _use_floor(
    task: RowCheck, member: str, load: MemberLoad, use: float, ranges: Ranges
) -> float:
    """Utilisation of a member by the guideline's load alone [-]."""
    floor = task.find_floor(ranges)
    if floor is None:
        return 0.0
    least = floor.find(member)
    if least is None:
        return math.inf
    pull = floor.head.pull if floor.head else 0.0
    return use * (load.share * least.force + _add_by_floor(load, pull))


def _bound_floor(
    task: RowCheck, member: str, load: MemberLoad, use: float, ranges: Ranges
) -> tuple[float, float]:
    """Ends of what `_use_floor` gives; no upper one where the bound is not known."""
    ends = task.bound_floor(ranges)
    if ends is None:
        return 0.0, math.inf
    least, most = (
        use * (load.share * end.of_members[member] + _add_by_floor(load, end.pull))
        for end in ends
    )
    return least, most


def _find_push(task: RowCheck, one: MemberCheck, demand: Demand) -> Push | None:
    """Part of the panel's force that the end guy brings; None of any other member."""
    if demand.panel is None or not demand.along.high:
        return None
    name, rope = name_in_panel(one.given.member), RopeForce.UPPER_ALONG
    results = task.solved.results
    inside = demand.on_support * demand.load.share * _widen(name, demand.panel, results)
    pull = find_extreme(rope, results).force.high
    return Push(force=name, rope=rope, ratio=demand.along.high / pull / inside)


def _find_load(task: RowCheck, one: MemberCheck, ranges: Ranges) -> float:
    """Load of an end post over some ranges, at most, over that of the row as is [-].

    The larger growth of width and ropes' pull counts for both.
    """
    now = task.site.ranges
    return max(
        _find_width(task, one, ranges) / _find_width(task, one, now),
        _find_end_factor(task, ranges) / _find_end_factor(task, now),
    )


def _widen(name: str, band: Band, results: Sequence[CaseResult]) -> float:
    """Upper end with what may hide, over the largest one of the solved cases [-]."""
    at_cases = find_extreme(name, results).force.high
    return band.high / at_cases if at_cases else 1.0


def _find_width(task: RowCheck, one: MemberCheck, ranges: Ranges) -> float:
    """Width that loads a support over ranges in which something was moved [m]."""
    supports = find_effects(task.row, task.standard, ranges).supports
    widths = [w.width for w in supports if w.position == one.width.position]
    return max(widths, default=one.width.width)


def _add_by_floor(load: MemberLoad, pull: float) -> float:
    """Force added to a member where the guideline's pull on the head may be larger [N].

    It grows with that pull, and never falls.
    """
    growth = max(0.0, pull / load.pull - 1.0) if load.pull else 0.0
    return load.added.value + growth * load.rise


def _doubt_density(task: RowCheck, change: ChangeRecord) -> ChangeRecord:
    """Change of density that says where the creep law is not given for its snow."""
    if change.bound is None or not find_doubt(
        task.site, task.row, task.law, density=change.bound, largest=math.inf
    ):
        return change
    return replace(change, note=say("change.if_law_accepted"))


def _list_resistance_changes(
    task: RowCheck, given: Resistance, result: CheckResult
) -> list[ChangeRecord]:
    """Characteristic resistance that is needed, and the type that has it."""
    factor: float | None = result.resistance_factor
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        found = task.standard.find_resistance_factor(given.mode, "tested")
        factor = found.value_si if found else None
        note = say("change.on_basis_of_tests")
    if factor is None or result.demand is None:
        return []
    needed = result.demand.high * factor
    shown = math.ceil(kilonewton_from_newton(needed) * 10.0 - 1e-9) / 10.0
    change = ChangeRecord(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=kilonewton_if_known(result.resistance),
        bound=shown,
        sense="at least",
        solves=0,
        note=note,
    )
    kind = find_type_change(
        task.site, task.row, given, result.demand.high, task.standard
    )
    return [change, kind] if kind else [change]
