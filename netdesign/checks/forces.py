"""Forces on the members of a support and their utilisation, step by step.

Each function is a line of a theory page: checks/THEORY.md, (V1) and (V2);
structure/THEORY.md, (S9) to (S19); panel/THEORY.md, (P7) and (P8);
resistance/THEORY.md, (R1) and (R12). Forces in kN, lengths in m, angles in degrees.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from netdesign.calculation.quantity import (
    Quantity,
    above_zero,
    at_value,
    cos,
    largest,
    sin,
    smallest,
    sqrt,
    tan,
)

Position = Literal["intermediate", "edge"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """Support of a row: what makes of a force inside the row that on it.

    Attributes
    ----------
    position : str
        "intermediate" or "edge".
    spacing, width : Quantity
        b and b_e [m]; one and the same inside the row.
    end_factor, end_length : Quantity or None
        f_R [-] and its length [m]; None inside the row.
    """

    position: Position
    spacing: Quantity
    width: Quantity
    end_factor: Quantity | None = None
    end_length: Quantity | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberLoad:
    """Way from a force of the section to that of a member, inside the row.

    Attributes
    ----------
    share : Quantity or None
        g, of the section's force in the member [-]; None of all of it.
    added : Quantity or None
        A, by the load along the row [kN]; None of nothing.
    lateral : Quantity or None
        k_q, by the load along the row at the net's foot [-]; None of 1.
    """

    share: Quantity | None = None
    added: Quantity | None = None
    lateral: Quantity | None = None


def place_support(spacing: Quantity) -> Support:
    """Support inside the row: a bay loads it."""
    return Support(position="intermediate", spacing=spacing, width=spacing)


def place_end_support(spacing: Quantity, factor: Quantity, length: Quantity) -> Support:
    """First or last support of a row: half a bay and the end effect."""
    return Support(
        position="edge",
        spacing=spacing,
        width=(spacing / 2 + factor * length).named("b_e", "m", "(S9)"),
        end_factor=factor,
        end_length=length,
    )


def find_lateral_factor(share: Quantity) -> Quantity:
    """k_q: a force with its part along the row, over that in the section."""
    return sqrt(1 + share * share).named("k_q", "-", "(S11)")


def load_guy(
    part: Quantity, share: Quantity, pull: Quantity, splay: Quantity
) -> MemberLoad:
    """One of two splayed guys, which hold the load along the row."""
    return MemberLoad(
        share=(1 / (2 * cos(splay))).named("g", "-", "(S17)"),
        added=(part * share * pull / sin(splay)).named("A", "kN", "(S17)"),
    )


def load_post(
    part: Quantity,
    share: Quantity,
    pull: Quantity,
    splay: Quantity,
    least_tension: Quantity,
) -> MemberLoad:
    """Post between splayed guys: the load along the row less what they hold anyway."""
    held = above_zero(share * pull / tan(splay) - least_tension)
    return MemberLoad(added=(part * held).named("A", "kN", "(S18)"))


def bring_to_support(
    symbol: str,
    inside: Quantity,
    load: MemberLoad,
    support: Support,
    push: Quantity | None = None,
) -> Quantity:
    """Force on a member of a support from that of the section inside the row.

    ``push`` is what the end guy adds to it.
    """
    force = inside if load.share is None else load.share * inside
    if load.added is not None:
        force = force + load.added
    if support.width is not support.spacing:
        force = force * support.width / support.spacing
    if load.lateral is not None:
        force = force * load.lateral
    if push is not None:
        force = force + push
    return force.named(symbol, "kN", "(V1)")


def bring_floor_to_support(
    symbol: str, inside: Quantity, load: MemberLoad, support: Support
) -> Quantity:
    """The same of the guideline's load, which has no band."""
    added = None if load.added is None else at_value(load.added)
    plain = MemberLoad(share=load.share, added=added, lateral=load.lateral)
    return bring_to_support(symbol, inside, plain, support)


def take_largest(symbol: str, *forces: Quantity) -> Quantity:
    """Characteristic force: the largest of section, panel and guideline.

    One that is alone has the symbol already.
    """
    first, *others = forces
    return largest(first, *others).named(symbol, "kN", "(V1)") if others else first


def pull_at_end(rope: Quantity, support: Support) -> Quantity:
    """Pull of a border rope along the row under the end effect, at most."""
    factor, length = support.end_factor, support.end_length
    if factor is None or length is None:
        raise ValueError("a support inside the row has no end effect")
    reach = factor * length / support.spacing
    if (length.value or 0.0) > 0.5 * (support.spacing.value or 0.0):
        reach = factor  # beyond half a bay it counts as if it were all over the bay
    grown = 1 + reach
    return (rope * grown).named("H", "kN", "(P8)")


def pull_end_guy(rope: Quantity, angle: Quantity) -> Quantity:
    """Tension of the end guy that holds the ridge rope."""
    return (rope / cos(angle)).named("E_k", "kN", "(P7)")


def push_end_post(rope: Quantity, angle: Quantity) -> Quantity:
    """Compression of the end post by its end guy."""
    return (rope * tan(angle)).named("Z", "kN", "(P7)")


def slide_base(pressing: Quantity, tilt: Quantity) -> Quantity:
    """Force along the slope at a post's base from that across it."""
    return (tilt * pressing).named("E_k", "kN", "(S19)")


def resist_by_friction(
    friction: Quantity, on_action: Quantity, pressing: Quantity
) -> Quantity:
    """Sliding resistance of a base that its post presses on the ground."""
    pressed = on_action * at_value(pressing)
    return (friction * pressed).named("R_k", "kN", "(R12)")


def resist_by_tests(
    mean: Quantity, on_mean: Quantity, least: Quantity, on_least: Quantity
) -> Quantity:
    """Pull-out resistance from tests."""
    return smallest(mean / on_mean, least / on_least).named("R_k", "kN", "(R1)")


def rate(
    force: Quantity, on_action: Quantity, resistance: Quantity, on_resistance: Quantity
) -> Quantity:
    """Utilisation: design force over design resistance."""
    demand = (on_action * force).named("E_d", "kN", "(V1)")
    design = (resistance / on_resistance).named("R_d", "kN", "(V1)")
    return (demand / design).named("μ", "-", "(V2)")
