"""``--dry-run``: cases and predicted time of a check; nothing is written."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING

from netdesign.commands.running import print_document, print_faults
from netdesign.commands.usage import tell
from netdesign.site.statements import list_missing
from netdesign.words.catalogue import Language, render
from netdesign.words.message import Message, say

if TYPE_CHECKING:
    from collections.abc import Sequence

    from netdesign.edge.progress import Phase
    from netdesign.site.model import Site
    from netdesign.solving.runner import Runner
    from netdesign.study.check_run import CheckRun


_TIMED_ROWS = 5  # about; enough for a guess, few enough to be quick


def announce(
    site: Site,
    run: CheckRun,
    profiles: int = 1,
    *,
    as_json: bool,
    language: Language = "en",
) -> int:
    """Print net rows, solves of every phase and the predicted time; the exit code."""
    from netdesign.solving.runner import Runner
    from netdesign.study.cases import list_phases

    runner, phases = Runner(), list_phases(site, run, profiles)
    seconds = _predict(phases, _measure_case(site, run, runner))
    if as_json:
        plan = {
            "schema": "netdesign.plan/1",
            "net_rows": len(site.rows),
            "cases": phases[0].cases,
            "is_searched": not site.ranges.is_grid,  # then about so many
            "further_solves": _count_further(phases),  # about
            "jobs": run.jobs,
            "predicted_s": seconds,
            "phases": [
                {
                    "phase": one.key,
                    "does": render(one.words, language),
                    "cases": one.cases,
                    "cases_most": one.most,
                }
                for one in phases
            ],
            "missing": [render(one, language) for one in _list_missing(site)],
            "notes": [render(one, language) for one in site.notes],
            "questions": [render(one, language) for one in site.questions],
        }
        print_document(plan)
    else:
        _show(site, run, phases, seconds, language)
    return print_faults(runner.faults, language)


def _show(
    site: Site,
    run: CheckRun,
    phases: Sequence[Phase],
    seconds: float,
    language: Language,
) -> None:
    summary = say(
        "plan.summary" if site.ranges.is_grid else "plan.summary_about",
        file=site.file_name,
        rows=len(site.rows),
        cases=phases[0].cases,
        further=_count_further(phases),
        seconds=max(seconds, 1.0),
        jobs=run.jobs,
    )
    tell(summary, language)
    for phase in phases:
        if phase.cases:
            tell(_name_phase(phase), language)
    for note in site.notes:
        tell(say("cli.note", text=note), language)
    for missing in _list_missing(site):
        tell(missing, language)
    for question in site.questions:
        tell(say("cli.question", text=question), language)


def _list_missing(site: Site) -> list[Message]:
    """Lines on what the net rows lack for a verdict; rows that lack the same share."""
    by_lack: dict[tuple[Message, ...], list[str]] = {}
    for row in site.rows:
        if names := list_missing(row, site.links):
            by_lack.setdefault(names, []).append(row.id)
    return [
        say("plan.missing", rows=tuple(rows), names=names)
        for names, rows in by_lack.items()
    ]


def _name_phase(phase: Phase) -> Message:
    if phase.most <= phase.cases:
        return say("plan.phase", cases=phase.cases, phase=phase.words)
    return say("plan.phase_most", cases=phase.cases, most=phase.most, phase=phase.words)


def _count_further(phases: Sequence[Phase]) -> int:
    """Solves beside the cases of the envelope."""
    return sum(phase.cases for phase in phases[1:])


def _predict(phases: Sequence[Phase], of_case: float) -> float:
    """Seconds of all phases, from those of a steady case in one process."""
    return sum(one.cases * one.cost * of_case + one.seconds for one in phases)


def _measure_case(site: Site, run: CheckRun, runner: Runner) -> float:
    """Seconds of one case on this machine: the middle of the ranges, for some rows."""
    from netdesign.envelope.ranges import Interval, Ranges
    from netdesign.study.cases import solve_site

    def middle(interval: Interval) -> Interval:
        value = (interval.low + interval.high) / 2
        return Interval(low=value, high=value, count=1)

    ranges = Ranges(
        intervals=tuple((name, middle(one)) for name, one in site.ranges.intervals)
    )
    rows = site.rows[:: max(1, len(site.rows) // _TIMED_ROWS)]
    steady = replace(run, jobs=1, method="steady")
    # the first solve also loads what the solver needs, which happens only once
    solve_site(replace(site, rows=rows[:1], ranges=ranges), steady, runner)
    start = time.perf_counter()
    solve_site(replace(site, rows=rows, ranges=ranges), steady, runner)
    return (time.perf_counter() - start) / len(rows)
