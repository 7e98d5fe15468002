"""Runs of the paper's study: what each recorded, at what error."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from netdesign.coupling.history.run import scale_history
from netdesign.coupling.history.settings import StaggeredSettings, TransientSettings
from netdesign.coupling.history.staggered import run_exchange
from netdesign.coupling.history.transient import run_history, solve_transient
from netdesign.coupling.moments import History
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.evidence.paper.cases import (
    PaperCase,
    PaperSettings,
    horizon_of,
    list_cases,
)
from netdesign.evidence.runner import spread
from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import SolveError
from netdesign.words.message import Message, say

# Heights of the two nodes that are followed, over the net's. The paper's nodes 3 and 8
# stand in a drawing only; these are at a quarter and at three quarters.
LOWER_HEIGHT, UPPER_HEIGHT = 0.25, 0.75
_ACCURACY = 0.1  # never refines: the settings say which meshes are taken


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """Records of a history, at its own times.

    Attributes
    ----------
    times : ndarray, shape (n,)
        [s].
    foot, head : ndarray, shape (n,)
        Pulls [N/m].
    lower, upper : ndarray, shape (2, n)
        Forces of the net on the snow at two nodes [N/m].
    heights : tuple of float
        Of these nodes above the ground, at the end [m].
    density : ndarray, shape (n,)
        Largest relative density [-].
    plateau : int or None
        Number of the moment at which a plateau begins.
    ended : Message or None
        Why it ended before its horizon; None if it did not.
    """

    times: Floats
    foot: Floats
    head: Floats
    lower: Floats
    upper: Floats
    heights: tuple[float, float]
    density: Floats
    plateau: int | None
    ended: Message | None

    def at(self, time: float, name: str) -> float:
        """Value of ``foot``, ``head`` or ``density`` at a time [s], between moments."""
        return float(np.interp(time, self.times, getattr(self, name)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shape:
    """Snow and net at the end: nodes, curve (2, n) [m], triangles, density [kg/m3]."""

    nodes: Floats
    triangles: Ints
    density: Floats
    curve: Floats
    sag: float

    @property
    def mean_density(self) -> float:
        """Mean density over the snow's area [kg/m3]."""
        first, second, third = self.nodes[:, self.triangles].transpose(1, 0, 2)
        one, other = second - first, third - first
        areas = np.abs(one[0] * other[1] - one[1] * other[0])
        return float((self.density * areas).sum() / areas.sum())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PaperRun:
    """Result of one case, or why there is none.

    Attributes
    ----------
    case : PaperCase
        What was run.
    failure : Message or None
        Why there is no result; None if there is one.
    foot, head : float or None
        Pulls of the steady state, or where the plateau begins [N/m]; None without.
    foot_error, head_error : float
        Difference from the coarser mesh, with a floor [N/m]; 0 where not known.
    track, shape : Track, Shape or None
        History; state at the end.
    """

    case: PaperCase
    failure: Message | None = None
    foot: float | None = None
    head: float | None = None
    foot_error: float = 0.0
    head_error: float = 0.0
    track: Track | None = None
    shape: Shape | None = None


def run_case(case: PaperCase, settings: PaperSettings) -> PaperRun:
    """Run one case; a failure is a result with its reason."""
    try:
        if case.method == "steady":
            return _run_steady(case)
        if case.method == "staggered" or case.is_coarse:
            return _run_one_mesh(case, settings)
        return _run_history(case, settings)
    except SolveError as failure:
        return PaperRun(case=case, failure=failure.reason)


def _run_steady(case: PaperCase) -> PaperRun:
    solution = solve_steady(case.scene, SolverSettings(accuracy=0.01))
    if not isinstance(solution, Solution):
        return PaperRun(case=case, failure=solution.reason)
    return PaperRun(
        case=case,
        foot=solution.foot.size,
        head=solution.head.size,
        foot_error=solution.foot.error,
        head_error=solution.head.error,
        shape=_shape_of(solution),
    )


def _run_history(case: PaperCase, settings: PaperSettings) -> PaperRun:
    solution = solve_transient(
        case.scene,
        TransientSettings(
            accuracy=_ACCURACY,
            start=case.start,
            densifies=case.densifies,
            horizon=horizon_of(case, settings),
            levels=settings.levels,
        ),
    )
    if isinstance(solution, FailedSolution):
        return PaperRun(case=case, failure=solution.reason)
    if solution.history is None:
        return PaperRun(case=case, failure=say("paper.no_history"))
    track = _track_of(solution.history, solution.net_curve[1, 1:])
    return PaperRun(
        case=case,
        foot=_at_plateau(track, "foot"),
        head=_at_plateau(track, "head"),
        foot_error=solution.foot.error,
        head_error=solution.head.error,
        track=track,
        shape=_shape_of(solution),
    )


def _run_one_mesh(case: PaperCase, settings: PaperSettings) -> PaperRun:
    scene = case.scene
    horizon = horizon_of(case, settings)
    creep_time = horizon / scene.time_scale
    size = settings.levels[0]
    if case.method == "staggered":
        run = run_exchange(
            scene,
            StaggeredSettings(base_drag=case.drag, horizon=creep_time, size=size),
        )
    else:
        plain = TransientSettings(start=case.start, horizon=horizon)
        run = run_history(scene, size, plain, creep_time)
    history = scale_history(run, scene)
    body = run.state.body
    heights = body.vertices[1, body.topology.net][1:] * scene.snowpack.thickness
    track = _track_of(history, heights)
    return PaperRun(
        case=case,
        foot=_at_plateau(track, "foot"),
        head=_at_plateau(track, "head"),
        track=track,
    )


def _at_plateau(track: Track, end: str) -> float | None:
    """Pull where the plateau begins; None without one."""
    if track.plateau is None:
        return None
    return float(getattr(track, end)[track.plateau])


def _track_of(history: History, heights: Floats) -> Track:
    moments = history.moments
    lower, upper = (_nearest(heights, share) for share in (LOWER_HEIGHT, UPPER_HEIGHT))
    return Track(
        times=np.array([moment.time for moment in moments]),
        foot=_sizes([moment.foot for moment in moments]),
        head=_sizes([moment.head for moment in moments]),
        lower=np.array([-moment.on_net[:, lower] for moment in moments]).T,
        upper=np.array([-moment.on_net[:, upper] for moment in moments]).T,
        heights=(float(heights[lower]), float(heights[upper])),
        density=np.array([moment.max_relative_density for moment in moments]),
        plateau=history.plateau.index,
        ended=history.ended,
    )


def _nearest(heights: Floats, share: float) -> int:
    return int(np.abs(heights - share * heights.max()).argmin())


def _sizes(vectors: Sequence[Floats]) -> Floats:
    return np.asarray(np.hypot(*np.array(vectors).T))


def _shape_of(solution: Solution) -> Shape:
    return Shape(
        nodes=solution.mesh_nodes,
        triangles=solution.mesh_triangles,
        density=solution.mesh_density,
        curve=solution.net_curve,
        sag=solution.sag,
    )


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
