"""Equations of one step of the moving snow, linearised about an iterate.

Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from netdesign.coupling.history.state import TransientProblem, TransientState
from netdesign.numerics.arrays import Floats, Ints, Mask, gather
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.body import SnowBody, build_material
from netdesign.snow.element import reference_element
from netdesign.snow.kernel import (
    assemble_base_force,
    assemble_base_stiffness,
    assemble_stiffness,
    assemble_stress,
    compute_base_velocity,
    compute_strain,
)
from netdesign.snow.law import (
    Material,
    Tangent,
    advance_stress,
    hold_stress,
    linearise_creep,
    linearise_sliding,
    squared_invariant,
    total_stress,
)
from netdesign.snow.linear import Matrix, SingularError, solve_matrix
from netdesign.snow.placed_mesh import PlacedMesh
from netdesign.snow.straight_mesh import build_straight_mesh, fold_load
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """Displacement of a step as a function of its end velocity: offset + rate v.

    Attributes
    ----------
    offset : ndarray, shape (2, n_vertices)
        [thickness].
    rate : float
        [time scale].
    guess : ndarray, shape (2, n_vertices)
        Displacement at which equilibrium is assembled [thickness].
    """

    offset: Floats
    rate: float
    guess: Floats

    @classmethod
    def of_step(cls, state: TransientState, step: float) -> Motion:
        """Motion of second order from two steps, (K6); of first order for the first.

        Parameters
        ----------
        state : TransientState
            At the step's start.
        step : float
            Duration [time scale].
        """
        if state.step == 0.0:
            still = np.zeros_like(state.moved)
            return cls(offset=still, rate=step, guess=still)
        growth = step / state.step
        return cls(
            offset=growth**2 / (1.0 + 2.0 * growth) * state.moved,
            rate=(1.0 + growth) / (1.0 + 2.0 * growth) * step,
            guess=growth * state.moved,
        )


class SnowIterate(NamedTuple):
    """Velocities, and the stresses that belong to them once converged.

    Attributes
    ----------
    unknowns : ndarray, shape (n_dofs,)
        Velocities, and pressures of the mixed element, in node axes.
    stress : ndarray, shape (n_triangles, n_points, R), or None
        None before the first iteration [rho g d].
    base_shear : ndarray, shape (n_edges, n_points), or None
        Of a ground with a shear [rho g d].
    """

    unknowns: Floats
    stress: Floats | None
    base_shear: Floats | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StepEquations:
    """The step's equations, but for stress and net.

    Attributes
    ----------
    problem, mesh, material
        Scene, mesh and creep law where equilibrium is assembled.
    bottom_fluidity_ratio : ndarray, shape (n_ground_edges, 1)
        Of the snow on the ground, over the reference.
    weight : ndarray, shape (n_dofs,)
        Nodal forces.
    free : ndarray of bool, shape (n_dofs,)
        Unknowns that nothing holds.
    net_dofs : ndarray of int, shape (2 n,)
        Unknowns of the net's nodes, X of all, then Y of all.
    top_slips : bool
        The snow's upper corner slips over the net's head.
    motion : Motion
        From velocities to displacements.
    nodes : ndarray, shape (2, n)
        The net's nodes moved by the offset.
    """

    problem: TransientProblem
    mesh: PlacedMesh
    material: Material
    bottom_fluidity_ratio: Floats
    weight: Floats
    free: Mask
    net_dofs: Ints
    top_slips: bool
    motion: Motion
    nodes: Floats

    @property
    def top(self) -> int:
        """First unknown of the snow's upper corner."""
        return 2 * int(self.mesh.template.net[-1])

    @property
    def weight_size(self) -> float:
        """Size of the whole weight."""
        return float(np.hypot(*self.mesh.to_slope_axes(self.weight).sum(axis=1)))

    def with_top(self, *, slips: bool) -> StepEquations:
        """The same equations with another upper corner.

        Parameters
        ----------
        slips : bool
            Whether the snow's upper corner slips; else it is held.
        """
        free = self.free.copy()
        free[self.top + 1] = slips
        return replace(self, free=free, top_slips=slips)

    def place_net(self, unknowns: Floats) -> Floats:
        """Net nodes as the velocities carry them.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            Velocities at the step's end [velocity scale].

        Returns
        -------
        ndarray, shape (2, n)
            [thickness].
        """
        moved = self.motion.rate * unknowns[self.net_dofs].reshape(2, -1)
        return np.asarray(self.nodes + moved)

    def hold(self, unknowns: Floats) -> Floats:
        """The unknowns, 0 where held.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            Any unit.

        Returns
        -------
        ndarray, shape (n_dofs,)
            In that unit.
        """
        return np.where(self.free, unknowns, 0.0)


