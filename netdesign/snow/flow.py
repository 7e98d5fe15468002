"""Velocity and stress of the snowpack at one instant, against a net at rest.

The stress, not the velocity, is iterated. The creep law gives the strain rate as a
*polynomial* of the stress. So Newton's method on the complementary energy needs fewer
steps than the usual one, whose viscosity is unbounded where the snow hardly deforms.
Every full step is in equilibrium exactly (N10). Theory: snow/THEORY.md, section 2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from operator import add
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.snow.contact import (
    Contact,
    change_some,
    free_unknowns,
    friction_shares,
    net_components,
    start_contact,
    update_contact,
)
from netdesign.snow.kernel import (
    assemble_base_force,
    assemble_body_force,
    assemble_end_load,
    assemble_stress,
    build_base_stiffness,
    build_stiffness,
    compute_base_velocity,
    compute_strain,
)
from netdesign.snow.law import (
    FlowProblem,
    Material,
    Tangent,
    advance_stress,
    linearise_creep,
    linearise_sliding,
    sample_material,
    squared_invariant,
    total_stress,
)
from netdesign.snow.linear import SingularError, solve_blocks
from netdesign.snow.ordering import Blocks, build_ordering
from netdesign.snow.placed_mesh import PlacedMesh

# Error that a Newton step leaves, (N16): a share of the step where contacts still
# change, else a multiple of its square (measured on random scenes: 95 % stay below).
_LINEAR_PART, _SQUARE_FACTOR = 0.05, 50.0
# After so many steps only some contacts change, after twice as many one at a time.
_PATIENCE = 12
# Weight of an error of the stress that the forces on the net do not feel: it sits in
# the few small triangles at the net's ends.
_FIELD_WEIGHT = 0.05


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowState:
    """One iterate, or the solution, of the flow problem.

    Attributes
    ----------
    unknowns, reaction : ndarray, shape (n_dofs,)
        Velocities (and pressures), and forces that net and ground exert on the
        snow, node axes.
    stress : ndarray, shape (n_triangles, n_points, 3 or 4)
        (xx, yy, xy); in the mixed element of the deviator, then the pressure.
    base_shear : ndarray, shape (n_edges, n_points) or None
        Shear stress on a sliding ground.
    contact : Contact
        Stick, slip and loss of contact on net and ground.
    """

    unknowns: Floats
    reaction: Floats
    stress: Floats
    base_shear: Floats | None
    contact: Contact

    def largest_velocity(self, mesh: PlacedMesh) -> float:
        """Largest velocity of all nodes.

        Parameters
        ----------
        mesh : PlacedMesh
            Of the state.

        Returns
        -------
        float
            [velocity scale].
        """
        return float(np.hypot(*mesh.to_slope_axes(self.unknowns)).max())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowResult:
    """End of a flow solve.

    Attributes
    ----------
    outcome : Outcome
        Converged, or why not.
    state : FlowState
        Usable only if converged.
    linear_solves : int
        Taken.
    change : float
        Relative error that the last step left, (N16) [-].
    """

    outcome: Outcome
    state: FlowState
    linear_solves: int
    change: float


class _Linear(NamedTuple):
    """Laws linearised about a state, and the blocks of their matrix."""

    creep: Tangent
    base: Tangent | None  # None where the ground does not slide by a law
    blocks: list[Blocks]


# A Newton step to the next state.
Step = Callable[[FlowProblem, Material, PlacedMesh, FlowState, Contact], FlowState]


def solve_flow(
    problem: FlowProblem,
    mesh: PlacedMesh,
    start: FlowState | None = None,
    *,
    tolerance: float,
    max_iterations: int = 40,
    step: Step | None = None,
) -> FlowResult:
    """Stress and velocity in equilibrium with gravity, ground and net.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    start : FlowState, optional
        State on a neighbouring placement of the same template.
    tolerance : float
        Largest relative error that the last step may leave [-]: in the sum of the
        forces on the net from its foot to any node, or 20 times that in the stress.
    max_iterations : int
        Newton steps allowed.
    step : callable, optional
        Takes the steps; default is the fast kernel.

    Returns
    -------
    FlowResult
        With outcome converged, max_iterations or nonfinite; never raises for a
        failed iteration.

    Verified by
    -----------
    tests/snow/test_flow.py, tests/verification/test_slab.py
    """
    advance = step or _advance
    material = sample_material(problem, mesh.template)
    state = start
    if state is None:
        state = _solve_linear_creep(problem, material, mesh, advance)
    solves = 0 if start is not None else 1
    outcome, change = Outcome.MAX_ITERATIONS, np.inf
    contact = state.contact
    if state.unknowns.any():
        contact = update_contact(problem, mesh, contact, state.unknowns, state.reaction)
    for iteration in range(max_iterations):
        before = state
        try:
            state = advance(problem, material, mesh, before, contact)
        except SingularError:
            outcome = Outcome.NONFINITE
            break
        solves += 1
        change = _estimate_left(problem, material, mesh, state, before, tolerance)
        if not np.isfinite(change):
            outcome = Outcome.NONFINITE
            break
        contact = update_contact(problem, mesh, contact, state.unknowns, state.reaction)
        if change < tolerance and contact.equals(state.contact):
            outcome = Outcome.CONVERGED
            break
        if iteration >= _PATIENCE:
            contact = change_some(
                state.contact, contact, only_first=iteration >= 2 * _PATIENCE
            )
    return FlowResult(outcome=outcome, state=state, linear_solves=solves, change=change)


def linearise_reaction(
    problem: FlowProblem, mesh: PlacedMesh, state: FlowState
) -> Floats:
    """Change of the snow's forces on the net where its normal velocity is prescribed.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh of the state.
    state : FlowState
        About which the flow is linearised; its contact does not change.

    Returns
    -------
    ndarray, shape (2, n_net, n_net - 1)
        Forces in the slope's axes, per velocity out of the snow at each node above
        the foot; 0 for nodes that the snow has left.

    Raises
    ------
    SingularError
        If nothing holds the snow.
    """
    material = sample_material(problem, mesh.template)
    blocks = _linearise(problem, material, mesh, state, state.contact).blocks
    matrix = reduce(add, (block.to_matrix(mesh.n_dofs) for block in blocks))
    normal, _ = net_components(mesh)
    held = np.flatnonzero(~state.contact.is_open)
    unknowns = np.zeros((mesh.n_dofs, normal.size))
    unknowns[normal[held], held] = 1.0
    unknowns += _solve_step(problem, mesh, state.contact, blocks, matrix @ unknowns)
    cosine, sine = mesh.axes[:, mesh.template.net, None]
    first = matrix[2 * mesh.template.net] @ unknowns
    second = matrix[2 * mesh.template.net + 1] @ unknowns
    return -np.array([cosine * first - sine * second, sine * first + cosine * second])


def remove_rounding(
    problem: FlowProblem, mesh: PlacedMesh, state: FlowState
) -> FlowState:
    """State whose stresses balance better, eq. (N17).

    Snow that moves far faster than it deforms, on a free ground or beside much softer
    layers, leaves the rounding of its velocities in the balance. A last correction,
    small, is added to the stresses themselves.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    state : FlowState
        A converged state.

    Raises
    ------
    SingularError
        If nothing holds the snow.
    """
    material = sample_material(problem, mesh.template)
    linear = _linearise(problem, material, mesh, state, state.contact)
    residual = compute_residual(problem, mesh, state)
    change = _solve_step(problem, mesh, state.contact, linear.blocks, residual)
    still = linear.creep._replace(intercept=np.zeros_like(state.stress))
    base_shear = state.base_shear
    if linear.base is not None and base_shear is not None:
        more = linear.base.modulus * compute_base_velocity(mesh, change)
        base_shear = base_shear + more
    return replace(
        state,
        unknowns=state.unknowns + change,
        reaction=residual + sum(block.multiply(change) for block in linear.blocks),
        stress=state.stress
        + advance_stress(problem, still, compute_strain(mesh, change)),
        base_shear=base_shear,
    )


def compute_residual(
    problem: FlowProblem, mesh: PlacedMesh, state: FlowState
) -> Floats:
    """Internal less external nodal forces: the reactions of the supports.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    state : FlowState
        With its stresses.

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    material = sample_material(problem, mesh.template)
    force = assemble_stress(mesh, total_stress(problem, state.stress))
    force -= _gravity_load(problem, material, mesh)
    if state.base_shear is not None:
        force += assemble_base_force(mesh, state.base_shear)
    return force


