"""State of the flow, and its contact: where snow sticks, slips, or lets go.

Theory: snow/THEORY.md, eqs (N14) and (N15). Components of the unknowns of a net node
are (normal, tangential); pressures and shears are forces of the snow on its support.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask, freeze
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh

# A node is released only when its shear exceeds the friction by this share of it.
_RELEASE_MARGIN = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Contact:
    """State of every support node but the foot, which is always held.

    Attributes
    ----------
    sign : ndarray of int, shape (n_net - 1,)
        Direction of slip towards the head (+1) or the foot (-1); 0 sticks.
    is_pressed : ndarray of bool, shape (n_net - 1,)
        The snow presses on the net there; only then is there friction.
    is_open : ndarray of bool, shape (n_net - 1,)
        The snow has let go of a one-sided net.
    is_lifted : ndarray of bool, shape (n_ground - 1,)
        The snow has let go of a one-sided ground.
    """

    sign: Ints
    is_pressed: Mask
    is_open: Mask
    is_lifted: Mask

    @property
    def slip_share(self) -> float:
        """Share of the net's nodes on which the snow slips [-]."""
        return float(np.count_nonzero(self.sign) / self.sign.size)

    def equals(self, other: Contact) -> bool:
        """Same state at every node (pressure alone does not count)."""
        return (
            np.array_equal(self.sign, other.sign)
            and np.array_equal(self.is_open, other.is_open)
            and np.array_equal(self.is_lifted, other.is_lifted)
        )


def start_contact(mesh: PlacedMesh) -> Contact:
    """Everything held: the snow sticks to the net and lies on the ground."""
    n_net, n_ground = mesh.template.net.size - 1, mesh.template.ground.size - 1
    return Contact(
        sign=np.zeros(n_net, dtype=np.int64),
        is_pressed=np.ones(n_net, dtype=bool),
        is_open=np.zeros(n_net, dtype=bool),
        is_lifted=np.zeros(n_ground, dtype=bool),
    )


def update_contact(
    problem: FlowProblem,
    mesh: PlacedMesh,
    contact: Contact,
    velocity: Floats,
    reaction: Floats,
) -> Contact:
    """State that follows from the last velocities and reactions.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    contact : Contact
        State under which both were found.
    velocity, reaction : ndarray, shape (n_dofs,)
        Unknowns of the last iterate, and forces of net and ground on the snow, in node
        axes [velocity scale, rho g d^2].
    """
    normal, tangential = net_components(mesh)
    pressure = -reaction[normal]
    is_open = contact.is_open
    if problem.net_contact == "one-sided":
        is_open = _let_go(is_open, pressure, velocity[normal])
    is_lifted = contact.is_lifted
    if problem.ground_contact == "one-sided":
        upward = 2 * mesh.template.ground[1:] + 1
        is_lifted = _let_go(is_lifted, reaction[upward], -velocity[upward])
        is_lifted &= may_lift(mesh.template)
    return Contact(
        sign=_update_slip(
            problem, contact, pressure, -reaction[tangential], velocity[tangential]
        ),
        is_pressed=(pressure > 0.0) & ~is_open,
        is_open=is_open,
        is_lifted=is_lifted,
    )


@lru_cache(maxsize=256)
def may_lift(template: MeshTemplate) -> Mask:
    """Ground nodes where a one-sided ground can let go.

    Not within a thickness of the upslope end: the snowpack goes on there, only the
    calculation ends, and its free end would rock on the ground.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.

    Returns
    -------
    ndarray of bool, shape (n_ground - 1,)
        Of the ground's nodes but the foot.
    """
    end = max(template.aspect - 1.0, template.aspect / 2.0)
    return freeze(template.nodes[0, template.ground[1:]] < end)


def change_some(contact: Contact, wanted: Contact, *, only_first: bool) -> Contact:
    """Contact with some of the wanted changes, friction of slipping nodes included.

    Where changing every node at once goes round in circles, changing the first half
    of each row of neighbours rarely does, and changing a single node on the net and
    one on the ground, the first (Murty's rule), hardly ever.

    Parameters
    ----------
    contact, wanted : Contact
        As it is, and as the last iterate asks for.
    only_first : bool
        Only the first change on the net, and the first on the ground.
    """
    sign, is_open = contact.sign.copy(), contact.is_open.copy()
    is_pressed = contact.is_pressed.copy()
    slips = (sign != 0) & (wanted.sign != 0)
    changes = (
        (sign != wanted.sign)
        | (is_open != wanted.is_open)
        | (slips & (is_pressed != wanted.is_pressed))
    )
    chosen = _choose(changes, only_first=only_first)
    sign[chosen], is_open[chosen] = wanted.sign[chosen], wanted.is_open[chosen]
    is_pressed[chosen] = wanted.is_pressed[chosen]
    is_lifted = contact.is_lifted.copy()
    chosen = _choose(is_lifted != wanted.is_lifted, only_first=only_first)
    is_lifted[chosen] = wanted.is_lifted[chosen]
    return Contact(
        sign=sign, is_pressed=is_pressed, is_open=is_open, is_lifted=is_lifted
    )


