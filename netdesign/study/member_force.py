"""Characteristic force on a member of a support, from the forces that a study states.

The formulas are those of ``checks/forces.py``; here they get their numbers: solved
forces, the guideline's, cells of the workbook, values of the profile.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.checks import Standard
from netdesign.checks.check import find_profile_value
from netdesign.checks.forces import (
    MemberLoad,
    Support,
    bring_floor_to_support,
    bring_to_support,
    find_lateral_factor,
    load_guy,
    load_post,
    place_end_support,
    place_support,
    pull_at_end,
    pull_end_guy,
    push_end_post,
    slide_base,
    take_largest,
)
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import (
    ROPE_OF,
    EndMember,
    Member,
    RopeForce,
    name_in_panel,
)
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.effects import RowEffects
from netdesign.study.force_records import ForceRecord
from netdesign.study.guideline_records import FloorForceRecord
from netdesign.study.support_records import HeldSidewaysRecord
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say
from netdesign.words.names import name

Governing = Literal["coupled", "panel", "guideline"]
PUSHED = (Member.POST, Member.POST_BASE)  # by the end guy
_UPHILL = (Member.UPHILL_GUY, Member.UPHILL_ANCHOR)
_DOWNHILL = (Member.DOWNHILL_GUY, Member.DOWNHILL_ANCHOR)


@dataclass(frozen=True, slots=True, kw_only=True)
class RowForces:
    """Forces that the checks of a row rest on, in engineer's units.

    Attributes
    ----------
    row, standard, effects
        Net row, limit profile, and the supports that differ in their load.
    largest : mapping of str to ForceRecord
        Largest solved forces by their keys, with what may hide.
    floor : mapping of str to FloorForceRecord, or None
        Forces by the guideline's load; None where it is no floor.
    held : HeldSidewaysRecord or None
        Load along the row at the head; None where nothing holds it.
    tilt : float
        Largest force along the slope at a post's base over that across, (S19) [-].
    """

    row: NetRow
    standard: Standard
    effects: RowEffects
    largest: Mapping[str, ForceRecord]
    floor: Mapping[str, FloorForceRecord] | None
    held: HeldSidewaysRecord | None
    tilt: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberForce:
    """Characteristic force on one member of one support, with what it follows from.

    Attributes
    ----------
    action : Quantity
        E_k [kN].
    solved : tuple of ForceRecord
        By section, and by the panel between posts where there is one.
    largest : ForceRecord
        Larger one of them, which the check names its case by.
    coupled, by_panel, guideline : Quantity or None
        On the support, by section, panel and guideline [kN]; None where there is none.
    load, push : MemberLoad, Quantity or None
        What turns a force inside the row into the member's, and the end guy's part.
    on_support : float
        Force on the support over that inside the row, lateral load included [-].
    pull, rise : float
        Largest pull on a head, which brings what is added, 0 without any; and what that
        grows by at most where the pull doubles [kN].
    tilt : float
        Factor on all of it, of a base that slides [-].
    pressing : Quantity or None
        Force across the base plate, of a base that slides [kN].
    """

    action: Quantity
    solved: tuple[ForceRecord, ...]
    largest: ForceRecord
    coupled: Quantity
    by_panel: Quantity | None = None
    guideline: Quantity | None = None
    load: MemberLoad
    push: Quantity | None = None
    on_support: float
    pull: float = 0.0
    rise: float = 0.0
    tilt: float = 1.0
    pressing: Quantity | None = None

    @property
    def is_by_panel(self) -> bool:
        """The force by the panel between posts is larger than that of the section."""
        return (_high(self.by_panel) or 0.0) > (_high(self.coupled) or 0.0)

    @property
    def governs(self) -> Governing:
        """Largest one of the three; solved forces count with their upper ends."""
        solved = max(_high(self.coupled) or 0.0, _high(self.by_panel) or 0.0)
        least = _high(self.guideline)
        if least and least >= solved:
            return "guideline"
        return "panel" if self.is_by_panel else "coupled"

    @property
    def share(self) -> float:
        """Part of the section's force in the member [-]."""
        share = self.load.share
        return self.tilt * ((share.value if share else None) or 1.0)

    @property
    def added(self) -> float:
        """Force that the load along the row adds, inside the row [kN]."""
        added = self.load.added
        return self.tilt * ((added.value if added else None) or 0.0)

    @property
    def added_high(self) -> float:
        """Upper end of what the load along the row adds, inside the row [kN]."""
        return self.tilt * (_high(self.load.added) or 0.0)

    def find_high(self, force: float, *, is_by_panel: bool) -> float:
        """Upper end of the member's force inside the row, from one solved [kN]."""
        push = (_high(self.push) or 0.0) if is_by_panel else 0.0
        along = self.tilt * push / self.on_support
        return self.share * force + self.added_high + along