def compute_weight(problem: FlowProblem, mesh: PlacedMesh) -> Floats:
    """Weight of the snow on the mesh, and load on its end.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.

    Returns
    -------
    ndarray, shape (2,)
        In the slope's axes [rho g d^2].
    """
    material = sample_material(problem, mesh.template)
    weight = np.array(problem.gravity) * float((mesh.weights * material.density).sum())
    return np.asarray(weight + np.array([problem.end_load, 0.0]))


def _estimate_left(
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    state: FlowState,
    before: FlowState,
    tolerance: float,
) -> float:
    """Relative error that a step leaves, eq. (N16); of the forces alone if too much."""
    sums = _sum_along_net(mesh, state.reaction)
    moved = sums - _sum_along_net(mesh, before.reaction)
    force = _left(float(np.hypot(*moved).max() / np.hypot(*sums).max()))
    if force >= tolerance:
        return force
    size = _stress_norm(problem, material, mesh, state.stress)
    field = _stress_norm(problem, material, mesh, state.stress - before.stress) / size
    return float(np.maximum(force, _FIELD_WEIGHT * _left(field)))


def _left(change: float) -> float:
    """Relative error that a step of this relative size leaves."""
    return float(np.minimum(change, _LINEAR_PART * change + _SQUARE_FACTOR * change**2))


