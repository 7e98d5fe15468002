"""The cases of a site: a grid of them, or a search of the worst."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.adaptive import SearchSettings
from netdesign.envelope.grid import Case, Ranges, build_cases
from netdesign.envelope.parameters import Box
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.envelope.runner import Runner
from netdesign.envelope.search import (
    RowEnvelope,
    RowTask,
    Wave,
    refine_settings,
    search_rows,
)
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, CreepLaw
from netdesign.snow.snowpack import Snowpack

_USUAL_SEARCH = 55  # cases of a row, for --dry-run only
_CLOSEST_GAP = 1e-3  # however accurate the cases are


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """How a site is to be solved."""

    settings: SolverSettings
    creep_law: CreepLaw = BOUTILLIER_2004
    jobs: int = 1
    command: str = "netdesign check"
    started: str = ""  # ISO 8601, UTC; given, so that equal input gives equal bytes


def count_cases(site: Site) -> int:
    """Number of cases of a grid; about that of a search, which nobody knows yet."""
    if site.ranges.is_grid:
        return len(site.rows) * len(build_cases(site.ranges))
    return len(site.rows) * _USUAL_SEARCH


def search_site(
    site: Site,
    run: CheckRun,
    runner: Runner | None = None,
    on_wave: Callable[[Wave], None] = lambda _: None,
) -> list[RowEnvelope]:
    """Search the largest forces of all net rows; no limit profile is needed for it.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    run : CheckRun
        Settings; their accuracy is the gap that is asked for, too.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise.
    on_wave : callable, optional
        Called after each wave of cases.

    Returns
    -------
    list of RowEnvelope
        One a row, each with its upper bounds and governing cases confirmed.
    """
    tasks = [_build_search(row, site.ranges, run) for row in site.rows]
    return search_rows(tasks, runner or Runner(), on_wave)


def _build_search(row: NetRow, ranges: Ranges, run: CheckRun) -> RowTask:
    middle = Case(
        density=ranges.density.low,
        friction_angle=ranges.friction_angle.low,
        inclination=ranges.inclination.low,
    )
    return RowTask(
        scene=_build_scene(row, middle, run),
        box=Box(
            intervals=(
                ("density", ranges.density),
                ("friction_angle", ranges.friction_angle),
                ("inclination", ranges.inclination),
            )
        ),
        layout=row.layout,
        settings=run.settings,
        search=SearchSettings(gap=max(run.settings.accuracy, _CLOSEST_GAP)),
        confirmed_by=refine_settings(run.settings),
    )


def solve_site(
    site: Site, run: CheckRun, runner: Runner | None = None
) -> list[list[CaseResult]]:
    """Solve all cases of all net rows; no limit profile is needed for it.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    run : CheckRun
        Settings.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise.

    Returns
    -------
    list of list of CaseResult
        For each row its cases in the order of the grid; failed ones are named.
    """
    cases = build_cases(site.ranges)
    tasks = [task for row in site.rows for task in _build_tasks(row, cases, run)]
    results = run_cases(tasks, runner)
    count = len(cases)
    return [results[k * count : (k + 1) * count] for k in range(len(site.rows))]


def _build_scene(row: NetRow, case: Case, run: CheckRun) -> Scene:
    return Scene(
        snowpack=Snowpack(
            slope_angle=row.slope_angle,
            thickness=row.snow_thickness,
            upslope_length=row.upslope_length,
            density=case.density,
        ),
        ground=row.ground,
        net=Net(
            height_normal=row.net_height,
            inclination=case.inclination,
            stiffness_per_m=row.net_stiffness_per_m,
            slack=row.slack,
            friction_angle=case.friction_angle,
        ),
        creep_law=run.creep_law,
    )


def _build_tasks(row: NetRow, cases: Sequence[Case], run: CheckRun) -> list[CaseTask]:
    return [
        build_task(
            case,
            lambda point: _build_scene(row, point, run),
            row.layout,
            run.settings,
        )
        for case in cases
    ]
