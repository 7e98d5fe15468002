"""Characteristic force on a member of a support, from the forces that a study states.

The formulas are those of ``checks/forces.py``; here they get their numbers: solved
forces, the guideline's, cells of the workbook, values of the profile.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from netdesign.calculation.quantity import Kind, Quantity, leaf
from netdesign.checks import Standard
from netdesign.checks.comparison import find_profile_value
from netdesign.checks.forces import (
    MemberLoad,
    Support,
    bring_to_support,
    find_lateral_factor,
    hold_one_way,
    load_guy,
    load_post,
    load_shared_anchor,
    load_shared_anchor_in_line,
    place_end_support,
    press_one_way,
    pull_at_end,
    pull_border_rope,
    pull_end_guy,
    pull_one_way,
    push_by_end_guy,
    slide_base,
    take_from_maker,
    take_largest,
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
from netdesign.study.anchor_pulls import is_shared
from netdesign.study.case_records import (
    FloorRecord,
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
_PRESSED = (Member.POST, Member.POST_BASE)  # by the load along the row
_WEIGHTS: Mapping[str, str] = {**PARTS, **dict.fromkeys(_PRESSED, "post_part")}
# Tension of the outer guy of each side by the linear truss.
_BY_TRUSS: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill_guy_kN",
    Member.UPHILL_ANCHOR: "uphill_guy_kN",
    Member.DOWNHILL_GUY: "downhill_guy_kN",
    Member.DOWNHILL_ANCHOR: "downhill_guy_kN",
}
SLIDING = "sliding"  # mode with a force of its own; in all others the member's counts
_ROPES = (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE)
# How an anchor of two guys is loaded, and the symbol of their number.
_SHARED = {
    "vector": (load_shared_anchor, "n_g"),
    "scalar": (load_shared_anchor_in_line, "n_h"),
}


def find_cell(row: NetRow, column: str) -> str:
    """Cell of a column of a row or of its net type; "" where it has none."""
    keys = [f"column.{table}.{column}" for table in ("rows", "net_types")]
    return next((echo.cell for echo in row.inputs if echo.label.key in keys), "")


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
    is_sliding = resistance.mode == SLIDING
    key = (resistance.member, is_sliding, width)
    if key not in forces.worked_out:
        at = _MemberAt(forces=forces, member=resistance.member, width=width)
        is_of_rope = at.member in ROPE_OF
        forces.worked_out[key] = (
            at.find_end_force() if is_of_rope else at.find_force(is_sliding=is_sliding)
        )
    return forces.worked_out[key]


@dataclass(frozen=True, kw_only=True)
class _MemberAt:
    """Member of one support of a row, with the numbers that its formulas take.

    Of two loads on the section, ``mark`` ends the symbols of the guideline's own.
    """

    forces: RowForces
    member: str
    width: LoadedWidth

    def find_force(self, *, is_sliding: bool) -> MemberForce | None:
        """Force on the member, along a base that slides; None without a solved case."""
        forces, standard = self.forces, self.forces.standard
        section, panel = forces.largest.get(self.member), self._panel
        if section is None:
            return None
        letter = "V" if is_sliding else "E"
        guideline, by_truss = self.find_by_guideline(letter), self._find_truss()
        stated = find_maker_force(forces.row, standard, self.member)
        is_alone = not any((panel, guideline, by_truss, stated))
        inside = solve_for(section, f"{letter}_s")
        coupled = self._bring(f"{letter}_k" if is_alone else f"{letter}_c", inside)
        by_panel = of_maker = None
        if panel is not None:
            by_panel = self._bring(f"{letter}_p", solve_for(panel, f"{letter}_p0"))
        if stated is not None:
            of_maker = take_from_maker(stated, self.support)
        deciding = [coupled, by_panel, guideline, by_truss, of_maker]
        if standard.is_by_guideline and guideline is not None:
            deciding = [guideline, of_maker]
        action = take_largest(f"{letter}_k", *filter(None, deciding))
        if action is guideline:
            action = action.named(f"{letter}_k", "kN", "(V1)")
        tilt = _solved("t", forces.tilt, "-", "tilt")
        is_by_panel = high_of(by_panel) > high_of(coupled)
        return MemberForce(
            action=slide_base(action, tilt) if is_sliding else action,
            coupled=coupled,
            by_panel=by_panel,
            guideline=guideline,
            by_truss=by_truss,
            support=self.support,
            load=self.load,
            push=self.push,
            pressing=action if is_sliding else None,
            solved=(section,) if panel is None else (section, panel),
            largest=panel if panel is not None and is_by_panel else section,
        )

    def find_end_force(self) -> MemberForce | None:
        """Force of a border rope, or on what holds its pull at the row's end.

        None where the row has no end, or where no case has a panel.
        """
        forces, member = self.forces, self.member
        is_rope, record = member in _ROPES, forces.largest.get(ROPE_OF[member])
        is_endless = forces.row.row_end is None and not is_rope
        if is_endless or record is None or forces.effects.open_end is not None:
            return None
        rope = _raise_rope(forces, record, "T_b" if is_rope else "T_r")
        angle = _find_guy_angle(forces.row)
        if is_rope:
            action = pull_border_rope(rope, self.support)
        elif angle and member in (EndMember.END_GUY, EndMember.END_GUY_ANCHOR):
            action = pull_end_guy(pull_at_end(rope, self.support), angle)
        else:
            action = pull_at_end(rope, self.support).named("E_k", "kN", "(P8)")
        return MemberForce(
            action=action,
            coupled=action,
            by_panel=action,
            support=self.support,
            solved=(record,),
            largest=record,
        )

    def find_by_guideline(self, letter: str = "E") -> Quantity | None:
        """Force by the guideline's load; None where its model knows none."""
        least, source = self.forces.find_least(self.member), f"floor.{self.member}"
        if least is None:
            return None
        inside = _solved(f"{letter}_g0", least.force_kN, "kN", source)
        load, push = self._find_load("_g"), self._find_push("_g")
        return bring_to_support(f"{letter}_g", inside, load, self.support, push)

    def _bring(self, symbol: str, inside: Quantity) -> Quantity:
        return bring_to_support(symbol, inside, self.load, self.support, self.push)

    @cached_property
    def load(self) -> MemberLoad:
        """Way from the section's solved force to the member's."""
        return self._find_load("")

    @cached_property
    def push(self) -> Quantity | None:
        """What the ropes' pull along the row adds to the solved force."""
        return self._find_push("")

    @cached_property
    def support(self) -> Support:
        """Widths that load the support, inside the row or at its end.

        The mesh has the whole end effect, which is local.
        """
        row, width = self.forces.row, self.width
        if width.position == "intermediate":
            return Support()
        rule, count = "end.constant", find_cell(row, "post_count")
        factor = leaf("f_R", width.end_factor, "-", rule, kind=Kind.PROFILE)
        if self.member == NetPart.MESH:
            return Support(end_factor=factor)
        is_second, holds_two = self._is_second, is_shared(row, self.member)
        own = ("s_2" if is_second else "s_e", width.share)
        parts = (own, ("s_n", width.beside if holds_two else 0.0))
        share, beside = (
            leaf(symbol, part, "-", count) if part else None for symbol, part in parts
        )
        return place_end_support(
            leaf("b", row.layout.post_spacing, "m", find_cell(row, "post_spacing")),
            factor,
            leaf("Δl", width.end_length, "m", rule, kind=Kind.PROFILE),
            second=share if is_second else None,
            other=None if is_second else share,
            beside=beside,
            is_shared=holds_two and bool(self._list_along("")),
        )

    @property
    def _is_second(self) -> bool:
        return self.width.position == "second"

    @property
    def _panel(self) -> LargestForce | None:
        return self.forces.largest.get(name_in_panel(self.member))

    def _list_along(self, mark: str) -> tuple[Quantity, ...]:
        """Weight of the load along the row in the member, its share, pull and splay.

        None of a member that it does not load.
        """
        held, name = self.forces.along_row, _WEIGHTS.get(self.member)
        if held is None or name is None or self._is_at_foot:
            return ()
        symbol = "w" if self.member in _PRESSED else "c"
        pull = leaf(
            *("P", held.pull_kN, "kN", "head_pull"),
            kind=Kind.SOLVED,
            band=(held.pull_low_kN, held.pull_high_kN),
        )
        if mark:
            pull = _solved("P_g", held.floor_pull_kN, "kN", "floor.head_pull")
        return (
            _solved(symbol, getattr(held, name), "-", name),
            find_profile_value(self.forces.standard, LATERAL_SHARE, "k"),
            pull,
            leaf("β", held.splay_deg, "deg", find_cell(self.forces.row, "guy_splay")),
        )

    @property
    def _is_at_foot(self) -> bool:
        return self.member in self.forces.row.layout.anchors_at_foot

    def _find_load(self, mark: str) -> MemberLoad:
        """Way from the section's force to the member's, with the load along the row."""
        along = self._list_along(mark)
        if self._is_at_foot:
            share = find_profile_value(self.forces.standard, LATERAL_SHARE, "k")
            if share.is_known:
                return MemberLoad(lateral=find_lateral_factor(share), along=share)
        if not along:
            return MemberLoad()
        if self.member in _PRESSED:
            if self._is_second and self._rope:
                return MemberLoad()  # what presses that post is worked out together
            return load_post(*along, mark=mark)
        if not is_shared(self.forces.row, self.member):
            return load_guy(*along, mark=mark)
        load_anchor, symbol = _SHARED[self.forces.standard.shared_sum]
        guys = leaf(symbol, 2.0, "-", find_cell(self.forces.row, "guy_anchors"))
        return load_anchor(guys, *along, mark=mark)

    @cached_property
    def _rope(self) -> Quantity | None:
        """Pull of a border rope along the row that a member at or beside its end holds.

        At the end it comes by the end guy; beside it one side pulls more than the
        other, unless the ropes slide.
        """
        end, name = self.forces.row.row_end, RopeForce.UPPER_ALONG
        if end is None or self._panel is None or self.width.position == "intermediate":
            return None
        if self._is_second:
            of_head = self.member in PUSHED and self.forces.along_row is not None
            if end.ropes_slide or not (of_head or self.member == Member.FOOT_ANCHOR):
                return None
            name = name if of_head else RopeForce.LOWER_ALONG
        elif not self._pushed:
            return None
        record = self.forces.largest.get(name)
        return None if record is None else _raise_rope(self.forces, record, "T_r")

    @property
    def _pushed(self) -> float:
        """Part of the end guy's pull on the head that the member has [-]."""
        part: float = getattr(self.forces.at_end, PUSHED.get(self.member, ""), 0.0)
        return part

    def _find_truss(self) -> Quantity | None:
        """Force of an outer guy, or on its anchor, by the truss at the row's end."""
        truss = getattr(self.forces.at_end, _BY_TRUSS.get(self.member, ""), None)
        if truss is None or self._panel is None or self.width.position != "edge":
            return None
        return _solved("E_t", truss, "kN", "truss")

    def _find_push(self, mark: str) -> Quantity | None:
        """Find what the ropes' pull along the row adds at its end, or beside it."""
        rope, support, along = self._rope, self.support, self._list_along(mark)
        if rope is None:
            return None
        is_pressed = self.member in _PRESSED
        if not self._is_second:
            part = _solved("e", self._pushed, "-", PUSHED[self.member])
            splay = along[-1] if along and not is_pressed else None
            pull, angle = pull_at_end(rope, support), _find_guy_angle(self.forces.row)
            return angle and push_by_end_guy(pull, angle, part, splay)
        pull = pull_one_way(rope, support)
        if not along:
            return pull
        if is_pressed:
            return press_one_way(pull, support, *along, mark=mark)
        part, *_, splay = along
        return hold_one_way(pull, part, splay)