def _high(quantity: Quantity | None) -> float | None:
    return quantity.high if quantity else None


def find_cell(row: NetRow, column: str, sheet: str = "Nets") -> str:
    """Cell of a row's input; "" where it has none."""
    label = say(f"column.{sheet}.{column}")
    return next((one.cell for one in row.inputs if one.label == label), "")


def solve_for(record: ForceRecord, symbol: str) -> Quantity:
    """Largest solved force as a quantity [kN]."""
    return given(
        *(symbol, record.value_kN, "kN", record.quantity),
        kind=Kind.SOLVED,
        band=(record.low_kN, record.high_kN),
    )


def build_support(row: NetRow, width: LoadedWidth) -> Support:
    """Support of a row, inside it or at its end, as a calculation has it."""
    cell = find_cell(row, "post_spacing")
    spacing = given("b", row.layout.post_spacing, "m", cell)
    if width.position == "intermediate":
        return place_support(spacing)
    factor, length = (
        given(symbol, value, unit, "end.constant", kind=Kind.PROFILE)
        for symbol, value, unit in (
            ("f_R", width.end_factor, "-"),
            ("Δl", width.end_length, "m"),
        )
    )
    return place_end_support(spacing, factor, length)


def find_force(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> MemberForce | None:
    """Force on a member of the support of that width; None without a solved case."""
    member = resistance.member
    if member not in forces.largest:
        return None
    support = build_support(forces.row, width)
    load, rise = _find_load(forces, member)
    is_sliding = resistance.mode == "sliding"
    letter = "V" if is_sliding else "E"
    push = _find_push(forces, member, support)
    found = _list_forces(forces, member, letter, load, support, push)
    action = take_largest(f"{letter}_k", *(one for one in found if one is not None))
    coupled, by_panel, guideline = found
    section = forces.largest[member]
    on_panel = forces.largest.get(name_in_panel(member))
    is_panel = on_panel is not None and (_high(by_panel) or 0.0) > (coupled.high or 0.0)
    is_foot = member in (Member.FOOT_ANCHOR, *forces.effects.at_foot)
    tilt = given("t", forces.tilt, "-", "tilt", kind=Kind.SOLVED)
    return MemberForce(
        action=slide_base(action, tilt) if is_sliding else action,
        solved=(section,) if on_panel is None else (section, on_panel),
        largest=on_panel if is_panel and on_panel is not None else section,
        coupled=coupled,
        by_panel=by_panel,
        guideline=guideline,
        load=load,
        push=push,
        on_support=_compare_support(support, load),
        pull=forces.held.pull_kN if forces.held and not is_foot else 0.0,
        rise=rise,
        tilt=forces.tilt if is_sliding else 1.0,
        pressing=action if is_sliding else None,
    )


def _list_forces(
    forces: RowForces,
    member: str,
    letter: str,
    load: MemberLoad,
    support: Support,
    push: Quantity | None,
) -> tuple[Quantity, Quantity | None, Quantity | None]:
    """Forces on the support by section, panel and guideline."""
    panel = forces.largest.get(name_in_panel(member))
    least = forces.floor.get(member) if forces.floor is not None else None
    is_alone = panel is None and least is None
    solved = solve_for(forces.largest[member], f"{letter}_s")
    symbol = f"{letter}_k" if is_alone else f"{letter}_c"
    coupled = bring_to_support(symbol, solved, load, support)
    by_panel = guideline = None
    if panel is not None:
        inside = solve_for(panel, f"{letter}_p0")
        by_panel = bring_to_support(f"{letter}_p", inside, load, support, push)
    if least is not None:
        symbol, source = f"{letter}_g0", f"floor.{member}"
        inside = given(symbol, least.force_kN, "kN", source, kind=Kind.SOLVED)
        guideline = bring_floor_to_support(f"{letter}_g", inside, load, support)
    return coupled, by_panel, guideline


def _compare_support(support: Support, load: MemberLoad) -> float:
    width, spacing = support.width.value or 0.0, support.spacing.value or 1.0
    lateral = load.lateral.value if load.lateral else None
    return width / spacing * (lateral or 1.0)


def _find_load(forces: RowForces, member: str) -> tuple[MemberLoad, float]:
    """Way from the section's force to a member's, and how its addition may grow."""
    if member in forces.effects.at_foot:
        share = find_profile_value(forces.standard, LATERAL_SHARE, "k")
        lateral = find_lateral_factor(share) if share.is_known else None
        return MemberLoad(lateral=lateral), 0.0
    held = forces.held
    if held is None or member == Member.FOOT_ANCHOR:
        return MemberLoad(), 0.0
    share = find_profile_value(forces.standard, LATERAL_SHARE, "k")
    splay = given("β", held.splay_deg, "deg", find_cell(forces.row, "guy_splay"))
    pull = given(
        *("P", held.pull_kN, "kN", "head_pull"),
        kind=Kind.SOLVED,
        band=(held.pull_low_kN, held.pull_high_kN),
    )
    if member in (*_UPHILL, *_DOWNHILL):
        is_uphill = member in _UPHILL
        part = held.uphill_part if is_uphill else held.downhill_part
        source = "uphill_part" if is_uphill else "downhill_part"
        weight = given("c", part, "-", source, kind=Kind.SOLVED)
        load = load_guy(weight, share, pull, splay)
        return load, _high(load.added) or 0.0
    weight = given("w", held.post_part, "-", "post_part", kind=Kind.SOLVED)
    least = given(
        "T_min", held.least_tension_kN, "kN", "least_tension", kind=Kind.SOLVED
    )
    load = load_post(weight, share, pull, splay, least)
    nothing = given("T_min", 0.0, "kN", "least_tension", kind=Kind.SOLVED)
    rise = _high(load_post(weight, share, pull, splay, nothing).added) or 0.0
    # the guys' least tension does not grow
    return (MemberLoad() if _high(load.added) == 0.0 else load), rise


def _find_push(forces: RowForces, member: str, support: Support) -> Quantity | None:
    """Compression by the end guy of a post at the row's end."""
    row, rope = forces.row, forces.largest.get(RopeForce.UPPER_ALONG)
    if member not in PUSHED or support.position != "edge" or rope is None:
        return None
    angle = _find_guy_angle(row)
    if angle is None:
        return None
    return push_end_post(pull_at_end(solve_for(rope, "T_r"), support), angle)


def _find_guy_angle(row: NetRow) -> Quantity | None:
    angle = row.row_end.guy_angle if row.row_end else None
    if angle is None:
        return None
    cell = find_cell(row, "end_guy_angle", "Ends") or find_cell(row, "end_guy_angle")
    return given("γ", degree_from_radian(angle), "deg", cell)


def find_end_force(forces: RowForces, member: str) -> MemberForce | None:
    """Force on a member that holds the ropes' pull along the row, at its end.

    None of a row without panel or end, and where no case has a panel.
    """
    rope = forces.largest.get(ROPE_OF[member])
    if forces.row.row_end is None or rope is None:
        return None
    support = build_support(forces.row, forces.effects.find_support("edge"))
    pull = pull_at_end(solve_for(rope, "T_r"), support)
    angle = _find_guy_angle(forces.row)
    if member == EndMember.LATERAL_ANCHOR or angle is None:
        action = pull.named("E_k", "kN", "(P8)")
    else:
        action = pull_end_guy(pull, angle)
    return MemberForce(
        action=action,
        solved=(rope,),
        largest=rope,
        coupled=action,
        by_panel=action,
        load=MemberLoad(),
        on_support=(action.high or 0.0) / rope.high_kN if rope.high_kN else 1.0,
    )


def tell_governing(reason: Message, force: MemberForce, load_case: str) -> Message:
    """A verdict's reason with the load that governs; of no demand at all, none does."""
    loads = (force.coupled, force.by_panel, force.guideline)
    is_alone = force.by_panel is None and force.guideline is None
    if is_alone or not any(_high(one) for one in loads):
        return reason
    load = say(f"load.{force.governs}", case=name("load_case", load_case))
    return say("load.reason", reason=reason, load=load)


def leave_out_governing(reason: Message) -> Message:
    """The reason alone of what `tell_governing` gives."""
    alone = reason.arguments.get("reason")
    is_told = reason.key == "load.reason" and isinstance(alone, Message)
    return alone if is_told and isinstance(alone, Message) else reason
