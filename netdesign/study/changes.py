"""Limits of single values of a check of forces, and changes that mend it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache, partial

from netdesign.envelope.extremes import Extreme, find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Verdict
from netdesign.site.model import BaseFriction
from netdesign.structure.members import RopeForce, name_in_panel
from netdesign.study.calibration import find_doubt
from netdesign.study.effects import find_effects
from netdesign.study.flips import (
    CLOSE,
    find_density_change,
    find_friction_change,
    find_height_change,
    find_spacing_change,
)
from netdesign.study.force_records import ForceRecord
from netdesign.study.holds import find_holds
from netdesign.study.judgement import MemberCheck, is_worst
from netdesign.study.member_force import MemberForce
from netdesign.study.records import ChangeRecord, HoldRecord
from netdesign.study.row_check import RowCheck
from netdesign.study.row_end import compute_end_factor
from netdesign.study.stronger_types import find_type_change
from netdesign.study.target import Push, Target
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say

# Changes that are limits of single values, too, and the names of these.
_SOLVED = {"change.snow_density": "density", "change.snow_thickness": "thickness"}


def list_targets(
    task: RowCheck, judged: Sequence[MemberCheck], extremes: Mapping[str, Extreme]
) -> list[Target | None]:
    """Checks as functions of a solved case; None of those that no solve may turn.

    Of several supports that one which uses a member most: where that holds, the
    others do.
    """
    if _is_open(task):
        return [None] * len(judged)
    return [
        _build_target(task, one, extremes)
        if _has_target(one) and is_worst(one, judged)
        else None
        for one in judged
    ]


def _is_open(task: RowCheck) -> bool:
    return task.probe is None or bool(task.solved.gap) or task.basis.row.is_overtopped


def find_row_holds(
    task: RowCheck,
    judged: Sequence[MemberCheck],
    changes: Sequence[Sequence[ChangeRecord]],
    targets: Sequence[Target | None],
) -> dict[str, list[HoldRecord]]:
    """Limits of single values for the checks that follow from forces, by their ids.

    ``changes`` and ``targets`` are those of the checks in their order.
    """
    if task.probe is None:
        return {}
    held = {
        one.id: target
        for one, target in zip(judged, targets, strict=True)
        if target is not None
    }
    told = {
        one.id: _list_told(found) for one, found in zip(judged, changes, strict=True)
    }
    return find_holds(held, task.probe, told)


def _list_told(changes: Sequence[ChangeRecord]) -> dict[str, float]:
    """Largest values up to which a check passes, by the quantity's name [SI]."""
    found = {}
    for change in changes:
        quantity = change.quantity
        key = quantity.key if isinstance(quantity, Message) else ""
        if key in _SOLVED and change.bound is not None:
            found[_SOLVED[key]] = change.bound
    return found


def build_end_target(
    task: RowCheck, one: MemberCheck, extremes: Mapping[str, Extreme]
) -> Target | None:
    """Check of a member that holds the row along itself as a function of a case.

    None where a solve tells nothing of it.
    """
    force, use = one.force, one.use
    is_open = _is_open(task) or one.gap is not None or one.doubt is not None
    if is_open or one.given.dimensions or force is None or use is None:
        return None
    if not force.largest.high_kN > 0.0:
        return None
    member = force.largest.quantity
    return Target(
        row=task.basis.row,
        ranges=task.basis.site.ranges,
        member=member,
        scale=use * _widen(force.largest, task.solved.results) / 1e3,
        governing=extremes[member].governing.case,
        results=task.solved.results,
        widen=cache(partial(_find_end_factor, task)),
    )


