"""The steady state: snow that flows along a net at rest, and the net it shapes.

Rounds of flow and net (``rounds``) on meshes refined until the end forces are accurate
enough. Theory: coupling/THEORY.md. Dimensionless inside: lengths in snow thicknesses d,
forces per metre of width in rho g d^2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from netdesign.coupling.balance import (
    LARGEST_SUCTION,
    SuctionError,
    check_balance,
    measure_balance,
    measure_suction,
)
from netdesign.coupling.interface import (
    STEADY_ERROR,
    Estimate,
    SupportForces,
    find_support_forces,
    is_balanced,
    measure_looseness,
    refine,
)
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    Cost,
    EndPull,
    FailedSolution,
    OnFailure,
    Solution,
    end_solve,
    triangle_density,
)
from netdesign.coupling.steady.net import NetEquilibrium, SteadyProblem, hang_net
from netdesign.coupling.steady.rounds import CoupledState, couple
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.contact import FlowState
from netdesign.snow.element import share_template
from netdesign.snow.mesh import MeshSize, MeshTemplate
from netdesign.words.message import say

# Share of suction, over the largest accepted, that no finer mesh takes back.
_HOPELESS_SUCTION = 2.0
# Triangles of layered snow with pressures of their own: 0.3 s and 0.2 GB a mesh.
MOST_MIXED_TRIANGLES = 1500


def solve_steady(
    scene: Scene,
    settings: SolverSettings | None = None,
    *,
    on_failure: OnFailure = "return",
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
    tests/coupling/steady/test_solve.py, tests/verification/test_reference_scene.py
    """
    return end_solve(lambda: _solve(scene, settings or SolverSettings()), on_failure)


def find_net_equilibrium(
    scene: Scene, size: MeshSize, settings: SolverSettings
) -> tuple[SteadyProblem, NetEquilibrium]:
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
    problem = _build_problem(scene, size)
    _, net, _ = _finish(couple(problem, settings, None, is_first=True))
    return problem, net


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
    states, estimates = _solve_levels(scene, settings)
    solution = _build_solution(scene, states, [end.error for end in estimates])
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
    scene: Scene, settings: SolverSettings
) -> tuple[list[CoupledState], list[Estimate]]:
    """Meshes until two agree; those before the one that fails, if they are two."""
    first = _build_problem(scene, settings.levels[0])
    solved: dict[MeshSize, CoupledState] = {}

    def solve(size: MeshSize, coarse: CoupledState | None) -> CoupledState:
        if size not in solved:
            problem = replace(first, template=_build_template(scene, size))
            _require_affordable(scene, problem)
            solved[size] = couple(problem, settings, coarse, is_first=coarse is None)
            _require_pressure(solved[size])
        return solved[size]

    def run(levels: Sequence[MeshSize]) -> tuple[list[CoupledState], list[Estimate]]:
        return refine(
            levels,
            solve,
            lambda end: (end.last.net.cable.foot_pull, end.last.net.cable.head_pull),
            settings.accuracy,
            STEADY_ERROR,
            lambda end: measure_looseness(end.last.state.contact),
        )

    try:
        return run(settings.levels)
    except SolveError as failure:
        # what a finer mesh finds outside of the model, coarser ones do not prove
        if len(solved) < 2 or failure.outcome is Outcome.OUT_OF_VALIDITY:
            raise
        return run(settings.levels[: len(solved)])


def _require_affordable(scene: Scene, problem: SteadyProblem) -> None:
    """Bound the work on layers that hardly change their volume (coupling/THEORY.md, 2).

    Raises
    ------
    SolveError
        If the mesh is larger; coarser ones that were solved then count.
    """
    count = problem.template.triangles.shape[1]
    keeps_volume = problem.is_layered and problem.snow.element == "mixed"
    if keeps_volume and count > MOST_MIXED_TRIANGLES:
        densest = max(layer.density for layer in scene.layers)
        what = say(
            "steady.too_much_work",
            density=float(densest),
            count=count,
            most=MOST_MIXED_TRIANGLES,
        )
        raise SolveError(Outcome.MAX_ITERATIONS, what)


def _require_pressure(end: CoupledState) -> None:
    """Leave a net that finer meshes will not press against the snow either.

    Raises
    ------
    SuctionError
        With some margin: the finest mesh decides.
    """
    mesh = end.last.mesh
    on_net = end.last.net.forces[:, : mesh.template.net.size]
    suction = measure_suction(mesh, on_net)
    if suction > _HOPELESS_SUCTION * LARGEST_SUCTION:
        raise SuctionError(suction)


def _build_problem(scene: Scene, size: MeshSize) -> SteadyProblem:
    net, thickness = scene.net, scene.snowpack.thickness
    return SteadyProblem(
        snow=scene.steady_flow_problem,
        template=_build_template(scene, size),
        head=net.head / thickness,
        length=net.unstressed_length / thickness,
        slack=net.slack,
        stiffness=net.stiffness_per_m / scene.force_scale,
    )


def _build_template(scene: Scene, size: MeshSize) -> MeshTemplate:
    return share_template(scene.modelled_aspect, size, scene.layer_tops)


def _finish(
    end: CoupledState,
) -> tuple[FlowState, NetEquilibrium, SupportForces]:
    """Forces from the stresses alone, and the net that hangs under these."""
    problem, last = end.problem, end.last
    if last.from_stresses is not None:
        forces, net = last.from_stresses
        if is_balanced(problem.snow, last.mesh, forces):
            return last.state, net, forces
    state, forces = find_support_forces(problem.snow, last.mesh, last.state)
    net = last.net
    return state, hang_net(problem, forces.on_net, net.cable.pull, net.parts), forces


def _build_solution(
    scene: Scene, states: Sequence[CoupledState], errors: Sequence[float]
) -> Solution:
    """Solution of the finest mesh; ``errors`` of its pulls at foot and head."""
    problem, mesh = states[-1].problem, states[-1].last.mesh
    state, net, forces = _finish(states[-1])
    thickness, scale, cable = scene.snowpack.thickness, scene.force_scale, net.cable
    foot, head = (
        EndPull.of_estimate(Estimate(vector=pull, error=error), scale)
        for pull, error in zip((cable.foot_pull, cable.head_pull), errors, strict=True)
    )
    along = problem.head / np.hypot(*problem.head)
    offsets = along[1] * cable.curve[0] - along[0] * cable.curve[1]
    tensions = np.append(cable.tension * scale, (foot.size, head.size))
    held = cable.foot_pull + cable.head_pull
    return Solution(
        scene=scene,
        method="steady",
        foot=foot,
        head=head,
        tension_min=float(tensions.min()),
        tension_max=float(tensions.max()),
        sag=float(offsets.max()) * thickness,
        net_curve=cable.curve * thickness,
        net_forces=forces.on_net * scale,
        net_slides=np.append(False, state.contact.sign != 0),
        mesh_nodes=mesh.nodes * thickness,
        mesh_triangles=mesh.template.triangles[:3],
        mesh_density=triangle_density(scene, mesh.template),
        mesh_velocity=mesh.to_slope_axes(state.unknowns) * scene.velocity_scale,
        balance=measure_balance(problem.snow, mesh, forces, held, cable.tension, scale),
        cost=Cost(
            linear_solves=sum(state.linear_solves for state in states),
            rounds=sum(state.rounds for state in states),
            elements=mesh.template.triangles.shape[1],
            degrees_of_freedom=mesh.n_dofs,
        ),
    )
