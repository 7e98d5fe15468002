"""The history: snow that creeps against the net until neither moves the other.

Steps are implicit in the net's stiffness and as long as accuracy allows; the snow
keeps its mass and may densify. Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from netdesign.addons.history.body import move_body
from netdesign.addons.history.instant import Instant, advance
from netdesign.addons.history.moments import find_plateau, judge_plateau
from netdesign.addons.history.net_pulls import measure_arcs
from netdesign.addons.history.run import (
    Run,
    build_solution,
    measure_run,
)
from netdesign.addons.history.settings import (
    MOST_ITERATIONS,
    STRESS_TOLERANCE,
    TransientSettings,
)
from netdesign.addons.history.state import (
    HEAD_GAP,
    Top,
    TransientProblem,
    TransientState,
    build_problem,
    build_start,
)
from netdesign.coupling.interface import ErrorModel, refine
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import (
    FailedSolution,
    Solution,
    end_solve,
)
from netdesign.numerics.arrays import Floats
from netdesign.numerics.curve import interpolate_curve
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.mesh import MeshSize
from netdesign.words.message import say

# First step, in creep time. A straight net takes up its load from the corners inward,
# within a time that goes with the square of their size; one that sags has most of its
# load from the start.
_FIRST_STRAIGHT, _FIRST_SAGGED = 1e-4, 1e-5
_SHORTEST_STEP, _SHORTEST_SHARE = 1e-12, 1e-4  # of creep time; of the time so far
_LONGEST_GROWTH, _SHORTEST_GROWTH = 2.0, 0.25
_SAFETY = 0.9
_FAILED_CUT = 0.25
# Error of a step, as the tension feels it, over the accuracy (measured: 3 gives about
# the accuracy on the way to the plateau, and a fifth of it there).
_STEP_SHARE = 3.0
# Step error of the coarsest mesh over that of the next, and so on: errors in time fall
# as those in space, so that the difference of two meshes shows both.
_LEVEL_RATIO = 4.0
_TOO_LARGE = 2.0  # a step whose error is that many times what is allowed is repeated
# Local error of a BDF2 step over its distance from the extrapolation.
_ERROR_SHARE = 0.25
# Of the largest pulls of a history (coupling/THEORY.md, section 6).
_ERROR = ErrorModel(share=2.0, floor=5e-3)
# Balance of a whole history, over what is asked of a step.
_WHOLE_BALANCE = 100.0
_LARGEST_GAIN = 0.01  # of mass, by a surface that the mesh cannot follow


def solve_transient(
    scene: Scene,
    settings: TransientSettings | None = None,
) -> Solution | FailedSolution:
    """History of a scene on two meshes or more.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : TransientSettings, optional
        Start, horizon, accuracy.

    Returns
    -------
    Solution or FailedSolution
        ``foot`` and ``head`` are the largest pulls while the snow is the scene's
        (``select_counted``), whatever the horizon; the plateau's own are in
        ``history``. A history whose plateau is not reached, or is left again, says so
        and proves nothing.

    Verified by
    -----------
    tests/addons/history/test_transient.py, ``netdesign verify``
    """
    return end_solve(lambda: _refine(scene, settings or TransientSettings()))


def run_history(
    scene: Scene,
    size: MeshSize,
    settings: TransientSettings,
    horizon: float,
    *,
    step_share: float = 1.0,
    on_state: Callable[[TransientState], None] | None = None,
) -> Run:
    """One history on one mesh.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    size : MeshSize
        Resolution.
    settings : TransientSettings
        Start, tolerances.
    horizon : float
        Creep time, dimensionless.
    step_share : float
        Error allowed in a step over that of the settings [-].
    on_state : callable, optional
        Called with the state after every step.

    Raises
    ------
    SolveError
        If not even the first step succeeds.
    """
    problem = build_problem(scene, densifies=settings.densifies)
    first = _FIRST_SAGGED
    if settings.start == "straight":
        first = _FIRST_STRAIGHT * size.corner**2
    start = build_start(scene, problem, size, settings.start)
    walk = _Walk(
        run=Run(problem=problem, start=settings.start, state=start),
        settings=settings,
        step=first,
        step_share=step_share,
        horizon=horizon,
    )
    if on_state is not None:
        on_state(start)
    while not walk.is_over:
        if walk.take_step() and on_state is not None:
            on_state(walk.run.state)
    return walk.finish()


@dataclass(slots=True, kw_only=True, eq=False)
class _Walk:
    """A run under way: the one place with a state that changes."""

    run: Run
    settings: TransientSettings
    step: float
    step_share: float
    horizon: float
    rejected: int = 0
    failure: SolveError | None = None

    @property
    def is_over(self) -> bool:
        """Nothing more to do."""
        is_done = self.run.state.time >= self.horizon * (1 - 1e-12)
        if self.failure is not None or is_done:
            return True
        return self.settings.stops_at_plateau and self.run.plateau.reached

    def take_step(self) -> bool:
        """Try one step; True if it was accepted."""
        if len(self.run.moments) >= self.settings.max_steps:
            self.failure = SolveError(
                Outcome.MAX_ITERATIONS, f"{len(self.run.moments)} steps were not enough"
            )
            return False
        step = min(self.step, self.horizon - self.run.state.time)
        try:
            instant = self._advance(step)
            error = self._estimate_error(instant, step)
            if error > _TOO_LARGE:
                self.rejected += 1
                self.step = step * _grow(error)
                return False
            state, fallen = follow(self.run.problem, self.run.state, instant, step)
        except SolveError as failure:
            self.rejected += 1
            self.step = step * _FAILED_CUT
            shortest = max(_SHORTEST_STEP, _SHORTEST_SHARE * self.run.state.time)
            if self.step < shortest:
                self.failure = failure
            return False
        run = self.run.follow(instant, state, fallen, step)
        if run.fallen_mass < -_LARGEST_GAIN * float(state.body.mass.sum()):
            self.failure = SolveError(
                Outcome.BALANCE_VIOLATED, "the snow's mass is not kept on this mesh"
            )
        if not run.plateau.reached:
            run = replace(run, plateau=find_plateau(run.moments))
        self.run, self.step = run, step * _grow(error)
        return True

    def finish(self) -> Run:
        """The run; one that failed ends where its last step was in balance."""
        if self.run.instant is None:
            failure = self.failure or SolveError(Outcome.MAX_ITERATIONS)
            raise SolveError(
                failure.outcome, say("history.first_step", reason=failure.reason)
            )
        return replace(
            self.run,
            plateau=judge_plateau(self.run.moments, self.run.plateau),
            ended=None if self.failure is None else self.failure.reason,
            rejected=self.rejected,
        )

    def _advance(self, step: float) -> Instant:
        return advance(
            self.run.problem,
            self.run.state,
            step,
            tolerance=STRESS_TOLERANCE,
            balance_tolerance=self.settings.balance_tolerance,
            max_iterations=MOST_ITERATIONS,
        )

    def _estimate_error(self, instant: Instant, step: float) -> float:
        """Error of the step's displacements over what is allowed."""
        state = self.run.state
        if state.step == 0.0:
            return 0.0
        count = state.moved.shape[1]
        last = state.velocity[:, :count]
        trend = (last - state.moved / state.step) / state.step
        expected = step * last + step**2 * trend
        off = instant.displaced - state.body.vertices - expected
        distance = float(np.hypot(*off)[state.body.topology.net].max())
        share = _STEP_SHARE * self.step_share
        allowed = share * self.settings.accuracy * self._sensitive_way(instant)
        return _ERROR_SHARE * distance / allowed

    def _sensitive_way(self, instant: Instant) -> float:
        """Way of the net's middle that changes its tension by its own size, (K8)."""
        problem = self.run.problem
        head = problem.head
        chord = float(np.hypot(*head))
        x, y = instant.points
        sag = float((head[1] * x - head[0] * y).max()) / chord
        strain = float(measure_arcs(instant.points).sum()) / problem.length - 1.0
        least = (8.0 / 3.0) * (sag / chord) ** 2 * 1e-2
        return 3.0 / 16.0 * max(strain, least) * chord**2 / max(sag, 1e-9)


