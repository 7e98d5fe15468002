"""Velocity and stress of the snowpack at one instant, against a net at rest.

Everything is dimensionless here: lengths in snow thicknesses d, stresses in
rho g d, strain rates in B a^((n+1)/2) (rho g d)^n. Theory: snow/THEORY.md.

The stress, not the velocity, is iterated. The creep law gives the strain rate as a
*polynomial* of the stress, so Newton's method on the complementary energy needs
about a third of the steps of the usual one, whose viscosity is unbounded where
the snow hardly deforms, and every full step is in equilibrium exactly (F5).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from netdesign.outcome import Outcome
from netdesign.snow.ground import GroundKind
from netdesign.snow.kernel import (
    PlacedMesh,
    assemble_base_force,
    assemble_base_stiffness,
    assemble_stiffness,
    assemble_stress,
    compute_base_velocity,
    compute_strain,
)
from netdesign.snow.mesh import Floats

# Stress [rho g d] below which snow creeps linearly: keeps the fluidity above zero.
# Halving it moves end forces by less than 1e-5 (tests/snow/test_flow.py).
STRESS_FLOOR = 1e-3
# A node is released only when its shear exceeds the friction by this share of it.
_RELEASE_MARGIN = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowLaw:
    """What governs one instant of flow, dimensionless.

    Attributes
    ----------
    exponent : float
        Creep exponent n [-].
    bulk_ratio : float
        a / b of the creep law [-].
    gravity : tuple of float
        Gravity over g in the slope's axes [-].
    ground : str
        Kind of base law.
    slip_ratio : float
        Slip length over thickness [-]; 0 unless the ground is sliding.
    friction : float
        tan phi of snow on net [-].
    """

    exponent: float
    bulk_ratio: float
    gravity: tuple[float, float]
    ground: GroundKind
    slip_ratio: float
    friction: float

    @property
    def metric(self) -> Floats:
        """M of eq. (F2), shape (3, 3): stress over strain rate of the linear law."""
        coupling = self.bulk_ratio - 2.0 / 3.0
        return np.array(
            [
                [2.0 + coupling, coupling, 0.0],
                [coupling, 2.0 + coupling, 0.0],
                [0.0, 0.0, 1.0],
            ]
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Contact:
    """Where the snow slips on the net; one entry per net node above the foot.

    Attributes
    ----------
    sign : ndarray of int
        Direction of slip towards the head (+1) or the foot (-1); 0 sticks.
    pressed : ndarray of bool
        The snow presses on the net there; only then is there friction.
    """

    sign: NDArray[np.int64]
    pressed: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowState:
    """One iterate, or the solution, of the flow problem.

    Attributes
    ----------
    velocity, reaction : ndarray, shape (n_dofs,)
        Velocities, and forces that net and ground exert on the snow, node axes.
    stress : ndarray, shape (n_triangles, n_points, 3)
        (xx, yy, xy).
    base_shear : ndarray, shape (n_edges, n_points) or None
        Shear stress on a sliding ground.
    contact : Contact
        Stick and slip on the net.
    """

    velocity: Floats
    reaction: Floats
    stress: Floats
    base_shear: Floats | None
    contact: Contact


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
    state = start if start is not None else _solve_linear_creep(law, mesh)
    solves = 0 if start is not None else 1
    change = np.inf
    for _ in range(max_iterations):
        contact = _update_contact(law, mesh, state)
        settled = bool(np.array_equal(contact.sign, state.contact.sign))
        state, change = _advance(law, mesh, state, contact)
        solves += 1
        if not np.isfinite(change):
            return FlowResult(
                outcome=Outcome.NONFINITE,
                state=state,
                linear_solves=solves,
                change=change,
            )
        if settled and change < tolerance:
            outcome = Outcome.CONVERGED
            break
    else:
        outcome = Outcome.MAX_ITERATIONS
    return FlowResult(outcome=outcome, state=state, linear_solves=solves, change=change)


def compute_residual(law: FlowLaw, mesh: PlacedMesh, state: FlowState) -> Floats:
    """Internal less external nodal forces (n_dofs,): the reactions of the supports."""
    force = assemble_stress(mesh, state.stress) - _gravity_load(law, mesh)
    if state.base_shear is not None:
        force += assemble_base_force(mesh, state.base_shear)
    return force


def free_components(law: FlowLaw, mesh: PlacedMesh) -> NDArray[np.bool_]:
    """Mask (n_dofs,) of velocity components that neither net nor ground hold.

    Components tangential to the net are left free here: friction decides.
    """
    free = np.ones(mesh.n_dofs, dtype=bool)
    template = mesh.template
    foot, ground = template.ground[0], template.ground[1:]
    free[2 * template.net] = False
    free[[2 * foot, 2 * foot + 1]] = False
    free[2 * ground + 1] = False
    if law.ground == "no-slip":
        free[2 * ground] = False
    return free


def _solve_linear_creep(law: FlowLaw, mesh: PlacedMesh) -> FlowState:
    """Linear creep with snow that sticks to the net: a start that needs no guess."""
    n_contacts = mesh.template.net.size - 1
    contact = Contact(
        sign=np.zeros(n_contacts, dtype=np.int64),
        pressed=np.ones(n_contacts, dtype=bool),
    )
    at_rest = FlowState(
        velocity=np.zeros(mesh.n_dofs),
        reaction=np.zeros(mesh.n_dofs),
        stress=np.zeros((*mesh.weights.shape, 3)),
        base_shear=(
            np.zeros_like(mesh.base.weights) if law.ground == "sliding" else None
        ),
        contact=contact,
    )
    return _advance(replace(law, exponent=1.0), mesh, at_rest, contact)[0]


def _advance(
    law: FlowLaw, mesh: PlacedMesh, state: FlowState, contact: Contact
) -> tuple[FlowState, float]:
    """One Newton step on the stress, eq. (F5), and its relative size."""
    moduli, kept = _linearise_creep(law, state.stress)
    matrix = assemble_stiffness(mesh, moduli)
    force = assemble_stress(mesh, kept) - _gravity_load(law, mesh)
    base = None
    if state.base_shear is not None:
        base = _linearise_sliding(law, state.base_shear)
        matrix = matrix + assemble_base_stiffness(mesh, base.modulus)
        force += assemble_base_force(mesh, base.kept)
    velocity = _solve_velocity(law, mesh, contact, matrix, force)
    stress = kept + (moduli @ compute_strain(mesh, velocity)[..., None])[..., 0]
    shear = None
    if base is not None:
        shear = base.kept + base.modulus * compute_base_velocity(mesh, velocity)
    advanced = FlowState(
        velocity=velocity,
        reaction=force + matrix @ velocity,
        stress=stress,
        base_shear=shear,
        contact=contact,
    )
    size = _stress_norm(law, mesh, stress)
    return advanced, _stress_norm(law, mesh, stress - state.stress) / size


def _linearise_creep(law: FlowLaw, stress: Floats) -> tuple[Floats, Floats]:
    """Moduli and the part of the stress that the tangent keeps, eqs (F4), (F5)."""
    metric = law.metric
    n = law.exponent
    size = _squared_size(law, stress)
    floored = size + STRESS_FLOOR**2
    share = 1.0 / (1.0 + (n - 1.0) * size / floored)
    outer = stress[..., :, None] * stress[..., None, :]
    reduction = ((n - 1.0) * share / floored)[..., None, None]
    viscosity = floored ** ((1.0 - n) / 2.0)
    moduli = viscosity[..., None, None] * (metric - reduction * outer)
    return moduli, stress * (1.0 - share)[..., None]


class _SlidingTangent(NamedTuple):
    modulus: Floats  # shape (n_edges, n_points)
    kept: Floats


def _linearise_sliding(law: FlowLaw, shear: Floats) -> _SlidingTangent:
    """Same as ``_linearise_creep`` for the scalar law of a sliding ground, (G2)."""
    n = law.exponent
    floored = shear**2 + STRESS_FLOOR**2
    share = 1.0 / (1.0 + (n - 1.0) * shear**2 / floored)
    modulus = floored ** ((1.0 - n) / 2.0) * share / law.slip_ratio
    return _SlidingTangent(modulus=modulus, kept=shear * (1.0 - share))


def _solve_velocity(
    law: FlowLaw,
    mesh: PlacedMesh,
    contact: Contact,
    matrix: sparse.csr_matrix,
    force: Floats,
) -> Floats:
    """Velocities in equilibrium with friction at its limit where the snow slips."""
    normal, tangential = _net_components(mesh)
    slips = (contact.sign != 0) & contact.pressed
    friction = sparse.csr_matrix(
        (
            -law.friction * contact.sign[slips],
            (tangential[slips], normal[slips]),
        ),
        shape=matrix.shape,
    )
    if slips.any():
        matrix = matrix + friction @ matrix
        force = force + friction @ force
    free = free_components(law, mesh)
    free[tangential[contact.sign == 0]] = False
    places = np.flatnonzero(free)
    factors = splu(
        matrix[places][:, places].tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.01,
        options={"SymmetricMode": True},
    )
    velocity = np.zeros(mesh.n_dofs)
    velocity[places] = factors.solve(-force[places])
    return velocity


def _update_contact(law: FlowLaw, mesh: PlacedMesh, state: FlowState) -> Contact:
    """Stick and slip that follow from the last velocities and reactions, (F6)."""
    normal, tangential = _net_components(mesh)
    pressure, shear = -state.reaction[normal], -state.reaction[tangential]
    velocity = state.velocity[tangential]
    limit = law.friction * np.maximum(pressure, 0.0)
    still = velocity * state.contact.sign <= 0.0
    released = np.where(
        np.abs(shear) > limit * (1.0 + _RELEASE_MARGIN), np.sign(shear), 0
    )
    stuck_or_released = np.where(state.contact.sign == 0, released, 0)
    sign = np.where(still, stuck_or_released, state.contact.sign)
    frictionless = np.where(velocity < 0.0, -1, 1)
    return Contact(
        sign=np.where(limit > 0.0, sign, frictionless).astype(np.int64),
        pressed=pressure > 0.0,
    )


def _net_components(mesh: PlacedMesh) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    above_foot = mesh.template.net[1:]
    return 2 * above_foot, 2 * above_foot + 1


def _gravity_load(law: FlowLaw, mesh: PlacedMesh) -> Floats:
    return mesh.to_node_axes(np.outer(law.gravity, mesh.load))


def _squared_size(law: FlowLaw, stress: Floats) -> Floats:
    """Squared invariant sigma . M^-1 sigma, eq. (F3)."""
    compliance = np.linalg.inv(law.metric)
    return np.asarray(((stress @ compliance) * stress).sum(axis=-1))


def _stress_norm(law: FlowLaw, mesh: PlacedMesh, stress: Floats) -> float:
    return float(np.sqrt((mesh.weights * _squared_size(law, stress)).sum()))
