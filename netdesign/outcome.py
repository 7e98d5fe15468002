"""Ends of solves and verdicts of checks."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum

from netdesign.words.message import Message, say


class Outcome(StrEnum):
    """End of one solve. Only ``CONVERGED`` carries numbers that may be used."""

    CONVERGED = "converged"
    MAX_ITERATIONS = "max_iterations"
    DIVERGED = "diverged"
    NONFINITE = "nonfinite"
    BALANCE_VIOLATED = "balance_violated"
    NO_EQUILIBRIUM = "no_equilibrium"
    PLATEAU_NOT_REACHED = "plateau_not_reached"
    OUT_OF_VALIDITY = "out_of_validity"
    WORKER_FAILED = "worker_failed"
    PROGRAM_FAULT = "program_fault"

    @property
    def message(self) -> Message:
        """Meaning of the outcome, for a report."""
        return say(f"outcome.{self.value}")

    @property
    def word(self) -> Message:
        """Its name, before a reason."""
        return say(f"ended.{self.value}")

    @property
    def sentence(self) -> str:
        """Meaning of the outcome, in English."""
        return str(self.message)


class Verdict(StrEnum):
    """Conclusion of a check, of a net row or of a whole study."""

    PASS = "pass"
    FAIL = "fail"
    NOT_PROVEN = "not_proven"


def merge_verdicts(verdicts: Iterable[Verdict]) -> Verdict:
    """Verdict of a whole from the verdicts of its parts.

    ==================  =====================  ===========
    any part fails      any part not proven    whole
    ==================  =====================  ===========
    yes                 no or yes              fail
    no                  yes                    not proven
    no                  no                     pass
    no part at all                             not proven
    ==================  =====================  ===========

    Examples
    --------
    >>> merge_verdicts([Verdict.PASS, Verdict.NOT_PROVEN]).value
    'not_proven'
    >>> merge_verdicts([]).value
    'not_proven'
    """
    parts = set(verdicts)
    if Verdict.FAIL in parts:
        return Verdict.FAIL
    if not parts or Verdict.NOT_PROVEN in parts:
        return Verdict.NOT_PROVEN
    return Verdict.PASS
