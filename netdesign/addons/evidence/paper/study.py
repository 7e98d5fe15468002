"""Runs of the source paper's study: what each is, what it recorded; tables of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from netdesign.addons.evidence.measurements import (
    CHANGES,
    ERRORS,
    FORCES,
    INCLINATIONS,
    TIMES,
    Kind,
    spread,
    tabulate,
)
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
from netdesign.numerics.arrays import Floats
from netdesign.outcome import SolveError
from netdesign.report.blocks import Table, text_cell
from netdesign.report.words import ENGLISH
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
    return replace(case, method="steady", start="straight", until=0.0)


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
    track, solution : Track, Solution or None
        History; state at the end.
    """

    case: PaperCase
    failure: Message | None = None
    foot: float | None = None
    head: float | None = None
    foot_error: float = 0.0
    head_error: float = 0.0
    track: Track | None = None
    solution: Solution | None = None

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
        solution=solution,
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
    return replace(
        _record(case, solution.history, solution.net_curve[1, 1:]),
        foot_error=solution.foot.error,
        head_error=solution.head.error,
        solution=solution,
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
    return _record(case, history, heights)


def _record(case: PaperCase, history: History, heights: Floats) -> PaperRun:
    """Run with its track, and the pulls where its plateau begins."""
    track, begin = _track_of(history, heights), history.plateau.index
    if begin is None:
        return PaperRun(case=case, track=track)
    foot, head = float(track.foot[begin]), float(track.head[begin])
    return PaperRun(case=case, foot=foot, head=head, track=track)


def _track_of(history: History, heights: Floats) -> Track:
    moments = history.moments
    wanted = np.outer((LOWER_HEIGHT, UPPER_HEIGHT), heights.max())
    lower, upper = np.abs(heights - wanted).argmin(axis=1).tolist()
    foot, head = (
        np.hypot(*np.array([getattr(moment, end) for moment in moments]).T)
        for end in ("foot", "head")
    )
    return Track(
        times=np.array([moment.time for moment in moments]),
        foot=foot,
        head=head,
        lower=np.array([-moment.on_net[:, lower] for moment in moments]).T,
        upper=np.array([-moment.on_net[:, upper] for moment in moments]).T,
        heights=(float(heights[lower]), float(heights[upper])),
        plateau=history.plateau.index,
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
    """Run every case of the study; the same whatever the number of processes.

    Parameters
    ----------
    settings : PaperSettings, optional
        Meshes, horizons, drag.
    jobs : int
        Processes; 1 stays in this one.
    on_done : callable, optional
        Called with each run as it ends.
    """
    settings = settings or PaperSettings()
    cases = list_cases()
    work = partial(run_case, settings=settings)
    runs = spread(work, cases, jobs=jobs, chunk=1, on_done=on_done)
    return PaperStudy(settings=settings, runs=dict(zip(cases, runs, strict=True)))


Columns = tuple[tuple[str, Kind], ...]  # headings, or their keys, and kinds
_WORDS = Kind(
    show=lambda key: text_cell(ENGLISH(f"paper_value.{key}")), is_number=False
)
_NET = ("θ [°]", INCLINATIONS)


def list_tables(study: PaperStudy) -> dict[str, Table]:
    """Tables of the study by their anchors on the page."""
    return {
        "plateau": _tabulate_plateaus(study),
        "friction": _tabulate_growth(study),
        "inclination-and-gravity": _tabulate_parameters(study),
    }


def _tabulate_plateaus(study: PaperStudy) -> Table:
    columns: Columns = (
        _NET,
        ("paper_table.method", _WORDS),
        ("paper_table.foot", FORCES),
        ("± ", ERRORS),
        ("paper_table.head", FORCES),
        ("± ", ERRORS),
        ("paper_table.foot_against_steady", CHANGES),
        ("paper_table.largest_foot", FORCES),
        ("paper_table.plateau_from", TIMES),
    )
    rows = []
    for net in NETS_DEG:
        straight = find_history(net)
        ways = {
            "steady": find_steady(straight),
            "sagged": replace(straight, start="sagged"),
            "straight": straight,
            "staggered": find_exchange(net),
        }
        steady = study[find_steady(straight)].foot
        for way, case in ways.items():
            run = study[case]
            has_error = case.method != "staggered" and not run.failure
            rows.append(
                (
                    *(net, f"way_{way}"),
                    *(run.foot, run.foot_error if has_error else None),
                    *(run.head, run.head_error if has_error else None),
                    _change(run.foot, steady),
                    None if run.track is None else float(run.track.foot.max()),
                    run.plateau_time,
                )
            )
    return tabulate(ENGLISH("paper_table.plateau"), columns, rows)


def _tabulate_growth(study: PaperStudy) -> Table:
    columns: Columns = (
        ("paper_table.method", _WORDS),
        _NET,
        ("paper_table.force", _WORDS),
        *((f"{phi:.0f}°", FORCES) for phi in FRICTIONS_DEG),
        ("paper_table.change", CHANGES),
    )
    rows: list[tuple[object, ...]] = []
    for net in NETS_DEG:
        histories = [find_history(net, phi) for phi in FRICTIONS_DEG]
        rows += _grow_histories("transient", net, [study[case] for case in histories])
        steady = [study[find_steady(case)] for case in histories]
        for end in ("foot", "head"):
            values = [getattr(run, end) for run in steady]
            rows.append(("steady", net, end, *values, _change(values[-1], values[0])))
    exchanges = [study[find_exchange(NORMAL_NET_DEG, phi)] for phi in FRICTIONS_DEG]
    rows += _grow_histories("staggered", NORMAL_NET_DEG, exchanges)
    return tabulate(ENGLISH("paper_table.friction"), columns, rows)


def _grow_histories(
    method: str, inclination: float, runs: Sequence[PaperRun]
) -> Iterator[tuple[object, ...]]:
    """At one time for all: when the last of them has come to its plateau, or ended.

    The change of a component of a node's force is told over that whole force.
    """
    tracks = [run.track for run in runs if run.track is not None]
    if len(tracks) < len(runs):
        return
    ends = [float(track.times[-1]) for track in tracks]
    begins = [run.plateau_time or end for run, end in zip(runs, ends, strict=True)]
    time = min(max(begins), min(ends))
    for end in ("foot", "head"):
        values = [track.at(time, end) for track in tracks]
        yield (method, inclination, end, *values, values[-1] / values[0] - 1.0)
    for node in ("lower", "upper"):
        forces = [
            [float(np.interp(time, track.times, part)) for part in getattr(track, node)]
            for track in tracks
        ]
        whole = math.hypot(*forces[0])
        for axis, name in enumerate("xy"):
            values = [abs(force[axis]) for force in forces]
            change = (values[-1] - values[0]) / whole
            yield (method, inclination, f"{node}_{name}", *values, change)


def _tabulate_parameters(study: PaperStudy) -> Table:
    columns: Columns = (
        _NET,
        ("paper_table.gravity", _WORDS),
        ("paper_table.history_foot", FORCES),
        ("paper_table.history_head", FORCES),
        ("paper_table.steady_foot", FORCES),
        ("paper_table.steady_head", FORCES),
    )
    cases = [find_history(net) for net in (NORMAL_NET_DEG, *INCLINATIONS_DEG)]
    cases += [replace(find_history(net), gravity="parallel") for net in NETS_DEG]
    rows = []
    for case in cases:
        history, steady = study[case], study[find_steady(case)]
        ends = (history.foot, history.head, steady.foot, steady.head)
        rows.append((case.inclination_deg, case.gravity, *ends))
    return tabulate(ENGLISH("paper_table.parameters"), columns, rows)


def _change(value: float | None, reference: float | None) -> float | None:
    """Share by which a value differs from a reference; None without one of them."""
    if value is None or reference is None:
        return None
    return value / reference - 1.0
