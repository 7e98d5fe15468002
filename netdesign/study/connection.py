"""Resistance of the links between a rope and its anchor."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from netdesign.checks import Standard
from netdesign.checks.check import find_action_factor
from netdesign.resistance.connection import (
    SHACKLE,
    Link,
    find_angle,
    find_direction_factor,
    resist_link,
)
from netdesign.site.model import Resistance
from netdesign.study.pulls import AnchorPull
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.words.message import Message, say
from netdesign.words.names import name

CONNECTION = "connection"


def connect(
    given: Resistance,
    chains: Mapping[str, tuple[Link, ...]],
    pull: AnchorPull | None,
    standard: Standard,
) -> Resistance:
    """Resistance of the chain of links of a member's type: that of the weakest.

    Parameters
    ----------
    given : Resistance
        Of the member's steel or rope, which names the type.
    chains : mapping of str to tuple of Link
        By type.
    pull : AnchorPull or None
        On the anchor at the end of the chain; its axis not known, a shackle may be
        pulled at a right angle. Without a pull its angle is as given, or a right angle.
    standard : Standard
        Limit profile.
    """
    links, type_id = chains.get(given.type_id, ()), given.type_id
    found = Resistance(
        member=given.member, mode=CONNECTION, type_id=type_id, source=given.source
    )
    factors = (
        find_action_factor(standard).value,
        getattr(standard.find_resistance_factor(CONNECTION, "declared"), "value", None),
    )
    on_action, on_resistance = factors
    if not type_id:
        return found
    if not links or on_action is None or on_resistance is None:
        lack = (
            None
            if links
            else say("connection.no_links", type=type_id, sheet=say("sheet.Links"))
        )
        return replace(found, lack=lack, basis="declared" if links else "")
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
        derivation=_describe(links[weakest], pulled, factors),
        dimensions=links[weakest],
    )


def _describe(
    link: Link, pulled: float | None, factors: tuple[float | None, float | None]
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
        action, resistance = (factor or 0.0 for factor in factors)
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
