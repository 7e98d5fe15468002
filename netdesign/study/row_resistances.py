"""Resistances that follow row, profile or demand.

Of anchors, their ground, posts and their bases; of steel at the end of the design life;
of the links between a rope and its anchor. Theory: resistance/THEORY.md, (R7) to (R12),
(R18) to (R20) and (R30).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from netdesign.calculation.quantity import Quantity, leaf
from netdesign.checks import Standard
from netdesign.checks.comparison import (
    find_action_factor,
    find_partial_factor,
    find_resistance,
)
from netdesign.checks.forces import resist_by_friction
from netdesign.checks.schema import ROPE_ANGLE
from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import Datum
from netdesign.resistance.ground import (
    BENDING,
    AnchorType,
    Soil,
)
from netdesign.resistance.post import PostSection
from netdesign.resistance.steel import (
    BARE,
    SHACKLE,
    USUAL_SOIL,
    BentBar,
    Link,
    RoundSection,
    Wear,
    compute_bent_bar_resistance,
    find_angle,
    find_direction_factor,
    find_least_tube,
    find_loss,
    leave_area,
    resist_link,
)
from netdesign.site.model import Resistance
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.anchor_ground import find_ground_resistance
from netdesign.study.case_records import PullRecord
from netdesign.study.member_force import MemberForce
from netdesign.study.posts import find_post_resistance
from netdesign.study.row_to_check import Basis
from netdesign.units import (
    degree_from_radian,
    kilonewton_from_newton,
)
from netdesign.words.catalogue import name
from netdesign.words.message import Message, say

_NOT_ACROSS = 1e-9  # sine of a pull along the axis
_LARGEST_ANGLE = math.radians(89.0)


def find_resistance_for_force(
    resistance: Resistance,
    basis: Basis,
    pull: PullRecord | None,
    width: LoadedWidth,
    force: Quantity,
) -> Resistance:
    """Resistance with the value that row, profile and pull give it; others as is.

    ``force`` is the characteristic one [kN].
    """
    if resistance.mode == "direction" and resistance.type_id:
        return _find_head_resistance(resistance, basis.standard, pull, force)
    match resistance.dimensions:
        case AnchorType(soil=Soil() as soil) as anchor if resistance.mode == "wedge":
            return find_ground_resistance(resistance, anchor, soil, basis, pull)
        case AnchorType() as anchor:
            is_held = holds_across(resistance, basis.standard, pull, force)
            anchor = anchor if is_held else replace(anchor, across=None)
            return _find_bent_resistance(resistance, anchor, pull)
        case PostSection() as section:
            return find_post_resistance(resistance, section, basis, width)
        case _:
            return resistance


def _find_bent_resistance(
    resistance: Resistance, anchor: AnchorType, pull: PullRecord | None
) -> Resistance:
    section, free = anchor.section, anchor.lever
    if section is None or free is None:
        return replace(resistance, lack=say("bending.no_section"))
    if pull is None:
        return resistance
    if pull.angle > _LARGEST_ANGLE:
        return replace(resistance, lack=say("bending.too_far", angle=pull.angle_deg))
    yields = 0.0 if anchor.is_in_block else anchor.ground_lever
    lever = free + yields
    worst = _bend(section, pull.angle, lever)
    key = "bending.of_block" if anchor.is_in_block else "bending.of_bar"
    derivation = say(
        "bending.of_tube" if anchor.has_tube else key,
        of=_describe_bending(section, worst),
        lever=1e3 * lever,
        free=1e3 * free,
        ground=1e3 * yields,
        length=find_least_tube(yields),
    )
    best = open_point = None
    if not anchor.kind:  # a rope turns to its pull
        best, open_point = section.axial_resistance, say("bending.kind_assumed")
    elif anchor.is_lever_assumed:
        best = _bend(section, pull.angle, yields).value
        open_point = say("bending.lever_assumed", free=1e3 * free)
    return replace(
        resistance, value=worst.value, best=best, open=open_point, derivation=derivation
    )


def _bend(section: RoundSection, largest: float, lever: float) -> BentBar:
    """Least resistance to a pull beside the axis, by up to the largest angle."""
    angles = (largest, _find_weakest(section, lever, largest))
    bars = (
        compute_bent_bar_resistance(section, angle=angle, lever=lever)
        for angle in angles
    )
    return min(bars, key=lambda each: each.value)


def _find_head_resistance(
    resistance: Resistance, standard: Standard, pull: PullRecord | None, force: Quantity
) -> Resistance:
    """Resistance to the pull of what takes the force across the axis at its head.

    Theory: resistance/THEORY.md, (R9c).
    """
    if pull is None:
        return resistance
    limit = standard.find(ROPE_ANGLE)
    numbers = {"angle": pull.angle_deg, "most": limit.value if limit else 0.0}
    if pull.angle > _LARGEST_ANGLE:
        return replace(resistance, lack=say("direction.rope_beyond", **numbers))
    across, anchor = max(math.sin(pull.angle), _NOT_ACROSS), resistance.dimensions
    holds = anchor.across if isinstance(anchor, AnchorType) else None
    if holds is None:
        factor = find_action_factor(standard).value or 1.0
        numbers |= {"force": factor * across * (force.high or 0.0)}
        return replace(resistance, lack=say("direction.no_head", **numbers))
    key = "direction.by_block" if may_bend(resistance) else "direction.by_head"
    numbers |= {"across": kilonewton_from_newton(holds)}
    return replace(
        resistance,
        value=holds / across,
        basis="declared",
        derivation=say(key, **numbers),
    )


def holds_across(
    resistance: Resistance, standard: Standard, pull: PullRecord | None, force: Quantity
) -> bool:
    """Whether the anchor's head takes the design force across the axis, (R9c).

    Where a block does not, the bar bends in the ground. ``force`` is
    the characteristic one [kN].
    """
    asked = replace(resistance, mode="direction", basis="declared")
    head = _find_head_resistance(asked, standard, pull, force)
    on_action, on_head = (
        find_action_factor(standard),
        find_partial_factor(asked, standard),
    )
    if head.value is None or on_head is None or on_action.value is None:
        return False
    design = on_action.value * (force.high or math.inf)
    return design <= kilonewton_from_newton(head.value) / on_head.value_si


def may_bend(resistance: Resistance) -> bool:
    """A bar or micropile bends where the block at its head does not hold."""
    anchor = resistance.dimensions
    return isinstance(anchor, AnchorType) and anchor.kind in BENDING


def _find_weakest(section: RoundSection, lever: float, largest: float) -> float:
    """Angle up to the largest at which axial force and bending use most [rad]."""
    bending = lever * section.axial_resistance / section.moment_resistance
    return min(math.atan(bending), largest)


def _describe_bending(section: RoundSection, bent: BentBar) -> Message:
    is_sheared = bent.shear_ratio > 0.5
    return say(
        "bending.with_shear" if is_sheared else "bending.without_shear",
        angle=degree_from_radian(bent.angle),
        lever=1e3 * bent.lever,
        outer=1e3 * section.outer,
        inner=1e3 * section.inner,
        strength=section.strength / 1e6,
        axial=kilonewton_from_newton(section.axial_resistance),
        moment=kilonewton_from_newton(section.moment_resistance),
        shear=kilonewton_from_newton(section.shear_resistance),
    )


def resist(resistance: Resistance, standard: Standard, force: MemberForce) -> Quantity:
    """Characteristic resistance of a member, also one that its force brings [kN]."""
    base, pressing = resistance.dimensions, force.pressing
    if not isinstance(base, float) or pressing is None or not pressing.value:
        return find_resistance(resistance, standard)
    friction = leaf("μ_b", base, "-", resistance.source)
    return resist_by_friction(friction, find_action_factor(standard), pressing)


def corrode(resistance: Resistance, basis: Basis) -> tuple[Resistance, Message | None]:
    """Resistance with the steel that is left, and why it may not last so long.

    Bare steel without a given diameter has no known resistance. Steel of no kind loses
    what a bar does, and proves no more than a rope. As it is, and no
    open point, of what does not corrode, what has a condition in the place of its
    protection, and where the profile leaves corrosion to others.
    """
    wear, life = resistance.wear, basis.row.design_life
    if wear is None or "corrosion" in basis.standard.not_checked:
        return resistance, None
    if wear.is_bare and None in (wear.outer, wear.inner):
        lack = say("corrosion.lacks", names=(say("column.anchor_types.bar_diameter"),))
        return replace(resistance, value=None, dimensions=None, lack=lack), None
    if not wear.is_bare:
        unprotected = say("corrosion.of_rope") if wear.protection in BARE else None
        return resistance, unprotected
    undecided = None if wear.kind else say("corrosion.of_rope")
    try:
        return _take_loss(resistance, wear, life), undecided
    except ModelError as error:
        return resistance, error.message


def _take_loss(resistance: Resistance, wear: Wear, life: int) -> Resistance:
    loss = find_loss(wear.soil or USUAL_SOIL, life)
    outer, inner = wear.outer or 0.0, wear.inner or 0.0
    share = leave_area(outer, inner, loss.value / 1e3)
    if not share:
        raise ModelError(say("corrosion.nothing_left", years=life))
    if isinstance(resistance.dimensions, AnchorType) and resistance.dimensions.section:
        section = replace(
            resistance.dimensions.section, outer=outer - 2e-3 * loss.value
        )
        return replace(
            resistance, dimensions=replace(resistance.dimensions, section=section)
        )
    if resistance.value is None:
        return resistance
    derivation = _describe_loss(resistance, wear, life, loss, share)
    return replace(resistance, value=share * resistance.value, derivation=derivation)


def _describe_loss(
    resistance: Resistance, wear: Wear, life: int, loss: Datum, share: float
) -> Message:
    origin = {"status": name("status", loss.status), "source": loss.source}
    whole = {"of": resistance.derivation} if resistance.derivation else {}
    return say(
        "corrosion.left_of" if whole else "corrosion.left",
        **whole,
        before=kilonewton_from_newton(resistance.value or 0.0),
        share=share,
        loss=loss.value,
        years=life,
        soil=say(f"choice.soil.{wear.soil or USUAL_SOIL}"),
        origin=say("derivation.origin", **origin),
    )


CONNECTION = "connection"


def connect(
    resistance: Resistance,
    chains: Mapping[str, tuple[Link, ...]],
    pull: PullRecord | None,
    standard: Standard,
) -> Resistance:
    """Resistance of the chain of links of a member's type: that of the weakest.

    Parameters
    ----------
    resistance : Resistance
        Of the member's steel or rope, which names the type.
    chains : mapping of str to tuple of Link
        By type.
    pull : PullRecord or None
        On the anchor at the end of the chain. Without a pull a shackle's angle is as
        given, or a right angle.
    standard : Standard
        Limit profile.
    """
    links, type_id = chains.get(resistance.type_id, ()), resistance.type_id
    weakest_link = Resistance(
        member=resistance.member,
        mode=CONNECTION,
        type_id=type_id,
        source=resistance.source,
    )
    if not type_id:
        return weakest_link
    if not links:
        lack = say("connection.no_links", type=type_id, sheet=say("sheet.parts"))
        return replace(weakest_link, lack=lack)
    on_action = find_action_factor(standard).value
    factor = standard.find_resistance_factor(CONNECTION, "declared")
    if on_action is None or factor is None:
        return replace(weakest_link, basis="declared")
    on_resistance = factor.value
    pulled = None if pull is None else pull.angle
    bear = partial(
        resist_link, pulled=pulled, on_action=on_action, on_resistance=on_resistance
    )
    weakest = min(links, key=bear)
    weakest_link = replace(
        weakest_link,
        value=bear(weakest),
        basis="declared",
        source=weakest.source,
        derivation=_describe_link(weakest, pulled, (on_action, on_resistance)),
        dimensions=weakest,
    )
    is_whole = any(link.is_of_whole for link in links)
    return weakest_link if is_whole else _add_usual_link(weakest_link, resistance.value)


def _add_usual_link(resistance: Resistance, strength: float | None) -> Resistance:
    """Add a usual link to a chain that is not said to be complete, (R17a).

    It is a shackle as strong as the steel or rope of its type, pulled at a right angle.
    """
    open_point = say(
        "connection.incomplete", type=resistance.type_id, sheet=say("sheet.parts")
    )
    if strength is None:
        return replace(resistance, open=open_point)
    usual = Link(
        kind=SHACKLE,
        breaking=strength,
        limit=None,
        count=1,
        angle=None,
        source=resistance.source,
    )
    value = resist_link(usual, pulled=math.pi / 2, on_action=1.0, on_resistance=1.0)
    listed = resistance.value or 0.0
    if value >= listed:
        return resistance
    derivation = _describe_link(usual, math.pi / 2, (1.0, 1.0))
    return replace(
        resistance,
        value=value,
        best=listed,
        open=open_point,
        derivation=say("connection.usual", of=derivation),
        dimensions=usual,
    )


def _describe_link(
    link: Link, pulled: float | None, factors: tuple[float, float]
) -> Message:
    """Way from a link's strength to its characteristic resistance."""
    force = kilonewton_from_newton(link.limit or link.breaking or 0.0)
    text = say(
        "connection.breaking",
        link=say(f"choice.link.{link.kind}"),
        count=link.count,
        force=force,
    )
    if link.limit is not None:
        action, resistance = factors
        text = say("connection.limit", of=text, action=action, resistance=resistance)
    if link.kind != SHACKLE:
        return text
    own = find_angle(link, pulled)
    factor = find_direction_factor(own)
    origin = {"status": name("status", factor.status), "source": factor.source}
    return say(
        "connection.beside",
        strength=text,
        factor=factor.value,
        angle=degree_from_radian(own),
        origin=say("derivation.origin", **origin),
    )
