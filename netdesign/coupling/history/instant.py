"""One step of snow that pushes the net along: equilibrium at the step's end.

The net's forces are taken where the step ends, so the step may be as long as
accuracy allows. Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from netdesign.cable.response import NetResponse, hold_net
from netdesign.cable.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.coupling.history.state import (
    Top,
    TransientProblem,
    TransientState,
    list_net_points,
)
from netdesign.coupling.history.step import (
    SnowIterate,
    StepEquations,
    advance_iterate,
    assemble_step,
    compute_imbalance,
    measure_change,
    solve_linear,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.law import squared_invariant
from netdesign.snow.straight_mesh import unfold_velocity
from netdesign.words.message import say

# Error that a Newton iteration leaves, over the square of its change (measured: less).
_LEFT_SHARE = 10.0
_ROUNDING_SHARE = 5.0  # residual with rounding over what is asked
_TOP_CHANGES = 3  # of the upper corner, between held and slipping, in one step


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Instant:
    """Equilibrium at the end of a step; dimensionless as in ``TransientState``.

    Attributes
    ----------
    displaced : ndarray, shape (2, n_vertices)
        Where the vertices end.
    velocity, stress, base_shear : ndarray
        Of the same shape and unit as there.
    top : str
        What the snow's upper corner does.
    points : ndarray, shape (2, n + 2)
        Foot, net nodes and head.
    response : NetResponse
        Forces and unstressed lengths of the net there.
    foot_pull, head_pull : ndarray, shape (2,)
        What net and snow pull with on the net's ends.
    on_net : ndarray, shape (2, n_net_vertices - 1)
        Forces of the snow on the net's vertices above the foot.
    ground_normal : ndarray, shape (n_ground - 1,)
        Downward nodal forces on the ground, without the node at the foot.
    creep_rate : float
        Mean size of the strain rate, S^n of eq. (N8), over the body.
    residual : float
        Force missing from the balance of any free node and of all, over the weight.
    linear_solves : int
        Taken by this step.
    """

    displaced: Floats
    velocity: Floats
    stress: Floats
    base_shear: Floats | None
    top: Top
    points: Floats
    response: NetResponse
    foot_pull: Floats
    head_pull: Floats
    on_net: Floats
    ground_normal: Floats
    creep_rate: float
    residual: float
    linear_solves: int


def advance(
    problem: TransientProblem,
    state: TransientState,
    step: float,
    *,
    tolerance: float,
    balance_tolerance: float,
    max_iterations: int,
) -> Instant:
    """Solve one step.

    Parameters
    ----------
    problem, state : TransientProblem, TransientState
        Scene and start of the step.
    step : float
        Duration [time scale].
    tolerance : float
        Relative error that the last iteration may leave in the stress [-].
    balance_tolerance : float
        Largest missing force over the weight [-].
    max_iterations : int
        Newton iterations allowed.

    Returns
    -------
    Instant

    Raises
    ------
    SolveError
        If the step does not converge; a shorter one may.
    """
    equations = assemble_step(problem, state, step)
    iterate = _begin(equations, state)
    points = list_net_points(problem, state.net_nodes)
    forces = hold_net(points, state.lengths, stiffness=problem.stiffness).forces
    guess = NetGuess.at_rest(equations.place_net(iterate.unknowns), state.slide_signs)
    top_changes = 0
    for iteration in range(1, max_iterations + 1):
        last = iterate.stress
        iterate, response, guess = _iterate(
            equations, iterate, state.lengths, forces, guess
        )
        forces = response.forces
        slips = _slips_over(equations, iterate)
        if slips != equations.top_slips and top_changes < _TOP_CHANGES:
            top_changes += 1
            equations = equations.with_top(slips=slips)
            iterate = iterate._replace(unknowns=equations.hold(iterate.unknowns))
            continue
        change = _require_finite(measure_change(equations, last, iterate.stress))
        if _LEFT_SHARE * change**2 < tolerance:
            instant = _finish(equations, state, iterate, response, iteration)
            if instant.residual < _ROUNDING_SHARE * balance_tolerance:
                return instant
    raise SolveError(Outcome.MAX_ITERATIONS, say("history.step"))


def advance_under(
    problem: TransientProblem,
    state: TransientState,
    step: float,
    response: NetResponse,
    *,
    tolerance: float,
    max_iterations: int,
) -> Instant:
    """Solve one step of snow under net forces that do not change in it.

    Only a base drag keeps such a step from being singular on a ground where the snow
    glides freely.

    Parameters
    ----------
    problem : TransientProblem
        What stays the same.
    state : TransientState
        At the step's start.
    step : float
        Duration [time scale].
    response : NetResponse
        The net at the step's start.
    tolerance : float
        Relative change of the stress in the last iteration [-].
    max_iterations : int
        Newton iterations allowed.

    Raises
    ------
    SolveError
        If the step does not converge.
    """
    equations = assemble_step(problem, replace(state, step=0.0), step)
    iterate = _begin(equations, state)
    for iteration in range(1, max_iterations + 1):
        last = iterate.stress
        solution = solve_linear(equations, iterate, response.forces, per_force=False)
        iterate = advance_iterate(equations, iterate, solution.linear, solution.change)
        change = _require_finite(measure_change(equations, last, iterate.stress))
        if change < tolerance:
            return _finish(equations, state, iterate, response, iteration)
    raise SolveError(Outcome.MAX_ITERATIONS, say("history.step_under_forces"))


def _begin(equations: StepEquations, state: TransientState) -> SnowIterate:
    """The snow as it moved in the last step."""
    unknowns = equations.hold(equations.mesh.to_node_axes(state.velocity))
    return SnowIterate(unknowns, state.stress, state.base_shear)


def _iterate(
    equations: StepEquations,
    iterate: SnowIterate,
    lengths: Floats,
    forces: Floats,
    guess: NetGuess,
) -> tuple[SnowIterate, NetResponse, NetGuess]:
    """Newton iteration of the snow; the net is solved exactly on its linear answer."""
    solution = solve_linear(equations, iterate, forces, per_force=True)
    dofs, rate = equations.net_dofs, equations.motion.rate
    nodes = YieldingNodes(
        positions=equations.place_net(iterate.unknowns + solution.change),
        forces=forces,
        compliance=rate * solution.per_force[dofs],
    )
    problem = equations.problem
    response, guess = settle_net(
        nodes,
        guess,
        problem.head,
        lengths,
        friction=problem.snow.friction,
        stiffness=problem.stiffness,
    )
    more = (response.forces - forces).ravel()
    change = solution.change + solution.per_force @ more
    iterate = advance_iterate(equations, iterate, solution.linear, change)
    return iterate, response, guess


def _slips_over(equations: StepEquations, iterate: SnowIterate) -> bool:
    """The snow's upper corner slips up over the head, against friction (N14)."""
    top = equations.top
    if equations.free[top]:
        return False
    if equations.top_slips:
        return bool(iterate.unknowns[top + 1] > 0.0)
    pressure, shear = -compute_imbalance(equations, iterate)[top : top + 2]
    return bool(shear > equations.problem.snow.friction * max(pressure, 0.0))


