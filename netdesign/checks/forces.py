"""Forces on the members of a support and their utilisation, step by step.

Each function is a line of a theory page: checks/THEORY.md, (V1) and (V2);
structure/THEORY.md, (S9) to (S20); panel/THEORY.md, (P7) to (P9);
resistance/THEORY.md, (R1), (R12), (R15). Forces in kN, lengths in m, angles in degrees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """Support of a row: what makes of a force inside the row that on it.

    Attributes
    ----------
    spacing, width : Quantity or None
        b and b_e [m]; None inside the row, where one is the other.
    end_factor, end_length : Quantity or None
        f_R [-] and its length [m]; None inside the row.
    """

    spacing: Quantity | None = None
    width: Quantity | None = None
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
    across : Quantity or None
        Of two guys on one anchor, square to what they share in the section [kN].
    """

    share: Quantity | None = None
    added: Quantity | None = None
    lateral: Quantity | None = None
    across: Quantity | None = None


def place_end_support(
    spacing: Quantity, factor: Quantity, length: Quantity, *, is_shared: bool = False
) -> Support:
    """First or last support of a row: half a bay and the end effect.

    An anchor that it shares holds a guy of the next post, which carries a whole bay.
    """
    width = spacing / 2 + factor * length
    if is_shared:
        width = largest(width, (width + spacing) / 2)
    return Support(
        spacing=spacing,
        width=width.named("b_e", "m", "(S20)" if is_shared else "(S9)"),
        end_factor=factor,
        end_length=length,
    )


def find_lateral_factor(share: Quantity) -> Quantity:
    """k_q: a force with its part along the row, over that in the section."""
    return sqrt(1 + share * share).named("k_q", "-", "(S11)")


def load_guy(
    part: Quantity, share: Quantity, pull: Quantity, splay: Quantity, *, mark: str = ""
) -> MemberLoad:
    """One of two splayed guys, which hold the load along the row.

    ``mark`` ends the symbol of what is added, here and below.
    """
    return MemberLoad(
        share=(1 / (2 * cos(splay))).named("g", "-", "(S17)"),
        added=(part * share * pull / sin(splay)).named(f"A{mark}", "kN", "(S17)"),
    )


def load_shared_anchor(guys: Quantity, *along: Quantity, mark: str = "") -> MemberLoad:
    """Anchor that holds a guy of each of two neighbours, each loaded ``along``."""
    of_one = load_guy(*along, mark=mark).added
    if of_one is None:
        raise ValueError("a guy holds no load along the row")
    return MemberLoad(across=(guys * of_one).named(f"B{mark}", "kN", "(S20)"))


def load_shared_anchor_in_line(
    guys: Quantity, *along: Quantity, mark: str = ""
) -> MemberLoad:
    """The same, the pulls of both guys added as numbers, as if they were in line."""
    of_one = load_guy(*along, mark=mark)
    if of_one.share is None or of_one.added is None:
        raise ValueError("a guy holds no load along the row")
    return MemberLoad(
        share=(guys * of_one.share).named("g_2", "-", "(S20a)"),
        added=(guys * of_one.added).named(f"B{mark}", "kN", "(S20a)"),
    )


def load_post(
    part: Quantity,
    share: Quantity,
    pull: Quantity,
    splay: Quantity,
    least_tension: Quantity,
    *,
    mark: str = "",
) -> MemberLoad:
    """Post between splayed guys: the load along the row less what they hold anyway."""
    held = above_zero(share * pull / tan(splay) - least_tension)
    return MemberLoad(added=(part * held).named(f"A{mark}", "kN", "(S18)"))


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
    if load.across is not None:
        force = sqrt(force * force + load.across * load.across)
    if support.width is not None and support.spacing is not None:
        force = force * support.width / support.spacing
    elif support.end_factor is not None:  # of the net itself: the end effect is local
        force = force * (1 + support.end_factor)
    if load.lateral is not None:
        force = force * load.lateral
    if push is not None:
        force = force + push
    return force.named(symbol, "kN", "(V1)")


def take_largest(symbol: str, *forces: Quantity) -> Quantity:
    """Characteristic force: the largest of section, panel and guideline.

    One that is alone has the symbol already.
    """
    first, *others = forces
    return largest(first, *others).named(symbol, "kN", "(V1)") if others else first


def pull_at_end(rope: Quantity, support: Support) -> Quantity:
    """Pull of a border rope along the row under the end effect, at most."""
    factor, length, spacing = support.end_factor, support.end_length, support.spacing
    if factor is None:
        raise ValueError("a support inside the row has no end effect")
    grown = 1 + factor  # beyond half a bay it counts as if it were all over the bay
    if length is not None and spacing is not None and _is_short(length, spacing):
        grown = 1 + factor * length / spacing
    return (rope * grown).named("H", "kN", "(P8)")


def pull_border_rope(tension: Quantity, support: Support) -> Quantity:
    """Tension of a border rope, at the row's end under the end effect, at most."""
    factor, length, spacing = support.end_factor, support.end_length, support.spacing
    if factor is None:
        return tension.named("E_k", "kN", "(P9)")
    grown = 1 + factor  # beyond half a bay it counts as if it were all over the bay
    if length is not None and spacing is not None and _is_short(length, spacing):
        grown = 1 + factor * (2 * length / spacing)
    return (tension * grown).named("E_k", "kN", "(P9)")


