"""Runs of the source paper's study: what each is, what it recorded, at what error."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from netdesign.addons.evidence.runner import spread
from netdesign.addons.evidence.scene import build_scene
from netdesign.addons.history.moments import History
from netdesign.addons.history.run import scale_history
from netdesign.addons.history.settings import (
    TRANSIENT_LEVELS,
    StaggeredSettings,
    Start,
    TransientSettings,
)
from netdesign.addons.history.staggered import run_exchange
from netdesign.addons.history.transient import solve_transient
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Method, Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import SolveError
from netdesign.snow.creep_law import ICE_DENSITY, PAPER_FLUIDITY
from netdesign.snow.mesh import MeshSize
from netdesign.snow.snowpack import GravityMode
from netdesign.units import second_from_day
from netdesign.words.message import Message, say

# The paper's: 20 m long, 4 m high, relative density 0.4. Slope and stiffness are not
# in it; these are assumed.
LENGTH, THICKNESS, RELATIVE_DENSITY = 20.0, 4.0, 0.4
ASSUMED_SLOPE_DEG, ASSUMED_STIFFNESS = 40.0, 2e7
PAPER_TIME = 8.0  # [s] that its computations covered
FRICTIONS_DEG = (15.0, 30.0, 45.0)
INCLINATIONS_DEG = (25.0, 30.0, 35.0)
NORMAL_NET_DEG, DESIGN_NET_DEG = 0.0, 30.0
NETS_DEG = (NORMAL_NET_DEG, DESIGN_NET_DEG)
MIDDLE_FRICTION_DEG = 30.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperCase:
    """One run; angles in degrees, as the paper gives them.

    ``until`` ends a run at a time of its own [s]; 0 takes that of the settings.
    """

    method: Method
    inclination_deg: float
    friction_deg: float
    gravity: GravityMode = "full"
    start: Start = "straight"
    until: float = 0.0

    @property
    def scene(self) -> Scene:
        """Scene of the run."""
        scene = build_scene(
            (THICKNESS, RELATIVE_DENSITY * ICE_DENSITY),
            slope=ASSUMED_SLOPE_DEG,
            length=LENGTH,
            lean=self.inclination_deg,
            friction=self.friction_deg,
            stiffness=ASSUMED_STIFFNESS,
            gravity=self.gravity,
        )
        return replace(scene, fluidity=PAPER_FLUIDITY)


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperSettings:
    """Settings of the runs; a thinned study takes less of each.

    Attributes
    ----------
    levels : tuple of MeshSize
        Meshes of the histories; their difference gives the stated error.
    horizon : float
        Of the histories [s].
    exchange_drag, exchange_time : float
        Base drag and creep time of the staggered runs [-].
    """

    levels: tuple[MeshSize, ...] = field(default=TRANSIENT_LEVELS[:2])
    horizon: float = second_from_day(30.0)
    exchange_drag: float = 0.05
    exchange_time: float = 0.36


def find_history(
    inclination_deg: float, friction_deg: float = MIDDLE_FRICTION_DEG
) -> PaperCase:
    """History from a straight net, densifying: the paper's own run."""
    return PaperCase(
        method="transient", inclination_deg=inclination_deg, friction_deg=friction_deg
    )


def find_exchange(
    inclination_deg: float, friction_deg: float = MIDDLE_FRICTION_DEG
) -> PaperCase:
    """Staggered run of the same scene, as the paper computed it."""
    return replace(find_history(inclination_deg, friction_deg), method="staggered")


def find_steady(case: PaperCase) -> PaperCase:
    """Steady state of a run's scene."""
    return PaperCase(
        method="steady",
        inclination_deg=case.inclination_deg,
        friction_deg=case.friction_deg,
        gravity=case.gravity,
    )


def find_paper_time() -> PaperCase:
    """History that ends where the paper's computations did."""
    return replace(find_history(NORMAL_NET_DEG), until=PAPER_TIME)


def list_cases() -> list[PaperCase]:
    """All runs of the study, the long ones first, each once."""
    histories = [find_history(net, phi) for net in NETS_DEG for phi in FRICTIONS_DEG]
    histories += [find_history(net) for net in INCLINATIONS_DEG]
    for net in NETS_DEG:
        middle = find_history(net)
        histories += [
            replace(middle, start="sagged"),
            replace(middle, gravity="parallel"),
        ]
    exchanges = [find_exchange(NORMAL_NET_DEG, phi) for phi in FRICTIONS_DEG]
    exchanges.append(find_exchange(DESIGN_NET_DEG))
    steady = [find_steady(case) for case in histories]
    return list(dict.fromkeys([*exchanges, *histories, find_paper_time(), *steady]))


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
    plateau : int or None
        Number of the moment at which a plateau begins.
    """

    times: Floats
    foot: Floats
    head: Floats
    lower: Floats
    upper: Floats
    heights: tuple[float, float]
    plateau: int | None

    def at(self, time: float, name: str) -> float:
        """Value of ``foot`` or ``head`` at a time [s], between moments."""
        return float(np.interp(time, self.times, getattr(self, name)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shape:
    """Snow and net at the end: nodes, curve (2, n) [m], triangles, density [kg/m3]."""

    nodes: Floats
    triangles: Ints
    density: Floats
    curve: Floats


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

    @property
    def plateau_time(self) -> float | None:
        """Begin of the plateau [s]; None without one."""
        if self.track is None or self.track.plateau is None:
            return None
        return float(self.track.times[self.track.plateau])


def run_case(case: PaperCase, settings: PaperSettings) -> PaperRun:
    """Run one case; a failure is a result with its reason."""
    try:
        if case.method == "steady":
            return _run_steady(case)
        if case.method == "staggered":
            return _run_exchange(case, settings)
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
            horizon=case.until or settings.horizon,
            levels=settings.levels,
        ),
    )
    if isinstance(solution, FailedSolution):
        return PaperRun(case=case, failure=solution.reason)
    if not isinstance(solution.history, History):
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


def _run_exchange(case: PaperCase, settings: PaperSettings) -> PaperRun:
    scene = case.scene
    run = run_exchange(
        scene,
        StaggeredSettings(
            base_drag=settings.exchange_drag,
            horizon=settings.exchange_time,
            size=settings.levels[0],
        ),
    )
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
        plateau=history.plateau.index,
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
        Meshes, horizons, drag.
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
    cases = list_cases()
    work = partial(run_case, settings=settings)
    runs = spread(work, cases, jobs=jobs, chunk=1, on_done=on_done)
    return PaperStudy(settings=settings, runs=dict(zip(cases, runs, strict=True)))