def find_guideline_force(
    forces: RowForces, member: str, width: LoadedWidth
) -> float | None:
    """Force on a member of a support by the guideline's load alone [kN].

    None where its model knows none.

    Parameters
    ----------
    forces : RowForces
        With the guideline's forces, and its pull on the heads.
    member, width : str, LoadedWidth
        Member and support.

    Raises
    ------
    ModelError
        Where the force is missing, with the reason.
    """
    at = _MemberAt(forces=forces, member=member, width=width)
    force = at.find_by_guideline()
    if force is not None and force.value is None:
        raise ModelError(force.lacks[0])
    return None if force is None else force.value


def find_end_pull(forces: RowForces) -> float | None:
    """Largest pull of the ridge rope along the row at its end [N]; None without one."""
    width = forces.effects.supports[-1]
    rope = forces.largest.get(RopeForce.UPPER_ALONG)
    if forces.row.row_end is None or rope is None or width.position != "edge":
        return None
    at = _MemberAt(forces=forces, member=EndMember.END_GUY, width=width)
    pull = pull_at_end(_raise_rope(forces, rope, "T_r"), at.support)
    return newton_from_kilonewton(high_of(pull))


def find_one_way_pull(forces: RowForces) -> float:
    """Pull of a border rope that the second support holds, over that inside [-]."""
    width, end = forces.effects.find_support("second"), forces.row.row_end
    if end is None or end.ropes_slide or width.position != "second":
        return 0.0
    at = _MemberAt(forces=forces, member=Member.FOOT_ANCHOR, width=width)
    return high_of(pull_one_way(_solved("T_r", 1.0, "kN", ""), at.support))


