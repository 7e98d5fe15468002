"""Inputs of a check: force with its band, resistance, proof, place in the row.

The width of net that an end support carries: structure/THEORY.md, (S9) to (S20).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.calculation.quantity import Quantity, largest
from netdesign.outcome import ModelError
from netdesign.resistance.ground import PullOutTests
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class Band:
    """A size with the band in which it surely lies: 0 <= low <= value <= high."""

    low: float
    value: float
    high: float

    def __post_init__(self) -> None:
        """Refuse disorder, negative sizes, NaN and infinity."""
        if not (0.0 <= self.low <= self.value <= self.high < math.inf):
            raise ModelError(say("band.disorder", band=repr(self)))


@dataclass(frozen=True, slots=True, kw_only=True)
class GivenResistance:
    """Characteristic resistance of one member in one mode, as a check reads it.

    Attributes
    ----------
    member, mode : str
        Member, as in "foot_anchor", and mode of failure, such as "pull_out".
    source : str
        Cell where it stands or should stand.
    value : float or None
        [N]; None where none is given.
    basis : str
        Way in which it was found: "tested", "computed", "declared", or "".
    type_id : str
        Id of the anchor, rope or post type, or "".
    tests : PullOutTests or None
        Pull-out tests in the place of a value.
    lack : Message or None
        Reason for a missing value, where "none is given" does not say it.
    factored_as : tuple of str
        Modes whose partial factors count, the largest of them; its own if empty.
    best : float or None
        Value at the best end of what is assumed for it [N]; None where it is the same.
    """

    member: str
    mode: str
    source: str
    value: float | None = None
    basis: str = ""
    type_id: str = ""
    tests: PullOutTests | None = None
    lack: Message | None = None
    factored_as: tuple[str, ...] = ()
    best: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Proof:
    """Place of a proof elsewhere: document, author, date ("" for none) and cell.

    A type approval has no author.

    A study has it as it is; its cell is that of the declaration, ``Declared!B2``.
    """

    document: str
    author: str
    date: str
    cell: str

    def describe(self) -> Message:
        """Document, author and date as one phrase."""
        if not self.author:
            return say("approval.proof", document=self.document, cell=self.cell)
        details = {"document": self.document, "author": self.author, "cell": self.cell}
        if not self.date:
            return say("check.proof_undated", **details)
        return say("check.proof", **details, date=self.date)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """Declaration of the workbook that a check is proven elsewhere.

    Attributes
    ----------
    row_id : str
        Net row; "" for all of them.
    member, mode : str
        Which check.
    position : str
        "edge": on a row's first and last support only. "": inside the row, and there
        too where its member is of the same type.
    proof : Proof
        Where it is proven, by whom and when.
    """

    row_id: str
    member: str
    mode: str
    position: str = ""
    proof: Proof


@dataclass(frozen=True, slots=True, kw_only=True)
class Support:
    """Support of a row: the factors from a force inside the row to that on it.

    Attributes
    ----------
    spacing, width : Quantity or None
        b and b_e [m]; None inside the row, where one is the other.
    end_factor, end_length : Quantity or None
        f_R [-] and its length [m]; None inside the row.
    is_second : bool
        It stands beside the end.
    reaching : int
        End effects that reach the last bay.
    has_both : bool
        An anchor of two posts, each beside an end: ropes add a force to both guys.
    """

    spacing: Quantity | None = None
    width: Quantity | None = None
    end_factor: Quantity | None = None
    end_length: Quantity | None = None
    is_second: bool = False
    reaching: int = 1
    has_both: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberLoad:
    """Way from a force of the section to that of a member, inside the row.

    Attributes
    ----------
    share : Quantity or None
        g, of the section's force in the member [-]; None of all of it.
    added : Quantity or None
        A, by the load along the row [kN]; None of nothing.
    lateral, along : Quantity or None
        k_q and k, by the load along the row at the net's foot [-]; None of 1 and 0.
    across, splay : Quantity or None
        Of two guys on one anchor, square to what they share in the section [kN]; and
        the angle of each out of it [deg].
    """

    share: Quantity | None = None
    added: Quantity | None = None
    lateral: Quantity | None = None
    along: Quantity | None = None
    across: Quantity | None = None
    splay: Quantity | None = None


def place_end_support(
    spacing: Quantity,
    factor: Quantity,
    length: Quantity,
    *,
    second: Quantity | None = None,
    other: Quantity | None = None,
    beside: Quantity | None = None,
    is_shared: bool = False,
) -> Support:
    """First or last support of a row: half a bay and the end effect.

    With ``second`` the one beside it: a bay, and that part of a bay of the end effect
    by the lever rule. ``other`` and ``beside`` are parts of a bay of the other end's
    effect on it, and of the end effects on the next support.

    An anchor that it shares holds a guy of the next post, too, which carries a bay and
    the part ``beside``. In a row of four that post stands beside the other end.
    """

    def widen(part: Quantity) -> Quantity:
        return spacing + factor * part * spacing

    width = spacing / 2 + factor * length if second is None else widen(second)
    if other is not None:
        width = width + factor * other * spacing
    if is_shared:
        both = (width + (spacing if beside is None else widen(beside))) / 2
        width = largest(width, both) if second is None else both
    has_both = False
    if is_shared and second is not None and beside is not None:
        has_both = (beside.value or 0.0) >= (second.value or 0.0)
    clause = "(S9)" if second is None else "(S10a)"
    return Support(
        spacing=spacing,
        width=width.named("b_e", "m", "(S20)" if is_shared else clause),
        end_factor=factor,
        end_length=length,
        is_second=second is not None,
        reaching=1 if other is None else 2,
        has_both=has_both,
    )
