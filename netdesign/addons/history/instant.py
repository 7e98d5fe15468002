"""One step of snow that pushes the net along: equilibrium at the step's end.

The net's forces are taken where the step ends, so the step may be as long as
accuracy allows. Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from netdesign.addons.history.body import SnowBody
from netdesign.addons.history.net_pulls import NetResponse, hold_net, join_points
from netdesign.addons.history.snow import SnowIterate
from netdesign.addons.history.state import (
    Top,
    TransientProblem,
    TransientState,
)
from netdesign.addons.history.step import (
    StepEquations,
    assemble_step,
    condense_step,
)
from netdesign.addons.history.yielding import NetGuess, YieldingNodes, settle_net
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.law import squared_invariant
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

    def end_state(
        self, state: TransientState, body: SnowBody, step: float
    ) -> TransientState:
        """State at the step's end with its body, the net as at the step's start.

        Parameters
        ----------
        state : TransientState
            At the step's start.
        body : SnowBody
            At its end.
        step : float
            Duration [time scale].
        """
        return replace(
            state,
            time=state.time + step,
            body=body,
            velocity=self.velocity,
            moved=self.displaced - state.body.vertices,
            step=step,
            stress=self.stress,
            base_shear=self.base_shear,
        )


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
    points = join_points(state.net_nodes, problem.head)
    forces = hold_net(points, state.lengths, stiffness=problem.stiffness).forces
    guess = NetGuess.at_rest(equations.place_net(iterate.unknowns), state.slide_signs)
    top_changes = 0
    for iteration in range(1, max_iterations + 1):
        iterate, response, guess = _iterate(
            equations, iterate, state.lengths, forces, guess
        )
        forces = response.forces
        slips = _slips_over(equations, iterate)
        if slips != equations.top_slips and top_changes < _TOP_CHANGES:
            top_changes += 1
            equations = replace(equations, top_slips=slips)
            velocity = equations.split(iterate.unknowns)
            iterate = iterate._replace(unknowns=equations.hold(velocity))
            continue
        if _LEFT_SHARE * _require_finite(iterate.change) ** 2 < tolerance:
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
        solution = condense_step(equations, iterate, response.forces)
        iterate = solution.answer(np.zeros(response.forces.size))
        if _require_finite(iterate.change) < tolerance:
            return _finish(equations, state, iterate, response, iteration)
    raise SolveError(Outcome.MAX_ITERATIONS, say("history.step_under_forces"))


def _begin(equations: StepEquations, state: TransientState) -> SnowIterate:
    """The snow as it moved in the last step."""
    return SnowIterate(equations.hold(state.velocity), state.stress, state.base_shear)


def _iterate(
    equations: StepEquations,
    iterate: SnowIterate,
    lengths: Floats,
    forces: Floats,
    guess: NetGuess,
) -> tuple[SnowIterate, NetResponse, NetGuess]:
    """Newton iteration of the snow; the net is solved exactly on its linear answer."""
    solution, count = condense_step(equations, iterate, forces), forces.size
    rate = equations.motion.rate
    moved = rate * solution.change[:count].reshape(2, -1)
    nodes = YieldingNodes(
        positions=equations.place_net(iterate.unknowns) + moved,
        forces=forces,
        compliance=rate * solution.per_force[:count],
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
    return solution.answer((response.forces - forces).ravel()), response, guess


def _slips_over(equations: StepEquations, iterate: SnowIterate) -> bool:
    """The snow's upper corner slips up over the head, against friction (N14)."""
    if equations.top_axis is None or iterate.imbalance is None:
        return False
    along = equations.top_axis
    if equations.top_slips:
        velocity = equations.split(iterate.unknowns)[:, equations.template.net[-1]]
        return bool(along @ velocity > 0.0)
    force = -equations.pull_vertices(iterate.imbalance)[:, -1]
    pressure, shear = along[1] * force[0] - along[0] * force[1], along @ force
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
    assert iterate.imbalance is not None
    residual = equations.pull_vertices(iterate.imbalance)
    corner, held = -residual[:, 0], -residual[:, -1]
    residual = residual[:, 1 : 1 + state.carried.size] - response.forces
    head_pull, on_net, top = response.head_pull, -response.forces, state.top
    if top != "on-net":
        head_pull = head_pull + held
        on_net = np.column_stack([on_net, held])
        top = "slipping" if equations.top_slips else "held"
    velocity = equations.split(iterate.unknowns)
    moved = (
        equations.motion.offset
        + equations.motion.rate * (velocity[:, : equations.template.n_vertices])
    )
    ground = equations.template.ground[1:]
    return Instant(
        displaced=state.body.vertices + moved,
        velocity=velocity,
        stress=iterate.stress,
        base_shear=iterate.base_shear,
        top=top,
        points=join_points(
            equations.place_net(iterate.unknowns), equations.problem.head
        ),
        response=response,
        foot_pull=response.foot_pull + _share_corner(equations, corner, response),
        head_pull=head_pull,
        on_net=on_net,
        ground_normal=equations.split(iterate.imbalance)[1, ground],
        creep_rate=_mean_creep_rate(equations, iterate.stress),
        residual=_measure_residual(equations, iterate.imbalance, residual),
        linear_solves=iterations,
    )


def _measure_residual(
    equations: StepEquations, imbalance: Floats, on_net: Floats
) -> float:
    """Force out of balance at what moves freely, over the weight [-]."""
    inside = np.linalg.norm(imbalance[equations.load.inner])
    return float(np.hypot(inside, np.linalg.norm(on_net))) / equations.weight_size


def _mean_creep_rate(equations: StepEquations, stress: Floats) -> float:
    snow, material = equations.problem.snow, equations.load.material
    weights = equations.snow.weights
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
