"""Forces on the members of a support and their utilisation, step by step.

Each function is a line of a theory page: checks/THEORY.md, (V1) and (V2);
structure/THEORY.md, (S9) to (S26); panel/THEORY.md, (P7) to (P11);
resistance/THEORY.md, (R1), (R12), (R15). Forces in kN, lengths in m, angles in degrees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

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
from netdesign.checks.inputs import (
    MemberLoad,
    Support,
    place_end_support,
)

Leaves = Mapping[str, Quantity]  # given and solved quantities of a check by symbol


def find_lateral_factor(share: Quantity) -> Quantity:
    """k_q: a force with its part along the row, over that in the section."""
    return sqrt(1 + share * share).named("k_q", "-", "(S11)")


def load_guy(
    part: Quantity, share: Quantity, pull: Quantity, splay: Quantity, *, mark: str = ""
) -> MemberLoad:
    """Load one of two splayed guys, which hold the load along the row.

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
    across = (guys * of_one).named(f"B{mark}", "kN", "(S20)")
    return MemberLoad(across=across, splay=along[-1])


def load_shared_anchor_in_line(
    guys: Quantity, *along: Quantity, mark: str = ""
) -> MemberLoad:
    """Load a shared anchor by the sum of both pulls, as if they were in line."""
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

    ``push`` is what the ropes' pull along the row adds to it there.
    """
    force = inside if load.share is None else load.share * inside
    if load.added is not None:
        force = force + load.added
    if load.across is not None and (push is None or load.splay is None):
        force = sqrt(force * force + load.across * load.across)
    if support.width is not None and support.spacing is not None:
        force = force * support.width / support.spacing
    elif support.end_factor is not None:  # of the net itself: the end effect is local
        force = force * (1 + support.end_factor)
    if push is not None:
        force = _add_push(force, load, support, push)
    elif load.lateral is not None:
        force = force * load.lateral
    return force.named(symbol, "kN", "(V1)")


def _add_push(
    force: Quantity, load: MemberLoad, support: Support, push: Quantity
) -> Quantity:
    """Force with what the ropes add: along the row at a foot, else along the member."""
    if load.along is not None:
        along = load.along * force + push
        return sqrt(force * force + along * along)
    if load.across is not None and load.splay is not None:
        return _pull_shared(force, load.across, load.splay, support, push)
    return force + 2 * push if support.has_both else force + push


def _pull_shared(
    force: Quantity, across: Quantity, splay: Quantity, at: Support, push: Quantity
) -> Quantity:
    """Pull of two guys on one anchor, to one of which the ropes add a force.

    Or to both, each away from the other: square to the section no more than one counts.
    """
    if at.width is not None and at.spacing is not None:
        across = across * at.width / at.spacing
    guys = 2 * push if at.has_both else push
    in_section, square = force + guys * cos(splay), across + push * sin(splay)
    return sqrt(in_section * in_section + square * square)


def take_largest(symbol: str, *forces: Quantity) -> Quantity:
    """Characteristic force: the largest of section, panel, guideline and maker.

    One that is alone has the symbol already.
    """
    first, *others = forces
    return largest(first, *others).named(symbol, "kN", "(V1)") if others else first


def take_from_maker(stated: Quantity, support: Support) -> Quantity:
    """Force on an anchor as its maker states it, at every support of the row.

    Where the end effect loads one with more than a bay, it grows in proportion.
    """
    if support.width is None or support.spacing is None:
        return stated.named("E_m", "kN", "(V1)")
    width = largest(support.width, support.spacing)
    return (stated * width / support.spacing).named("E_m", "kN", "(V1)")


def pull_at_end(rope: Quantity, support: Support) -> Quantity:
    """Pull of a border rope along the row under the end effect, at most."""
    return (rope * (1 + _raise_pull(support))).named("H", "kN", "(P8)")


def pull_one_way(rope: Quantity, support: Support) -> Quantity:
    """Pull of a border rope in the last bay beyond that in the next one, at most."""
    return (rope * _raise_pull(support)).named("D", "kN", "(P10)")


def _raise_pull(support: Support) -> Quantity:
    """Growth of a rope's pull in the last bay by the end effect, at most [-]."""
    factor, length, spacing = support.end_factor, support.end_length, support.spacing
    if factor is None:
        raise ValueError("a support inside the row has no end effect")
    if support.reaching > 1:
        factor = support.reaching * factor
    if length is not None and spacing is not None and _is_short(length, spacing):
        return factor * length / spacing
    return factor  # beyond half a bay it counts as if it were all over the bay


