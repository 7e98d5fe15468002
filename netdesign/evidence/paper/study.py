"""The paper's study: all its runs, in one process or several."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context

from netdesign.evidence.paper.cases import PaperCase, PaperSettings, list_cases
from netdesign.evidence.paper.runs import PaperRun, run_case


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
    notify = on_done or (lambda _: None)
    runs = _run_all(cases, partial(run_case, settings=settings), jobs, notify)
    return PaperStudy(settings=settings, runs={case: runs[case] for case in cases})


def _run_all(
    cases: Sequence[PaperCase],
    run: Callable[[PaperCase], PaperRun],
    jobs: int,
    notify: Callable[[PaperRun], object],
) -> dict[PaperCase, PaperRun]:
    runs: dict[PaperCase, PaperRun] = {}
    if jobs == 1:
        for case in cases:
            runs[case] = run(case)
            notify(runs[case])
        return runs
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        places = {pool.submit(run, case): case for case in cases}
        for future in as_completed(places):
            runs[places[future]] = future.result()
            notify(runs[places[future]])
    return runs
