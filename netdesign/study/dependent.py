"""Resistances that follow row, profile or demand.

Of anchors, their ground, posts and their bases; of steel at the end of the design life;
of the links between a rope and its anchor. Theory: resistance/THEORY.md, (R7) to (R12),
(R18), (R19) and (R30).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from netdesign.calculation.quantity import Quantity
from netdesign.calculation.quantity import given as quantity
from netdesign.checks import Standard
from netdesign.checks.comparison import (
    find_action_factor,
    find_resistance,
    lack_factor,
)
from netdesign.checks.forces import resist_by_friction
from netdesign.checks.schema import (
    SOIL_COHESION,
    SOIL_FRICTION,
)
from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import Datum
from netdesign.resistance.post import BasePlate, PostSection
from netdesign.resistance.steel import (
    BARE,
    SHACKLE,
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
from netdesign.resistance.wedge import (
    AnchorType,
    Soil,
    WedgeResistance,
    compute_slab_stability,
    compute_wedge_resistance,
)
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import Member
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.member_force import MemberForce
from netdesign.study.posts import find_plate_resistance, find_post_resistance
from netdesign.study.row_to_check import Basis
from netdesign.study.support_records import PullRecord
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

_LARGEST_ANGLE = math.radians(89.0)


def find_resistance_for_force(
    given: Resistance, basis: Basis, pull: PullRecord | None, width: LoadedWidth
) -> Resistance:
    """Resistance with the value that row, profile and pull give it; others as is."""
    match given.dimensions:
        case AnchorType(soil=Soil() as soil) as anchor if given.mode == "wedge":
            return _find_ground_resistance(given, anchor, soil, basis, pull)
        case AnchorType() as anchor:
            return _find_bent_resistance(given, anchor, pull)
        case PostSection() as section:
            return find_post_resistance(given, section, basis, width)
        case BasePlate() as plate:
            return find_plate_resistance(given, plate, basis)
        case _:
            return given


def _find_bent_resistance(
    given: Resistance, anchor: AnchorType, pull: PullRecord | None
) -> Resistance:
    section, free = anchor.section, anchor.lever
    if section is None or free is None:
        return replace(given, lack=say("bending.no_section"))
    if pull is None:
        return given
    if not pull.is_axis_known:
        return replace(given, lack=say("bending.no_axis"))
    if pull.angle > _LARGEST_ANGLE:
        return replace(given, lack=say("bending.too_far", angle=pull.angle_deg))
    lever = free + anchor.ground_lever
    worst = min(
        (
            compute_bent_bar_resistance(section, angle=angle, lever=lever)
            for angle in (pull.angle, _find_weakest(section, lever, pull.angle))
        ),
        key=lambda one: one.value,
    )
    told = say(
        "bending.of_tube" if anchor.has_tube else "bending.of_bar",
        of=_describe_bending(section, worst),
        lever=1e3 * lever,
        free=1e3 * free,
        ground=1e3 * anchor.ground_lever,
        length=find_least_tube(anchor.ground_lever),
    )
    return replace(given, value=worst.value, derivation=told)


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


def _find_ground_resistance(
    given: Resistance,
    anchor: AnchorType,
    soil: Soil,
    basis: Basis,
    pull: PullRecord | None,
) -> Resistance:
    """Resistance of the weakest wedge of ground in front of an anchor's bond."""
    row, standard = basis.row, basis.standard
    factors = [standard.find(key) for key in (SOIL_COHESION, SOIL_FRICTION)]
    for key, factor in zip((SOIL_COHESION, SOIL_FRICTION), factors, strict=True):
        if factor is None:
            return replace(given, lack=lack_factor(key))
    on_cohesion, on_friction = (one.value for one in factors if one)
    if pull is None:
        return given
    if not pull.is_axis_known:
        return replace(given, lack=say("bending.no_axis"))
    depths, width = anchor.list_depths(pull.axis), _find_ground_width(row, pull)
    if not depths:
        names = row.list_unsaid_bore(pull.anchor, pull.position)
        return replace(given, lack=say("check.unsaid", names=names))
    if not min(depths) > 0.0:
        return replace(given, lack=say("wedge.no_depth"))
    reduced = soil.reduce(on_cohesion, on_friction)
    depth, wedge = _find_weakest_wedge(reduced, row, pull, depths, width)
    told: dict[str, float | Message] = {
        "depth": depth,
        "width": width,
        "plane": degree_from_radian(wedge.plane),
        "cohesion": soil.cohesion / 1e3,
        "friction": degree_from_radian(soil.friction),
        "weight": soil.weight / 1e3,
        "on_cohesion": on_cohesion,
        "on_friction": on_friction,
        "water": say("wedge.drained" if soil.is_drained else "wedge.seepage"),
    }
    stability = compute_slab_stability(reduced, max(depths), row.slope_angle)
    if stability < 1.0:
        told |= {"depth": max(depths), "stability": stability}
        return replace(given, lack=say("wedge.slab", **told))
    return replace(given, value=wedge.value, derivation=say("wedge.lifts", **told))


def _find_weakest_wedge(
    soil: Soil, row: NetRow, pull: PullRecord, depths: Sequence[float], width: float
) -> tuple[float, WedgeResistance]:
    """Depth of a bond's middle that resists least, and its wedge."""
    is_pulled_up = pull.anchor == Member.DOWNHILL_ANCHOR
    found = {
        depth: compute_wedge_resistance(
            soil,
            depth=depth,
            width=width,
            slope=-row.slope_angle if is_pulled_up else row.slope_angle,
            least_pull=pull.pulls.least,
            largest_pull=pull.pulls.largest,
        )
        for depth in depths
    }
    depth = min(found, key=lambda one: found[one].value)
    return depth, found[depth]


