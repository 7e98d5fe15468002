"""Characteristic force on a member of a support, from the forces that a study states.

The formulas are those of ``checks/forces.py``; here they get their numbers: solved
forces, the guideline's, cells of the workbook, values of the profile.
"""

from __future__ import annotations

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
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.case_records import FloorForceRecord, FloorRecord, LargestForce
from netdesign.study.effects import RowEffects
from netdesign.study.maker import list_maker_leaves
from netdesign.study.pulls import GUY_ANCHORS, may_share
from netdesign.study.row_to_check import Basis
from netdesign.study.support_records import (
    EndGuyRecord,
    HeldSidewaysRecord,
    PullRecord,
)
from netdesign.units import degree_from_radian, newton_from_kilonewton
from netdesign.words.message import Message, say

# What the end guy's pull on the head loads, by the part of it in each.
PUSHED: Mapping[str, str] = {
    Member.POST: "post_part",
    Member.POST_BASE: "base_part",
    Member.UPHILL_GUY: "uphill_part",
    Member.UPHILL_ANCHOR: "uphill_part",
    Member.DOWNHILL_GUY: "downhill_part",
    Member.DOWNHILL_ANCHOR: "downhill_part",
}
# Tension of the outer guy of each side by the linear truss.
_BY_TRUSS: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill_guy_kN",
    Member.UPHILL_ANCHOR: "uphill_guy_kN",
    Member.DOWNHILL_GUY: "downhill_guy_kN",
    Member.DOWNHILL_ANCHOR: "downhill_guy_kN",
}
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
    end_guy : EndGuyRecord, Message or None
        What the end guy does to the end's support, or why nothing holds that; None
        without a guy whose angle is given.
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
    end_guy: EndGuyRecord | Message | None = None
    pulls: tuple[PullRecord, ...] = ()
    gap: Message | None = None
    panel_gap: Message | None = None

    @property
    def along_row(self) -> HeldSidewaysRecord | None:
        """Load along the row at the head; None where nothing holds it."""
        return self.held if isinstance(self.held, HeldSidewaysRecord) else None

    @property
    def at_end(self) -> EndGuyRecord | None:
        """What the end guy does to the end's support; None where it is not known."""
        return self.end_guy if isinstance(self.end_guy, EndGuyRecord) else None

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
    def is_by_truss(self) -> bool:
        """The truss of post, guys and end guy has the largest force."""
        loads = (self.on.coupled, self.on.by_panel, self.on.guideline)
        shared = self.on.shared
        return shared is not None and _high(shared) >= max(map(_high, loads))

    @property
    def is_post_beside(self) -> bool:
        """A post beside the end: what presses it is worked out together, (P11)."""
        on, posts = self.on, (Member.POST, Member.POST_BASE)
        is_post = self.largest.quantity in (*posts, *map(name_in_panel, posts))
        return is_post and on.support.is_second and on.push is not None

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
    leaves += list_maker_leaves(forces.row, forces.standard, member)
    added, rise = _list_load_leaves(forces, member, width)
    leaves += added
    if panel is not None:
        leaves += _list_rope_leaves(forces, member, width)
    if is_sliding:
        leaves.append(_solved("t", forces.tilt, "-", "tilt"))
    force = calculate_force(
        {one.symbol: one for one in leaves},
        by_guideline=forces.standard.is_by_guideline,
    )
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


def find_guideline_force(
    forces: RowForces, member: str, width: LoadedWidth
) -> float | None:
    """Force on a member of a support by the guideline's load alone [kN].

    It knows no pull of the ropes along the row. None where it is not available.
    """
    least = forces.find_least(member)
    if least is None:
        return None
    leaves = _list_support_leaves(forces.row, width, member)
    leaves += [
        _solved(symbol, least.force_kN, "kN", f"floor.{member}")
        for symbol in ("E_s", "E_g0")
    ]
    leaves += _list_load_leaves(forces, member, width)[0]
    found = calculate_force({one.symbol: one for one in leaves}).guideline
    return found.value if found else None


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
    leaves += _list_floor_factor(forces, ROPE_OF[member])
    if member in (EndMember.END_GUY, EndMember.END_GUY_ANCHOR):
        leaves += _list_guy_angle(forces.row)
    force = calculate_force({one.symbol: one for one in leaves})
    return MemberForce(on=force, solved=(rope,), largest=rope)


