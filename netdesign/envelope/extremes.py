"""Largest member forces over all cases, with their governing case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.checks.inputs import Band
from netdesign.envelope.run import CaseResult
from netdesign.panel.solve import FailedPanel
from netdesign.words.message import Message, group_reasons, say


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Extreme:
    """Largest force of one member.

    Attributes
    ----------
    member : str
        As in ``AnchorForces.member_forces``.
    force : Band
        Its largest value, and the largest lower and upper ends of all bands [N].
    governing : CaseResult
        The case of the largest value; carries the coincident forces.
    hidden : float
        How much larger it may be between the cases than at them [N].
    """

    member: str
    force: Band
    governing: CaseResult
    hidden: float = 0.0

    @property
    def widened(self) -> Band:
        """Largest force anywhere in the ranges [N].

        The upper end adds what may hide between the cases.
        """
        return replace(self.force, high=self.force.high + self.hidden)

    @property
    def upper_bound(self) -> float:
        """Largest force with what may hide, without the numerical error [N]."""
        return self.force.value + self.hidden


def find_extremes(results: Sequence[CaseResult]) -> dict[str, Extreme]:
    """Extreme of every member over the converged cases; empty if there is none.

    Converged means by outcome, never by arithmetic on missing numbers.
    """
    converged = [result for result in results if result.is_converged]
    members = dict.fromkeys(name for case in converged for name in case.member_forces)
    return {member: find_extreme(member, converged) for member in members}


def describe_gap(results: Sequence[CaseResult]) -> Message | None:
    """Reason why the extremes do not cover every case; None if they do."""
    failed = [result for result in results if not result.is_converged]
    if not results:
        return say("envelope.no_case")
    if failed:
        return _describe_failed("envelope.failed_cases", failed, len(results))
    without = [result for result in results if isinstance(result.panel, FailedPanel)]
    if without:
        return _describe_failed("panel.failed_cases", without, len(results))
    return None


def _describe_failed(key: str, failed: Sequence[CaseResult], count: int) -> Message:
    reasons = group_reasons(result.lack for result in failed if result.lack is not None)
    return say(key, failed=len(failed), count=count, reasons=reasons)


def find_extreme(member: str, results: Sequence[CaseResult]) -> Extreme:
    """Extreme of one member over the cases that have its force; there has to be one."""
    converged = [result for result in results if member in result.member_forces]
    bands = [result.member_forces[member] for result in converged]
    # Equal forces: the first case of the grid, whatever the order of the results.
    governing = min(
        converged,
        key=lambda result: (-result.member_forces[member].value, result.case),
    )
    return Extreme(
        member=member,
        force=Band(
            low=max(band.low for band in bands),
            value=governing.member_forces[member].value,
            high=max(band.high for band in bands),
        ),
        governing=governing,
    )