class _Linear(NamedTuple):
    """Linearised equations about an iterate."""

    tangent: Tangent
    strain: Floats
    base: Tangent | None
    base_shear: Floats | None


class LinearSolution(NamedTuple):
    """Change of the unknowns, and its derivative by the forces on the net.

    Attributes
    ----------
    linear : _Linear
        The equations.
    change : ndarray, shape (n_dofs,)
        Under the forces of the last iteration.
    per_force : ndarray, shape (n_dofs, 2 n) or (n_dofs, 0)
        Per unit force on each net unknown.
    """

    linear: _Linear
    change: Floats
    per_force: Floats


def assemble_step(
    problem: TransientProblem, state: TransientState, step: float
) -> StepEquations:
    """Equations of a step.

    Parameters
    ----------
    problem : TransientProblem
        What stays the same.
    state : TransientState
        At the step's start.
    step : float
        Duration [time scale].

    Raises
    ------
    SolveError
        If the mesh folds over where equilibrium is to be assembled.
    """
    body, snow = state.body, problem.snow
    motion = Motion.of_step(state, step)
    vertices = body.vertices + motion.guess
    template = body.topology.template
    top_axis = None
    if state.top != "on-net":
        last = problem.head - vertices[:, body.topology.net[-2]]
        top_axis = np.array([last[1], -last[0]]) / np.hypot(*last)
    mesh = build_straight_mesh(template, vertices, snow.element, top_axis)
    if not mesh.is_valid:
        raise SolveError(
            Outcome.OUT_OF_VALIDITY,
            say("history.mesh_folds_in_step"),
        )
    moved = replace(body, vertices=vertices)
    material = build_material(problem.settling, snow, moved)
    fluidity = np.broadcast_to(material.fluidity_ratio, mesh.weights.shape)
    return StepEquations(
        problem=problem,
        mesh=mesh,
        material=material,
        bottom_fluidity_ratio=fluidity[body.topology.bottom, :1],
        weight=_nodal_weight(problem, mesh, body),
        free=_free_places(problem, mesh, state),
        net_dofs=np.concatenate([2 * state.carried, 2 * state.carried + 1]),
        top_slips=state.top == "slipping",
        motion=motion,
        nodes=(body.vertices + motion.offset)[:, state.carried],
    )


def solve_linear(
    equations: StepEquations, iterate: SnowIterate, forces: Floats, *, per_force: bool
) -> LinearSolution:
    """Newton step of the snow under net forces, and its change per force.

    Written for changes of the velocities: what rounding leaves of equilibrium in one
    iteration is mended in the next.

    Parameters
    ----------
    equations : StepEquations
        Of the step.
    iterate : SnowIterate
        The last one.
    forces : ndarray, shape (2, n)
        Of the net on its nodes [rho g d^2].
    per_force : bool
        The change per force is wanted, too.

    Raises
    ------
    SolveError
        If nothing holds the snow.
    """
    linear, matrix, force = _linearise(equations, iterate)
    dofs = equations.net_dofs
    rhs = np.zeros((force.size, 1 + (dofs.size if per_force else 0)))
    rhs[:, 0] = force
    rhs[dofs, 0] -= forces.ravel()
    if per_force:
        rhs[dofs, 1 + np.arange(dofs.size)] = -1.0
    solutions = _solve(equations, matrix, rhs)
    return LinearSolution(linear, solutions[:, 0], solutions[:, 1:])


def advance_iterate(
    equations: StepEquations, iterate: SnowIterate, linear: _Linear, change: Floats
) -> SnowIterate:
    """The iterate after a change of its unknowns.

    Parameters
    ----------
    equations : StepEquations
        Of the step.
    iterate : SnowIterate
        The last one.
    linear : _Linear
        The equations linearised about it.
    change : ndarray, shape (n_dofs,)
        Of its unknowns [velocity scale].
    """
    mesh, snow = equations.mesh, equations.problem.snow
    base_shear = linear.base_shear
    if linear.base is not None and base_shear is not None:
        base_velocity = compute_base_velocity(mesh, change)
        base_shear = base_shear + linear.base.modulus * base_velocity
    return SnowIterate(
        unknowns=iterate.unknowns + change,
        stress=advance_stress(
            snow, linear.tangent, linear.strain, compute_strain(mesh, change)
        ),
        base_shear=base_shear,
    )


