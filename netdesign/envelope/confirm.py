"""Confirms governing cases of the steady envelope by their histories."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from netdesign.checks.result import Band
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.transient import TransientSettings
from netdesign.envelope.extremes import find_extremes
from netdesign.envelope.run import CaseResult, CaseTask, run_cases
from netdesign.envelope.runner import Runner
from netdesign.envelope.search import RowEnvelope, build_point_task


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
        The results with the governing ones replaced: forces are the larger of steady
        state and history. A history that fails, or comes to no plateau, leaves a
        failed case: its row is not proven.
    """
    places = [
        (row, place)
        for row, of_row in enumerate(results)
        for place in find_governing(of_row)
    ]
    histories = run_cases(
        [replace(tasks[row][place], settings=settings) for row, place in places],
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
        )
        for one, of_row in zip(envelopes, results, strict=True)
    ]


def find_governing(results: Sequence[CaseResult]) -> list[int]:
    """Places of the cases that govern some member that is not slack, ascending."""
    governing = {
        id(one.governing)
        for one in find_extremes(results).values()
        if one.force.high > 0.0
    }
    return [place for place, one in enumerate(results) if id(one) in governing]


def merge_history(steady: CaseResult, history: CaseResult) -> CaseResult:
    """Steady result with the larger forces of both; a failed history fails it."""
    if not history.is_converged:
        return replace(history, reason=f"history of a governing case: {history.reason}")
    forces = {
        member: _take_larger(band, history.member_forces[member])
        for member, band in steady.member_forces.items()
    }
    return replace(steady, member_forces=forces)


def build_history_settings(settings: SolverSettings) -> TransientSettings:
    """Histories from a sagged net, at the accuracy of the envelope."""
    return TransientSettings(accuracy=settings.accuracy)


def _take_larger(one: Band, other: Band) -> Band:
    return Band(
        low=max(one.low, other.low),
        value=max(one.value, other.value),
        high=max(one.high, other.high),
    )
