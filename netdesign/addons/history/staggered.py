"""The source paper's exchange: snow under the last net forces, then the net.

Explicit, so its oscillations come from the scheme and its steps must be short; on a
ground where snow glides freely only a base drag makes a step well posed. Its cable is
the paper's own: linearised increments of tension; ``yielding`` has the exact form. The
paper leaves open how to find the nodes that slide. Here every node that breaks its
condition changes over; where that no longer helps, wrong sliders stop first, then the
worst offender starts. Kept as the record of the paper's method and to compare with.
Theory: coupling/THEORY.md, section 7; cable/THEORY.md, eqs (C18) to (C20).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from netdesign.addons.history.body import move_body
from netdesign.addons.history.instant import Instant, advance_under
from netdesign.addons.history.moments import find_plateau, judge_plateau
from netdesign.addons.history.net_pulls import (
    compute_tensions,
    join_points,
    measure_arcs,
    pull_nodes,
)
from netdesign.addons.history.run import (
    Run,
    build_solution,
    measure_run,
)
from netdesign.addons.history.settings import (
    EXCHANGE_TOLERANCE,
    MOST_EXCHANGE_ITERATIONS,
    StaggeredSettings,
)
from netdesign.addons.history.state import (
    TransientProblem,
    build_problem,
    build_start,
)
from netdesign.cable.net import compute_turning_angles
from netdesign.coupling.interface import ErrorModel, Estimate
from netdesign.coupling.scene import Scene
from netdesign.coupling.solution import (
    FailedSolution,
    Solution,
    end_solve,
)
from netdesign.numerics.arrays import Floats, Signs
from netdesign.outcome import ModelError, Outcome, SolveError
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
) -> Solution | FailedSolution:
    """The paper's exchange, with a step and with half of it.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : StaggeredSettings, optional
        Drag, step, start.

    Returns
    -------
    Solution or FailedSolution
        ``error`` is that of the step and, on free ground, of the drag (K9); not that
        of the mesh.

    Verified by
    -----------
    tests/addons/history/test_staggered.py, ``netdesign verify``
    """
    return end_solve(lambda: _halve(scene, settings or StaggeredSettings()))


def _halve(scene: Scene, settings: StaggeredSettings) -> Solution:
    """Solution by two steps, or its failure with what to try."""
    half = replace(settings, step_share=settings.step_share / 2.0)
    try:
        runs = [run_exchange(scene, settings), run_exchange(scene, half)]
        pulls = _ERROR.estimate([measure_run(run) for run in runs])
        if scene.ground.kind == "free":
            pulls = [add_drag(pull, *measure_drag(runs[-1])) for pull in pulls]
        tolerances = _BALANCE_TOLERANCE, _FRICTION_TOLERANCE
        return build_solution(scene, runs, pulls, "staggered", *tolerances)
    except SolveError as failure:
        advice = say("staggered.advice", reason=failure.reason)
        raise SolveError(failure.outcome, advice) from None


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
    start = build_start(scene, problem, settings.size, settings.start)
    run = Run(problem=problem, start=settings.start, state=start)
    arcs = measure_arcs(join_points(start.net_nodes, problem.head))
    lengths = np.minimum(start.lengths, arcs)
    cable = build_cable_state(arcs, lengths, problem.stiffness)
    step = settings.step_share * _longest_step(problem, scene.snowpack.aspect)
    while run.state.time < settings.horizon:
        points = join_points(run.state.net_nodes, problem.head)
        net = pull_nodes(points, cable.unstressed_lengths, cable.tensions)
        instant = advance_under(
            problem,
            run.state,
            step,
            net,
            tolerance=EXCHANGE_TOLERANCE,
            max_iterations=MOST_EXCHANGE_ITERATIONS,
        )
        run, cable = _follow(run, cable, instant, step)
    plateau = judge_plateau(run.moments, find_plateau(run.moments))
    return replace(run, plateau=plateau)


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


def _follow(
    run: Run, cable: CableState, instant: Instant, step: float
) -> tuple[Run, CableState]:
    problem, state = run.problem, run.state
    net = instant.displaced[:, state.body.topology.net].copy()
    if state.top != "on-net":
        net[:, -1] = problem.head
    body, fallen = move_body(state.body, instant.displaced, net, problem.head)
    moved = instant.end_state(state, body, step)
    points = join_points(moved.net_nodes, problem.head)
    cable = advance_increment(
        cable,
        measure_arcs(points),
        compute_turning_angles(points),
        friction=problem.snow.friction,
        stiffness=problem.stiffness,
    )
    return run.follow(instant, moved, fallen, step), cable


Nodes = NDArray[np.intp]

_PATIENCE = 3  # rounds without fewer broken conditions before fewer nodes change
_ROUNDING = 1e-12  # breach of a condition, over its terms, that counts as none


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CableState:
    """The cable at one time.

    Attributes
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i [m].
    tensions : ndarray, shape (n + 1,)
        T_i, the sum of the increments so far [N/m].
    """

    final_lengths: Floats
    unstressed_lengths: Floats
    tensions: Floats


def build_cable_state(
    final_lengths: Floats, unstressed_lengths: Floats, stiffness: float
) -> CableState:
    """State whose tensions are those of (C10): where a run of increments begins.

    Parameters
    ----------
    final_lengths, unstressed_lengths : ndarray, shape (n + 1,)
        l_i and lo_i [m].
    stiffness : float
        ES [N/m].

    Returns
    -------
    CableState
        With tensions in N/m.
    """
    return CableState(
        final_lengths=final_lengths,
        unstressed_lengths=unstressed_lengths,
        tensions=compute_tensions(final_lengths, unstressed_lengths, stiffness),
    )


def advance_increment(
    state: CableState,
    final_lengths: Floats,
    turning_angles: Floats,
    *,
    friction: float,
    stiffness: float,
    max_rounds: int = 1000,
) -> CableState:
    """One increment of the paper's cable, its Eqs 5 to 14.

    Parameters
    ----------
    state : CableState
        At time t.
    final_lengths : ndarray, shape (n + 1,)
        l_i at t + tau [m].
    turning_angles : ndarray, shape (n,)
        beta_i at t + tau, positive where the net presses [rad].
    friction : float
        Tan phi [-].
    stiffness : float
        ES [N/m].
    max_rounds : int
        Sets of sliding nodes that may be tried. A sliding stretch grows by about one
        node a round.

    Returns
    -------
    CableState
        At t + tau; exact sliding to first order in the increment.

    Raises
    ------
    SolveError
        If the sliding nodes are not found, or a segment would push: the increments have
        no rule for a slack net.

    Source
    ------
    The paper's section "The cable"; |R_t| for R_t in its Eqs 12 and 13.
    """
    increment = _linearise(state, final_lengths, turning_angles, friction, stiffness)
    signs = np.zeros(turning_angles.size, dtype=np.int8)
    fewest, patience = signs.size + 1, _PATIENCE
    for _ in range(max_rounds):
        tensions = _solve_tensions(increment, signs)
        revised = _revise_signs(increment, tensions, signs)
        changing: Nodes = np.flatnonzero(revised != signs)
        if changing.size == 0:
            return _end(increment, tensions)
        helps = changing.size < fewest
        patience = _PATIENCE if helps else patience - 1
        fewest = min(fewest, changing.size)
        if patience <= 0:
            changing = _choose_worst(_excess(increment, tensions), signs, changing)
        signs = signs.copy()
        signs[changing] = revised[changing]
    raise SolveError(Outcome.MAX_ITERATIONS, say("staggered.no_increment"))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Increment:
    """Coefficients of the linear equations of one increment."""

    final: Floats  # l_i at t + tau
    unstressed: Floats  # lo_i at t
    stuck: Floats  # tensions if nothing slides
    softening: Floats  # loss of tension per increase of lo
    across: Floats  # cos(beta / 2): R_t per difference of tensions
    grip: Floats  # tan(phi) sin(beta / 2): friction per sum of tensions


def _linearise(
    state: CableState,
    final: Floats,
    angles: Floats,
    friction: float,
    stiffness: float,
) -> _Increment:
    """Coefficients of (C18) and (C19)."""
    unstressed = state.unstressed_lengths
    lengthening = final - state.final_lengths
    return _Increment(
        final=final,
        unstressed=unstressed,
        stuck=state.tensions + stiffness / unstressed * lengthening,
        softening=stiffness * final / unstressed**2,
        across=np.cos(angles / 2.0),
        grip=friction * np.sin(np.maximum(angles, 0.0) / 2.0),
    )


def _solve_tensions(increment: _Increment, signs: Signs) -> Floats:
    """Tensions at t + tau, block by block between nodes that do not slide.

    In a block (C19) gives every tension as a multiple of the first, and (C20) that.
    """
    tensions = np.empty_like(increment.stuck)
    edges = np.flatnonzero(signs == 0) + 1
    grip = signs * increment.grip
    # of nodes that slide, (C19); 1 at the others, which do not ask
    ratios = (increment.across - grip) / (increment.across + grip)
    for block in np.split(np.arange(tensions.size), edges):
        multiples = np.cumprod(np.concatenate([[1.0], ratios[block[:-1]]]))
        softening = increment.softening[block]
        first = (increment.stuck[block] / softening).sum()
        tensions[block] = multiples * first / (multiples / softening).sum()
    return tensions


def _revise_signs(increment: _Increment, tensions: Floats, signs: Signs) -> Signs:
    """Signs of the nodes under these tensions; ``signs`` where nothing changes."""
    lower, upper = tensions[:-1], tensions[1:]
    margin = _ROUNDING * increment.across * (np.abs(upper) + np.abs(lower))
    starts = (signs == 0) & (_excess(increment, tensions) > margin)
    slides = np.cumsum(_lengthening(increment, tensions))[:-1]
    stops = signs * slides < -_ROUNDING * increment.unstressed.sum()
    towards = np.where(upper < lower, 1, -1)
    return np.where(starts, towards, np.where(stops, 0, signs)).astype(np.int8)


def _choose_worst(excess: Floats, signs: Signs, broken: Nodes) -> Nodes:
    """All wrong sliders among the nodes that break a condition, else the worst node."""
    stopping: Nodes = broken[signs[broken] != 0]
    return stopping if stopping.size else broken[[np.argmax(excess[broken])]]


def _excess(increment: _Increment, tensions: Floats) -> Floats:
    """|R_t| - R_n tan(phi) at the nodes, shape (n,)."""
    lower, upper = tensions[:-1], tensions[1:]
    pull = increment.across * np.abs(upper - lower)
    return pull - increment.grip * (upper + lower)


def _lengthening(increment: _Increment, tensions: Floats) -> Floats:
    """Increments of lo that belong to these tensions, (C18), shape (n + 1,)."""
    return (increment.stuck - tensions) / increment.softening


def _end(increment: _Increment, tensions: Floats) -> CableState:
    unstressed = increment.unstressed + _lengthening(increment, tensions)
    if not (tensions.min() >= 0.0 and unstressed.min() > 0.0):
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("staggered.no_increment"))
    return CableState(
        final_lengths=increment.final,
        unstressed_lengths=unstressed,
        tensions=tensions,
    )
