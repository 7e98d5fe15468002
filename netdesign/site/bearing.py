"""What bears the forces of a net row: resistances, and members at its end."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.checks import GivenResistance
from netdesign.resistance.ground import AnchorType
from netdesign.resistance.post import PostSection
from netdesign.resistance.steel import Link, Wear
from netdesign.structure.members import EndMember, Member, NetPart
from netdesign.structure.splay import EndGuy
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class Resistance(GivenResistance):
    """Characteristic resistance of one member in one mode.

    ``value`` is None where the workbook gives none, and where it follows the demand,
    from ``dimensions``: of a base that slides, its coefficient of friction [-].
    """

    member: Member | EndMember | NetPart
    derivation: Message | None = None  # how it follows from dimensions
    dimensions: AnchorType | PostSection | Link | float | None = None
    buckling_length: float | None = None  # of a post, with which it was computed [m]
    drilled_length: float | None = None  # of an anchor, where given [m]
    ground: str = ""  # of an anchor type: where it was tested or computed; "" unknown
    wear: Wear | None = None  # of steel that corrodes
    # said where an assumption decides: between value and best, or without a best
    open: Message | None = None
    proof_limit: float | None = None  # of a test, by the tendon that it pulls [N]
    is_basis_assumed: bool = False  # how it is known is not given: as computed


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEnd:
    """Members that hold a row of panels along itself, at its end.

    Attributes
    ----------
    guy_angle : float
        Between the end guy and the row [rad]; where none is given the largest.
    stiffnesses : tuple of tuple of float, shape (n, 4)
        EA that uphill guy, downhill guy, end guy and post there may have together [N].
    ropes_slide : bool or None
        The border ropes slide at the supports; None where it is not given: the worse
        of both counts.
    lateral_axis : float or None
        Of the lateral anchor against the slope [rad]; None where none is given.
    resistances : tuple of Resistance
        Of all ``END_MODES``, given or not, and what follows the demand.
    anchors : tuple of (EndMember, AnchorType)
        Those that have a type.
    """

    guy_angle: float
    stiffnesses: tuple[tuple[float, ...], ...] = ()
    ropes_slide: bool | None = None
    lateral_axis: float | None = None
    resistances: tuple[Resistance, ...]
    anchors: tuple[tuple[EndMember, AnchorType], ...] = ()

    @property
    def guy(self) -> EndGuy:
        """End guy in space."""
        return EndGuy(angle=self.guy_angle)

    def find_anchor_type(self, anchor: str) -> AnchorType | None:
        """Type of one of its anchors; None where it is not given."""
        return next(
            (anchor_type for member, anchor_type in self.anchors if member == anchor),
            None,
        )
