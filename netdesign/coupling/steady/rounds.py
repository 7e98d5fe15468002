"""The steady state: snow that flows along a net at rest, and the net it shapes.

Rounds of snow flow against a given curve and net equilibrium under the forces
found, accelerated, on meshes refined until the end forces are accurate enough.
Theory: coupling/THEORY.md. Dimensionless inside: lengths in snow thicknesses d,
forces per metre of width in rho g d^2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Literal

import numpy as np

from netdesign.cable.net import LARGEST_FRICTION_ANGLE, Net
from netdesign.coupling.balance import (
    LARGEST_SUCTION,
    SuctionError,
    check_balance,
    measure_balance,
    measure_suction,
)
from netdesign.coupling.interface import (
    SupportForces,
    find_support_forces,
    measure_looseness,
    share_net_forces,
)
from netdesign.coupling.refine import STEADY_ERROR, Estimate, refine
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    Cost,
    EndPull,
    FailedSolution,
    Solution,
    list_skipped,
    triangle_density,
)
from netdesign.coupling.steady.correction import (
    Correction,
    Round,
    carry_tangent,
    correct_round,
)
from netdesign.coupling.steady.hanging import (
    Hanging,
    SteadyProblem,
    find_contact_curve,
    hang_again,
    locate_nodes,
    start_hanging,
)
from netdesign.errors import ModelError, SolveError
from netdesign.numerics.arrays import Floats
from netdesign.numerics.curve import interpolate_curve
from netdesign.numerics.fixed_point import mix_anderson
from netdesign.outcome import Outcome
from netdesign.snow.flow import FlowResult, FlowState, solve_flow
from netdesign.snow.kernel import PlacedMesh, build_placed_mesh
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.transfer import transfer_state
from netdesign.words.message import Message, say

# What iterations may leave of the accuracy asked for; the meshes take the rest.
_ITERATED_SHARE = 0.04
# The flow of a round is solved this much more tightly than the net still moves.
_INNER_SHARE = 0.1
_LOOSEST_INNER = 1e-2
# How far a net that was found on a coarser mesh may still move.
_REFINED = 4e-3
# Flows of corrected rounds leave this much less, so that a miss is the step's own.
_CORRECTED = 0.1
# Iterations on the first mesh may leave more: it is only compared with the next.
_FIRST_MESH = 5.0
_HALVINGS = 4
# Layers whose creep rates differ by more may have no steady state that rounds find.
_LAYER_CONTRAST = 1e3
# So may nets of more slack (over the chord): they hang close to the ground.
_MUCH_SLACK = 0.1
# Layered snow may pull by a percent more or less on a net that hardly moves: its pulls
# may change in the last round by this many times what the net may move.
_SETTLED = 5.0
# Change of layered snow's pulls over that of the net [1/thickness] up to which a finer
# mesh behaves as the coarser one.
_CALM = 10.0
# Rounds that leave more than this share of the last one's movement are slow.
_SLOW = 0.2
# Linear solves after which rounds on one mesh are given up: so many, of layered snow
# fewer, or so many over its triangles (some 1 s).
_LEAST_WORK, _LEAST_WORK_LAYERED, _MOST_WORK = 100, 40, 4e4
_FAILED_FLOW = 20  # of them, for a flow that does not converge
# Share of suction, over the largest accepted, that no finer mesh takes back.
_HOPELESS_SUCTION = 2.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Coupled:
    """Snow and net at rest with each other on one mesh, dimensionless."""

    problem: SteadyProblem
    mesh: PlacedMesh
    state: FlowState
    hanging: Hanging
    tangent: Floats | None  # of the round, if plain rounds gained little
    pull_gain: float  # relative change of pulls over that of the net [1/thickness]
    linear_solves: int
    rounds: int


def solve_steady(
    scene: Scene,
    settings: SolverSettings | None = None,
    *,
    on_failure: Literal["return", "raise"] = "return",
) -> Solution | FailedSolution:
    """Steady state of a scene, refined until its end forces are accurate.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    settings : SolverSettings, optional
        Accuracy and tolerances.
    on_failure : str
        ``return`` a FailedSolution, or ``raise`` a SolveError.

    Returns
    -------
    Solution or FailedSolution
        The error of each end pull is estimated from two meshes. If the finest mesh
        does not reach the accuracy asked for, the error says so.

    Raises
    ------
    SolveError
        For what else is a FailedSolution, if ``on_failure`` is ``raise``.

    Verified by
    -----------
    tests/coupling/steady/test_rounds.py, tests/verification/test_reference_scene.py
    """
    try:
        return _solve(scene, settings or SolverSettings())
    except SolveError as failure:
        if on_failure == "raise":
            raise
        return FailedSolution(outcome=failure.outcome, reason=failure.reason)


def find_end_pulls(
    scene: Scene, size: MeshSize, settings: SolverSettings
) -> tuple[Floats, Floats]:
    """Pulls at foot and head on one mesh, of unknown error.

    A benchmark compares them with the truth; a check takes ``solve_steady``.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    size : MeshSize
        Of the one mesh.
    settings : SolverSettings
        Accuracy and tolerances.

    Returns
    -------
    ndarray, ndarray, shape (2,)
        [N/m].

    Raises
    ------
    SolveError
        If the mesh gives no converged solution.
    """
    _, hanging = find_hanging(scene, size, settings)
    cable = hanging.cable
    return cable.foot_pull * scene.force_scale, cable.head_pull * scene.force_scale


def find_hanging(
    scene: Scene, size: MeshSize, settings: SolverSettings
) -> tuple[SteadyProblem, Hanging]:
    """Net at rest on one mesh, dimensionless: where a history may begin.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    size : MeshSize
        Of the one mesh.
    settings : SolverSettings
        Accuracy and tolerances.

    Raises
    ------
    SolveError
        If the mesh gives no converged solution.
    """
    problem = _build_problem(scene, _require_net(scene), size)
    end, _ = _finish(_couple(problem, settings, None, is_first=True))
    return problem, end.hanging


def _require_net(scene: Scene) -> Net:
    if not isinstance(scene.net, Net):
        raise ModelError(say("steady.needs_net"))
    return scene.net


def _solve(scene: Scene, settings: SolverSettings) -> Solution:
    """The scene; with a net that lets go if the snow would pull on it too much."""
    try:
        return _solve_as_given(scene, settings)
    except SuctionError as refusal:
        released = replace(scene, net_contact="one-sided")
        try:
            freed = _solve_as_given(released, settings)
        except SolveError:
            raise refusal from None
        return _widen(replace(freed, is_released=True), refusal.held)


def _widen(freed: Solution, held: Solution | None) -> Solution:
    """Errors that reach to the net which holds on: pulls then do not jump by more."""
    if held is None:
        return freed
    foot, head = (
        replace(own, error=own.error + math.hypot(own.x - other.x, own.y - other.y))
        for own, other in ((freed.foot, held.foot), (freed.head, held.head))
    )
    return replace(freed, foot=foot, head=head)


def _solve_as_given(scene: Scene, settings: SolverSettings) -> Solution:
    if start := _find_start(scene, settings):
        with suppress(SolveError):  # then it is solved as any other
            return _refine(scene, settings, start)
    return _refine(scene, settings, None)


def _refine(scene: Scene, settings: SolverSettings, start: _Coupled | None) -> Solution:
    states, estimates = _solve_levels(scene, settings, start)
    solution = _build_solution(scene, states, [one.error for one in estimates])
    try:
        check_balance(
            solution.balance,
            settings.balance_tolerance,
            friction_tolerance=settings.stress_tolerance,
        )
    except SuctionError as refusal:
        refusal.held = solution
        raise
    return solution


def _solve_levels(
    scene: Scene, settings: SolverSettings, start: _Coupled | None
) -> tuple[list[_Coupled], list[Estimate]]:
    """Meshes until two agree; those before the one that fails, if they are two."""
    net = _require_net(scene)
    solved: dict[MeshSize, _Coupled] = {}

    def solve(size: MeshSize, coarse: _Coupled | None) -> _Coupled:
        if size not in solved:
            problem = _build_problem(scene, net, size)
            solved[size] = _couple(
                problem, settings, coarse or start, is_first=coarse is None
            )
            _require_pressure(solved[size])
        return solved[size]

    def run(levels: Sequence[MeshSize]) -> tuple[list[_Coupled], list[Estimate]]:
        return refine(
            levels,
            solve,
            lambda end: (end.hanging.cable.foot_pull, end.hanging.cable.head_pull),
            settings.accuracy,
            STEADY_ERROR,
            lambda end: measure_looseness(end.state.contact),
        )

    try:
        return run(settings.levels)
    except SolveError as failure:
        # what a finer mesh finds outside of the model, coarser ones do not prove
        if len(solved) < 2 or failure.outcome is Outcome.OUT_OF_VALIDITY:
            raise
        return run(settings.levels[: len(solved)])


def _require_pressure(end: _Coupled) -> None:
    """Leave a net that finer meshes will not press against the snow either.

    Raises
    ------
    SuctionError
        With some margin: the finest mesh decides.
    """
    on_net = share_net_forces(end.problem.snow, end.mesh, end.state.reaction)
    suction = measure_suction(end.mesh, on_net)
    if suction > _HOPELESS_SUCTION * LARGEST_SUCTION:
        raise SuctionError(suction)


def _find_start(scene: Scene, settings: SolverSettings) -> _Coupled | None:
    """State that the first mesh starts from; None if there is none."""
    if not settings.shares_start:
        return None
    net = replace(_require_net(scene), friction_angle=LARGEST_FRICTION_ANGLE)
    return _find_stuck(replace(scene, net=net), settings)


@lru_cache(maxsize=1)
def _find_stuck(scene: Scene, settings: SolverSettings) -> _Coupled | None:
    """First mesh of a scene whose snow sticks to its net; None without a solution.

    Scenes in turn that differ in friction only have it in common. Each ends the same
    whether this was known or not.
    """
    problem = _build_problem(scene, _require_net(scene), settings.levels[0])
    try:
        return _couple(problem, settings, None, is_first=True)
    except SolveError:
        return None


def _build_problem(scene: Scene, net: Net, size: MeshSize) -> SteadyProblem:
    thickness = scene.snowpack.thickness
    return SteadyProblem(
        snow=scene.steady_flow_problem,
        template=build_template(scene.modelled_aspect, size, scene.layer_tops),
        head=net.head / thickness,
        length=net.unstressed_length / thickness,
        slack=net.slack,
        stiffness=net.stiffness_per_m / scene.force_scale,
    )


def _couple(
    problem: SteadyProblem,
    settings: SolverSettings,
    guess: _Coupled | None,
    *,
    is_first: bool = False,
) -> _Coupled:
    """Rounds of flow and net until neither moves the other."""
    hanging = guess.hanging if guess is not None else start_hanging(problem)
    curve = _start_curve(problem, hanging, guess)
    tolerance, still = _choose_tolerances(settings, is_first=is_first)
    allowed = settings.patience * _allow_solves(problem)
    played: list[Round] = []
    correction: Correction | None = None
    was_slow = guess is not None and guess.tangent is not None
    carried = _carry(problem, guess)
    moved, solves, tried = 1.0 if guess is None else _REFINED, 0, 0
    while tried < settings.max_rounds and solves <= allowed:
        tried += 1
        inner = _choose_inner(tolerance, moved, is_corrected=correction is not None)
        try:
            curve, mesh = _place_between(problem, played, curve)
            state = _start_state(guess, played, mesh)
            flow = _flow_along(problem, mesh, state, settings, inner)
            now = _hang_round(problem, hanging, curve, mesh, flow)
        except SolveError:
            if correction is None or not correction.may_halve:
                raise
            correction = correction.halve()
            curve, solves = correction.target, solves + _FAILED_FLOW
            continue
        played.append(now)
        hanging = now.hanging
        moved, solves = now.moved, solves + now.flow.linear_solves
        is_still = moved < still and now.flow.change < tolerance
        if is_still and _has_settled(problem, played, guess, _SETTLED * still):
            return _Coupled(
                problem=problem,
                mesh=now.mesh,
                state=now.flow.state,
                hanging=now.hanging,
                tangent=correction.tangent if correction else carried,
                pull_gain=_measure_gain(problem, played, guess),
                linear_solves=solves,
                rounds=tried,
            )
        # a net that is still, whose pulls are not, is worth no derivative
        is_slow = not is_still and _is_slow(played)
        if correction or was_slow or is_slow:
            correction = correct_round(problem, now, correction, carried)
            curve, carried = correction.target, None
        else:
            curve = mix_anderson(
                [one.curve for one in played], [one.image for one in played]
            )
    raise _fail(
        problem,
        Outcome.MAX_ITERATIONS,
        say("steady.still_moves", moved=float(moved), rounds=tried),
    )


def _allow_solves(problem: SteadyProblem) -> float:
    """Linear solves that rounds on one mesh usually may take."""
    least = _LEAST_WORK_LAYERED if problem.is_layered else _LEAST_WORK
    return float(max(least, _MOST_WORK / problem.template.triangles.shape[1]))


def _has_settled(
    problem: SteadyProblem,
    played: Sequence[Round],
    guess: _Coupled | None,
    allowed: float,
) -> bool:
    """Pulls of layered snow on the net change by a small share in a round.

    The first round on a finer mesh has none before it: how pulls follow the net is
    known from the coarser mesh.
    """
    if not problem.is_layered:
        return True
    if len(played) > 1:
        return _change_pulls(*played[-2:]) <= allowed
    # what a coarser mesh tells is trusted less than what was seen
    expected = math.inf if guess is None else guess.pull_gain * played[-1].moved
    return expected <= allowed / _SETTLED


def _change_pulls(before: Round, now: Round) -> float:
    """Relative change of the pulls from one round to the next, of the larger one."""
    cable, last = now.hanging.cable, before.hanging.cable
    foot = np.hypot(*(cable.foot_pull - last.foot_pull)) / np.hypot(*cable.foot_pull)
    head = np.hypot(*(cable.head_pull - last.head_pull)) / np.hypot(*cable.head_pull)
    return float(max(foot, head))


def _measure_gain(
    problem: SteadyProblem, played: Sequence[Round], guess: _Coupled | None
) -> float:
    """Largest relative change of pulls over that of the net, on the meshes so far."""
    if not problem.is_layered:
        return math.inf  # is not asked for
    gains = [
        _change_pulls(before, now) / float(np.abs(now.curve - before.curve).max())
        for before, now in pairwise(played)
    ]
    return max([guess.pull_gain if guess else 0.0, *gains])


def _carry(problem: SteadyProblem, guess: _Coupled | None) -> Floats | None:
    """Derivative of a round as the coarser mesh knew it; None if it will not do."""
    if guess is None or guess.tangent is None or guess.pull_gain > _CALM:
        return None
    known = locate_nodes(guess.problem.template, guess.hanging)
    wanted = locate_nodes(problem.template, guess.hanging)
    return carry_tangent(guess.tangent, known, wanted)


def _start_state(
    guess: _Coupled | None, played: Sequence[Round], mesh: PlacedMesh
) -> FlowState | None:
    """State that the flow of a round starts from; None if there is none."""
    if played:
        return played[-1].flow.state
    if guess is not None:
        return transfer_state(guess.state, guess.mesh, mesh)
    return None


def _hang_round(
    problem: SteadyProblem,
    hanging: Hanging,
    curve: Floats,
    mesh: PlacedMesh,
    flow: FlowResult,
) -> Round:
    """The net under the forces of a flow."""
    on_net = share_net_forces(problem.snow, mesh, flow.state.reaction)
    found = hang_again(problem, hanging, on_net)
    image = find_contact_curve(problem, found)
    return Round(curve=curve, mesh=mesh, flow=flow, hanging=found, image=image)


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


def _flow_along(
    problem: SteadyProblem,
    mesh: PlacedMesh,
    start: FlowState | None,
    settings: SolverSettings,
    tolerance: float,
) -> FlowResult:
    """Converged flow along a net at rest."""
    flow = solve_flow(
        problem.snow,
        mesh,
        start,
        tolerance=tolerance,
        max_iterations=settings.max_iterations,
        step=settings.step,
    )
    if flow.outcome is not Outcome.CONVERGED:
        raise _fail(
            problem, flow.outcome, say("snow.flow_failed", outcome=flow.outcome.message)
        )
    return flow


def _fail(problem: SteadyProblem, outcome: Outcome, what: Message) -> SolveError:
    """The failure, with what in the scene is known to leave no steady state."""
    snow, causes = problem.snow, []
    if "one-sided" in (snow.ground_contact, snow.net_contact):
        causes.append(say("steady.lifts_off"))
    rates = [layer.fluidity_ratio for layer in snow.layers]
    if max(rates) > _LAYER_CONTRAST * min(rates):
        contrast = max(rates) / min(rates)
        causes.append(say("steady.layers_contrast", contrast=contrast))
    if problem.slack > _MUCH_SLACK:
        causes.append(say("steady.much_slack", slack=float(problem.slack)))
    if outcome is not Outcome.MAX_ITERATIONS or not causes:
        return SolveError(outcome, what)
    return SolveError(
        Outcome.NO_EQUILIBRIUM,
        say("steady.not_found", what=what, causes=tuple(causes)),
    )


def _is_slow(played: Sequence[Round]) -> bool:
    """Snow slips along the net, and the last round gained little."""
    if len(played) < 2 or not played[-1].flow.state.contact.sign.any():
        return False
    return played[-1].moved > _SLOW * played[-2].moved


def _place_between(
    problem: SteadyProblem, played: Sequence[Round], wanted: Floats
) -> tuple[Floats, PlacedMesh]:
    """Mesh on the wanted curve, or as near to it from the last one as it can be."""
    for _ in range(_HALVINGS if played else 0):
        try:
            return wanted, _place(problem, wanted)
        except SolveError:
            wanted = (wanted + played[-1].curve) / 2
    return wanted, _place(problem, wanted)


def _place(problem: SteadyProblem, curve: Floats) -> PlacedMesh:
    if curve[1, 1:].min() <= 0.0:
        raise SolveError(
            Outcome.OUT_OF_VALIDITY,
            say("net.would_touch_ground"),
        )
    nodes = place_nodes(problem.template, curve)
    mesh = build_placed_mesh(problem.template, nodes, problem.snow.element)
    if not mesh.is_valid:
        above = np.degrees(np.arctan2(curve[1, 1], curve[0, 1]))
        raise SolveError(
            Outcome.OUT_OF_VALIDITY,
            say("net.bulges", angle=float(above)),
        )
    return mesh


def _start_curve(
    problem: SteadyProblem, hanging: Hanging, guess: _Coupled | None
) -> Floats:
    if guess is None:
        return find_contact_curve(problem, hanging)
    curve = find_contact_curve(guess.problem, hanging)
    known = locate_nodes(guess.problem.template, hanging)
    wanted = locate_nodes(problem.template, hanging)
    # between its nodes as smooth as the net is, which a polygon is not
    return interpolate_curve(known, curve, wanted)


def _finish(end: _Coupled) -> tuple[_Coupled, SupportForces]:
    """Forces from the stresses alone, and the net that hangs under these."""
    state, forces = find_support_forces(end.problem.snow, end.mesh, end.state)
    hanging = hang_again(end.problem, end.hanging, forces.on_net)
    return replace(end, state=state, hanging=hanging), forces


def _build_solution(
    scene: Scene, states: Sequence[_Coupled], errors: Sequence[float]
) -> Solution:
    """Solution of the finest mesh; ``errors`` of its pulls at foot and head."""
    end, forces = _finish(states[-1])
    thickness, scale = scene.snowpack.thickness, scene.force_scale
    cable, mesh, snow = end.hanging.cable, end.mesh, end.problem.snow
    foot, head = (
        EndPull.of_estimate(Estimate(vector=pull, error=error), scale)
        for pull, error in zip((cable.foot_pull, cable.head_pull), errors, strict=True)
    )
    along = end.problem.head / np.hypot(*end.problem.head)
    offsets = along[1] * cable.curve[0] - along[0] * cable.curve[1]
    tensions = [*(cable.tension.ravel() * scale), foot.size, head.size]
    held = cable.foot_pull + cable.head_pull
    return Solution(
        scene=scene,
        method="steady",
        foot=foot,
        head=head,
        tension_min=min(tensions),
        tension_max=max(tensions),
        sag=float(offsets.max()) * thickness,
        net_curve=cable.curve * thickness,
        net_forces=forces.on_net * scale,
        net_slides=np.append(False, end.state.contact.sign != 0),
        mesh_nodes=mesh.nodes * thickness,
        mesh_edges=mesh.template.edges,
        mesh_triangles=mesh.template.triangles[:3],
        mesh_density=triangle_density(scene, mesh.template),
        largest_velocity=end.state.largest_velocity(mesh) * scene.velocity_scale,
        balance=measure_balance(snow, mesh, forces, held, cable.tension, scale),
        cost=Cost(
            linear_solves=sum(state.linear_solves for state in states),
            rounds=sum(state.rounds for state in states),
            elements=mesh.template.triangles.shape[1],
            degrees_of_freedom=mesh.n_dofs,
            skipped=list_skipped(scene, mesh),
        ),
    )
