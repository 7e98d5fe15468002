"""Rounds of flow and net on one mesh, until neither moves the other.

Snow flows against a given curve, the net hangs under the forces found; the next curve
is accelerated. Theory: coupling/THEORY.md. Dimensionless: lengths in snow thicknesses
d, forces per metre of width in rho g d^2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np

from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.compiled import prepare_rounds
from netdesign.coupling.steady.net import (
    Hang,
    NetEquilibrium,
    SteadyProblem,
    find_contact_curve,
    locate_nodes,
    start_net,
)
from netdesign.coupling.steady.round import (
    Correction,
    RoundResult,
    Take,
    carry_tangent,
    correct_round,
    explain_failure,
    take_near,
    take_round,
)
from netdesign.numerics.arrays import Floats
from netdesign.numerics.curve import interpolate_curve
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.contact import FlowState
from netdesign.snow.flow import transfer_state
from netdesign.snow.mesh import MeshTemplate
from netdesign.words.message import say


def mix_anderson(
    points: Sequence[Floats],
    images: Sequence[Floats],
    *,
    depth: int = 20,
    damping: float = 0.5,
) -> Floats:
    """Next iterate of a fixed-point iteration from its history.

    The combination of past iterates whose residual, image - point, is least, moved
    on by a share of what is left of that residual. The first step goes all the way.

    Parameters
    ----------
    points, images : sequence of ndarray, all of one shape
        Iterates and what the map made of them, oldest first; at least one.
    depth : int
        How many of the last entries are used.
    damping : float
        Share of the remaining residual that is added, 0 to 1 [-]. One half converges
        also where the map alone would circle round its fixed point.

    Returns
    -------
    ndarray, of that shape
        The next iterate.

    Source
    ------
    Walker and Ni (2011), Anderson acceleration for fixed-point iterations, SIAM J.
    Numer. Anal. 49, type II.
    """
    residuals = [image - point for point, image in zip(points, images, strict=True)]
    used = min(len(points), depth)
    if used == 1:
        return images[-1]
    differences = np.array([residuals[-1] - r for r in residuals[-used:-1]])
    steps = np.array([points[-1] - point for point in points[-used:-1]])
    columns = differences.reshape(used - 1, -1).T
    weights, *_ = np.linalg.lstsq(columns, residuals[-1].ravel(), rcond=1e-10)
    left = residuals[-1] - np.tensordot(weights, differences, 1)
    step = damping * left - np.tensordot(weights, steps, 1)
    return np.asarray(points[-1] + step)


# What iterations may leave of the accuracy asked for; the meshes take the rest.
_ITERATED_SHARE = 0.04
# The flow of a round is solved this much more tightly than the net still moves.
_INNER_SHARE = 0.1
_LOOSEST_INNER = 1e-2
# How far a net that was found on a coarser mesh may still move.
_REFINED = 2e-3
# Flows of corrected rounds leave this much less, so that a miss is the step's own.
_CORRECTED = 0.1
# Iterations on the first mesh may leave more: it is only compared with the next.
_FIRST_MESH = 5.0
# Layered snow may pull by a percent more or less on a net that hardly moves: its pulls
# may change in the last round by this many times what the net may move.
_SETTLED = 5.0
# Change of layered snow's pulls over that of the net [1/thickness] up to which a finer
# mesh behaves as the coarser one.
_CALM = 10.0
# Rounds that leave more than this share of the last one's movement are slow. So is the
# first of all, where snow slips along so much of a net that is as near as this to rest.
_SLOW = 0.2
_MOST_SLIPS, _NEAR_REST = 0.8, 0.01
# Linear solves after which rounds on one mesh are given up: so many, of layered snow
# fewer, or so many over its triangles (some 1 s).
_LEAST_WORK, _LEAST_WORK_LAYERED, _MOST_WORK = 100, 40, 4e4
_FAILED_FLOW = 20  # of them, for a flow that does not converge


@dataclass(frozen=True, slots=True, eq=False)
class CoupledState:
    """Snow and net at rest with each other on one mesh, dimensionless.

    Attributes
    ----------
    problem : SteadyProblem
        What was solved.
    last : RoundResult
        The last round.
    tangent : ndarray, shape (2, n_net, 2, n_net), or None
        Derivative of the last round, if plain rounds gained little [-].
    pull_gain : float
        Largest relative change of pulls over that of the net [1/thickness].
    linear_solves, rounds : int
        What it took.
    """

    problem: SteadyProblem
    last: RoundResult
    tangent: Floats | None
    pull_gain: float
    linear_solves: int
    rounds: int


def couple(
    problem: SteadyProblem,
    settings: SolverSettings,
    guess: CoupledState | None,
    *,
    is_first: bool = False,
) -> CoupledState:
    """Rounds of flow and net until neither moves the other.

    Parameters
    ----------
    problem : SteadyProblem
        Snow and net on one mesh.
    settings : SolverSettings
        Tolerances, and how many rounds at most.
    guess : CoupledState or None
        Where to start: the same or a like scene on this or on a coarser mesh.
    is_first : bool
        A coarsest mesh, which is only compared with the next.

    Raises
    ------
    SolveError
        If the rounds do not end, or one of them has no solution.
    """
    tolerance, still = _choose_tolerances(settings, is_first=is_first)
    core = prepare_rounds(problem, settings, still)
    take: Take = core.take if core else partial(take_round, problem, settings)
    state, net = _begin(problem, guess, core.hang if core else None)
    curve = _start_curve(problem, net, guess)
    allowed = settings.patience * _allow_solves(problem)
    taken: list[RoundResult] = []
    correction: Correction | None = None
    corrects = guess is not None and guess.tangent is not None
    carried = _carry(problem, guess)
    solves = tried = 0
    while tried < settings.max_rounds and solves <= allowed:
        tried += 1
        moved = _measure_movement(taken, guess)
        inner = _choose_inner(tolerance, moved, is_corrected=correction is not None)
        try:
            now = take_near(take, taken, curve, state, net, inner)
        except SolveError:
            if correction is None or not correction.may_halve:
                raise
            correction = correction.halve()
            curve, solves = correction.target, solves + _FAILED_FLOW
            continue
        taken.append(now)
        state, net, solves = now.state, now.net, solves + now.linear_solves
        is_still = now.moved < still and now.change < tolerance
        if is_still and _has_settled(problem, taken, guess, _SETTLED * still):
            tangent = correction.tangent if correction else carried
            gain = _measure_gain(problem, taken, guess)
            return CoupledState(problem, now, tangent, gain, solves, tried)
        # a net that is still, whose pulls are not, is worth no derivative
        corrects = corrects or (not is_still and _is_slow(taken, guess))
        if corrects:
            correction = correct_round(problem, now, correction, carried)
            curve, carried = correction.target, None
        else:
            curve = mix_anderson([r.curve for r in taken], [r.image for r in taken])
    raise _explain_end(problem, taken, guess, curve, tried)


def _explain_end(
    problem: SteadyProblem,
    taken: Sequence[RoundResult],
    guess: CoupledState | None,
    curve: Floats,
    tried: int,
) -> SolveError:
    """Rounds that have not settled; ``curve`` is the next one."""
    left = float(_measure_movement(taken, guess))
    what = say("steady.still_moves", moved=left, rounds=tried)
    last = taken[-1].curve if taken else curve
    return explain_failure(problem, Outcome.MAX_ITERATIONS, what, last)


def _measure_movement(
    taken: Sequence[RoundResult], guess: CoupledState | None
) -> float:
    """Way of the net in the last round; before the first, its usual way [thickness]."""
    if taken:
        return taken[-1].moved
    return 1.0 if guess is None else _REFINED


def _allow_solves(problem: SteadyProblem) -> float:
    """Linear solves that rounds on one mesh usually may take."""
    least = _LEAST_WORK_LAYERED if problem.is_layered else _LEAST_WORK
    return float(max(least, _MOST_WORK / problem.template.triangles.shape[1]))


def _has_settled(
    problem: SteadyProblem,
    taken: Sequence[RoundResult],
    guess: CoupledState | None,
    allowed: float,
) -> bool:
    """Pulls of layered snow on the net change by a small share in a round.

    The first round on a finer mesh has none before it: how pulls follow the net is
    known from the coarser mesh.
    """
    if not problem.is_layered:
        return True
    if len(taken) > 1:
        return _change_pulls(*taken[-2:]) <= allowed
    # what a coarser mesh tells is trusted less than what was seen
    expected = math.inf if guess is None else guess.pull_gain * taken[-1].moved
    return expected <= allowed / _SETTLED


def _change_pulls(before: RoundResult, now: RoundResult) -> float:
    """Relative change of the pulls from one round to the next, of the larger one."""
    cable, last = now.net.cable, before.net.cable
    foot = np.hypot(*(cable.foot_pull - last.foot_pull)) / np.hypot(*cable.foot_pull)
    head = np.hypot(*(cable.head_pull - last.head_pull)) / np.hypot(*cable.head_pull)
    return float(max(foot, head))


def _measure_gain(
    problem: SteadyProblem, taken: Sequence[RoundResult], guess: CoupledState | None
) -> float:
    """Largest relative change of pulls over that of the net, on the meshes so far."""
    if not problem.is_layered:
        return math.inf  # not calm: no derivative goes on to a finer mesh
    gains = [
        _change_pulls(before, now) / float(np.abs(now.curve - before.curve).max())
        for before, now in pairwise(taken)
    ]
    return max([guess.pull_gain if guess else 0.0, *gains])


def _carry(problem: SteadyProblem, guess: CoupledState | None) -> Floats | None:
    """Derivative of a round as the coarser mesh knew it; None if it will not do."""
    if guess is None or guess.tangent is None or guess.pull_gain > _CALM:
        return None
    places = locate_nodes(guess.problem.template, guess.last.net)
    wanted = locate_nodes(problem.template, guess.last.net)
    return carry_tangent(guess.tangent, places, wanted)


def _begin(
    problem: SteadyProblem, guess: CoupledState | None, hang: Hang | None
) -> tuple[FlowState | None, NetEquilibrium]:
    """Snow, as far as it is known, and net before the first round."""
    if guess is None:
        return None, start_net(problem, hang)
    old, new = guess.problem.template, problem.template
    return transfer_state(guess.last.state, old, new), guess.last.net


def _choose_inner(tolerance: float, moved: float, *, is_corrected: bool) -> float:
    """Error that the flow of a round may leave, for a net that still moves."""
    tighter = _CORRECTED if is_corrected else 1.0
    return tighter * max(tolerance, min(_INNER_SHARE * moved, _LOOSEST_INNER))


def _choose_tolerances(
    settings: SolverSettings, *, is_first: bool
) -> tuple[float, float]:
    """Error that the last Newton step may leave, and way of the last round."""
    rough = _FIRST_MESH if is_first else 1.0
    share = _ITERATED_SHARE * settings.accuracy
    return (
        rough * min(settings.stress_tolerance, share),
        rough * min(settings.shape_tolerance, share),
    )


def _is_slow(taken: Sequence[RoundResult], guess: CoupledState | None) -> bool:
    """Snow slips along the net, and the last round gained little, or the next would."""
    last = taken[-1]
    if len(taken) > 1:
        is_slow = last.moved > _SLOW * taken[-2].moved
        return is_slow and last.state.contact.slip_share > 0.0
    is_near = guess is None and last.moved < _NEAR_REST
    return is_near and last.state.contact.slip_share > _MOST_SLIPS


def _start_curve(
    problem: SteadyProblem, net: NetEquilibrium, guess: CoupledState | None
) -> Floats:
    """Curve of the first round, shape (2, n_net) [thickness]."""
    if guess is None:
        return find_contact_curve(problem, net)
    curve = find_contact_curve(guess.problem, net)
    # between its nodes as smooth as the net is, which a polygon is not
    source, target = guess.problem.template, problem.template
    if not source.interfaces and not target.interfaces:
        return np.asarray(curve @ _weigh_nodes(source.origin, target.origin))
    places, wanted = (locate_nodes(template, net) for template in (source, target))
    return interpolate_curve(places, curve, wanted)


@lru_cache(maxsize=64)  # else a twentieth of a solve
def _weigh_nodes(source: MeshTemplate, target: MeshTemplate) -> Floats:
    """Weights of a net's nodes in those of another mesh, without layers, (n, m)."""
    places, wanted = source.net_fractions, target.net_fractions
    return interpolate_curve(places, np.eye(places.size), wanted)
