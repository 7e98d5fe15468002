"""Confirms governing cases of the steady envelope by their histories.

Which of the two is the demand, and why: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from netdesign.checks.result import Band
from netdesign.coupling.history.settings import TransientSettings
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.extremes import find_extremes
from netdesign.envelope.rows import Confirmation, RowEnvelope, build_point_task
from netdesign.envelope.run import CaseResult, CaseTask, Compared, run_cases
from netdesign.panel.solution import FailedPanel
from netdesign.solving.runner import Runner
from netdesign.words.message import say

# A thousand years [s]: snow that has not come to rest by then never does.
_LONGEST = 1e3 * 365.25 * 86400.0


def confirm_rows(
    tasks: Sequence[Sequence[CaseTask]],
    results: Sequence[Sequence[CaseResult]],
    settings: TransientSettings,
    runner: Runner | None = None,
) -> list[list[CaseResult]]:
    """Follow the history of every case that governs a member of its net row.

    Parameters
    ----------
    tasks, results : sequence of sequence
        Of the steady envelope, by net row, each in the order of the grid.
    settings : TransientSettings
        Of the histories.
    runner : Runner, optional
        Where they are solved and kept; this process unless told otherwise.

    Returns
    -------
    list of list of CaseResult
        The results with the governing ones replaced: the demand is the steady state's
        force, or the history's where that is larger by more than both errors. A history
        that fails, or comes to no plateau, leaves a failed case: its row is not proven.
    """
    places = [
        (row, place)
        for row, of_row in enumerate(results)
        for place in find_governing(of_row)
    ]
    histories = run_cases(
        [tasks[row][place].solved_by(settings) for row, place in places],
        runner=runner,
    )
    confirmed = [list(of_row) for of_row in results]
    for (row, place), history in zip(places, histories, strict=True):
        confirmed[row][place] = merge_history(results[row][place], history)
    return confirmed


def confirm_envelopes(
    envelopes: Sequence[RowEnvelope],
    settings: TransientSettings,
    runner: Runner | None = None,
) -> list[RowEnvelope]:
    """Searched rows with the histories of their governing cases, as ``confirm_rows``.

    What may hide between the cases stays that of the steady states.
    """
    tasks = [
        [build_point_task(one.task, point) for point in one.maxima.points]
        for one in envelopes
    ]
    results = confirm_rows(tasks, [one.results for one in envelopes], settings, runner)
    return [
        replace(
            one,
            results=tuple(of_row),
            members=one.members if any(r.is_converged for r in of_row) else (),
            confirmations=tuple(
                _confirm_again(before, of_row) for before in one.confirmations
            ),
        )
        for one, of_row in zip(envelopes, results, strict=True)
    ]


def _confirm_again(before: Confirmation, results: Sequence[CaseResult]) -> Confirmation:
    """Confirmation by the history, where the history is the demand."""
    for one in results:
        compared = one.compared
        if compared is None or compared.steady is not before.screened:
            continue
        in_history = compared.history.member_forces
        if before.member in in_history and compared.exceeds(before.member):
            return replace(before, confirmed=compared.history)
    return before


def find_governing(results: Sequence[CaseResult]) -> list[int]:
    """Places of the cases that govern some member that is not slack, ascending."""
    governing = {
        id(one.governing)
        for one in find_extremes(results).values()
        if one.force.high > 0.0
    }
    return [place for place, one in enumerate(results) if id(one) in governing]


def merge_history(steady: CaseResult, history: CaseResult) -> CaseResult:
    """The steady result, or the history's forces where these are surely larger.

    Where one is, the drawn state is the history's too. A failed history fails the
    case. A steady state whose panel failed keeps that gap, whatever the history's is.
    """
    if not history.is_converged:
        reason = say("envelope.history_failed", reason=history.reason or "")
        return replace(history, reason=reason)
    compared = Compared(steady=steady, history=history)
    forces = {
        member: _take_demand(compared, member)
        for member in history.member_forces
        if member in steady.member_forces
    }
    raised = any(compared.exceeds(member) for member in forces)
    if raised:  # of the panel, too, its own forces count, if it has some
        is_lost = isinstance(steady.panel, FailedPanel)
        panel = steady.panel if is_lost else history.panel
        return replace(history, member_forces=forces, panel=panel, compared=compared)
    return replace(
        steady, member_forces=steady.member_forces | forces, compared=compared
    )


def _take_demand(compared: Compared, member: str) -> Band:
    """The steady force, or the history's; its band covers what the other may reach."""
    steady = compared.steady.member_forces[member]
    history = compared.history.member_forces[member]
    taken = history if compared.exceeds(member) else steady
    return replace(taken, high=max(steady.high, history.high))


def build_history_settings(settings: SolverSettings) -> TransientSettings:
    """Histories from the steady net to their plateau, as accurate as the envelope.

    They end there, not after so many days: what comes later is other snow, and how
    soon it comes is a matter of the fluidity, which decides no force.
    """
    return TransientSettings(
        accuracy=settings.accuracy, horizon=_LONGEST, stops_at_plateau=True
    )
