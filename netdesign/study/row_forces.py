"""What is known of a row's forces, and the force on one member of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from netdesign.calculation.quantity import Quantity
from netdesign.checks.forces import SupportForce
from netdesign.structure.members import Member, RopeForce, name_in_panel
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
    end_guy : EndGuyRecord, Message or None
        What the end guy does to the end's support, or why nothing holds that; None
        without a guy whose angle is given.
    pulls : tuple of PullRecord
        Directions at the anchors.
    open_cases : Message or None
        Why the forces do not cover every case.
    open_panel : Message or None
        Why an assumed panel fails, so that a force may be larger than those known.
    """

    effects: RowEffects
    largest: Mapping[str, LargestForce]
    floor: FloorRecord | None
    held: HeldSidewaysRecord | Message
    tilt: float
    end_guy: EndGuyRecord | Message | None = None
    pulls: tuple[PullRecord, ...] = ()
    open_cases: Message | None = None
    open_panel: Message | None = None
    # forces that were asked for: with their way, and by their numbers alone
    worked_out: dict[
        tuple[str, str, LoadedWidth], tuple[MemberForce | None, MemberForce | None]
    ] = field(default_factory=dict, init=False, compare=False, repr=False)

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
        return high_of(self.on.by_panel) > high_of(self.on.coupled)

    @property
    def is_by_truss(self) -> bool:
        """The truss of post, guys and end guy has the largest force."""
        loads = (self.on.coupled, self.on.by_panel, self.on.guideline)
        shared = self.on.shared
        return shared is not None and high_of(shared) >= max(map(high_of, loads))

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
            return high_of(self.action) / (self.largest.high_kN or 1.0)
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
        return self._tilt * (high_of(self.on.load.added) + high_of(self.on.load.across))

    def compare_load(self, other: MemberForce) -> float:
        """Load of its support over that of another [-].

        The larger growth of width and of what the end guy brings counts for both.
        """
        growth, push = self.on_support / other.on_support, high_of(other.on.push)
        return max(growth, high_of(self.on.push) / push) if push else growth


def high_of(quantity: Quantity | None) -> float:
    """Upper end of a quantity, 0 of none."""
    return (quantity.high if quantity else None) or 0.0
