"""Snow against a rigid wall or rake, and its forces on it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar, cast

import numpy as np

from netdesign.coupling.balance import check_balance, measure_balance
from netdesign.coupling.interface import (
    STEADY_ERROR,
    SupportForces,
    find_support_forces,
    measure_looseness,
    refine,
)
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import (
    Balance,
    EndPull,
    FailedSolution,
    end_solve,
    require_solved,
)
from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import (
    Outcome,
    SolveError,
    require_positive,
    require_within,
)
from netdesign.snow.contact import FlowState
from netdesign.snow.flow import solve_flow
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh
from netdesign.words.message import say

if TYPE_CHECKING:
    from netdesign.cable.net import Net


@dataclass(frozen=True, slots=True, kw_only=True)
class Wall:
    """A plane rigid surface from the origin upwards, in the place of a scene's net.

    Attributes
    ----------
    height_normal : float
        Normal to the slope [m].
    inclination : float
        From the slope normal, upper edge downslope positive [rad].
    friction_angle : float or None
        Of snow on the wall [rad]; None where the snow adheres (no velocity).
    """

    height_normal: float
    inclination: float = 0.0
    friction_angle: float | None = None
    slack: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        """Refuse values that no wall has."""
        require_positive("wall height", self.height_normal, "m")
        require_within("wall inclination", self.inclination, 0.0, math.radians(80.0))
        if self.friction_angle is not None:
            limit = math.radians(60.0)
            require_within("friction angle", self.friction_angle, 0.0, limit, "rad")

    @property
    def friction(self) -> float:
        """Tan phi [-]; infinite for adhesion."""
        angle = self.friction_angle
        return math.inf if angle is None else math.tan(angle)


def put_wall(scene: Scene, wall: Wall) -> Scene:
    """Scene whose snow a wall holds, which stands for its net wherever snow asks."""
    return replace(scene, net=cast("Net", wall))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WallSolution:
    """Snow against a rigid wall, its balances checked. SI units.

    Attributes
    ----------
    force : EndPull
        Resultant of the snow on the wall.
    wall_forces : ndarray, shape (2, n)
        Of its nodes, foot to upper edge [N/m].
    wall_slides : ndarray of bool, shape (n,)
        Where the snow slips on the wall.
    balance
        As in ``Solution``.
    """

    force: EndPull
    wall_forces: Floats
    wall_slides: Mask
    balance: Balance


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _WallState:
    """Snow against the wall on one mesh, dimensionless."""

    problem: FlowProblem
    mesh: PlacedMesh
    state: FlowState
    forces: SupportForces


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
    tests/addons/evidence/verification/test_rigid.py
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
    return WallSolution(
        force=EndPull.of_estimate(force, scene.force_scale),
        wall_forces=end.forces.on_net * scene.force_scale,
        wall_slides=np.append(False, end.state.contact.sign != 0),
        balance=balance,
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
    return _WallState(problem=problem, mesh=mesh, state=state, forces=forces)


def solve_wall(
    scene: Scene, settings: SolverSettings, *, friction_angle: float | None = None
) -> WallSolution:
    """Snow of a scene held by a wall in the place of its net, as high as the snow.

    Parameters
    ----------
    scene : Scene
        Its net gives the inclination.
    settings : SolverSettings
        Of the solve.
    friction_angle : float, optional
        Snow against wall [rad]; without one the snow adheres.

    Raises
    ------
    SolveError
        If it has no steady state.
    """
    wall = Wall(
        height_normal=scene.snowpack.thickness,
        inclination=scene.net.inclination,
        friction_angle=friction_angle,
    )
    return require_solved(solve_rigid(put_wall(scene, wall), settings))