def pull_border_rope(tension: Quantity, support: Support) -> Quantity:
    """Tension of a border rope, at the row's end under the end effect, at most."""
    factor, length, spacing = support.end_factor, support.end_length, support.spacing
    if factor is None:
        return tension.named("E_k", "kN", "(P9)")
    if support.reaching > 1:
        factor = support.reaching * factor
    grown = 1 + factor  # beyond half a bay it counts as if it were all over the bay
    if length is not None and spacing is not None and _is_short(length, spacing):
        grown = 1 + factor * (2 * length / spacing)
    return (tension * grown).named("E_k", "kN", "(P9)")


def _is_short(length: Quantity, spacing: Quantity) -> bool:
    return (length.value or 0.0) / (spacing.value or 1.0) <= 0.5


def pull_end_guy(rope: Quantity, angle: Quantity) -> Quantity:
    """Tension of the end guy that holds the ridge rope."""
    return (rope / cos(angle)).named("E_k", "kN", "(P7)")


def push_by_end_guy(
    rope: Quantity,
    angle: Quantity,
    part: Quantity | None = None,
    splay: Quantity | None = None,
) -> Quantity:
    """Force that the end guy's pull on the head brings to a member of the support.

    All of it to one that stands along that pull; half to each of two splayed guys.
    """
    push = rope * tan(angle)
    if part is not None:
        push = part * push
    if splay is not None:
        push = push / (2 * cos(splay))
    return push.named("Z", "kN", "(S25)")


def hold_one_way(rope: Quantity, part: Quantity, splay: Quantity) -> Quantity:
    """Tension of a splayed guy of the second head by the rope's unbalanced pull."""
    return (part * rope / sin(splay)).named("Z", "kN", "(P11)")


def press_one_way(
    rope: Quantity, post: Leaves, at: Support, mark: str = ""
) -> Quantity:
    """Compression of the second post by that pull and the load along the row, (S18)."""
    sideways, least = post["k"] * post[f"P{mark}"], post[f"T_min{mark}"]
    if at.width is not None and at.spacing is not None:
        sideways, least = (load * at.width / at.spacing for load in (sideways, least))
    held = above_zero((sideways + rope) / tan(post["β"]) - least)
    return (post["w"] * held).named(f"Z{mark}", "kN", "(P11)")


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
        What turns a force inside the row into the member's, and the ropes' part.
    shared : Quantity or None
        That of a linear truss of post, guys and end guy, on a guy or its anchor [kN].
    pressing, tilt : Quantity or None
        Force across the base plate [kN], and that along it over it [-], of a base that
        slides.
    """

    action: Quantity
    coupled: Quantity
    by_panel: Quantity | None = None
    guideline: Quantity | None = None
    support: Support
    load: MemberLoad = field(default_factory=MemberLoad)
    push: Quantity | None = None
    shared: Quantity | None = None
    pressing: Quantity | None = None
    tilt: Quantity | None = None

    @property
    def by_model(self) -> list[Quantity]:
        """Forces of the coupled calculation, whether they decide or not."""
        return [force for force in (self.coupled, self.by_panel, self.shared) if force]


# Symbols of the number of guys on one anchor, by how their pulls are added.
GUYS_ON_ANCHOR = {"vector": "n_g", "scalar": "n_h"}
_SHARED = {"n_g": load_shared_anchor, "n_h": load_shared_anchor_in_line}


def calculate_force(leaves: Leaves, *, by_guideline: bool = False) -> SupportForce:
    """Characteristic force of a check from its leaves, whichever of them it has.

    It is the largest one; ``by_guideline``, that of the guideline's load where there is
    one, and not less than the maker's ``E_m0``.


    ``E_s``, ``E_p0``, ``E_g0`` are the forces inside the row by section, panel and
    guideline, which has a pull on the head and a least tension of its own; ``V_s`` and
    so on those across a base that slides, with its tilt ``t``; ``T_r`` alone is the
    rope of a member that holds the row's end, with the angle ``γ`` of its guy.
    """
    support = _find_support(leaves)
    letter = "V" if "V_s" in leaves else "E"
    inside, in_panel, by_floor = (
        leaves.get(f"{letter}_{index}") for index in ("s", "p0", "g0")
    )
    if inside is None or "T_b" in leaves:
        return _calculate_end(leaves, support)
    load, push = _find_load(leaves, support), _find_push(leaves, support)
    shared, of_maker = leaves.get("E_t"), leaves.get("E_m0")
    beside = (in_panel, by_floor, shared, of_maker)
    name = f"{letter}_k" if not any(beside) else f"{letter}_c"
    coupled = bring_to_support(name, inside, load, support, push)
    by_panel = guideline = None
    if in_panel is not None:
        by_panel = bring_to_support(f"{letter}_p", in_panel, load, support, push)
    if by_floor is not None:
        own = _find_load(leaves, support, mark="_g")
        of_floor = _find_push(leaves, support, mark="_g")
        guideline = bring_to_support(f"{letter}_g", by_floor, own, support, of_floor)
    stated = take_from_maker(of_maker, support) if of_maker else None
    solved = () if by_guideline and guideline else (coupled, by_panel)
    deciding = (*solved, guideline, shared if solved else None, stated)
    action = take_largest(f"{letter}_k", *(x for x in deciding if x is not None))
    if guideline is action:
        action = action.named(f"{letter}_k", "kN", "(V1)")
    tilt = leaves.get("t")
    return SupportForce(
        action=action if tilt is None else slide_base(action, tilt),
        coupled=coupled,
        by_panel=by_panel,
        guideline=guideline,
        support=support,
        load=load,
        push=push,
        shared=shared,
        pressing=None if tilt is None else action,
        tilt=tilt,
    )


def _calculate_end(leaves: Leaves, support: Support) -> SupportForce:
    """Force in a border rope, or on a member that holds its pull along the row."""
    if "T_b" in leaves:
        action = pull_border_rope(_take_rope(leaves, "T_b"), support)
    elif "γ" in leaves:
        pull = pull_at_end(_take_rope(leaves), support)
        action = pull_end_guy(pull, leaves["γ"])
    else:
        action = pull_at_end(_take_rope(leaves), support).named("E_k", "kN", "(P8)")
    return SupportForce(action=action, coupled=action, by_panel=action, support=support)


def _take_rope(leaves: Leaves, symbol: str = "T_r") -> Quantity:
    """Force of a border rope, raised to the guideline's load where that is larger."""
    rope = leaves[symbol]
    return leaves["φ_g"] * rope if "φ_g" in leaves else rope


