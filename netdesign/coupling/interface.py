"""Forces that pass from the snow to the net and to the ground, and their accuracy.

Solves on finer and finer meshes go on until vectors are accurate enough.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Protocol, TypeVar

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
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
from netdesign.snow.mesh import MeshSize
from netdesign.snow.placed_mesh import PlacedMesh

State = TypeVar("State")


class Estimate(NamedTuple):
    """A vector with its estimated discretisation error.

    Attributes
    ----------
    vector : ndarray, shape (2,)
        In the unit of the solve.
    error : float
        In the same unit.
    """

    vector: Floats
    error: float


class Looseness(NamedTuple):
    """Looseness of the snow on its supports.

    Attributes
    ----------
    slip : float
        Share of the net along which the snow slips [-].
    lifts : bool
        The snow lifts off ground or net: where it does so moves with the mesh.
    """

    slip: float = 0.0
    lifts: bool = False


_FIRM = Looseness()


class ErrorModel(NamedTuple):
    """Error of the last mesh, as the meshes so far tell it, eq. (K5).

    Attributes
    ----------
    share : float
        Error over the difference of the last two [-].
    floor : float
        Relative error that is added for what no mesh sees [-].
    floor_ratio : float
        The floor of each further mesh over that before [-].
    slip_share, lift_share : float
        What is added to ``share`` where the snow slips along the whole net, and where
        it lifts off ground or net [-].
    lift_floor : float
        What is added to ``floor`` where it lifts [-].
    loose_ratio : float
        What is added to ``floor_ratio`` where it slips along the whole net or lifts
        [-].
    memory : float
        What a further mesh leaves at least of a difference: two meshes in turn may
        agree by accident [-].
    kinship : float
        Least relative error of a vector over that of the others [-].
    """

    share: float
    floor: float
    floor_ratio: float = 1.0
    slip_share: float = 0.0
    lift_share: float = 0.0
    lift_floor: float = 0.0
    loose_ratio: float = 0.0
    memory: float = 0.0
    kinship: float = 0.0

    def estimate(
        self, meshes: Sequence[Sequence[Floats]], held: Looseness = _FIRM
    ) -> list[Estimate]:
        """The last mesh's vectors with their errors.

        Parameters
        ----------
        meshes : sequence of sequence of ndarray
            The vectors, shape (2,) each, on two meshes or more from coarse to fine.
        held : Looseness
            Of the last mesh.
        """
        share = self.share + self.slip_share * held.slip + self.lift_share * held.lifts
        floor = self.floor + self.lift_floor * held.lifts
        ratio = self.floor_ratio + self.loose_ratio * max(held.slip, held.lifts)
        floor *= ratio ** (len(meshes) - 2)
        sizes = [math.hypot(*vector) for vector in meshes[-1]]
        steps = [self._remember(mesh) for mesh in zip(*meshes, strict=True)]
        pairs = list(zip(steps, sizes, strict=True))
        errors = [share * step + floor * size for step, size in pairs]
        own = zip(errors, sizes, strict=True)
        shared = self.kinship * max(
            error / size if size else 0.0 for error, size in own
        )
        return [
            Estimate(vector=vector, error=max(error, shared * size))
            for vector, error, size in zip(meshes[-1], errors, sizes, strict=True)
        ]

    def _remember(self, meshes: Sequence[Floats]) -> float:
        """Difference of the last two meshes, or the remembered part of earlier ones."""
        step = 0.0
        for coarse, fine in pairwise(meshes):
            step = max(math.hypot(*(fine - coarse)), self.memory * step)
        return step


# Of nets and walls at rest; measured on random scenes and along lines of scenes
# (netdesign bench --errors, --lines).
STEADY_ERROR = ErrorModel(
    share=0.9,
    floor=2.5e-3,
    floor_ratio=0.5,
    slip_share=0.3,
    lift_share=0.5,
    lift_floor=3e-3,
    loose_ratio=0.3,
    memory=0.45,
    kinship=0.5,
)


def refine(
    levels: Sequence[MeshSize],
    solve: Callable[[MeshSize, State | None], State],
    measure: Callable[[State], Sequence[Floats]],
    accuracy: float,
    model: ErrorModel,
    loosen: Callable[[State], Looseness] = lambda _: _FIRM,
) -> tuple[list[State], list[Estimate]]:
    """Solve level after level until two in turn agree.

    Parameters
    ----------
    levels : sequence of MeshSize
        From coarse to fine, at least two.
    solve : callable
        Level and the state on the level before to a state.
    measure : callable
        State to the vectors that matter, each shape (2,).
    accuracy : float
        Relative error allowed in each vector [-].
    model : ErrorModel
        Turns the differences of meshes into an error.
    loosen : callable, optional
        State to how loosely its snow is held.

    Returns
    -------
    list, list of Estimate
        All states, coarse to fine, and the vectors of the last. If the finest level
        does not reach the accuracy, the error says so.
    """
    states = [solve(levels[0], None)]
    meshes = [measure(states[0])]
    for level in levels[1:]:
        states.append(solve(level, states[-1]))
        meshes.append(measure(states[-1]))
        estimates = model.estimate(meshes, loosen(states[-1]))
        if all(end.error <= accuracy * math.hypot(*end.vector) for end in estimates):
            break
    return states, estimates


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


class NetState(Protocol):
    """Net of a solution, or of what an envelope keeps of one."""

    @property
    def method(self) -> str:
        """Name: ``steady``, ``transient`` or ``staggered``."""

    @property
    def net_curve(self) -> Floats:
        """Nodes from foot to head [m], shape (2, n)."""

    @property
    def net_forces(self) -> Floats:
        """Forces of the snow on the nodes [N/m], shape (2, n)."""

    @property
    def net_slides(self) -> Mask:
        """Mask of the nodes in the snow where it slips, shape (k,)."""


_SIMPSON = (1.0 / 6.0, 4.0 / 6.0)  # corner, midpoint of a quadratic edge


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Face:
    """Snow's face on the net, and what the snow does to it.

    Attributes
    ----------
    points, forces : ndarray, shape (2, n)
        Foot to head [m], [N/m].
    is_quadratic : bool
        Every second point is the midpoint of an edge.
    """

    points: Floats
    forces: Floats
    is_quadratic: bool

    @property
    def inner(self) -> slice:
        """Nodes between the ends: at those the pressure is singular."""
        return slice(2, -2) if self.is_quadratic else slice(1, -1)

    @property
    def pressures(self) -> Floats:
        """Pressures of the nodes from foot to head [Pa], shape (n,)."""
        along = _bisect(self.points)
        normal = np.array([along[1], -along[0]])
        pressure: Floats = (self.forces * normal).sum(axis=0) / self._lengths()
        return pressure

    def _lengths(self) -> Floats:
        """Length of the face that each node's force stands for [m]."""
        if not self.is_quadratic:
            halves = np.hypot(*np.diff(self.points, axis=1)) / 2.0
            return np.asarray(np.append(halves, 0.0) + np.append(0.0, halves))
        edges = np.hypot(*np.diff(self.points[:, ::2], axis=1))
        shares = np.zeros(self.points.shape[1])
        corner, middle = _SIMPSON
        shares[:-1:2] += corner * edges
        shares[2::2] += corner * edges
        shares[1::2] = middle * edges
        return shares


def _bisect(points: Floats) -> Floats:
    """Unit directions along a polygon, halfway between those of its segments."""
    segments = np.diff(points, axis=1)
    segments /= np.hypot(*segments)
    both = np.column_stack(
        [segments[:, 0], segments[:, :-1] + segments[:, 1:], segments[:, -1]]
    )
    return np.asarray(both / np.hypot(*both))


def find_net_face(net: NetState) -> Face:
    """Face of the snow on a net, without the net's free end above it.

    Parameters
    ----------
    net : NetState
        From a solution.
    """
    count = net.net_slides.size
    return Face(
        points=net.net_curve[:, :count],
        forces=net.net_forces[:, :count],
        is_quadratic=net.method == "steady",
    )
