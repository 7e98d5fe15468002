"""The source paper's exchange: snow under the last net forces, then the net.

Explicit, so its oscillations come from the scheme and its steps must be short; on a
ground where snow glides freely only a base drag makes a step well posed. Kept as the
record of the paper's method and to compare with. Theory: coupling/THEORY.md,
section 7.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from netdesign.addons.history.body import move_body
from netdesign.addons.history.incremental import (
    CableState,
    advance_increment,
    build_cable_state,
)
from netdesign.addons.history.instant import Instant, advance_under
from netdesign.addons.history.moments import HistoryPoint, find_plateau, judge_plateau
from netdesign.addons.history.net_pulls import (
    NetResponse,
    join_points,
    measure_arcs,
    pull_nodes,
)
from netdesign.addons.history.run import (
    Run,
    build_solution,
    measure_run,
    record_moment,
)
from netdesign.addons.history.settings import (
    EXCHANGE_TOLERANCE,
    MOST_EXCHANGE_ITERATIONS,
    StaggeredSettings,
)
from netdesign.addons.history.state import (
    TransientProblem,
    TransientState,
    build_problem,
    build_start,
    find_start,
)
from netdesign.cable.net import compute_turning_angles
from netdesign.coupling.interface import ErrorModel, Estimate
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import (
    FailedSolution,
    OnFailure,
    Solution,
    end_solve,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, Outcome, SolveError
from netdesign.snow.mesh import build_template
from netdesign.words.message import say

# Of the step: whole and halved.
_ERROR = ErrorModel(share=1.0, floor=0.0)
# Share of the time in which net and drag come to rest that a step may take.
_STABLE_SHARE = 0.3
# Force missing from the balance, over the weight. Shear beyond the friction limit, over
# the weight: increments keep the limit only as steps vanish.
_BALANCE_TOLERANCE, _FRICTION_TOLERANCE = 1e-8, 1e-2


def solve_staggered(
    scene: Scene,
    settings: StaggeredSettings | None = None,
    *,
    on_failure: OnFailure = "return",
) -> Solution | FailedSolution:
    """The paper's exchange, with a step and with half of it.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : StaggeredSettings, optional
        Drag, step, start.
    on_failure : str
        ``return`` a FailedSolution, or ``raise`` a SolveError.

    Returns
    -------
    Solution or FailedSolution
        ``error`` is that of the step and, on free ground, of the drag (K9); not that
        of the mesh.

    Raises
    ------
    SolveError
        For what else is a FailedSolution, if ``on_failure`` is ``raise``.

    Verified by
    -----------
    tests/addons/history/test_staggered.py, ``netdesign verify``
    """
    return end_solve(lambda: _solve(scene, settings or StaggeredSettings()), on_failure)


def _solve(scene: Scene, settings: StaggeredSettings) -> Solution:
    """Solution, or its failure with what to try."""
    try:
        return _halve(scene, settings)
    except SolveError as failure:
        advice = say("staggered.advice", reason=failure.reason)
        raise SolveError(failure.outcome, advice) from None


def _halve(scene: Scene, settings: StaggeredSettings) -> Solution:
    half = replace(settings, step_share=settings.step_share / 2.0)
    runs = [run_exchange(scene, settings), run_exchange(scene, half)]
    pulls = _ERROR.estimate([measure_run(run) for run in runs])
    if scene.ground.kind == "free":
        pulls = [add_drag(pull, *measure_drag(runs[-1])) for pull in pulls]
    tolerances = _BALANCE_TOLERANCE, _FRICTION_TOLERANCE
    return build_solution(scene, runs, pulls, "staggered", *tolerances)


def run_exchange(scene: Scene, settings: StaggeredSettings) -> Run:
    """One history by the paper's exchange, dimensionless.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : StaggeredSettings
        Drag, step, start.

    Raises
    ------
    SolveError
        If a step fails: the net would have to push, or the mesh folds.
    """
    if scene.ground.kind == "no-slip":
        raise ModelError(say("staggered.base_drag"))
    problem = build_problem(scene, densifies=True, base_drag=settings.base_drag)
    aspect = scene.snowpack.aspect
    template = build_template(aspect, settings.size, scene.layer_tops)
    start = find_start(scene, settings.size, settings.start)
    state = build_start(problem, template, start)
    arcs = measure_arcs(join_points(state.net_nodes, problem.head))
    lengths = np.minimum(state.lengths, arcs)
    cable = build_cable_state(arcs, lengths, problem.stiffness)
    step = settings.step_share * _longest_step(problem, aspect)
    moments: list[HistoryPoint] = []
    way: Floats | float = 0.0
    solves, mass = 0, float(state.body.mass.sum())
    while state.time < settings.horizon:
        instant = advance_under(
            problem,
            state,
            step,
            _respond(problem, state, cable),
            tolerance=EXCHANGE_TOLERANCE,
            max_iterations=MOST_EXCHANGE_ITERATIONS,
        )
        state, cable = _follow(problem, state, cable, instant, step)
        moment, way = record_moment(problem, state, instant, way, moments, step)
        moments.append(moment)
        solves += instant.linear_solves
    return Run(
        problem=problem,
        moments=tuple(moments),
        plateau=judge_plateau(moments, find_plateau(moments)),
        state=state,
        instant=instant,
        fallen=1.0 - float(state.body.mass.sum()) / mass,
        ended=None,
        linear_solves=solves,
        rejected=0,
        start=settings.start,
    )


def measure_drag(run: Run) -> tuple[float, float]:
    """Pull of the drag on a free ground, and what the net's ends hold beside it, (K9).

    Parameters
    ----------
    run : Run
        By the exchange.

    Returns
    -------
    float, float
        Along the slope, where the drag is largest [rho g d^2].
    """
    kept = float(run.state.body.mass.sum())
    weight = kept / (1.0 - run.fallen) * float(run.problem.snow.gravity[0])
    held = min(float((moment.foot + moment.head)[0]) for moment in run.counted)
    return max(0.0, weight - held), held


def add_drag(pull: Estimate, drag: float, held: float) -> Estimate:
    """Pull of an end with the drag's share in its error, (K9).

    Parameters
    ----------
    pull : Estimate
        With the error of the step [rho g d^2].
    drag, held : float
        ``measure_drag`` [rho g d^2].

    Raises
    ------
    SolveError
        If the drag holds the snow alone.
    """
    if held <= 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("staggered.drag_holds_all"))
    share = max(1.0, math.hypot(*pull.vector) / held)
    return pull._replace(error=pull.error + share * drag)


def _longest_step(problem: TransientProblem, aspect: float) -> float:
    """Time in which drag lets the net come to rest, as one spring and one dashpot."""
    chord = float(np.hypot(*problem.head))
    return _STABLE_SHARE * problem.base_drag * aspect * chord / problem.stiffness


def _respond(
    problem: TransientProblem, state: TransientState, cable: CableState
) -> NetResponse:
    """The net as it is, its forces taken as they are."""
    points = join_points(state.net_nodes, problem.head)
    return pull_nodes(points, cable.unstressed_lengths, cable.tensions)


def _follow(
    problem: TransientProblem,
    state: TransientState,
    cable: CableState,
    instant: Instant,
    step: float,
) -> tuple[TransientState, CableState]:
    net = instant.displaced[:, state.body.topology.net].copy()
    if state.top != "on-net":
        net[:, -1] = problem.head
    body, _ = move_body(state.body, instant.displaced, net, problem.head)
    moved = replace(
        state,
        time=state.time + step,
        body=body,
        velocity=instant.velocity,
        moved=instant.displaced - state.body.vertices,
        step=step,
        stress=instant.stress,
        base_shear=instant.base_shear,
    )
    points = join_points(moved.net_nodes, problem.head)
    cable = advance_increment(
        cable,
        measure_arcs(points),
        compute_turning_angles(points),
        friction=problem.snow.friction,
        stiffness=problem.stiffness,
    )
    return moved, cable
