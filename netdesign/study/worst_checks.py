"""Checks of all supports of a row, each on the variant of it on which it is worst.

A variant is a corner of what is assumed of the row's statics.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from netdesign.checks import Rating
from netdesign.outcome import SEVERITY, Verdict
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import CONNECTED, EndMember, Member, NetPart
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.anchor_pulls import check_direction, find_pull
from netdesign.study.member_checks import (
    AT_SUPPORT,
    MemberCheck,
    find_open,
    rate_at,
)
from netdesign.study.member_force import PUSHED, RowForces, lifts
from netdesign.study.row_resistances import connect, may_bend
from netdesign.words.message import Message


def judge_members(variants: Sequence[RowForces]) -> list[MemberCheck]:
    """Checks of both supports' members, then of the net and what holds its ropes.

    Each check is that of the variant on which it is worst.
    """
    forces = variants[0]
    effects, row = forces.effects, forces.row
    at_end, not_checked = effects.find_support("edge"), forces.standard.not_checked
    held = row.row_end.resistances if row.row_end else ()
    parts = () if "mesh" in not_checked else row.net_parts
    of_supports: dict[str, list[MemberCheck]] = {
        width.position: list(
            _judge_at(variants, width, row.resistances_at(width.position))
        )
        for width in effects.supports
    }
    judged = [
        *_place_second(forces, of_supports),
        *_judge_at(variants, at_end, (*parts, *held)),
    ]
    open_cases = find_open(judged)
    turned: dict[str, list[MemberCheck]] = {
        width.position: _judge_directions(
            variants, row.resistances_at(width.position), width, open_cases
        )
        for width in effects.supports
    }
    of_end = _judge_directions(variants, held, at_end, open_cases)
    return [*judged, *_place_second(forces, turned), *of_end]


def _judge_at(
    variants: Sequence[RowForces],
    width: LoadedWidth,
    resistances: Iterable[Resistance],
) -> Iterator[MemberCheck]:
    """Checks of the members of one support, each rope's with those of its links.

    The checks of the directions follow later, since they depend on these.
    """
    for resistance in resistances:
        if resistance.mode == "direction" or not _concerns(variants, resistance):
            continue
        yield _judge_worst(variants, width, resistance)
        is_rope = (
            resistance.mode in ("tendon", "rope") and resistance.member in CONNECTED
        )
        if is_rope and "connections" not in variants[0].standard.not_checked:
            yield _judge_worst(variants, width, resistance, _find_chain)


# Members whose forces and resistances are the same on every variant.
_ALIKE = (
    *(Member.FOOT_ANCHOR, NetPart.MESH, NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE),
    EndMember.LATERAL_ANCHOR,
)
_OF_END_GUY = (EndMember.END_GUY, EndMember.END_GUY_ANCHOR)


def list_apart(
    variants: Sequence[RowForces], member: str, width: LoadedWidth
) -> Sequence[RowForces]:
    """Variants of which a member's checks may differ, one of those that are alike."""
    if member in _ALIKE and not variants[0].row.layout.is_foot_shared:
        return variants[:1]
    if member in PUSHED and width.position == "edge":
        return variants
    of_end_guy = member in _OF_END_GUY
    apart = {
        _find_guy_angle(forces.row)
        if of_end_guy
        else (forces.row.layout, forces.row.guys): forces
        for forces in reversed(variants)
    }
    return [*apart.values()]


def _find_guy_angle(row: NetRow) -> float | None:
    return row.row_end.guy_angle if row.row_end else None


_Find = Callable[[RowForces, Resistance, LoadedWidth], Resistance]


def _keep(_: RowForces, resistance: Resistance, __: LoadedWidth) -> Resistance:
    return resistance


def _judge_worst(
    variants: Sequence[RowForces],
    width: LoadedWidth,
    resistance: Resistance,
    find: _Find = _keep,
) -> MemberCheck:
    """Judge a member where it is worst; ``find`` gives its resistance."""

    def rate(forces: RowForces) -> MemberCheck:
        there = forces.effects.find_support(width.position)
        return rate_at(forces, find(forces, resistance, there), there)

    apart = list_apart(variants, resistance.member, width)
    if len(apart) == 1:
        return replace(rate(apart[0]), again=rate)
    return replace(_take_worst(list(map(rate, apart))), again=rate)


def _take_worst(rated: Sequence[MemberCheck]) -> MemberCheck:
    """Worst of a member's checks on several variants, eased to the best of them.

    That is the gravest verdict, then the most used, then the most loaded one.
    """
    best = min(rated, key=lambda each: find_least(each.rating))
    least = find_least(best.rating)
    worst = max(rated, key=lambda each: _weigh(each.rating.ease(least)))
    return replace(worst, rated=worst.check.ease(least), best=best.forces)


def find_least(rating: Rating) -> float:
    """Low end of a utilisation; 0 where there is none, endless where nothing bounds."""
    return math.inf if rating.is_unbounded else rating.band[0] or 0.0