def _solved(symbol: str, value: float, unit: str, source: str) -> Quantity:
    return leaf(symbol, value, unit, source, kind=Kind.SOLVED)


def _raise_rope(forces: RowForces, record: LargestForce, symbol: str) -> Quantity:
    """Force of a border rope, raised to the guideline's load where that is larger."""
    rope, name = solve_for(record, symbol), record.quantity
    if forces.floor is None:
        return rope
    is_lower = name in (RopeForce.LOWER_ALONG, RopeForce.LOWER_TENSION)
    factor = forces.floor.lower_rope if is_lower else forces.floor.ridge_rope
    return _solved("φ_g", factor, "-", "floor") * rope if factor > 1.0 else rope


def _find_guy_angle(row: NetRow) -> Quantity | None:
    angle = row.row_end.guy_angle if row.row_end else None
    if angle is None:
        return None
    assumed = row.find_assumed("end_guy_angle")
    is_given = assumed is None or assumed.is_typed
    cell = find_cell(row, "end_guy_angle") if is_given else ""
    return leaf("γ", degree_from_radian(angle), "deg", cell)


def lifts(forces: Iterable[LargestForce], floor: FloorRecord | None) -> bool:
    """Whether some case, or the guideline's load, may pull a post off its base."""
    least = floor.forces if floor else ()
    pulls = [
        *(force.high_kN for force in forces if force.quantity in POST_PULLS),
        *(force.force_kN for force in least if force.member == Member.POST_FOOT),
    ]
    return any(force > 0.0 for force in pulls)


_STATED: Mapping[str, str] = {
    Member.FOOT_ANCHOR: "foot_force",
    Member.UPHILL_ANCHOR: "uphill_force",
    Member.DOWNHILL_ANCHOR: "downhill_force",
}


def find_maker_force(row: NetRow, standard: Standard, member: str) -> Quantity | None:
    """Characteristic force on an anchor by the net's maker, where it is a floor."""
    name = _STATED.get(member)
    stated = getattr(row.approval, name) if row.approval and name else None
    if stated is None or not standard.has_maker_floor:
        return None
    return leaf("E_m0", kilonewton_from_newton(stated.value), "kN", stated.cell)
