"""One step of the flow: laws linearised about a state, and the state that follows.

Theory: snow/THEORY.md, sections 2 and 5.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.snow.contact import (
    Contact,
    FlowState,
    free_unknowns,
    friction_shares,
)
from netdesign.snow.kernel import (
    Matrix,
    SingularError,
    assemble_base_force,
    assemble_base_stiffness,
    assemble_body_force,
    assemble_end_load,
    assemble_stiffness,
    assemble_stress,
    compute_base_velocity,
    compute_strain,
    solve_matrix,
)
from netdesign.snow.law import (
    FlowProblem,
    Material,
    Tangent,
    advance_stress,
    linearise_creep,
    linearise_sliding,
    sample_material,
    total_stress,
)
from netdesign.snow.placed_mesh import PlacedMesh


class _Linear(NamedTuple):
    """Laws linearised about a state, and their matrix."""

    creep: Tangent
    base: Tangent | None  # None where the ground does not slide by a law
    matrix: Matrix


def take_step(
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    state: FlowState,
    contact: Contact,
) -> FlowState:
    """Newton's step from a state under a contact, (N10).

    Parameters
    ----------
    problem, material, mesh : FlowProblem, Material, PlacedMesh
        Creep, ground and friction on the mesh.
    state : FlowState
        Before the step.
    contact : Contact
        Under which it is taken.

    Raises
    ------
    SingularError
        If nothing holds the snow.
    """
    creep, base, matrix = _linearise(problem, material, mesh, state, contact)
    force = assemble_stress(mesh, creep.intercept) - _gravity_load(
        problem, material, mesh
    )
    if base is not None:
        force += assemble_base_force(mesh, base.intercept)
    unknowns = _solve_step(problem, mesh, contact, matrix, force)
    base_shear = None
    if base is not None:
        base_shear = base.intercept + base.modulus * compute_base_velocity(
            mesh, unknowns
        )
    return FlowState(
        unknowns=unknowns,
        reaction=force + matrix @ unknowns,
        stress=advance_stress(problem, creep, compute_strain(mesh, unknowns)),
        base_shear=base_shear,
        contact=contact,
    )


def condense_to_net(problem: FlowProblem, mesh: PlacedMesh, state: FlowState) -> Floats:
    """Forces at the net's nodes that their velocities give, no other force on the snow.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh of the state.
    state : FlowState
        About which the flow is linearised.

    Returns
    -------
    ndarray, shape (2 n_net, 2 n_net)
        Symmetric, in node axes: both components of each node in turn.

    Raises
    ------
    SingularError
        If nothing holds the snow.
    """
    material = sample_material(problem, mesh.template)
    matrix = _linearise(problem, material, mesh, state, state.contact).matrix
    net = _list_net(mesh)
    free = free_unknowns(problem, mesh, state.contact)
    free[net] = False
    moved = np.zeros((mesh.n_dofs, net.size))
    moved[net, np.arange(net.size)] = 1.0
    moved += solve_matrix(mesh.template, matrix, matrix @ moved, free)
    return np.asarray(matrix[net] @ moved)


def linearise_reaction(
    problem: FlowProblem, mesh: PlacedMesh, contact: Contact, root: Floats
) -> Floats:
    """Change of the snow's forces on the net where its normal velocity is prescribed.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    contact : Contact
        Of the snow; it does not change.
    root : ndarray, shape (2 n_net, 2 n_net)
        As ``condense_to_net`` gives it.

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
    net = _list_net(mesh)
    held = np.flatnonzero(~contact.is_open)
    moved = np.zeros((net.size, contact.sign.size))
    moved[2 + 2 * held, held] = 1.0
    shares = friction_shares(problem, mesh, contact)
    moved += _solve_root(
        root,
        root @ moved,
        free_unknowns(problem, mesh, contact)[net],
        None if shares is None else shares[net],
    )
    first, second = (root @ moved).reshape(-1, 2, contact.sign.size).transpose(1, 0, 2)
    cosine, sine = mesh.axes[:, mesh.template.net, None]
    return -np.array([cosine * first - sine * second, sine * first + cosine * second])


def _list_net(mesh: PlacedMesh) -> Ints:
    """Unknowns of the net's nodes, (2 n_net,)."""
    net = 2 * mesh.template.net
    return np.column_stack([net, net + 1]).ravel()


def _solve_root(
    root: Floats, forces: Floats, free: Mask, shares: Floats | None
) -> Floats:
    """Unknowns of the net that balance forces (2 n_net, m); 0 where held."""
    load, matrix = -forces, root.copy()
    if shares is not None:
        load[1::2] += shares[1::2, None] * load[::2]
        matrix[1::2] += shares[1::2, None] * matrix[::2]
    solved = np.zeros_like(load)
    try:
        solved[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free])
    except np.linalg.LinAlgError as error:
        raise SingularError(str(error)) from None
    return solved


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
    change = _solve_step(problem, mesh, state.contact, linear.matrix, residual)
    still = linear.creep._replace(intercept=np.zeros_like(state.stress))
    base_shear = state.base_shear
    if linear.base is not None and base_shear is not None:
        more = linear.base.modulus * compute_base_velocity(mesh, change)
        base_shear = base_shear + more
    return replace(
        state,
        unknowns=state.unknowns + change,
        reaction=residual + linear.matrix @ change,
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


def _solve_step(
    problem: FlowProblem,
    mesh: PlacedMesh,
    contact: Contact,
    matrix: Matrix,
    force: Floats,
) -> Floats:
    """Unknowns that balance forces (n_dofs,) or (n_dofs, m) under a contact."""
    return solve_matrix(
        mesh.template,
        matrix,
        force,
        free_unknowns(problem, mesh, contact),
        friction_shares(problem, mesh, contact),
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
    matrix, base = assemble_stiffness(mesh, creep.modulus), None
    if state.base_shear is not None:
        base = linearise_base(problem, state.base_shear, contact)
        matrix = matrix + assemble_base_stiffness(mesh, base.modulus)
    return _Linear(creep=creep, base=base, matrix=matrix)


def linearise_base(problem: FlowProblem, shear: Floats, contact: Contact) -> Tangent:
    """Tangent of the base law; edges that have lifted wholly carry nothing.

    Parameters
    ----------
    problem : FlowProblem
        Ground.
    shear : ndarray, shape (n_edges, n_points)
        Shear stress on it [rho g d].
    contact : Contact
        Where the snow has let go of it.
    """
    tangent = linearise_sliding(problem, shear)
    lifted = np.append(False, contact.is_lifted)
    bears = ~(lifted[:-2:2] & lifted[1::2] & lifted[2::2])[:, None]
    return Tangent(modulus=tangent.modulus * bears, intercept=tangent.intercept * bears)


def _gravity_load(problem: FlowProblem, material: Material, mesh: PlacedMesh) -> Floats:
    if isinstance(material.density, float):
        mass = mesh.load * material.density
        load = mesh.to_node_axes(tuple(mass * part for part in problem.gravity))
    else:
        body_force = np.multiply.outer(np.array(problem.gravity), material.density)
        load = assemble_body_force(mesh, body_force)
    if problem.end_load:
        load += assemble_end_load(mesh, problem.end_load)
    return load