def list_end_changes(
    task: RowCheck, one: MemberCheck, target: Target | None
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check of such a member."""
    if not _is_worth_telling(task, one):
        return []
    changes = _list_resistance_changes(task, one)
    return changes + (_list_solved_changes(task, target) if target else [])


def _is_worth_telling(task: RowCheck, one: MemberCheck) -> bool:
    """It has a force, and does not pass with much to spare."""
    demand, used = one.result.find("E_d"), one.result.find("μ")
    if demand is None or demand.high == 0.0 or task.basis.row.is_overtopped:
        return False
    if used is None:
        return one.result.verdict is not Verdict.PASS
    return (used.high or 0.0) >= CLOSE


def _find_end_factor(task: RowCheck, ranges: Ranges) -> float:
    """Factor of the end effect on a rope's pull, over some ranges [-]."""
    effects = find_effects(task.basis.row, task.basis.standard, ranges)
    edge = effects.find_support("edge")
    return compute_end_factor(edge, effects.post_spacing)


def list_changes(
    task: RowCheck, one: MemberCheck, target: Target | None
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check.

    What needs a solve is looked for where there is a ``target``.
    """
    if not _is_worth_telling(task, one) or isinstance(
        one.given.dimensions, BaseFriction
    ):
        return []  # sliding is in proportion to what presses the base
    changes = _list_resistance_changes(task, one)
    used = one.result.find("μ")
    if used is None or used.high is None:
        return changes
    if task.basis.row.panel is None:  # its forces are in no proportion to the spacing
        spacing = task.basis.row.layout.post_spacing
        changes.append(find_spacing_change(spacing, one.width, used.high))
    if one.gap or one.doubt:
        key = "change.as_far_as_solved" if one.gap else "change.if_law_accepted"
        return [replace(change, note=say(key)) for change in changes]
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
    force = one.force
    if force is None or one.given.dimensions or one.use is None or one.ratio <= 0.0:
        return False
    return force.largest.high_kN > 0.0 or force.added_high == 0.0


def _build_target(
    task: RowCheck, one: MemberCheck, extremes: Mapping[str, Extreme]
) -> Target:
    """The check as a function of a solved case and of the row.

    Of section and panel that one which is larger is followed, the other beside it.
    """
    force, use = one.force, one.use
    if force is None or use is None:
        raise ValueError("a check without a force has no target")
    member, results = one.given.member, task.solved.results
    scales = {
        record.quantity: use * force.share * _widen(record, results) / 1e3
        for record in force.solved
    }
    followed = force.largest.quantity
    use_floor = (task, member, force, use)
    return Target(
        row=task.basis.row,
        ranges=task.basis.site.ranges,
        member=followed,
        scale=scales.pop(followed),
        beside=tuple(scales.items()),
        added=use * force.added_high,
        rise=use * force.rise,
        governing=extremes[followed].governing.case,
        results=results,
        use_floor=partial(_use_floor, *use_floor),
        bound_floor=partial(_bound_floor, *use_floor),
        widen=cache(partial(_find_load if force.on.push else _find_width, task, one)),
        push=_find_push(task, one, force),
    )


def _use_floor(
    task: RowCheck, member: str, force: MemberForce, use: float, ranges: Ranges
) -> float:
    """Utilisation of a member by the guideline's load alone [-]."""
    floor = task.find_floor(ranges)
    if floor is None:
        return 0.0
    least = floor.find(member)
    if least is None:
        return math.inf
    pull = floor.head.pull if floor.head else 0.0
    return use * (force.share * least.force / 1e3 + _add_by_floor(force, pull / 1e3))


def _bound_floor(
    task: RowCheck, member: str, force: MemberForce, use: float, ranges: Ranges
) -> tuple[float, float]:
    """Ends of what `_use_floor` gives; no upper one where the bound is not known."""
    ends = task.bound_floor(ranges)
    if ends is None:
        return 0.0, math.inf
    least, most = (
        use
        * (
            force.share * end.of_members[member] / 1e3
            + _add_by_floor(force, end.pull / 1e3)
        )
        for end in ends
    )
    return least, most


def _find_push(task: RowCheck, one: MemberCheck, force: MemberForce) -> Push | None:
    """Part of the panel's force that the end guy brings; None of any other member."""
    if force.on.push is None or not force.on.push.high:
        return None
    name, rope = name_in_panel(one.given.member), RopeForce.UPPER_ALONG
    results = task.solved.results
    panel = next(record for record in force.solved if record.quantity == name)
    inside = force.on_support * force.share * _widen(panel, results)
    pull = kilonewton_from_newton(find_extreme(rope, results).force.high)
    return Push(force=name, rope=rope, ratio=force.on.push.high / pull / inside)


def _find_load(task: RowCheck, one: MemberCheck, ranges: Ranges) -> float:
    """Load of an end post over some ranges, at most, over that of the row as is [-].

    The larger growth of width and ropes' pull counts for both.
    """
    now = task.basis.site.ranges
    return max(
        _find_width(task, one, ranges) / _find_width(task, one, now),
        _find_end_factor(task, ranges) / _find_end_factor(task, now),
    )


def _widen(force: ForceRecord, results: Sequence[CaseResult]) -> float:
    """Upper end with what may hide, over the largest one of the solved cases [-]."""
    at_cases = kilonewton_from_newton(find_extreme(force.quantity, results).force.high)
    return force.high_kN / at_cases if at_cases else 1.0


def _find_width(task: RowCheck, one: MemberCheck, ranges: Ranges) -> float:
    """Width that loads a support over ranges in which something was moved [m]."""
    supports = find_effects(task.basis.row, task.basis.standard, ranges).supports
    widths = [w.width for w in supports if w.position == one.width.position]
    return max(widths, default=one.width.width)


def _add_by_floor(force: MemberForce, pull: float) -> float:
    """Force added to a member where the guideline's pull on the head may be larger.

    It grows with that pull, and never falls [kN].
    """
    growth = max(0.0, pull / force.pull - 1.0) if force.pull else 0.0
    return force.added + growth * force.rise


def _doubt_density(task: RowCheck, change: ChangeRecord) -> ChangeRecord:
    """Change of density that says where the creep law is not given for its snow."""
    if change.bound is None or not find_doubt(
        task.basis.site,
        task.basis.row,
        task.basis.law,
        density=change.bound,
        largest=math.inf,
    ):
        return change
    return replace(change, note=say("change.if_law_accepted"))


def _list_resistance_changes(task: RowCheck, one: MemberCheck) -> list[ChangeRecord]:
    """Characteristic resistance that is needed, and the type that has it."""
    site, standard, result = task.basis.site, task.basis.standard, one.result
    demand, factor = result.find("E_d"), result.find_value("γ_R")
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        found = standard.find_resistance_factor(one.given.mode, "tested")
        factor = found.value_si if found else None
        note = say("change.on_basis_of_tests")
    if factor is None or demand is None or demand.high is None:
        return []
    change = ChangeRecord(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=result.find_value("R_k"),
        bound=math.ceil(demand.high * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        solves=0,
        note=note,
    )
    row = task.basis.row
    kind = find_type_change(site, row, one.given, demand.high, standard)
    return [change, kind] if kind else [change]