def _weigh(rating: Rating) -> tuple[int, float, float]:
    high = -1.0 if rating.high is None else rating.high
    used = math.inf if rating.is_unbounded else high
    return -SEVERITY.index(rating.verdict), used, rating.demand or 0.0


def _judge_directions(
    variants: Sequence[RowForces],
    resistances: Iterable[Resistance],
    width: LoadedWidth,
    open_cases: Message | None,
) -> list[MemberCheck]:
    """Checks of the angles of rope anchors of one support, and of blocks that hold."""
    members = []
    for resistance in resistances:
        if resistance.mode != "direction":
            continue
        rate = partial(_rate_direction, resistance, width, open_cases)
        rated = list(map(rate, list_apart(variants, resistance.member, width)))
        if may_bend(resistance):  # where its block does not hold, it bends
            rated = [x for x in rated if x.rating.verdict is Verdict.PASS]
        if rated:
            members.append(replace(_take_worst(rated), again=rate))
    return members


def _rate_direction(
    resistance: Resistance,
    width: LoadedWidth,
    open_cases: Message | None,
    forces: RowForces,
) -> MemberCheck:
    """Check a rope anchor's angle; beyond the limit, or of no type, check its head."""
    pull = find_pull(forces.pulls, resistance.member, width.position)
    check = None
    if pull and resistance.type_id:
        check = check_direction(pull, forces.standard, open_cases)
    if check is None:
        there = forces.effects.find_support(width.position)
        return rate_at(forces, resistance, there)
    check = replace(
        check, id=check.id + AT_SUPPORT[width.position], position=width.position
    )
    return MemberCheck(
        forces=forces, resistance=resistance, width=width, rated=check, pull=pull
    )


_AS_INSIDE = 1.01  # times the utilisation inside the row: the second support is alike


def _place_second(
    forces: RowForces, of_supports: Mapping[str, Sequence[MemberCheck]]
) -> list[MemberCheck]:
    """List the checks of all supports, those of the second one where they can govern.

    It has the types inside and no less load. Where that is alike, its check is the one
    inside; where the end has the same type with more load, that check says all.
    """
    inside, at_end = of_supports["intermediate"], of_supports.get("edge", ())
    kept, ends = (
        {member_check.name: member_check for member_check in each}
        for each in (inside, at_end)
    )
    beside = []
    for member_check in of_supports.get("second", ()):
        # no check inside of a block that does not hold there
        within = kept.get(member_check.name, member_check)
        if _is_no_worse(member_check, within) or _is_covered(
            forces, member_check, ends.get(member_check.name)
        ):
            continue
        if 0.0 < _rate_load(member_check) <= _AS_INSIDE * _rate_load(within):
            as_inside = replace(
                member_check.check, id=within.check.id, position="intermediate"
            )
            kept[member_check.name] = replace(member_check, rated=as_inside)
        else:
            beside.append(member_check)
    return [*kept.values(), *beside, *at_end]


def _rate_load(member_check: MemberCheck) -> float:
    """Upper end of the utilisation, or of the force where no resistance is known."""
    return (
        member_check.ratio
        if member_check.ratio >= 0.0
        else member_check.check.read_band("E_d")[1] or 0.0
    )


def _is_no_worse(member_check: MemberCheck, other: MemberCheck) -> bool:
    """Whether a check has no larger use, no larger load and no worse verdict."""
    ranks = [SEVERITY.index(each.check.verdict) for each in (member_check, other)]
    loads = [each.check.read_band("E_d")[1] or 0.0 for each in (member_check, other)]
    is_less = member_check.ratio <= other.ratio and loads[0] <= loads[1]
    return is_less and ranks[0] >= ranks[1]


def _is_covered(
    forces: RowForces, member_check: MemberCheck, end: MemberCheck | None
) -> bool:
    """Whether the end's check of the same type is worse, and no document proves it."""
    if (
        end is None
        or not end.resistance.type_id
        or end.resistance.type_id != member_check.resistance.type_id
    ):
        return False
    at_end, here = (
        forces.site.find_declaration(forces.row, *member_check.name, place)
        for place in ("edge", "second")
    )
    return at_end == here and _is_no_worse(member_check, end)


def _concerns(variants: Sequence[RowForces], resistance: Resistance) -> bool:
    """Whether row and profile have the check: a post foot where a case lifts it."""
    if resistance.member == Member.POST_FOOT:
        return any(lifts(forces.largest.values(), forces.floor) for forces in variants)
    not_checked = variants[0].standard.not_checked
    return resistance.mode != "wedge" or "anchor_ground" not in not_checked


def _find_chain(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> Resistance:
    """Resistance of the links between a rope and its anchor."""
    anchor = CONNECTED[resistance.member]
    pull = find_pull(forces.pulls, anchor, width.position) if anchor else None
    return connect(resistance, forces.site.links, pull, forces.standard)
