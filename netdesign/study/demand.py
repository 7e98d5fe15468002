"""The demand on one member of one support: the largest of coupled bound and floor.

The coupled force is that of the section, and that of the panel between posts where the
row has one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from netdesign.checks import Band
from netdesign.guideline.floor import FloorForce
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.effects import RowEffects
from netdesign.study.records import ActionRecord
from netdesign.study.sideways import MemberLoad
from netdesign.units import (
    given_degree_from_radian,
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.message import Message, say
from netdesign.words.names import name

NOTHING = Band(low=0.0, value=0.0, high=0.0)
Governing = Literal["coupled", "panel", "guideline"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Characteristic force on one member of one support.

    Attributes
    ----------
    solved : Band
        Coupled, inside the row; the upper end with what may hide [N].
    floor : FloorForce or None
        The guideline's, inside the row; None where it is no floor.
    width : LoadedWidth
        Of the support.
    on_support : float
        Force on the support over that inside the row, lateral load included [-].
    load : MemberLoad
        How the member's force follows from that of the section.
    panel : Band or None
        As ``solved``, by the panel between posts; None of a row without one.
    along : Band
        What the ropes' pull along the row adds to ``panel`` at its end [N].
    """

    solved: Band
    floor: FloorForce | None
    width: LoadedWidth
    on_support: float
    load: MemberLoad
    panel: Band | None = None
    along: Band = NOTHING

    @property
    def coupled(self) -> Band:
        """Coupled force on the support [N]."""
        return self.load.apply(self.solved).times(self.on_support)

    @property
    def by_panel(self) -> Band | None:
        """Force on the support by the panel between posts [N]."""
        if self.panel is None:
            return None
        force = self.load.apply(self.panel).times(self.on_support)
        return Band(
            low=force.low + self.along.low,
            value=force.value + self.along.value,
            high=force.high + self.along.high,
        )

    @property
    def largest(self) -> Band:
        """Larger one of the two inside the row, by its upper end on the support [N]."""
        by_panel = self.by_panel
        is_panel = by_panel is not None and by_panel.high > self.coupled.high
        return self.panel if is_panel and self.panel is not None else self.solved

    @property
    def guideline(self) -> float | None:
        """The guideline's force on the support [N]; None where it is no floor."""
        if self.floor is None:
            return None
        on_member = self.load.share * self.floor.force + self.load.added.value
        return on_member * self.on_support

    @property
    def governs(self) -> Governing:
        """Largest one of the three; coupled forces count with their upper ends."""
        least, by_panel = self.guideline, self.by_panel
        coupled = max(self.coupled.high, by_panel.high if by_panel else 0.0)
        if least and least >= coupled:
            return "guideline"
        return "panel" if coupled > self.coupled.high else "coupled"

    @property
    def action(self) -> Band:
        """The demand [N]: no end of its band lies below the floor, or either force."""
        force, least = self.coupled, self.guideline or 0.0
        beside = self.by_panel or force
        return Band(
            low=max(force.low, beside.low, least),
            value=max(force.value, beside.value, least),
            high=max(force.high, beside.high, least),
        )

    def record(self, effects: RowEffects, member: str) -> ActionRecord:
        """Action with what it follows from, in engineer's units."""
        width, floor = self.width, self.floor
        panel, by_panel = self.panel, self.by_panel
        return ActionRecord(
            solved_kN=kilonewton_from_newton(self.solved.value),
            post_spacing_m=effects.post_spacing,
            position=width.position,
            loaded_width_m=width.width,
            other_width_m=width.other_width,
            end_factor=width.end_factor,
            end_length_m=width.end_length,
            lateral_factor=effects.lateral_factor(member),
            coupled_kN=kilonewton_from_newton(self.coupled.high),
            floor_kN=kilonewton_if_known(floor.force if floor else None),
            guideline_kN=kilonewton_if_known(self.guideline),
            floor_case=floor.case.name if floor else "",
            floor_inclination_deg=given_degree_from_radian(floor.at.net.inclination)
            if floor
            else None,
            governs=self.governs,
            share=self.load.share,
            added_kN=kilonewton_from_newton(self.load.added.value),
            added_low_kN=kilonewton_from_newton(self.load.added.low),
            added_high_kN=kilonewton_from_newton(self.load.added.high),
            sideways=self.load.sideways,
            panel_kN=kilonewton_if_known(panel.value if panel else None),
            panel_low_kN=kilonewton_if_known(panel.low if panel else None),
            panel_support_kN=kilonewton_if_known(by_panel.high if by_panel else None),
            along_kN=kilonewton_from_newton(self.along.value),
            along_low_kN=kilonewton_from_newton(self.along.low),
            along_high_kN=kilonewton_from_newton(self.along.high),
            solved_low_kN=kilonewton_from_newton(self.solved.low),
            solved_high_kN=kilonewton_from_newton(self.solved.high),
        )


def build_demand(
    effects: RowEffects,
    member: str,
    width: LoadedWidth,
    solved: Band,
    floor: FloorForce | None,
    load: MemberLoad,
    panel: Band | None = None,
    along: Band = NOTHING,
) -> Demand:
    """Demand on a member of the support of that width.

    ``solved`` is inside the row, as is ``panel``, by the panel between posts;
    ``along`` is of the row's end.
    """
    return Demand(
        solved=solved,
        floor=floor,
        width=width,
        on_support=effects.factor(member, width),
        load=load,
        panel=panel,
        along=along,
    )


def tell_governing(reason: Message, action: ActionRecord) -> Message:
    """A verdict's reason with the load that governs; of no demand at all, none does."""
    forces = (action.coupled_kN, action.guideline_kN, action.panel_support_kN)
    is_alone = action.floor_kN is None and action.panel_kN is None
    if is_alone or not any(forces):
        return reason
    load = say(f"load.{action.governs}", case=name("load_case", action.floor_case))
    return say("load.reason", reason=reason, load=load)


def leave_out_governing(reason: Message) -> Message:
    """The reason alone of what `tell_governing` gives."""
    alone = reason.arguments.get("reason")
    is_told = reason.key == "load.reason" and isinstance(alone, Message)
    return alone if is_told and isinstance(alone, Message) else reason
