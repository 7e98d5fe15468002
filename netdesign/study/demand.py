"""The demand on one member of one support: coupled bound or floor, the larger."""

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

Governing = Literal["coupled", "guideline"]


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
    """

    solved: Band
    floor: FloorForce | None
    width: LoadedWidth
    on_support: float
    load: MemberLoad

    @property
    def coupled(self) -> Band:
        """Coupled force on the support [N]."""
        return self.load.apply(self.solved).times(self.on_support)

    @property
    def guideline(self) -> float | None:
        """The guideline's force on the support [N]; None where it is no floor."""
        if self.floor is None:
            return None
        on_member = self.load.share * self.floor.force + self.load.added.value
        return on_member * self.on_support

    @property
    def governs(self) -> Governing:
        """Larger one of the two; the coupled force counts with its upper end."""
        least = self.guideline
        return "guideline" if least and least >= self.coupled.high else "coupled"

    @property
    def action(self) -> Band:
        """The demand [N]: no end of its band lies below the floor."""
        force, least = self.coupled, self.guideline or 0.0
        return Band(
            low=max(force.low, least),
            value=max(force.value, least),
            high=max(force.high, least),
        )

    def record(self, effects: RowEffects, member: str) -> ActionRecord:
        """Action with what it follows from, in engineer's units."""
        width, floor = self.width, self.floor
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
) -> Demand:
    """Demand on a member of the support of that width; ``solved`` is inside the row."""
    return Demand(
        solved=solved,
        floor=floor,
        width=width,
        on_support=effects.factor(member, width),
        load=load,
    )


def tell_governing(reason: Message, action: ActionRecord) -> Message:
    """A verdict's reason with the load that governs; of no demand at all, none does."""
    if action.floor_kN is None or not (action.coupled_kN or action.guideline_kN):
        return reason
    load = say(f"load.{action.governs}", case=name("load_case", action.floor_case))
    return say("load.reason", reason=reason, load=load)


def leave_out_governing(reason: Message) -> Message:
    """The reason alone of what `tell_governing` gives."""
    alone = reason.arguments.get("reason")
    is_told = reason.key == "load.reason" and isinstance(alone, Message)
    return alone if is_told and isinstance(alone, Message) else reason
