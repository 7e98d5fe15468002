"""Characteristic force on a member of a support, from the forces that a study states.

The formulas are those of ``checks/forces.py``; here they get their numbers: solved
forces, the guideline's, cells of the workbook, values of the profile.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from netdesign.calculation.quantity import Kind, Quantity, given
from netdesign.checks.comparison import find_profile_value
from netdesign.checks.forces import (
    GUYS_ON_ANCHOR,
    SupportForce,
    calculate_force,
    load_guy,
    load_post,
)
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.result_reader import POST_PULLS
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import (
    ROPE_OF,
    EndMember,
    Member,
    NetPart,
    RopeForce,
    name_in_panel,
)
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.case_records import FloorForceRecord, FloorRecord, LargestForce
from netdesign.study.effects import RowEffects
from netdesign.study.pulls import may_share
from netdesign.study.row_to_check import Basis
from netdesign.study.support_records import HeldSidewaysRecord, PullRecord
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say

PUSHED = (Member.POST, Member.POST_BASE)  # by the end guy
_MOST_NAMES = 3  # of inputs that a row lacks, in the reason of a check
_ROPES = (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE)
# Weights of the load along the row in the guys of each side.
PARTS: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill_part",
    Member.UPHILL_ANCHOR: "uphill_part",
    Member.DOWNHILL_GUY: "downhill_part",
    Member.DOWNHILL_ANCHOR: "downhill_part",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RowForces(Basis):
    """Knowledge of a row by its solved cases, or by its study, in engineer's units.

    Attributes
    ----------
    effects : RowEffects
        Supports that differ in their load.
    largest : mapping of str to LargestForce
        Largest solved forces by their keys, with what may hide.
    floor : FloorRecord or None
        Forces by the guideline's load; None where it is no floor.
    held : HeldSidewaysRecord or Message
        Load along the row at the head, or why nothing holds it.
    tilt : float
        Largest force along the slope at a post's base over that across, (S19) [-].
    pulls : tuple of PullRecord
        Directions at the anchors.
    gap : Message or None
        Why the forces do not cover every case.
    panel_gap : Message or None
        Why an assumed panel fails, so that nothing is known of the row.
    """

    effects: RowEffects
    largest: Mapping[str, LargestForce]
    floor: FloorRecord | None
    held: HeldSidewaysRecord | Message
    tilt: float
    pulls: tuple[PullRecord, ...] = ()
    gap: Message | None = None
    panel_gap: Message | None = None

    @property
    def along_row(self) -> HeldSidewaysRecord | None:
        """Load along the row at the head; None where nothing holds it."""
        return self.held if isinstance(self.held, HeldSidewaysRecord) else None

    @property
    def floor_gap(self) -> Message | None:
        """Reason why the guideline's load is not known."""
        return self.floor.reason if self.floor else None

    def find_least(self, member: str) -> FloorForceRecord | None:
        """Force of a member by the guideline's load; None where there is none."""
        forces = self.floor.forces if self.floor else ()
        return next((one for one in forces if one.member == member), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberForce:
    """Characteristic force on one member of one support, with where it comes from.

    Attributes
    ----------
    on : SupportForce
        The force, step by step.
    solved : tuple of LargestForce
        By section, and by the panel between posts where there is one.
    largest : LargestForce
        Larger one of them, which the check names its case by.
    pull, rise : float
        Largest pull on a head, which brings what is added, 0 without any; and what that
        grows by at most where the pull doubles [kN].
    """

    on: SupportForce
    solved: tuple[LargestForce, ...]
    largest: LargestForce
    pull: float = 0.0
    rise: float = 0.0

    @property
    def action(self) -> Quantity:
        """E_k [kN]."""
        return self.on.action

    @property
    def is_by_panel(self) -> bool:
        """The force by the panel between posts is larger than that of the section."""
        return _high(self.on.by_panel) > _high(self.on.coupled)

    @property
    def on_support(self) -> float:
        """Force on the support over that inside the row, lateral load included [-]."""
        support, lateral = self.on.support, self.on.load.lateral
        if self.largest.quantity in tuple(RopeForce):
            return _high(self.action) / (self.largest.high_kN or 1.0)
        if support.end_factor is not None and support.width is None:  # of the mesh
            return 1.0 + (support.end_factor.value or 0.0)
        ratio = 1.0
        if support.width is not None and support.spacing is not None:
            ratio = (support.width / support.spacing).value or 1.0
        return ratio * ((lateral.value if lateral else None) or 1.0)

    @property
    def share(self) -> float:
        """Part of the section's force in the member [-]."""
        share = self.on.load.share
        return self._tilt * ((share.value if share else None) or 1.0)

    @property
    def _tilt(self) -> float:
        return (self.on.tilt.value if self.on.tilt else None) or 1.0

    @property
    def added(self) -> float:
        """Force that the load along the row adds, inside the row [kN]."""
        added = self.on.load.added
        return self._tilt * ((added.value if added else None) or 0.0)

    @property
    def added_high(self) -> float:
        """Upper end of what the load along the row adds, inside the row [kN]."""
        return self._tilt * (_high(self.on.load.added) + _high(self.on.load.across))

    def compare_load(self, other: MemberForce) -> float:
        """Load of its support over that of another [-].

        The larger growth of width and of what the end guy brings counts for both.
        """
        growth, push = self.on_support / other.on_support, _high(other.on.push)
        return max(growth, _high(self.on.push) / push) if push else growth

    def find_high(self, force: float) -> float:
        """Upper end of the member's force inside the row, from one solved [kN]."""
        push = _high(self.on.push) if self.is_by_panel else 0.0
        along = self._tilt * push / self.on_support
        if self.on.load.across is not None:
            return math.hypot(force, _high(self.on.load.across))
        return self.share * force + self.added_high + along


def _high(quantity: Quantity | None) -> float:
    return (quantity.high if quantity else None) or 0.0


def find_cell(row: NetRow, column: str, sheet: str = "Nets") -> str:
    """Cell of a row's input; "" where it has none."""
    label = say(f"column.{sheet}.{column}")
    return next((one.cell for one in row.inputs if one.label == label), "")


def solve_for(record: LargestForce, symbol: str) -> Quantity:
    """Largest solved force as a quantity [kN]."""
    return given(
        *(symbol, record.value_kN, "kN", record.quantity),
        kind=Kind.SOLVED,
        band=(record.low_kN, record.high_kN),
    )


def find_force(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> MemberForce | None:
    """Force on a member of the support of that width; None without a solved case."""
    member = resistance.member
    if member in ROPE_OF:
        return _find_end_force(forces, member, width)
    section = forces.largest.get(member)
    if section is None:
        return None
    is_sliding = resistance.mode == "sliding"
    letter = "V" if is_sliding else "E"
    leaves = _list_support_leaves(forces.row, width, member)
    leaves += [solve_for(section, f"{letter}_s")]
    panel = forces.largest.get(name_in_panel(member))
    if panel is not None:
        leaves.append(solve_for(panel, f"{letter}_p0"))
    least = forces.find_least(member)
    if least is not None:
        leaves.append(_solved(f"{letter}_g0", least.force_kN, "kN", f"floor.{member}"))
    added, rise = _list_load_leaves(forces, member)
    leaves += added
    if panel is not None and member in PUSHED and width.position == "edge":
        leaves += _list_push_leaves(forces)
    if is_sliding:
        leaves.append(_solved("t", forces.tilt, "-", "tilt"))
    force = calculate_force({one.symbol: one for one in leaves})
    is_by_panel, held = _high(force.by_panel) > _high(force.coupled), forces.along_row
    has_no_pull = member in (
        Member.FOOT_ANCHOR,
        NetPart.MESH,
        *forces.row.layout.anchors_at_foot,
    )
    return MemberForce(
        on=force,
        solved=(section,) if panel is None else (section, panel),
        largest=panel if panel is not None and is_by_panel else section,
        pull=held.pull_kN if held and not has_no_pull else 0.0,
        rise=rise,
    )


def _find_end_force(
    forces: RowForces, member: str, width: LoadedWidth
) -> MemberForce | None:
    """Force of a border rope, or on a member that holds its pull at the row's end.

    None of a row without panel or end, and where no case has a panel.
    """
    rope = forces.largest.get(ROPE_OF[member])
    is_endless = forces.row.row_end is None and member in tuple(EndMember)
    if is_endless or rope is None or forces.effects.end_lack is not None:
        return None
    symbol = "T_b" if member in _ROPES else "T_r"
    leaves = [*_list_support_leaves(forces.row, width, member), solve_for(rope, symbol)]
    if member in (EndMember.END_GUY, EndMember.END_GUY_ANCHOR):
        leaves += _list_guy_angle(forces.row)
    force = calculate_force({one.symbol: one for one in leaves})
    return MemberForce(on=force, solved=(rope,), largest=rope)


def _solved(symbol: str, value: float, unit: str, source: str) -> Quantity:
    return given(symbol, value, unit, source, kind=Kind.SOLVED)


def _list_support_leaves(
    row: NetRow, width: LoadedWidth, member: str
) -> list[Quantity]:
    """Widths that load a support, inside the row or at its end.

    The mesh has the whole end effect, which is local.
    """
    if width.position == "intermediate":
        return []
    rule = "end.constant"
    factor = given("f_R", width.end_factor, "-", rule, kind=Kind.PROFILE)
    if member == NetPart.MESH:
        return [factor]
    return [
        given("b", row.layout.post_spacing, "m", find_cell(row, "post_spacing")),
        factor,
        given("Δl", width.end_length, "m", rule, kind=Kind.PROFILE),
    ]


def _list_load_leaves(forces: RowForces, member: str) -> tuple[list[Quantity], float]:
    """Leaves of what the load along the row adds, and how that may grow [kN]."""
    share = find_profile_value(forces.standard, LATERAL_SHARE, "k")
    held = forces.along_row
    if member in forces.row.layout.anchors_at_foot:
        return ([share] if share.is_known else []), 0.0
    if held is None or member in (Member.FOOT_ANCHOR, Member.POST_FOOT, NetPart.MESH):
        return [], 0.0  # it presses a post, (S18)
    splay = given("β", held.splay_deg, "deg", find_cell(forces.row, "guy_splay"))
    by_floor = _list_floor_leaves(forces, member, held)
    pull = given(
        *("P", held.pull_kN, "kN", "head_pull"),
        kind=Kind.SOLVED,
        band=(held.pull_low_kN, held.pull_high_kN),
    )
    if member in PARTS:
        part: float = getattr(held, PARTS[member])
        leaves = [_solved("c", part, "-", PARTS[member]), share, pull, splay]
        rise = _high(load_guy(*leaves).added)
        leaves += by_floor[:1]
        if not is_shared(forces.row, member):
            return leaves, rise
        cell = find_cell(forces.row, "guy_anchors")
        symbol = GUYS_ON_ANCHOR[forces.standard.shared_sum]
        return [given(symbol, 2.0, "-", cell), *leaves], 2.0 * rise
    weight = _solved("w", held.post_part, "-", "post_part")
    nothing, least = (
        _solved("T_min", force, "kN", "least_tension")
        for force in (0.0, held.least_tension_kN)
    )
    # the least tension does not grow
    rise = _high(load_post(weight, share, pull, splay, nothing).added)
    leaves = [weight, share, pull, splay, least]
    added = [load_post(*leaves).added]
    if by_floor:
        of_floor, own = by_floor
        added.append(load_post(weight, share, of_floor, splay, own).added)
    return ([*leaves, *by_floor] if any(map(_high, added)) else []), rise


def _list_floor_leaves(
    forces: RowForces, member: str, held: HeldSidewaysRecord
) -> list[Quantity]:
    """Pull and least tension of the guideline's own load, where that loads a member."""
    if forces.find_least(member) is None:
        return []
    return [
        _solved("P_g", held.floor_pull_kN, "kN", "floor.head_pull"),
        _solved("T_min_g", held.floor_tension_kN, "kN", "floor.least_tension"),
    ]


def lifts(forces: Iterable[LargestForce], floor: FloorRecord | None) -> bool:
    """Some case, or the guideline's load, may pull a post off its base."""
    least = floor.forces if floor else ()
    pulls = [
        *(one.high_kN for one in forces if one.quantity in POST_PULLS),
        *(one.force_kN for one in least if one.member == Member.POST_FOOT),
    ]
    return any(force > 0.0 for force in pulls)


def _list_push_leaves(forces: RowForces) -> list[Quantity]:
    """Rope and guy that push the post at the row's end."""
    rope = forces.largest.get(RopeForce.UPPER_ALONG)
    angle = _list_guy_angle(forces.row)
    return [solve_for(rope, "T_r"), *angle] if rope is not None and angle else []


def _list_guy_angle(row: NetRow) -> list[Quantity]:
    angle = row.row_end.guy_angle if row.row_end else None
    if angle is None:
        return []
    cell = find_cell(row, "end_guy_angle", "Ends")
    return [given("γ", degree_from_radian(angle), "deg", cell)]


def is_shared(row: NetRow, member: str) -> bool:
    """An anchor holds a guy of each of two neighbouring posts, or may do so."""
    of_guys = (Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
    return may_share(row.guys) and member in of_guys


def name_unsaid(row: NetRow) -> Message:
    """The columns that a row leaves empty, and that every force depends on.

    The first of many: each check says it, and the row has them all.
    """
    names = row.unsaid
    if len(names) <= _MOST_NAMES:
        return say("check.unsaid", names=names)
    first = names[: _MOST_NAMES - 1]
    return say("check.unsaid_many", names=first, count=len(names) - len(first))


def find_lack(row: NetRow, given: Resistance) -> Message | None:
    """Lack of the workbook that leaves a rope, an end member, or the end post, open."""
    if given.member in _ROPES:
        return None if row.panels else row.panel_lack
    if row.row_end is None or given.member not in (*EndMember, *PUSHED):
        return None
    if not row.panels:
        return row.panel_lack
    if row.row_end.guy_angle is not None or given.member == EndMember.LATERAL_ANCHOR:
        return None
    return say("row_end.no_angle")


def find_other_panel(
    row: NetRow, given: Resistance, position: Position
) -> Message | None:
    """Doubt that the ropes between the posts are those that were computed.

    It concerns what they load more than the section does.
    """
    pulled = [Member.UPHILL_GUY, Member.UPHILL_ANCHOR, *_ROPES]
    if row.layout.is_foot_shared:
        pulled.append(Member.FOOT_ANCHOR)
    at_end = (*EndMember, *PUSHED) if position == "edge" and row.row_end else ()
    return row.panel_lack if given.member in (*pulled, *at_end) else None
