"""Input and result of a check."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from netdesign.calculation.quantity import Quantity
from netdesign.calculation.steps import list_named
from netdesign.checks.routes import TestedResistance
from netdesign.outcome import ModelError, Verdict
from netdesign.resistance.pull_out import PullOutTests
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

    def times(self, factor: float) -> Band:
        """Multiply by a positive factor [-]."""
        return Band(
            low=self.low * factor, value=self.value * factor, high=self.high * factor
        )

    def over(self, divisor: float) -> Band:
        """Divide by a positive number in the same unit."""
        return Band(
            low=self.low / divisor,
            value=self.value / divisor,
            high=self.high / divisor,
        )


class GivenResistance(Protocol):
    """Resistance as a check reads it; ``site.model.Resistance`` is one."""

    @property
    def member(self) -> str:
        """Member, as in "foot_anchor"."""

    @property
    def mode(self) -> str:
        """Mode of failure, such as "pull_out"."""

    @property
    def value(self) -> float | None:
        """Characteristic resistance [N]; None where none is given."""

    @property
    def basis(self) -> str:
        """Way in which it was found: "tested", "computed", "declared", or ""."""

    @property
    def type_id(self) -> str:
        """Id of the anchor, rope or post type, or ""."""

    @property
    def source(self) -> str:
        """Cell where it stands or should stand."""

    @property
    def tests(self) -> PullOutTests | None:
        """Pull-out tests in the place of a value [N]; None without."""

    @property
    def lack(self) -> Message | None:
        """Reason for a missing value, where "none is given" does not say it."""


def describe_proof(document: str, author: str, date: str, cell: str) -> Message:
    """Document, author, date ("" for none) and cell of a declaration as one phrase."""
    if not date:
        return say("check.proof_undated", document=document, author=author, cell=cell)
    return say("check.proof", document=document, author=author, date=date, cell=cell)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """Somebody's word that a check is proven elsewhere.

    Attributes
    ----------
    row_id : str
        Net row; "" for all of them.
    member, mode : str
        Which check.
    position : str
        "edge": on a row's first and last support only. "": inside the row, and there
        too where its member is of the same type.
    document, author, date : str
        Where it is proven, by whom and when; the date may be "".
    source : str
        Cell, as in "Declared!B2".
    """

    row_id: str
    member: str
    mode: str
    document: str
    author: str
    date: str
    source: str
    position: str = ""

    @property
    def proof(self) -> Message:
        """The place of the proof, as one phrase."""
        return describe_proof(self.document, self.author, self.date, self.source)


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckResult:
    """One check. A number that does not exist is None, and never leads to a pass.

    Attributes
    ----------
    id, clause, member, mode : str
        Name of the check, clause of its limit ("-" if none), and its subject.
    verdict : Verdict
        From ``check.judge`` alone.
    reason : Message
        Why, in one sentence.
    used : Quantity or None
        Utilisation with all that it follows from: of a check of a force.
    declaration : Declaration or None
        Where it is said to be proven, whatever the verdict.
    tested : TestedResistance or None
        Resistance from tests by every way; None where it is not from tests.
    is_unbounded : bool
        Nothing is left to resist the demand: its utilisation is infinite, and no
        number.
    """

    id: str
    clause: str
    member: str
    mode: str
    verdict: Verdict
    reason: Message
    used: Quantity | None = None
    declaration: Declaration | None = None
    is_unbounded: bool = False
    tested: TestedResistance | None = None

    def find(self, symbol: str) -> Quantity | None:
        """Quantity of the calculation under a symbol; None if it has no value."""
        named = [] if self.used is None else list_named(self.used)
        return next((q for q in named if q.symbol == symbol and q.is_known), None)

    def find_value(self, symbol: str) -> float | None:
        """Value of a quantity of the calculation, in its unit."""
        found = self.find(symbol)
        return found.value if found else None
