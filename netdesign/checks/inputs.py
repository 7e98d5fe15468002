"""Inputs of a check: force with its band, resistance, proof elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass

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