def _find_ground_width(row: NetRow, pull: PullRecord) -> float:
    """Width of ground that one anchor has along the row [m]."""
    if pull.anchor == Member.FOOT_ANCHOR:
        is_doubled = any(one.has_mid_anchors for one in row.panels)
    else:
        is_doubled = row.guys.count > 1 and not row.guys.are_shared
    return row.layout.post_spacing / (2.0 if is_doubled else 1.0)


def resist(given: Resistance, standard: Standard, force: MemberForce) -> Quantity:
    """Characteristic resistance of a member, also one that its force brings [kN]."""
    base, pressing = given.dimensions, force.on.pressing
    if not isinstance(base, float) or pressing is None or not pressing.value:
        return find_resistance(given, standard)
    friction = quantity("μ_b", base, "-", given.source)
    return resist_by_friction(friction, find_action_factor(standard), pressing)


def corrode(given: Resistance, basis: Basis) -> tuple[Resistance, Message | None]:
    """Resistance with the steel that is left, and why it may not last so long.

    None is known where that is not given. As it is, and no doubt, of what does not
    corrode, and where the profile leaves corrosion to others.
    """
    wear, life = given.wear, basis.row.design_life
    if wear is None or "corrosion" in basis.standard.not_checked:
        return given, None
    unsaid = basis.row.list_unsaid_wear(given)
    if unsaid or life is None:
        lack = say("corrosion.lacks", names=unsaid)
        return replace(given, value=None, dimensions=None, lack=lack), lack
    if not wear.is_bare:
        return given, _doubt_protection(wear, life)
    try:
        return _take_loss(given, wear, life), None
    except ModelError as error:
        return given, error.message


def _doubt_protection(wear: Wear, life: int) -> Message | None:
    if wear.protection in BARE:
        return say("corrosion.of_rope")
    years = wear.protected_years or 0
    return say("corrosion.short", years=years, life=life) if years < life else None


def _take_loss(given: Resistance, wear: Wear, life: int) -> Resistance:
    loss = find_loss(wear.soil, life)
    outer, inner = wear.outer or 0.0, wear.inner or 0.0
    share = leave_area(outer, inner, loss.value / 1e3)
    if not share:
        raise ModelError(say("corrosion.nothing_left", years=life))
    if isinstance(given.dimensions, AnchorType) and given.dimensions.section:
        section = replace(given.dimensions.section, outer=outer - 2e-3 * loss.value)
        return replace(given, dimensions=replace(given.dimensions, section=section))
    if given.value is None:
        return given
    derivation = _describe_loss(given, wear, life, loss, share)
    return replace(given, value=share * given.value, derivation=derivation)


def _describe_loss(
    given: Resistance, wear: Wear, life: int, loss: Datum, share: float
) -> Message:
    origin = {"status": name("status", loss.status), "source": loss.source}
    told = {"of": given.derivation} if given.derivation else {}
    return say(
        "corrosion.left_of" if told else "corrosion.left",
        **told,
        before=kilonewton_from_newton(given.value or 0.0),
        share=share,
        loss=loss.value,
        years=life,
        soil=say(f"choice.soil.{wear.soil}"),
        origin=say("derivation.origin", **origin),
    )


CONNECTION = "connection"


def connect(
    given: Resistance,
    chains: Mapping[str, tuple[Link, ...]],
    pull: PullRecord | None,
    standard: Standard,
) -> Resistance:
    """Resistance of the chain of links of a member's type: that of the weakest.

    Parameters
    ----------
    given : Resistance
        Of the member's steel or rope, which names the type.
    chains : mapping of str to tuple of Link
        By type.
    pull : PullRecord or None
        On the anchor at the end of the chain; its axis not known, a shackle may be
        pulled at a right angle. Without a pull its angle is as given, or a right angle.
    standard : Standard
        Limit profile.
    """
    links, type_id = chains.get(given.type_id, ()), given.type_id
    found = Resistance(
        member=given.member, mode=CONNECTION, type_id=type_id, source=given.source
    )
    if not type_id:
        return found
    if not links:
        lack = say("connection.no_links", type=type_id, sheet=say("sheet.Links"))
        return replace(found, lack=lack)
    on_action = find_action_factor(standard).value
    factor = standard.find_resistance_factor(CONNECTION, "declared")
    if on_action is None or factor is None:
        return replace(found, basis="declared")
    on_resistance = factor.value
    pulled = None if pull is None else pull.angle
    if pull is not None and not pull.is_axis_known:
        pulled = math.pi / 2
    strengths = [
        resist_link(
            one, pulled=pulled, on_action=on_action, on_resistance=on_resistance
        )
        for one in links
    ]
    weakest = min(range(len(links)), key=strengths.__getitem__)
    return replace(
        found,
        value=strengths[weakest],
        basis="declared",
        source=links[weakest].source,
        derivation=_describe_link(links[weakest], pulled, (on_action, on_resistance)),
        dimensions=links[weakest],
    )


def _describe_link(
    link: Link, pulled: float | None, factors: tuple[float, float]
) -> Message:
    """Way from a link's strength to its characteristic resistance."""
    force = kilonewton_from_newton(link.limit or link.breaking or 0.0)
    told = say(
        "connection.breaking",
        link=say(f"choice.link.{link.kind}"),
        count=link.count,
        force=force,
    )
    if link.limit is not None:
        action, resistance = factors
        told = say("connection.limit", of=told, action=action, resistance=resistance)
    if link.kind != SHACKLE:
        return told
    own = find_angle(link, pulled)
    factor = find_direction_factor(own)
    origin = {"status": name("status", factor.status), "source": factor.source}
    return say(
        "connection.beside",
        strength=told,
        factor=factor.value,
        angle=degree_from_radian(own),
        origin=say("derivation.origin", **origin),
    )
