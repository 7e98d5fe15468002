"""Snow against a rigid wall or rake: forces on it, and the glide factor by them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.coupling.balance import check_balance, measure_balance
from netdesign.coupling.interface import (
    STEADY_ERROR,
    Estimate,
    SupportForces,
    find_support_forces,
    measure_looseness,
    refine,
)
from netdesign.coupling.scene import Scene, SolverSettings, Wall
from netdesign.coupling.solution import (
    Balance,
    Cost,
    EndPull,
    FailedSolution,
    WallSolution,
    end_solve,
    list_skipped,
    require_solved,
    triangle_density,
)
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.contact import FlowState
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.flow import solve_flow
from netdesign.snow.ground import GroundLaw
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh
from netdesign.snow.snowpack import Snowpack
from netdesign.words.message import say

# The recipe: snow adhering to a rigid wall normal to the slope, as high as the snow.
# What these leave open: coupling/THEORY.md, section 1.
_THICKNESS = 3.0  # [m]
_UPSLOPE_LENGTH = 240.0  # [m]
_SLOPE_ANGLE = math.radians(40.0)
_DENSITY = 340.0  # [kg/m3]
_FINE = SolverSettings(accuracy=0.001)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _WallState:
    """Snow against the wall on one mesh, dimensionless."""

    problem: FlowProblem
    mesh: PlacedMesh
    state: FlowState
    forces: SupportForces
    linear_solves: int


def solve_rigid(
    scene: Scene, settings: SolverSettings | None = None
) -> WallSolution | FailedSolution:
    """Steady flow against the scene's wall, refined until its force is accurate.

    Parameters
    ----------
    scene : Scene
        With a ``Wall``.
    settings : SolverSettings, optional
        Accuracy and tolerances.

    Returns
    -------
    WallSolution or FailedSolution
        Forces of the snow on the wall, the error from two meshes.

    Verified by
    -----------
    tests/verification/test_rigid_wall.py
    """
    return end_solve(lambda: _solve(scene, settings or SolverSettings()))


def _solve(scene: Scene, settings: SolverSettings) -> WallSolution:
    states, (force,) = refine(
        settings.levels,
        lambda size, _: _press(scene, size, settings),
        lambda pressed: [pressed.forces.on_net.sum(axis=1)],
        settings.accuracy,
        STEADY_ERROR,
        lambda pressed: measure_looseness(pressed.state.contact),
    )
    end = states[-1]
    balance = measure_balance(
        end.problem, end.mesh, end.forces, force.vector, None, scene.force_scale
    )
    check_balance(
        balance,
        settings.balance_tolerance,
        friction_tolerance=settings.stress_tolerance,
    )
    return _build_solution(scene, states, force, balance)


def _build_solution(
    scene: Scene, states: Sequence[_WallState], force: Estimate, balance: Balance
) -> WallSolution:
    """The finest state in SI."""
    end, scale, thickness = states[-1], scene.force_scale, scene.snowpack.thickness
    nodes = end.mesh.nodes[:, end.mesh.template.net]
    moment = (nodes[1] * end.forces.on_net[0] - nodes[0] * end.forces.on_net[1]).sum()
    return WallSolution(
        scene=scene,
        force=EndPull.of_estimate(force, scale),
        moment_about_foot=float(moment) * scale * thickness,
        wall_nodes=nodes * thickness,
        wall_forces=end.forces.on_net * scale,
        wall_slides=np.append(False, end.state.contact.sign != 0),
        mesh_nodes=end.mesh.nodes * thickness,
        mesh_edges=end.mesh.template.edges,
        mesh_triangles=end.mesh.template.triangles[:3],
        mesh_density=triangle_density(scene, end.mesh.template),
        largest_velocity=end.state.largest_velocity(end.mesh) * scene.velocity_scale,
        balance=balance,
        cost=Cost(
            linear_solves=sum(state.linear_solves for state in states),
            rounds=len(states),
            elements=end.mesh.template.triangles.shape[1],
            degrees_of_freedom=end.mesh.n_dofs,
            skipped=list_skipped(scene, end.mesh),
        ),
    )


def _press(scene: Scene, size: MeshSize, settings: SolverSettings) -> _WallState:
    problem = scene.steady_flow_problem
    template = build_template(scene.modelled_aspect, size, scene.layer_tops)
    heights = template.net_fractions
    wall = np.array([heights * np.tan(scene.net.inclination), heights])
    mesh = build_placed_mesh(template, place_nodes(template, wall), problem.element)
    flow = solve_flow(
        problem,
        mesh,
        tolerance=settings.stress_tolerance,
        max_iterations=settings.max_iterations,
    )
    if flow.outcome is not Outcome.CONVERGED:
        raise SolveError(
            flow.outcome, say("snow.flow_failed", outcome=flow.outcome.message)
        )
    state, forces = find_support_forces(problem, mesh, flow.state)
    return _WallState(
        problem=problem,
        mesh=mesh,
        state=state,
        forces=forces,
        linear_solves=flow.linear_solves,
    )


def measure_glide_factor(law: CreepLaw, slip_ratio: float) -> float:
    """Ratio of snow pressures on a rigid wall with and without sliding.

    Parameters
    ----------
    law : CreepLaw
        Creep law.
    slip_ratio : float
        Slip length over snow thickness [-].

    Returns
    -------
    float
        N [-].

    Raises
    ------
    SolveError
        If one of the two scenes has no solution.
    """
    sliding = GroundLaw(kind="sliding", slip_length=slip_ratio * _THICKNESS)
    rough = GroundLaw(kind="no-slip")
    return _wall_force(law, sliding) / _wall_force(law, rough)


def _wall_force(law: CreepLaw, ground: GroundLaw) -> float:
    scene = Scene(
        snowpack=Snowpack(
            slope_angle=_SLOPE_ANGLE,
            thickness=_THICKNESS,
            upslope_length=_UPSLOPE_LENGTH,
            density=_DENSITY,
        ),
        ground=ground,
        net=Wall(height_normal=_THICKNESS),
        creep_law=law,
    )
    return require_solved(solve_rigid(scene, _FINE)).force.x