def find_end_pull(forces: RowForces) -> float | None:
    """Largest pull of the ridge rope along the row at its end [N]; None without one."""
    width = forces.effects.supports[-1]
    rope = forces.largest.get(RopeForce.UPPER_ALONG)
    if forces.row.row_end is None or rope is None or width.position != "edge":
        return None
    leaves = _list_support_leaves(forces.row, width, EndMember.END_GUY)
    leaves += [solve_for(rope, "T_r"), *_list_floor_factor(forces, rope.quantity)]
    pull = calculate_force({one.symbol: one for one in leaves}).action
    return newton_from_kilonewton(_high(pull))


def find_one_way_pull(forces: RowForces) -> float:
    """Pull of a border rope that the second support holds, over that inside [-]."""
    width, end = forces.effects.find_support("second"), forces.row.row_end
    if end is None or end.ropes_slide or width.position != "second":
        return 0.0
    leaves = _list_support_leaves(forces.row, width, Member.FOOT_ANCHOR)
    leaves += [_solved(symbol, 1.0, "kN", "") for symbol in ("E_s", "T_r")]
    found = calculate_force({one.symbol: one for one in leaves})
    return _high(found.push)


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
    rule, count = "end.constant", find_cell(row, "post_count")
    factor = given("f_R", width.end_factor, "-", rule, kind=Kind.PROFILE)
    if member == NetPart.MESH:
        return [factor]
    parts = {"s_2" if width.position == "second" else "s_e": width.share}
    if is_shared(row, member):
        parts["s_n"] = width.beside
    return [
        given("b", row.layout.post_spacing, "m", find_cell(row, "post_spacing")),
        factor,
        given("Δl", width.end_length, "m", rule, kind=Kind.PROFILE),
        *(given(symbol, part, "-", count) for symbol, part in parts.items() if part),
    ]


def _list_load_leaves(
    forces: RowForces, member: str, width: LoadedWidth
) -> tuple[list[Quantity], float]:
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
    is_loaded = any(map(_high, added)) or width.position == "second"
    return ([*leaves, *by_floor] if is_loaded else []), rise


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


def _list_rope_leaves(
    forces: RowForces, member: str, width: LoadedWidth
) -> list[Quantity]:
    """Pull of a border rope along the row that a member at or beside its end holds.

    At the end it comes by the end guy; besides, the truss of both has its own force.
    """
    row = forces.row
    if row.row_end is None or width.position == "intermediate":
        return []
    if width.position == "second":
        return _list_unbalanced(forces, member, slide=row.row_end.ropes_slide)
    angle, at_end = _list_guy_angle(row), forces.at_end
    rope = forces.largest.get(RopeForce.UPPER_ALONG)
    if member not in PUSHED or at_end is None or rope is None:
        return []
    truss = getattr(at_end, _BY_TRUSS.get(member, ""), None)
    leaves = [] if truss is None else [_solved("E_t", truss, "kN", "truss")]
    part: float = getattr(at_end, PUSHED[member])
    if part > 0.0:
        of_rope = _list_floor_factor(forces, rope.quantity)
        leaves += [solve_for(rope, "T_r"), *of_rope, *angle]
        leaves.append(_solved("e", part, "-", PUSHED[member]))
    return leaves


def _list_unbalanced(forces: RowForces, member: str, *, slide: bool) -> list[Quantity]:
    """Rope that pulls a member beside the row's end more from one side; none slides."""
    of_head = member in PUSHED and forces.along_row is not None
    if slide or not (of_head or member == Member.FOOT_ANCHOR):
        return []
    rope = RopeForce.UPPER_ALONG if of_head else RopeForce.LOWER_ALONG
    solved = forces.largest.get(rope)
    if solved is None:
        return []
    return [solve_for(solved, "T_r"), *_list_floor_factor(forces, rope)]


def _list_floor_factor(forces: RowForces, rope: str) -> list[Quantity]:
    """Factor by which the guideline's load raises a rope; none where it does not."""
    if forces.floor is None:
        return []
    is_lower = rope in (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)
    factor = forces.floor.lower_rope if is_lower else forces.floor.ridge_rope
    return [_solved("φ_g", factor, "-", "floor")] if factor > 1.0 else []


def _list_guy_angle(row: NetRow) -> list[Quantity]:
    angle = row.row_end.guy_angle if row.row_end else None
    if angle is None:
        return []
    cell = find_cell(row, "end_guy_angle", "Ends")
    return [given("γ", degree_from_radian(angle), "deg", cell)]


def is_shared(row: NetRow, member: str) -> bool:
    """An anchor holds a guy of each of two neighbouring posts, or may do so."""
    return may_share(row.guys) and member in GUY_ANCHORS