def _grow(error: float) -> float:
    """Factor to the next step of a second-order method."""
    wanted: float = _SAFETY * max(error, 1e-6) ** (-1.0 / 3.0)
    return min(_LONGEST_GROWTH, max(_SHORTEST_GROWTH, wanted))


def _list_pulls(run: Run, time: float) -> list[Floats]:
    """Largest pulls, and those at one time."""
    times = np.log([moment.time for moment in run.moments])
    ends = [[getattr(m, end) for m in run.moments] for end in ("foot", "head")]
    at_time = [
        np.array([np.interp(np.log(time), times, axis) for axis in np.array(end).T])
        for end in ends
    ]
    return [*measure_run(run), *at_time]


def _refine(scene: Scene, settings: TransientSettings) -> Solution:
    horizon = settings.horizon / scene.time_scale

    rests: list[float] = []

    def run(size: MeshSize, _: Run | None) -> Run:
        share = _LEVEL_RATIO ** (1 - settings.levels.index(size))
        history = run_history(scene, size, settings, horizon, step_share=share)
        begin = history.plateau.index
        rests.append(history.moments[-1 if begin is None else begin].time)
        return history

    runs, estimates = refine(
        settings.levels,
        run,
        lambda run: _list_pulls(run, rests[0]),
        settings.accuracy,
        _ERROR,
    )
    # the largest pulls come first
    tolerance = _WHOLE_BALANCE * settings.balance_tolerance
    return build_solution(scene, runs, estimates[:2], "transient", tolerance)


