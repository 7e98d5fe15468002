"""Velocity and stress of the snowpack at one instant, against a net at rest.

The stress, not the velocity, is iterated. The creep law gives the strain rate as a
*polynomial* of the stress, so Newton's method on the complementary energy needs
about a third of the steps of the usual one, whose viscosity is unbounded where
the snow hardly deforms, and every full step is in equilibrium exactly (F5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from netdesign.outcome import Outcome
from netdesign.snow.contact import (
    Contact,
    free_unknowns,
    friction_rows,
    start_contact,
    update_contact,
)
from netdesign.snow.kernel import (
    PlacedMesh,
    assemble_base_force,
    assemble_base_stiffness,
    assemble_body_force,
    assemble_stiffness,
    assemble_stress,
    compute_base_velocity,
    compute_strain,
)
from netdesign.snow.law import (
    FlowLaw,
    Material,
    Tangent,
    advance_stress,
    linearise_creep,
    linearise_sliding,
    sample_material,
    squared_size,
    total_stress,
)
from netdesign.snow.mesh import Floats


class _SingularError(Exception):
    """The linear problem of a step has no solution; ends the iteration."""


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
        """Of all nodes, dimensionless."""
        return float(np.hypot(*mesh.to_slope_axes(self.unknowns)).max())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowResult:
    """End of a flow solve; ``state`` is usable only if converged."""

    outcome: Outcome
    state: FlowState
    linear_solves: int
    change: float  # relative change of the stress in the last step [-]


def solve_flow(
    law: FlowLaw,
    mesh: PlacedMesh,
    start: FlowState | None = None,
    *,
    tolerance: float,
    max_iterations: int = 40,
) -> FlowResult:
    """Stress and velocity in equilibrium with gravity, ground and net.

    Parameters
    ----------
    law : FlowLaw
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    start : FlowState, optional
        State on a neighbouring placement of the same template.
    tolerance : float
        Largest relative change of the stress in the last step [-].
    max_iterations : int
        Newton steps allowed.

    Returns
    -------
    FlowResult
        With outcome converged, max_iterations or nonfinite; never raises for a
        failed iteration.

    Verified by
    -----------
    tests/snow/test_flow.py, tests/verification/test_slab.py
    """
    material = sample_material(law, mesh.template)
    state = start
    if state is None:
        state = _solve_linear_creep(law, material, mesh)
    solves = 0 if start is not None else 1
    outcome, change = Outcome.MAX_ITERATIONS, np.inf
    for _ in range(max_iterations):
        contact = update_contact(
            law, mesh, state.contact, state.unknowns, state.reaction
        )
        settled = contact.equals(state.contact)
        try:
            state, change = _advance(law, material, mesh, state, contact)
        except _SingularError:
            outcome = Outcome.NONFINITE
            break
        solves += 1
        if not np.isfinite(change):
            outcome = Outcome.NONFINITE
            break
        if settled and change < tolerance:
            outcome = Outcome.CONVERGED
            break
    return FlowResult(outcome=outcome, state=state, linear_solves=solves, change=change)


def compute_residual(law: FlowLaw, mesh: PlacedMesh, state: FlowState) -> Floats:
    """Internal less external nodal forces (n_dofs,): the reactions of the supports."""
    material = sample_material(law, mesh.template)
    force = assemble_stress(mesh, total_stress(law, state.stress))
    force -= _gravity_load(law, material, mesh)
    if state.base_shear is not None:
        force += assemble_base_force(mesh, state.base_shear)
    return force


def compute_weight(law: FlowLaw, mesh: PlacedMesh) -> Floats:
    """Weight of the snow on the mesh, shape (2,) [rho g d^2]."""
    material = sample_material(law, mesh.template)
    return np.array(law.gravity) * float((mesh.weights * material.density).sum())


def _solve_linear_creep(
    law: FlowLaw, material: Material, mesh: PlacedMesh
) -> FlowState:
    """Linear creep of snow held everywhere: a start that needs no guess."""
    at_rest = FlowState(
        unknowns=np.zeros(mesh.n_dofs),
        reaction=np.zeros(mesh.n_dofs),
        stress=np.zeros((*mesh.weights.shape, mesh.operator.shape[2])),
        base_shear=(
            np.zeros_like(mesh.base.weights) if law.ground == "sliding" else None
        ),
        contact=start_contact(mesh),
    )
    linear = replace(law, exponent=1.0)
    return _advance(linear, material, mesh, at_rest, at_rest.contact)[0]


def _advance(
    law: FlowLaw,
    material: Material,
    mesh: PlacedMesh,
    state: FlowState,
    contact: Contact,
) -> tuple[FlowState, float]:
    """One Newton step on the stress, eq. (F5), and its relative size."""
    tangent = linearise_creep(law, material, state.stress)
    matrix = assemble_stiffness(mesh, tangent.modulus)
    force = assemble_stress(mesh, tangent.kept) - _gravity_load(law, material, mesh)
    base = None
    if state.base_shear is not None:
        base = _linearise_base(law, state.base_shear, contact)
        matrix = matrix + assemble_base_stiffness(mesh, base.modulus)
        force += assemble_base_force(mesh, base.kept)
    unknowns = _solve_unknowns(law, mesh, contact, matrix, force)
    stress = advance_stress(law, tangent, compute_strain(mesh, unknowns))
    base_shear = None
    if base is not None:
        base_shear = base.kept + base.modulus * compute_base_velocity(mesh, unknowns)
    advanced = FlowState(
        unknowns=unknowns,
        reaction=force + matrix @ unknowns,
        stress=stress,
        base_shear=base_shear,
        contact=contact,
    )
    size = _stress_norm(law, material, mesh, stress)
    return advanced, _stress_norm(law, material, mesh, stress - state.stress) / size


def _linearise_base(law: FlowLaw, shear: Floats, contact: Contact) -> Tangent:
    """Tangent of the base law; edges that have lifted wholly carry nothing."""
    tangent = linearise_sliding(law, shear)
    if not contact.is_lifted.any():
        return tangent
    lifted = np.append(False, contact.is_lifted)
    bears = ~(lifted[:-2:2] & lifted[1::2] & lifted[2::2])[:, None]
    return Tangent(modulus=tangent.modulus * bears, kept=tangent.kept * bears)


def _solve_unknowns(
    law: FlowLaw,
    mesh: PlacedMesh,
    contact: Contact,
    matrix: sparse.csr_matrix,
    force: Floats,
) -> Floats:
    """Unknowns in equilibrium, with friction at its limit where the snow slips."""
    friction = friction_rows(law, mesh, contact)
    if friction is not None:
        matrix = matrix + friction @ matrix
        force = force + friction @ force
    places = np.flatnonzero(free_unknowns(law, mesh, contact))
    try:
        factors = splu(
            matrix[places][:, places].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.01,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:  # how SuperLU tells of a singular matrix
        raise _SingularError(str(error)) from None
    unknowns = np.zeros(mesh.n_dofs)
    unknowns[places] = factors.solve(-force[places])
    return unknowns


def _gravity_load(law: FlowLaw, material: Material, mesh: PlacedMesh) -> Floats:
    if isinstance(material.density, float):
        return mesh.to_node_axes(np.outer(law.gravity, mesh.load * material.density))
    body_force = np.multiply.outer(np.array(law.gravity), material.density)
    return assemble_body_force(mesh, body_force)


def _stress_norm(
    law: FlowLaw, material: Material, mesh: PlacedMesh, stress: Floats
) -> float:
    size = squared_size(law, material, stress)
    return float(np.sqrt((mesh.weights * size).sum()))
