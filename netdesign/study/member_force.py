"""Characteristic force on a member of a support, from the forces that a study states.

The formulas are those of ``checks/forces.py``; here they get their numbers: solved
forces, the guideline's, cells of the workbook, values of the profile.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache

from netdesign.calculation.quantity import Kind, Quantity, leaf
from netdesign.checks import Standard
from netdesign.checks.comparison import find_profile_value
from netdesign.checks.forces import (
    GUYS_ON_ANCHOR,
    SupportForce,
    calculate_force,
    load_post,
)
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.panel_forces import POST_PULLS
from netdesign.outcome import ModelError
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
from netdesign.study.anchor_pulls import GUY_ANCHORS, may_share
from netdesign.study.case_records import (
    FloorRecord,
    HeldSidewaysRecord,
    LargestForce,
)
from netdesign.study.row_forces import MemberForce as MemberForce
from netdesign.study.row_forces import RowForces as RowForces
from netdesign.study.row_forces import high_of
from netdesign.units import (
    degree_from_radian,
    kilonewton_from_newton,
    newton_from_kilonewton,
)
from netdesign.words.message import say

# Weights of the load along the row in the guys of each side.
PARTS: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill_part",
    Member.UPHILL_ANCHOR: "uphill_part",
    Member.DOWNHILL_GUY: "downhill_part",
    Member.DOWNHILL_ANCHOR: "downhill_part",
}
# What the end guy's pull on the head loads, by the part of it in each.
PUSHED: Mapping[str, str] = {
    Member.POST: "post_part",
    Member.POST_BASE: "base_part",
    **PARTS,
}
# Tension of the outer guy of each side by the linear truss.
_BY_TRUSS: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill_guy_kN",
    Member.UPHILL_ANCHOR: "uphill_guy_kN",
    Member.DOWNHILL_GUY: "downhill_guy_kN",
    Member.DOWNHILL_ANCHOR: "downhill_guy_kN",
}
# Modes with a force of their own; in all others that of the member counts.
OWN_FORCES = ("sliding",)
_ROPES = (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE)


def find_cell(row: NetRow, column: str) -> str:
    """Cell of a column of a row or of its net type; "" where it has none."""
    labels = [say(f"column.{table}.{column}") for table in ("rows", "net_types")]
    return next((echo.cell for echo in row.inputs if echo.label in labels), "")


def solve_for(record: LargestForce, symbol: str) -> Quantity:
    """Largest solved force as a quantity [kN]."""
    return leaf(
        *(symbol, record.value_kN, "kN", record.quantity),
        kind=Kind.SOLVED,
        band=(record.low_kN, record.high_kN),
    )


def find_force(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> MemberForce | None:
    """Force on a member of the support of that width; None without a solved case.

    Each is calculated once.
    """
    mode = resistance.mode if resistance.mode in OWN_FORCES else ""
    key = (resistance.member, mode, width)
    if key not in forces.worked_out:
        forces.worked_out[key] = _work_out(forces, resistance, width)
    return forces.worked_out[key]


def _calculate(forces: RowForces, leaves: Sequence[Quantity]) -> SupportForce:
    return _calculate_of(tuple(leaves), forces.standard.is_by_guideline)


@lru_cache(maxsize=4096)  # of alike leaves at many corners
def _calculate_of(leaves: tuple[Quantity, ...], by_guideline: bool) -> SupportForce:
    of = {quantity.symbol: quantity for quantity in leaves}
    return calculate_force(of, by_guideline=by_guideline)


def _work_out(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> MemberForce | None:
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
    leaves += _list_load_leaves(forces, member, width)
    if panel is not None:
        leaves += _list_rope_leaves(forces, member, width)
    if is_sliding:
        leaves.append(_solved("t", forces.tilt, "-", "tilt"))
    force = _calculate(forces, leaves)
    is_by_panel = high_of(force.by_panel) > high_of(force.coupled)
    return MemberForce(
        on=force,
        solved=(section,) if panel is None else (section, panel),
        largest=panel if panel is not None and is_by_panel else section,
    )


def find_guideline_force(
    forces: RowForces, member: str, width: LoadedWidth, inside: float
) -> float:
    """Force on a member of a support by the guideline's load alone [kN].

    The guideline knows no pull of the ropes along the row.

    Parameters
    ----------
    forces : RowForces
        Of a row without a solved case, with the guideline's pull on its heads.
    member, width : str, LoadedWidth
        Member and support.
    inside : float
        Force in the section, inside the row [kN].

    Raises
    ------
    ModelError
        Where the force is missing, with the reason.
    """
    leaves = _list_support_leaves(forces.row, width, member)
    leaves.append(_solved("E_s", inside, "kN", f"floor.{member}"))
    leaves += _list_load_leaves(forces, member, width)
    force = _calculate(forces, leaves).action
    if force.value is None:
        raise ModelError(force.lacks[0])
    return force.value


def _find_end_force(
    forces: RowForces, member: str, width: LoadedWidth
) -> MemberForce | None:
    """Force of a border rope, or on a member that holds its pull at the row's end.

    None where the row has no end, or where no case has a panel.
    """
    rope = forces.largest.get(ROPE_OF[member])
    is_endless = forces.row.row_end is None and member in tuple(EndMember)
    if is_endless or rope is None or forces.effects.open_end is not None:
        return None
    symbol = "T_b" if member in _ROPES else "T_r"
    leaves = [*_list_support_leaves(forces.row, width, member), solve_for(rope, symbol)]
    leaves += _list_floor_factor(forces, ROPE_OF[member])
    if member in (EndMember.END_GUY, EndMember.END_GUY_ANCHOR):
        leaves += _list_guy_angle(forces.row)
    force = _calculate(forces, leaves)
    return MemberForce(on=force, solved=(rope,), largest=rope)


def find_end_pull(forces: RowForces) -> float | None:
    """Largest pull of the ridge rope along the row at its end [N]; None without one."""
    width = forces.effects.supports[-1]
    rope = forces.largest.get(RopeForce.UPPER_ALONG)
    if forces.row.row_end is None or rope is None or width.position != "edge":
        return None
    leaves = _list_support_leaves(forces.row, width, EndMember.END_GUY)
    leaves += [solve_for(rope, "T_r"), *_list_floor_factor(forces, rope.quantity)]
    pull = _calculate(forces, leaves).action
    return newton_from_kilonewton(high_of(pull))


def find_one_way_pull(forces: RowForces) -> float:
    """Pull of a border rope that the second support holds, over that inside [-]."""
    width, end = forces.effects.find_support("second"), forces.row.row_end
    if end is None or end.ropes_slide or width.position != "second":
        return 0.0
    leaves = _list_support_leaves(forces.row, width, Member.FOOT_ANCHOR)
    leaves += [_solved(symbol, 1.0, "kN", "") for symbol in ("E_s", "T_r")]
    return high_of(_calculate(forces, leaves).push)


def _solved(symbol: str, value: float, unit: str, source: str) -> Quantity:
    return leaf(symbol, value, unit, source, kind=Kind.SOLVED)


def _list_support_leaves(
    row: NetRow, width: LoadedWidth, member: str
) -> list[Quantity]:
    """Widths that load a support, inside the row or at its end.

    The mesh has the whole end effect, which is local.
    """
    if width.position == "intermediate":
        return []
    rule, count = "end.constant", find_cell(row, "post_count")
    factor = leaf("f_R", width.end_factor, "-", rule, kind=Kind.PROFILE)
    if member == NetPart.MESH:
        return [factor]
    parts = {"s_2" if width.position == "second" else "s_e": width.share}
    if is_shared(row, member):
        parts["s_n"] = width.beside
    return [
        leaf("b", row.layout.post_spacing, "m", find_cell(row, "post_spacing")),
        factor,
        leaf("Δl", width.end_length, "m", rule, kind=Kind.PROFILE),
        *(leaf(symbol, part, "-", count) for symbol, part in parts.items() if part),
    ]


def _list_load_leaves(
    forces: RowForces, member: str, width: LoadedWidth
) -> list[Quantity]:
    """Leaves of what the load along the row adds."""
    share = find_profile_value(forces.standard, LATERAL_SHARE, "k")
    held = forces.along_row
    if member in forces.row.layout.anchors_at_foot:
        return [share] if share.is_known else []
    if held is None or member in (Member.FOOT_ANCHOR, Member.POST_FOOT, NetPart.MESH):
        return []  # it presses a post, (S18)
    splay = leaf("β", held.splay_deg, "deg", find_cell(forces.row, "guy_splay"))
    by_floor = _list_floor_leaves(forces, member, held)
    pull = leaf(
        *("P", held.pull_kN, "kN", "head_pull"),
        kind=Kind.SOLVED,
        band=(held.pull_low_kN, held.pull_high_kN),
    )
    if member in PARTS:
        part: float = getattr(held, PARTS[member])
        leaves = [_solved("c", part, "-", PARTS[member]), share, pull, splay]
        leaves += by_floor[:1]
        if not is_shared(forces.row, member):
            return leaves
        cell = find_cell(forces.row, "guy_anchors")
        symbol = GUYS_ON_ANCHOR[forces.standard.shared_sum]
        return [leaf(symbol, 2.0, "-", cell), *leaves]
    weight = _solved("w", held.post_part, "-", "post_part")
    least = _solved("T_min", held.least_tension_kN, "kN", "least_tension")
    leaves = [weight, share, pull, splay, least]
    added = [load_post(*leaves).added]
    if by_floor:
        of_floor, own = by_floor
        added.append(load_post(weight, share, of_floor, splay, own).added)
    is_loaded = any(map(high_of, added)) or width.position == "second"
    return [*leaves, *by_floor] if is_loaded else []


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
    """Whether some case, or the guideline's load, may pull a post off its base."""
    least = floor.forces if floor else ()
    pulls = [
        *(force.high_kN for force in forces if force.quantity in POST_PULLS),
        *(force.force_kN for force in least if force.member == Member.POST_FOOT),
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
        return _list_unbalanced(forces, member, slide=bool(row.row_end.ropes_slide))
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
    assumed = row.find_assumed("end_guy_angle")
    is_given = assumed is None or assumed.is_typed
    cell = find_cell(row, "end_guy_angle") if is_given else ""
    return [leaf("γ", degree_from_radian(angle), "deg", cell)]


def is_shared(row: NetRow, member: str) -> bool:
    """An anchor holds a guy of each of two neighbouring posts, or may do so."""
    return may_share(row.guys) and member in GUY_ANCHORS


_STATED: Mapping[str, str] = {
    Member.FOOT_ANCHOR: "foot_force",
    Member.UPHILL_ANCHOR: "uphill_force",
    Member.DOWNHILL_ANCHOR: "downhill_force",
}


def list_maker_leaves(row: NetRow, standard: Standard, member: str) -> list[Quantity]:
    """Characteristic force on an anchor by the net's maker, where it is a floor."""
    name = _STATED.get(member)
    stated = getattr(row.approval, name) if row.approval and name else None
    if stated is None or not standard.has_maker_floor:
        return []
    return [leaf("E_m0", kilonewton_from_newton(stated.value), "kN", stated.cell)]
