"""What is known of a row's forces, and the force on one member of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from netdesign.calculation.quantity import Quantity
from netdesign.checks.forces import MemberLoad, Support
from netdesign.envelope.extremes import Extreme
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.case_records import (
    EndGuyRecord,
    FloorForceRecord,
    FloorRecord,
    HeldSidewaysRecord,
    LargestForce,
    PullRecord,
)
from netdesign.study.guideline_load import RowEffects
from netdesign.study.row_to_check import Basis
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class RowForces(Basis):
    """Forces of a row by its solved cases, in engineer's units.

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
    extremes : mapping of str to Extreme
        Largest solved forces with the states of their cases; empty before any solve.
    end_guy : EndGuyRecord, Message or None
        What the end guy does to the end's support, or why nothing holds that; None
        without a guy whose angle is given.
    pulls : tuple of PullRecord
        Directions at the anchors.
    open_cases : Message or None
        Why the forces do not cover every case.
    """

    effects: RowEffects
    largest: Mapping[str, LargestForce]
    floor: FloorRecord | None
    held: HeldSidewaysRecord | Message
    tilt: float
    extremes: Mapping[str, Extreme] = field(default_factory=dict)
    end_guy: EndGuyRecord | Message | None = None
    pulls: tuple[PullRecord, ...] = ()
    open_cases: Message | None = None
    # forces that were asked for
    worked_out: dict[tuple[str, bool, LoadedWidth], MemberForce | None] = field(
        default_factory=dict, init=False, compare=False, repr=False
    )

    @property
    def along_row(self) -> HeldSidewaysRecord | None:
        """Load along the row at the head; None where nothing holds it."""
        return self.held if isinstance(self.held, HeldSidewaysRecord) else None

    @property
    def at_end(self) -> EndGuyRecord | None:
        """What the end guy does to the end's support; None where it is not known."""
        return self.end_guy if isinstance(self.end_guy, EndGuyRecord) else None

    @property
    def open_floor(self) -> Message | None:
        """Reason why the guideline's load is not known."""
        return self.floor.reason if self.floor else None

    def find_least(self, member: str) -> FloorForceRecord | None:
        """Force of a member by the guideline's load; None where there is none."""
        forces = self.floor.forces if self.floor else ()
        return next((force for force in forces if force.member == member), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberForce:
    """Characteristic force on one member of one support, with what it follows from.

    Attributes
    ----------
    action : Quantity
        E_k [kN].
    coupled, by_panel, guideline, by_truss : Quantity or None
        On the support, by section, panel, guideline, and of a guy or its anchor by the
        truss of post, guys and end guy [kN]; None where there is none. Of a base that
        slides, those across it.
    support, load, push : Support, MemberLoad, Quantity or None
        What turns a force inside the row into the member's, and the ropes' part.
    pressing : Quantity or None
        Force across the plate of a base that slides [kN].
    solved : tuple of LargestForce
        By section, and by the panel between posts where there is one.
    largest : LargestForce
        Larger one of them, which the check names its case by.
    """

    action: Quantity
    coupled: Quantity
    by_panel: Quantity | None = None
    guideline: Quantity | None = None
    by_truss: Quantity | None = None
    support: Support
    load: MemberLoad = field(default_factory=MemberLoad)
    push: Quantity | None = None
    pressing: Quantity | None = None
    solved: tuple[LargestForce, ...]
    largest: LargestForce

    @property
    def by_model(self) -> list[Quantity]:
        """Forces of the coupled calculation, whether they decide or not."""
        forces = (self.coupled, self.by_panel, self.by_truss)
        return [force for force in forces if force]


def high_of(quantity: Quantity | None) -> float:
    """Upper end of a quantity, 0 of none."""
    return (quantity.high if quantity else None) or 0.0