def compute_imbalance(equations: StepEquations, iterate: SnowIterate) -> Floats:
    """Internal forces less the weight.

    Parameters
    ----------
    equations : StepEquations
        Of the step.
    iterate : SnowIterate
        With its stresses.

    Returns
    -------
    ndarray, shape (n_dofs,)
        Forces that supports and net have to give [rho g d^2]; (K7).
    """
    mesh, snow = equations.mesh, equations.problem.snow
    assert iterate.stress is not None
    residual = assemble_stress(mesh, total_stress(snow, iterate.stress))
    residual -= equations.weight
    if iterate.base_shear is not None:
        residual += assemble_base_force(mesh, iterate.base_shear)
    return residual


def measure_change(
    equations: StepEquations, old: Floats | None, new: Floats | None
) -> float:
    """Relative change of the stress, by its invariant over the body.

    Parameters
    ----------
    equations : StepEquations
        Of the step.
    old, new : ndarray, shape (n_triangles, n_points, R), or None
        Stresses [rho g d].

    Returns
    -------
    float
        [-]; 1 without one of them.
    """
    if old is None or new is None:
        return 1.0
    snow, material = equations.problem.snow, equations.material
    weights = equations.mesh.weights
    change = (weights * squared_invariant(snow, material, new - old)).sum()
    return float(
        np.sqrt(change / (weights * squared_invariant(snow, material, new)).sum())
    )


def _linearise(
    equations: StepEquations, iterate: SnowIterate
) -> tuple[_Linear, Matrix, Floats]:
    mesh, snow, stress = equations.mesh, equations.problem.snow, iterate.stress
    if stress is None:  # the first iterate is linear creep
        snow = replace(snow, exponent=1.0)
        stress = np.zeros((*mesh.weights.shape, mesh.operator.shape[2]))
    tangent = linearise_creep(snow, equations.material, stress)
    strain = compute_strain(mesh, iterate.unknowns)
    matrix = assemble_stiffness(mesh, tangent.modulus)
    force = assemble_stress(mesh, hold_stress(tangent, strain)) - equations.weight
    base, shear = _linearise_base(equations, iterate), None
    if base is not None:
        base_velocity = compute_base_velocity(mesh, iterate.unknowns)
        shear = base.intercept + base.modulus * base_velocity
        matrix = matrix + assemble_base_stiffness(mesh, base.modulus)
        force += assemble_base_force(mesh, shear)
    return _Linear(tangent, strain, base, shear), matrix, force


def _linearise_base(equations: StepEquations, iterate: SnowIterate) -> Tangent | None:
    weights, problem = equations.mesh.base.weights, equations.problem
    shear = iterate.base_shear
    if problem.snow.ground == "sliding":
        snow = problem.snow
        if shear is None:
            snow = replace(snow, exponent=1.0, slip_exponent=None)
            shear = np.zeros_like(weights)
        return linearise_sliding(snow, shear, equations.bottom_fluidity_ratio)
    if problem.base_drag > 0.0:
        drag = np.full_like(weights, problem.base_drag)
        return Tangent(modulus=drag, intercept=np.zeros_like(weights))
    return None


def _solve(equations: StepEquations, matrix: Matrix, force: Floats) -> Floats:
    mesh, snow = equations.mesh, equations.problem.snow
    friction = None
    if equations.top_slips and snow.friction > 0.0:
        # over the head the snow slips up, with friction against it (N14)
        friction = np.zeros(mesh.n_dofs)
        friction[equations.top + 1] = -snow.friction
    try:
        return solve_matrix(mesh.template, matrix, force, equations.free, friction)
    except SingularError:
        raise SolveError(Outcome.NONFINITE, say("history.nothing_holds")) from None


def _nodal_weight(
    problem: TransientProblem, mesh: PlacedMesh, body: SnowBody
) -> Floats:
    """Weight of the mass that each triangle has kept."""
    shape, _, point_weights = reference_element()
    shares = 2.0 * point_weights @ shape
    template = mesh.template
    nodal = gather(
        template.triangles.T, np.outer(body.mass, shares), mesh.nodes.shape[1]
    )
    loads = np.outer(problem.snow.gravity, fold_load(template, nodal))
    return mesh.to_node_axes(loads)


def _free_places(
    problem: TransientProblem, mesh: PlacedMesh, state: TransientState
) -> Mask:
    template = mesh.template
    free = np.ones(mesh.n_dofs, dtype=bool)
    midpoints, ground = template.net[1::2], template.ground
    free[2 * midpoints] = free[2 * midpoints + 1] = False
    free[2 * ground + 1] = False
    free[2 * ground[0]] = False
    if problem.snow.ground == "no-slip":
        free[2 * ground] = False
    if state.top != "on-net":
        free[2 * template.net[-1]] = False
        free[2 * template.net[-1] + 1] = state.top == "slipping"
    return free