def _sum_along_net(mesh: PlacedMesh, reaction: Floats) -> Floats:
    """Sums of the net's forces from the foot to each node, shape (2, n_net)."""
    return np.cumsum(mesh.net_in_slope_axes(reaction), axis=1)


def _solve_linear_creep(
    problem: FlowProblem, material: Material, mesh: PlacedMesh, advance: Step
) -> FlowState:
    """Linear creep of snow held everywhere: a start that needs no guess."""
    at_rest = FlowState(
        unknowns=np.zeros(mesh.n_dofs),
        reaction=np.zeros(mesh.n_dofs),
        stress=np.zeros((*mesh.weights.shape, mesh.operator.shape[2])),
        base_shear=(
            np.zeros_like(mesh.base.weights) if problem.ground == "sliding" else None
        ),
        contact=start_contact(mesh),
    )
    linear = _make_linear(problem)
    material = sample_material(linear, mesh.template)
    return advance(linear, material, mesh, at_rest, at_rest.contact)


def _make_linear(problem: FlowProblem) -> FlowProblem:
    """The problem with linear creep, whose layers share the stress about as given.

    Layers that deform together carry stresses as their fluidities to the power -1/n.
    """
    layers = tuple(
        replace(layer, fluidity_ratio=layer.fluidity_ratio ** (1.0 / problem.exponent))
        for layer in problem.layers
    )
    return replace(problem, exponent=1.0, slip_exponent=None, layers=layers)


def _advance(
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    state: FlowState,
    contact: Contact,
) -> FlowState:
    """One Newton step on the stress, eq. (N10)."""
    creep, base, blocks = _linearise(problem, material, mesh, state, contact)
    force = assemble_stress(mesh, creep.intercept) - _gravity_load(
        problem, material, mesh
    )
    if base is not None:
        force += assemble_base_force(mesh, base.intercept)
    unknowns = _solve_step(problem, mesh, contact, blocks, force)
    base_shear = None
    if base is not None:
        base_shear = base.intercept + base.modulus * compute_base_velocity(
            mesh, unknowns
        )
    return FlowState(
        unknowns=unknowns,
        reaction=force + sum(block.multiply(unknowns) for block in blocks),
        stress=advance_stress(problem, creep, compute_strain(mesh, unknowns)),
        base_shear=base_shear,
        contact=contact,
    )


def _solve_step(
    problem: FlowProblem,
    mesh: PlacedMesh,
    contact: Contact,
    blocks: Sequence[Blocks],
    force: Floats,
) -> Floats:
    """Unknowns that balance forces (n_dofs,) or (n_dofs, m) under a contact."""
    return solve_blocks(
        build_ordering(
            mesh.template, has_pressures=problem.element == "mixed", couples_net=False
        ),
        blocks,
        force,
        free_unknowns(problem, mesh, contact),
        friction_shares(problem, mesh, contact),
        is_definite=problem.element == "velocity",
    )


def _linearise(
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    state: FlowState,
    contact: Contact,
) -> _Linear:
    """Creep and sliding about a state, under a contact."""
    creep = linearise_creep(problem, material, state.stress)
    blocks = [build_stiffness(mesh, creep.modulus)]
    base = None
    if state.base_shear is not None:
        base = _linearise_base(problem, state.base_shear, contact)
        blocks.append(build_base_stiffness(mesh, base.modulus))
    return _Linear(creep=creep, base=base, blocks=blocks)


def _linearise_base(problem: FlowProblem, shear: Floats, contact: Contact) -> Tangent:
    """Tangent of the base law; edges that have lifted wholly carry nothing."""
    tangent = linearise_sliding(problem, shear)
    if not contact.is_lifted.any():
        return tangent
    lifted = np.append(False, contact.is_lifted)
    bears = ~(lifted[:-2:2] & lifted[1::2] & lifted[2::2])[:, None]
    return Tangent(modulus=tangent.modulus * bears, intercept=tangent.intercept * bears)


def _gravity_load(problem: FlowProblem, material: Material, mesh: PlacedMesh) -> Floats:
    if isinstance(material.density, float):
        load = mesh.to_node_axes(
            np.outer(problem.gravity, mesh.load * material.density)
        )
    else:
        body_force = np.multiply.outer(np.array(problem.gravity), material.density)
        load = assemble_body_force(mesh, body_force)
    if problem.end_load:
        load += assemble_end_load(mesh, problem.end_load)
    return load


def _stress_norm(
    problem: FlowProblem, material: Material, mesh: PlacedMesh, stress: Floats
) -> float:
    size = squared_invariant(problem, material, stress)
    return float(np.sqrt((mesh.weights * size).sum()))
