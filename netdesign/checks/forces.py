"""Forces on the members of a support and their utilisation, step by step.

Each function is a line of a theory page: checks/THEORY.md, (V1) and (V2);
structure/THEORY.md, (S9) to (S26); panel/THEORY.md, (P7) to (P11);
resistance/THEORY.md, (R1), (R12), (R15). Forces in kN, lengths in m, angles in degrees.
"""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.calculation.quantity import (
    Quantity,
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
    """Support of a row: the factors from a force inside the row to that on it.

    Attributes
    ----------
    spacing, width : Quantity or None
        b and b_e [m]; None inside the row, where one is the other.
    end_factor, end_length : Quantity or None
        f_R [-] and its length [m]; None inside the row.
    is_second : bool
        It stands beside the end.
    reaching : int
        End effects that reach the last bay.
    has_both : bool
        An anchor of two posts, each beside an end: ropes add a force to both guys.
    """

    spacing: Quantity | None = None
    width: Quantity | None = None
    end_factor: Quantity | None = None
    end_length: Quantity | None = None
    is_second: bool = False
    reaching: int = 1
    has_both: bool = False

    def widen(self, force: Quantity) -> Quantity:
        """Force by the width of net that the support carries, from that of a bay."""
        if self.width is None or self.spacing is None:
            return force
        return force * self.width / self.spacing


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberLoad:
    """Way from a force of the section to that of a member, inside the row.

    Attributes
    ----------
    share : Quantity or None
        g, of the section's force in the member [-]; None of all of it.
    added : Quantity or None
        A, by the load along the row [kN]; None of nothing.
    lateral, along : Quantity or None
        k_q and k, by the load along the row at the net's foot [-]; None of 1 and 0.
    across, splay : Quantity or None
        Of two guys on one anchor, square to what they share in the section [kN]; and
        the angle of each out of it [deg].
    """

    share: Quantity | None = None
    added: Quantity | None = None
    lateral: Quantity | None = None
    along: Quantity | None = None
    across: Quantity | None = None
    splay: Quantity | None = None


def place_end_support(
    spacing: Quantity,
    factor: Quantity,
    length: Quantity,
    *,
    second: Quantity | None = None,
    other: Quantity | None = None,
    beside: Quantity | None = None,
    is_shared: bool = False,
) -> Support:
    """First or last support of a row: half a bay and the end effect.

    With ``second`` the one beside it: a bay, and that part of a bay of the end effect
    by the lever rule. ``other`` and ``beside`` are parts of a bay of the other end's
    effect on it, and of the end effects on the next support.

    An anchor that it shares holds a guy of the next post, too, which carries a bay and
    the part ``beside``. In a row of four that post stands beside the other end.
    """

    def widen(part: Quantity) -> Quantity:
        return spacing + factor * part * spacing

    width = spacing / 2 + factor * length if second is None else widen(second)
    if other is not None:
        width = width + factor * other * spacing
    if is_shared:
        both = (width + (spacing if beside is None else widen(beside))) / 2
        width = largest(width, both) if second is None else both
    has_both = False
    if is_shared and second is not None and beside is not None:
        has_both = (beside.value or 0.0) >= (second.value or 0.0)
    clause = "(S9)" if second is None else "(S10a)"
    return Support(
        spacing=spacing,
        width=width.named("b_e", "m", "(S20)" if is_shared else clause),
        end_factor=factor,
        end_length=length,
        is_second=second is not None,
        reaching=1 if other is None else 2,
        has_both=has_both,
    )


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
    part: Quantity, share: Quantity, pull: Quantity, splay: Quantity, *, mark: str = ""
) -> MemberLoad:
    """Post between splayed guys, pressed by the load along the row that they hold."""
    pressed = part * (share * pull / tan(splay))
    return MemberLoad(added=pressed.named(f"A{mark}", "kN", "(S18)"))


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
    force = support.widen(force)
    if support.width is None and support.end_factor is not None:
        force = force * (1 + support.end_factor)  # of the net: the effect is local
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
    across = at.widen(across)
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
    rope: Quantity,
    at: Support,
    weight: Quantity,
    share: Quantity,
    pull: Quantity,
    splay: Quantity,
    *,
    mark: str = "",
) -> Quantity:
    """Compression of the second post by that pull and the load along the row, (S18)."""
    held = (at.widen(share * pull) + rope) / tan(splay)
    return (weight * held).named(f"Z{mark}", "kN", "(P11)")


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
