"""Rating of a check: utilisation, open points, and the verdict from both."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import ClassVar

from netdesign.checks.inputs import Proof
from netdesign.outcome import Verdict
from netdesign.words.message import Text


class OpenKind(StrEnum):
    """Kinds of open points, the gravest first."""

    FAILS = "fails"  # nothing is left to resist, whatever the force
    UNSOLVED = "unsolved"  # the force is not known, or not in every case
    RESISTANCE_MISSING = "resistance_missing"
    RESISTANCE_IN_DOUBT = "resistance_in_doubt"  # it may not last, or not hold there
    VALUE_ASKED = "value_asked"  # a value that the engineer has to confirm
    ASSUMED_DECIDES = "assumed_decides"  # met at the best ends of what is assumed
    PROVEN_ELSEWHERE = "proven_elsewhere"  # by a document


# Best verdict beside a point of a kind; of any other it is not proven.
_BEST = {OpenKind.FAILS: Verdict.FAIL, OpenKind.PROVEN_ELSEWHERE: Verdict.DECLARED}


@dataclass(frozen=True, kw_only=True)
class Open:
    """Point that keeps a check from being proven.

    ``proof`` is the document of what is proven elsewhere.
    """

    LEAVES_OUT_NONE: ClassVar[bool] = True

    kind: OpenKind
    message: Text
    proof: Proof | None = None


def merge_open(met: Verdict, points: Iterable[Open]) -> Verdict:
    """Verdict of a comparison with its open points.

    ================  =====================  =================  ==========
    fails, or a       proven elsewhere       any other point,   verdict
    point that fails                         or not met
    ================  =====================  =================  ==========
    yes               no or yes              no or yes          fail
    no                yes                    no or yes          declared
    no                no                     yes                not proven
    no                no                     no                 pass
    ================  =====================  =================  ==========

    Parameters
    ----------
    met : Verdict
        By the numbers alone.
    points : iterable of Open
        All that is open.
    """
    verdicts = {met, *(_BEST.get(point.kind, Verdict.NOT_PROVEN) for point in points)}
    ranked = (Verdict.FAIL, Verdict.DECLARED, Verdict.NOT_PROVEN, Verdict.PASS)
    return next(verdict for verdict in ranked if verdict in verdicts)


def rate_utilisation(low: float | None, high: float | None) -> Verdict:
    """Verdict on the band of a utilisation [-]; not proven where it is not known."""
    if low is None or high is None:
        return Verdict.NOT_PROVEN
    return judge(low, high, least=0.0, most=1.0)


def judge(low: float, high: float, *, least: float, most: float) -> Verdict:
    """Verdict on a quantity that lies in a band and must lie in a range.

    The only place where numbers become a verdict. Each answer but "not proven" has
    to be earned by a comparison that holds, which NaN never does.

    Parameters
    ----------
    low, high : float
        Band of the quantity; finite, or nothing is proven.
    least, most : float
        Range that is accepted, both ends included, in the unit of the band; ``most``
        may be infinite.

    Examples
    --------
    >>> judge(0.8, 1.0, least=0.0, most=1.0).value
    'pass'
    """
    is_known = all(math.isfinite(number) for number in (low, high, least))
    if not (is_known and low <= high and most > -math.inf):
        return Verdict.NOT_PROVEN
    if low > most or high < least:
        return Verdict.FAIL
    return Verdict.PASS if least <= low and high <= most else Verdict.NOT_PROVEN


@dataclass(frozen=True, slots=True, kw_only=True)
class Rating:
    """How far a check is met, by its numbers and its open points.

    Attributes
    ----------
    low, high : float or None
        Utilisation at the ends of the demand [-]; None where it is not known.
    open : sequence of Open
        All that is open.
    demand : float or None
        High end of the design force [kN].
    met : Verdict or None
        In place of a utilisation: by another comparison, or of information only.
    eased : float or None
        Low end of the utilisation at the best ends of what is assumed [-].
    """

    low: float | None
    high: float | None
    open: Sequence[Open] = ()
    demand: float | None = None
    met: Verdict | None = None
    eased: float | None = None

    @property
    def eased_low(self) -> float | None:
        """Low end at the best ends of what is assumed [-]; None if no lower."""
        low, eased = self.low, self.eased
        return eased if low is not None and eased is not None and eased < low else None

    @property
    def band(self) -> tuple[float | None, float | None]:
        """Utilisation at the best ends of what is assumed, and at the worst [-]."""
        return self.low if self.eased_low is None else self.eased_low, self.high

    @property
    def is_unbounded(self) -> bool:
        """No resistance is left, so that the utilisation has no bound."""
        return any(point.kind is OpenKind.FAILS for point in self.open)

    @property
    def by_numbers(self) -> Verdict:
        """Verdict by the numbers alone; no stated one stands above a utilisation."""
        return rate_utilisation(*self.band) if self.met is None else self.met

    @property
    def verdict(self) -> Verdict:
        """Verdict by the whole interval and all open points."""
        return merge_open(self.by_numbers, self.open)

    def ease(self, least: float) -> Rating:
        """Rating of a check that is used that much at the best ends [-].

        What leaves nothing to resist where it is worst, but not there, fails no longer.
        """
        if self.is_unbounded and least < math.inf:
            points = [
                replace(point, kind=OpenKind.ASSUMED_DECIDES)
                if point.kind is OpenKind.FAILS
                else point
                for point in self.open
            ]
            return replace(self, open=points, eased=least)
        low, _ = self.band
        return self if low is None or least >= low else replace(self, eased=least)