def _find_support(leaves: Leaves) -> Support:
    if "f_R" not in leaves:
        return Support()
    if "Δl" not in leaves:  # of a rope whose pull grows by f_R alone
        return Support(end_factor=leaves["f_R"])
    effect = (leaves["b"], leaves["f_R"], leaves["Δl"])
    is_shared = any(symbol in leaves for symbol in _SHARED)
    second, other, beside = (leaves.get(symbol) for symbol in ("s_2", "s_e", "s_n"))
    return place_end_support(
        *effect, second=second, other=other, beside=beside, is_shared=is_shared
    )


def _find_load(leaves: Leaves, support: Support, mark: str = "") -> MemberLoad:
    """Load along the row; with a mark that of the guideline's own pull on the head."""
    along = [leaves[symbol] for symbol in ("k", f"P{mark}", "β") if symbol in leaves]
    for guys, load in _SHARED.items():
        if guys in leaves:
            return load(leaves[guys], leaves["c"], *along, mark=mark)
    if "c" in leaves:
        return load_guy(leaves["c"], *along, mark=mark)
    if "w" in leaves:
        if support.is_second and "T_r" in leaves:
            return MemberLoad()  # what presses the post is worked out together
        loads = [leaves["w"], *along, leaves[f"T_min{mark}"]]
        return load_post(*loads, mark=mark)
    if "k" in leaves:
        share = leaves["k"]
        return MemberLoad(lateral=find_lateral_factor(share), along=share)
    return MemberLoad()


def _find_push(leaves: Leaves, support: Support, mark: str = "") -> Quantity | None:
    """Find what the ropes' pull along the row adds at its end, or beside it."""
    if "T_r" not in leaves:
        return None
    rope, splay = _take_rope(leaves), leaves.get("β") if "c" in leaves else None
    if not support.is_second:
        pull = pull_at_end(rope, support)
        return push_by_end_guy(pull, leaves["γ"], leaves.get("e"), splay)
    pull = pull_one_way(rope, support)
    if splay is not None:
        return hold_one_way(pull, leaves["c"], splay)
    return press_one_way(pull, leaves, support, mark) if "w" in leaves else pull
