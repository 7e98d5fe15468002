"""How a solve ended, and what a check concluded."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


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
    def sentence(self) -> str:
        """What the outcome means, for a report."""
        return _SENTENCES[self]


_SENTENCES = {
    Outcome.CONVERGED: "The solution converged and its balances were checked.",
    Outcome.MAX_ITERATIONS: "The iteration limit was reached before convergence.",
    Outcome.DIVERGED: "The iteration did not lower its energy or residual.",
    Outcome.NONFINITE: "A value stopped being a finite number.",
    Outcome.BALANCE_VIOLATED: "A balance, tension or friction test was not met.",
    Outcome.NO_EQUILIBRIUM: "The net has no equilibrium under these loads.",
    Outcome.PLATEAU_NOT_REACHED: "The history came to no plateau within its horizon.",
    Outcome.OUT_OF_VALIDITY: "The scene lies outside what the model can represent.",
    Outcome.WORKER_FAILED: "The process that computed this case ended early.",
    Outcome.PROGRAM_FAULT: "A fault of the program, not of the input.",
}


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