def _require_finite(change: float) -> float:
    if not np.isfinite(change):
        raise SolveError(Outcome.NONFINITE, say("history.stress_not_finite"))
    return change


def _finish(
    equations: StepEquations,
    state: TransientState,
    iterate: SnowIterate,
    response: NetResponse,
    iterations: int,
) -> Instant:
    assert iterate.stress is not None
    mesh, topology = equations.mesh, state.body.topology
    residual = compute_imbalance(equations, iterate)
    residual[equations.net_dofs] -= response.forces.ravel()
    supports = -mesh.to_slope_axes(residual)
    corner = supports[:, topology.ground[0]]
    head_pull, on_net, top = response.head_pull, -response.forces, state.top
    if top != "on-net":
        held = supports[:, topology.net[-1]]
        head_pull = head_pull + held
        on_net = np.column_stack([on_net, held])
        top = "slipping" if equations.top_slips else "held"
    velocity = unfold_velocity(mesh.template, mesh.to_slope_axes(iterate.unknowns))
    moved = (
        equations.motion.offset
        + equations.motion.rate * (velocity[:, : mesh.template.n_vertices])
    )
    return Instant(
        displaced=state.body.vertices + moved,
        velocity=velocity,
        stress=iterate.stress,
        base_shear=iterate.base_shear,
        top=top,
        points=list_net_points(
            equations.problem, equations.place_net(iterate.unknowns)
        ),
        response=response,
        foot_pull=response.foot_pull + _share_corner(equations, corner, response),
        head_pull=head_pull,
        on_net=on_net,
        ground_normal=-supports[1, mesh.template.ground[1:]],
        creep_rate=_mean_creep_rate(equations, iterate.stress),
        residual=_measure_residual(equations, residual),
        linear_solves=iterations,
    )


def _measure_residual(equations: StepEquations, residual: Floats) -> float:
    """Force out of balance at what moves freely, over the weight [-]."""
    free = equations.free.copy()
    free[equations.mesh.n_velocities :] = False
    if equations.top_slips:
        free[equations.top + 1] = False
    return float(np.linalg.norm(residual[free])) / equations.weight_size


def _mean_creep_rate(equations: StepEquations, stress: Floats) -> float:
    snow, material = equations.problem.snow, equations.material
    weights = equations.mesh.weights
    rate = material.fluidity_ratio * squared_invariant(snow, material, stress) ** (
        snow.exponent / 2.0
    )
    return float((weights * rate).sum() / weights.sum())


def _share_corner(
    equations: StepEquations, corner: Floats, response: NetResponse
) -> Floats:
    """The net's part of the force on the corner that net and ground hold together.

    As in ``interface``: along a ground without reactions at nodes all of its X-force
    is the net's; the rest follows from the node above, as under a uniform traction.
    """
    below, above = equations.nodes[:, 0], equations.nodes[:, 1]
    first, second = np.hypot(*below), np.hypot(*(above - below))
    share = -response.forces[:, 0] * first / (first + second)
    if equations.problem.snow.ground != "no-slip":
        share[0] = corner[0]
    return np.asarray(share)