class _Net(NamedTuple):
    """Net vertices (2, n) from the foot on, lengths of all segments."""

    vertices: Floats
    lengths: Floats
    top: Top


def follow(
    problem: TransientProblem, state: TransientState, instant: Instant, step: float
) -> tuple[TransientState, float]:
    """State at the end of a step.

    Parameters
    ----------
    problem : TransientProblem
        What stays the same.
    state : TransientState
        At the step's start.
    instant : Instant
        Equilibrium at its end.
    step : float
        Duration [time scale].

    Returns
    -------
    TransientState, float
        And the mass of snow that fell over the head [mean density times d^2].

    Raises
    ------
    SolveError
        If the net touches the ground or the mesh cannot follow the snow.
    """
    net = _spread_nodes(problem, state, _move_top(problem, state, instant))
    if not net.vertices[1, 1:].min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("net.touches_ground"))
    # the upper corner may have become a node of the net, or none any more
    signs = np.append(instant.response.slide_signs, np.zeros(1, dtype=np.int8))
    body, fallen = move_body(state.body, instant.displaced, net.vertices, problem.head)
    signs = signs[: net.lengths.size - 1]
    following = instant.end_state(state, body, step)
    return replace(
        following, lengths=net.lengths, top=net.top, slide_signs=signs
    ), fallen


def _move_top(
    problem: TransientProblem, state: TransientState, instant: Instant
) -> _Net:
    """Decide what the snow's upper corner does in the next step."""
    vertices = instant.displaced[:, state.body.topology.net].copy()
    lengths = instant.response.lengths
    head, chord = problem.head, float(np.hypot(*problem.head))
    last = head - vertices[:, -2]
    distance = float(np.hypot(*last))
    if instant.top == "on-net":
        below = float((head - vertices[:, -1]) @ last) / distance
        if below > HEAD_GAP * chord / 4.0:
            return _Net(vertices, lengths, "on-net")
        vertices[:, -1] = head
        return _Net(vertices, np.append(lengths[:-2], lengths[-2:].sum()), "held")
    vertices[:, -1] = head
    upward = last / distance
    if instant.top == "slipping":
        return _Net(vertices, lengths, "slipping")
    normal = np.array([upward[1], -upward[0]])
    shear = float(instant.on_net[:, -1] @ upward)
    limit = problem.snow.friction * max(float(instant.on_net[:, -1] @ normal), 0.0)
    if shear >= -limit:
        return _Net(vertices, lengths, "held")
    if not instant.response.tensions[-1] > 0.0:
        return _Net(vertices, lengths, "held")
    share = HEAD_GAP * chord / distance
    vertices[:, -1] = head - last * share
    parts = lengths[-1] * np.array([1.0 - share, share])
    return _Net(vertices, np.append(lengths[:-1], parts), "on-net")


def _spread_nodes(problem: TransientProblem, state: TransientState, net: _Net) -> _Net:
    """Vertices spaced along the net as in the template; each keeps what net it has."""
    points = net.vertices
    if net.top == "on-net":
        points = np.column_stack([points, problem.head])
    places = np.append(0.0, np.cumsum(measure_arcs(points)))
    in_snow = places[: net.vertices.shape[1]]
    wanted = state.body.topology.template.net_fractions[::2] * in_snow[-1]
    vertices = interpolate_curve(in_snow, net.vertices, wanted)
    vertices[:, 0], vertices[:, -1] = net.vertices[:, 0], net.vertices[:, -1]
    material = np.append(0.0, np.cumsum(net.lengths))
    shifted = np.interp(wanted, places, material)
    shifted[-1] = material[wanted.size - 1]
    lengths = np.append(np.diff(shifted), net.lengths[wanted.size - 1 :])
    return _Net(vertices, lengths, net.top)
