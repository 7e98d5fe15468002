"""The use case: site -> cases -> checks -> studies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from netdesign.checks import Standard
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.envelope.search import Wave
from netdesign.site.model import NetRow, Site
from netdesign.solving.runner import Runner
from netdesign.study.cases import (
    CheckRun,
    have_same_forces,
    search_site,
    solve_site,
)
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


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedSite:
    """A site with the solved cases of its rows."""

    site: Site
    rows: Sequence[RowGrid | RowEnvelope]


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
    solved = solve_rows(site, run, runner, watch)
    return judge_solved(solved, standards, run, runner, watch)


def solve_rows(
    site: Site,
    run: CheckRun,
    runner: Runner,
    watch: Watch,
    known: SolvedSite | None = None,
) -> SolvedSite:
    """Cases of every net row, solved; rows with the same forces as ``known`` are not.

    A what-if has the rows of the site that is known, in their order, and some of them
    may be solved alike: only their checks are other ones.
    """
    todo = [row for row in site.rows if known is None or _is_new(row, site, known, run)]
    part = replace(site, rows=tuple(todo))
    found: Sequence[RowGrid | RowEnvelope] = ()
    if todo and site.ranges.is_grid:
        found = solve_site(part, run, runner)
    elif todo:
        found = search_site(part, run, runner, watch.tell_wave)
    by_id = dict(zip((row.id for row in todo), found, strict=True))
    if known is not None:
        old = zip(known.site.rows, known.rows, strict=True)
        by_id = {row.id: solved for row, solved in old} | by_id
    return SolvedSite(site=site, rows=[by_id[row.id] for row in site.rows])


def _is_new(row: NetRow, site: Site, known: SolvedSite, run: CheckRun) -> bool:
    """No row of that id was solved, or its forces are other ones."""
    old = {one.id: one for one in known.site.rows}.get(row.id)
    return old is None or not have_same_forces(
        row, site.ranges, old, known.site.ranges, run
    )


def judge_solved(
    solved: SolvedSite,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner,
    watch: Watch,
) -> list[Study]:
    """Studies of a solved site, one for each profile."""
    watch.enter("checks")
    probe = Probe(run.settings, run.creep_law, runner)
    site, rows = solved.site, solved.rows
    studies = [
        judge_site(site, rows, one, run, probe, watch.count_piece) for one in standards
    ]
    _keep_faults(site, rows, runner)
    return studies


def _keep_faults(
    site: Site, solved: Sequence[RowGrid | RowEnvelope], runner: Runner
) -> None:
    """Tell the runner which net rows the faults in their cases befell."""
    for row, of_row in zip(site.rows, solved, strict=True):
        again = of_row.confirmations if isinstance(of_row, RowEnvelope) else ()
        for result in (*of_row.results, *(one.confirmed for one in again)):
            runner.keep_fault(result.fault, row.id)
