"""The use case: site -> cases -> checks -> studies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from netdesign.checks import Standard
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.envelope.search import Wave
from netdesign.site.model import Site
from netdesign.solving.runner import Runner
from netdesign.study.cases import CheckRun, follow_site, search_site, solve_site
from netdesign.study.judge import judge_site
from netdesign.study.probe import Probe
from netdesign.study.records import Study


class Watch(Protocol):
    """Who is told how far a check has come; ``edge.progress.RunProgress`` is one."""

    def enter(self, key: str) -> None:
        """Tell that a phase of ``cases.list_phases`` begins."""

    def tell_wave(self, wave: Wave) -> None:
        """Tell that a wave of the search is over."""

    def count_piece(self) -> None:
        """Tell that a check of a force is finished."""


class _Nobody:
    """Watch of a check whose progress nobody asks for."""

    def enter(self, key: str) -> None: ...
    def tell_wave(self, wave: Wave) -> None: ...
    def count_piece(self) -> None: ...


def check_site(
    site: Site,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner | None = None,
    watch: Watch | None = None,
) -> list[Study]:
    """Check a site against limit profiles; its cases are solved once.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    standards : sequence of Standard
        Limit profiles.
    run : CheckRun
        Settings and identity of the run.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise. It
        remembers the faults of the program.
    watch : Watch, optional
        Told of every phase, wave and check.

    Returns
    -------
    list of Study
        One for each profile.
    """
    runner, watch = runner or Runner(), watch or _Nobody()
    solved: Sequence[RowGrid | RowEnvelope]
    if site.ranges.is_grid:
        solved = solve_site(site, run, runner)
    else:
        solved = search_site(site, run, runner, watch.tell_wave)
    watch.enter("measured")
    measured = follow_site(site, run, runner)
    watch.enter("checks")
    probe = Probe(run.settings, run.creep_law, runner)
    studies = [
        judge_site(site, solved, one, run, probe, measured, watch.count_piece)
        for one in standards
    ]
    _keep_faults(site, solved, runner)
    return studies


def _keep_faults(
    site: Site, solved: Sequence[RowGrid | RowEnvelope], runner: Runner
) -> None:
    """Tell the runner which net rows the faults in their cases befell."""
    for row, of_row in zip(site.rows, solved, strict=True):
        again = of_row.confirmations if isinstance(of_row, RowEnvelope) else ()
        for result in (*of_row.results, *(one.confirmed for one in again)):
            runner.keep_fault(result.fault, row.id)
