"""Forces that pass from the snow to the net and to the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.coupling.refine import Looseness
from netdesign.numerics.arrays import Floats
from netdesign.snow.contact import (
    Contact,
    FlowState,
    free_unknowns,
    may_lift,
    net_components,
)
from netdesign.snow.flow import compute_weight
from netdesign.snow.flow_step import compute_residual, remove_rounding
from netdesign.snow.law import FlowProblem
from netdesign.snow.placed_mesh import PlacedMesh

# Forces left on free nodes, over the weight, that are more than rounding elsewhere.
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportForces:
    """Forces of the snow on what holds it, in the slope's axes [rho g d^2].

    Attributes
    ----------
    on_net : ndarray, shape (2, n_net)
        Nodal forces on the net, foot to head.
    on_ground : ndarray, shape (2,)
        Resultant on the ground.
    ground_normal : ndarray, shape (n,)
        Downward nodal forces on the ground where it may let go: without the node at
        the foot and the last thickness upslope.
    unbalanced : float
        Norm of the forces left on nodes that nothing holds [rho g d^2].
    """

    on_net: Floats
    on_ground: Floats
    ground_normal: Floats
    unbalanced: float


def find_support_forces(
    problem: FlowProblem, mesh: PlacedMesh, state: FlowState
) -> tuple[FlowState, SupportForces]:
    """Forces of a converged flow; its rounding is removed first where it shows.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    state : FlowState
        A converged flow.

    Raises
    ------
    SingularError
        If nothing holds the snow.
    """
    forces = compute_support_forces(problem, mesh, state)
    if is_balanced(problem, mesh, forces):
        return state, forces
    mended = remove_rounding(problem, mesh, state)
    return mended, compute_support_forces(problem, mesh, mended)


def is_balanced(problem: FlowProblem, mesh: PlacedMesh, forces: SupportForces) -> bool:
    """No force is left on free nodes but rounding.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    forces : SupportForces
        Of a converged flow.
    """
    weight = float(np.hypot(*compute_weight(problem, mesh)))
    return forces.unbalanced <= _ROUNDING * weight


def compute_support_forces(
    problem: FlowProblem, mesh: PlacedMesh, state: FlowState
) -> SupportForces:
    """Forces on net and ground, from the stresses of the snow alone.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    state : FlowState
        With its stresses.
    """
    residual = compute_residual(problem, mesh, state)
    supports = -mesh.to_slope_axes(residual)
    template = mesh.template
    on_net = share_net_forces(problem, mesh, residual)
    ground = supports[:, template.ground[1:]]
    on_ground = ground.sum(axis=1) + supports[:, template.net[0]] - on_net[:, 0]
    if problem.ground != "no-slip":
        on_ground[0] = 0.0
    if state.base_shear is not None:
        on_ground[0] = float((mesh.base_weights * state.base_shear).sum())
    free = free_unknowns(problem, mesh, state.contact)
    free[net_components(mesh)[1]] = False  # friction, tested on its own
    free[mesh.n_velocities :] = False
    return SupportForces(
        on_net=on_net,
        on_ground=on_ground,
        ground_normal=-ground[1, may_lift(template)],
        unbalanced=float(np.linalg.norm(residual[free])),
    )


def share_net_forces(
    problem: FlowProblem, mesh: PlacedMesh, reaction: Floats
) -> Floats:
    """Forces on the net of reactions, the foot's corner shared.

    The corner node is held by net and ground. Along a ground without reactions at
    nodes (free or sliding) its X-force is all the net's; what else the net takes
    there follows from the next node: a quarter of a midpoint's force, as under uniform
    traction. The share is one corner element wide; coupling/THEORY.md, section 3.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    reaction : ndarray, shape (n_dofs,)
        Of net and ground on the snow, node axes [rho g d^2].

    Returns
    -------
    ndarray, shape (2, n_net)
        In the slope's axes, foot to head [rho g d^2].
    """
    on_net = -mesh.net_in_slope_axes(reaction)
    corner = on_net[:, 0].copy()
    on_net[:, 0] = on_net[:, 1] / 4.0
    if problem.ground != "no-slip":
        on_net[0, 0] = corner[0]
    return on_net


def measure_looseness(contact: Contact) -> Looseness:
    """Slip along the net and loss of contact of a state.

    Parameters
    ----------
    contact : Contact
        On net and ground.
    """
    lifts = contact.is_lifted.any() or contact.is_open.any()
    return Looseness(slip=contact.slip_share, lifts=bool(lifts))