def _is_short(length: Quantity, spacing: Quantity) -> bool:
    return (length.value or 0.0) / (spacing.value or 1.0) <= 0.5


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


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportForce:
    """Characteristic force on one member of one support, with what it follows from.

    Attributes
    ----------
    action : Quantity
        E_k [kN].
    coupled, by_panel, guideline : Quantity or None
        On the support, by section, panel and guideline [kN]; None where there is none.
        Of a base that slides, those across it.
    support, load, push : Support, MemberLoad, Quantity or None
        What turns a force inside the row into the member's, and the end guy's part.
    pressing, tilt : Quantity or None
        Force across the base plate [kN], and that along it over it [-], of a base that
        slides.
    """

    action: Quantity
    coupled: Quantity
    by_panel: Quantity | None = None
    guideline: Quantity | None = None
    support: Support
    load: MemberLoad = MemberLoad()
    push: Quantity | None = None
    pressing: Quantity | None = None
    tilt: Quantity | None = None


# Symbols of the number of guys on one anchor, by how their pulls are added.
GUYS_ON_ANCHOR = {"vector": "n_g", "scalar": "n_h"}
_SHARED = {"n_g": load_shared_anchor, "n_h": load_shared_anchor_in_line}
Leaves = Mapping[str, Quantity]  # given and solved quantities of a check by symbol


def calculate_force(leaves: Leaves) -> SupportForce:
    """Characteristic force of a check from its leaves, whichever of them it has.

    ``E_s``, ``E_p0``, ``E_g0`` are the forces inside the row by section, panel and
    guideline, which has a pull on the head and a least tension of its own; ``V_s`` and
    so on those across a base that slides, with its tilt ``t``; ``T_r`` alone is the
    rope of a member that holds the row's end, with the angle ``γ`` of its guy.
    """
    support = _find_support(leaves)
    letter = "V" if "V_s" in leaves else "E"
    inside, in_panel, by_floor = (
        leaves.get(f"{letter}_{one}") for one in ("s", "p0", "g0")
    )
    if inside is None or "T_b" in leaves:
        return _calculate_end(leaves, support)
    load, push = _find_load(leaves), _find_push(leaves, support)
    is_alone = in_panel is None and by_floor is None
    name = f"{letter}_k" if is_alone else f"{letter}_c"
    coupled = bring_to_support(name, inside, load, support)
    by_panel = guideline = None
    if in_panel is not None:
        by_panel = bring_to_support(f"{letter}_p", in_panel, load, support, push)
    if by_floor is not None:
        own = _find_load(leaves, mark="_g")
        guideline = bring_to_support(f"{letter}_g", by_floor, own, support)
    loads = [one for one in (coupled, by_panel, guideline) if one is not None]
    action, tilt = take_largest(f"{letter}_k", *loads), leaves.get("t")
    return SupportForce(
        action=action if tilt is None else slide_base(action, tilt),
        coupled=coupled,
        by_panel=by_panel,
        guideline=guideline,
        support=support,
        load=load,
        push=push,
        pressing=None if tilt is None else action,
        tilt=tilt,
    )


def _calculate_end(leaves: Leaves, support: Support) -> SupportForce:
    """Force in a border rope, or on a member that holds its pull along the row."""
    if "T_b" in leaves:
        action = pull_border_rope(leaves["T_b"], support)
    elif "γ" in leaves:
        action = pull_end_guy(pull_at_end(leaves["T_r"], support), leaves["γ"])
    else:
        action = pull_at_end(leaves["T_r"], support).named("E_k", "kN", "(P8)")
    return SupportForce(action=action, coupled=action, by_panel=action, support=support)


def _find_support(leaves: Leaves) -> Support:
    if "f_R" not in leaves:
        return Support()
    if "Δl" not in leaves:  # of a rope whose pull grows by f_R alone
        return Support(end_factor=leaves["f_R"])
    return place_end_support(
        leaves["b"],
        leaves["f_R"],
        leaves["Δl"],
        is_shared=any(one in leaves for one in _SHARED),
    )


def _find_load(leaves: Leaves, mark: str = "") -> MemberLoad:
    """Load along the row; with a mark that of the guideline's own pull on the head."""
    along = [leaves[one] for one in ("k", f"P{mark}", "β") if one in leaves]
    for guys, load in _SHARED.items():
        if guys in leaves:
            return load(leaves[guys], leaves["c"], *along, mark=mark)
    if "c" in leaves:
        return load_guy(leaves["c"], *along, mark=mark)
    if "w" in leaves:
        given = [leaves["w"], *along, leaves[f"T_min{mark}"]]
        return load_post(*given, mark=mark)
    if "k" in leaves:
        return MemberLoad(lateral=find_lateral_factor(leaves["k"]))
    return MemberLoad()


def _find_push(leaves: Leaves, support: Support) -> Quantity | None:
    if "T_r" not in leaves:
        return None
    return push_end_post(pull_at_end(leaves["T_r"], support), leaves["γ"])