def _choose(changes: Mask, *, only_first: bool) -> Ints:
    """Places of the first change, or of the first half of each row of changes."""
    places = np.flatnonzero(changes)
    if only_first or places.size < 2:
        return places[:1]
    rows = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    return np.concatenate([row[: (row.size + 1) // 2] for row in rows])


def free_unknowns(problem: FlowProblem, mesh: PlacedMesh, contact: Contact) -> Mask:
    """Unknowns that nothing holds.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    contact : Contact
        State of every support node.

    Returns
    -------
    ndarray of bool, shape (n_dofs,)
        True where neither net nor ground holds.
    """
    free = np.ones(mesh.n_dofs, dtype=bool)
    normal, tangential = net_components(mesh)
    foot, ground = mesh.template.ground[0], mesh.template.ground[1:]
    free[[2 * foot, 2 * foot + 1]] = False
    free[normal] = contact.is_open
    free[tangential] = contact.is_open | (contact.sign != 0)
    free[2 * ground + 1] = contact.is_lifted
    if problem.ground == "no-slip":
        free[2 * ground] = contact.is_lifted
    return free


def friction_shares(
    problem: FlowProblem, mesh: PlacedMesh, contact: Contact
) -> Floats | None:
    """Shares of the normal rows that go to the tangential rows; None if nothing.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    contact : Contact
        State of every support node.

    Returns
    -------
    ndarray, shape (n_dofs,), or None
        Not 0 at the tangential unknowns of slipping nodes [-]. With it their equation
        reads R_t = tan(phi) R_n sign, (N14).
    """
    _, tangential = net_components(mesh)
    slips = (contact.sign != 0) & contact.is_pressed
    if not slips.any() or problem.friction == 0.0:
        return None
    shares = np.zeros(mesh.n_dofs)
    shares[tangential[slips]] = -problem.friction * contact.sign[slips]
    return shares


def net_components(mesh: PlacedMesh) -> tuple[Ints, Ints]:
    """Unknowns of the net nodes above the foot.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.

    Returns
    -------
    ndarray of int, ndarray of int, shape (n_net - 1,)
        Normal and tangential unknowns.
    """
    above_foot = mesh.template.net[1:]
    return 2 * above_foot, 2 * above_foot + 1


def _update_slip(
    problem: FlowProblem,
    contact: Contact,
    pressure: Floats,
    shear: Floats,
    velocity: Floats,
) -> Ints:
    """Eq. (N14): slipping against one's sign sticks, too much shear releases."""
    if np.isinf(problem.friction):
        return np.zeros_like(contact.sign)
    limit = problem.friction * np.maximum(pressure, 0.0)
    against_sign = velocity * contact.sign <= 0.0
    exceeds = np.abs(shear) > limit * (1.0 + _RELEASE_MARGIN)
    released = np.where(exceeds & (contact.sign == 0), np.sign(shear), 0)
    with_friction = np.where(against_sign, released, contact.sign).astype(np.int64)
    if contact.is_pressed.all() and limit.all():
        return with_friction
    as_it_moves = np.where(velocity < 0.0, -1, 1)
    # snow that slid without friction goes on the way it went
    was_loose = (contact.sign != 0) & ~contact.is_pressed & (velocity != 0.0)
    keeps_friction = (limit > 0.0) & ~was_loose
    return np.where(keeps_friction, with_friction, as_it_moves)


def _let_go(is_apart: Mask, push: Floats, outward: Floats) -> Mask:
    """Eq. (N15): a held node that would pull lets go, one that moves back is held."""
    return np.where(is_apart, outward <= 0.0, push < 0.0)


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


def rest(problem: FlowProblem, mesh: PlacedMesh) -> FlowState:
    """Snow without stress or velocity, held everywhere.

    Parameters
    ----------
    problem, mesh : FlowProblem, PlacedMesh
        Ground, and mesh against the net's curve.
    """
    slides = problem.ground == "sliding"
    return FlowState(
        unknowns=np.zeros(mesh.n_dofs),
        reaction=np.zeros(mesh.n_dofs),
        stress=np.zeros((*mesh.weights.shape, 4 if mesh.is_mixed else 3)),
        base_shear=np.zeros_like(mesh.base_weights) if slides else None,
        contact=start_contact(mesh),
    )
