"""The paper's study: all its runs, in one process or several."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from netdesign.evidence.paper.cases import PaperCase, PaperSettings, list_cases
from netdesign.evidence.paper.runs import PaperRun, run_case
from netdesign.evidence.runner import spread


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PaperStudy:
    """All runs by their case, and how they were computed."""

    settings: PaperSettings
    runs: Mapping[PaperCase, PaperRun]

    def __getitem__(self, case: PaperCase) -> PaperRun:
        """Run of a case; every case of ``list_cases`` has one."""
        return self.runs[case]


def run_study(
    settings: PaperSettings | None = None,
    *,
    jobs: int = 1,
    on_done: Callable[[PaperRun], object] | None = None,
) -> PaperStudy:
    """Run every case of the study.

    Parameters
    ----------
    settings : PaperSettings, optional
        Meshes, horizons, drags.
    jobs : int
        Processes; 1 stays in this one.
    on_done : callable, optional
        Called with each run as it ends.

    Returns
    -------
    PaperStudy
        The same whatever the number of processes.
    """
    settings = settings or PaperSettings()
    cases = list_cases(settings)
    work = partial(run_case, settings=settings)
    runs = spread(work, cases, jobs=jobs, chunk=1, on_done=on_done)
    return PaperStudy(settings=settings, runs=dict(zip(cases, runs, strict=True)))
