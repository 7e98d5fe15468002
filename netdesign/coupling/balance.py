"""Tests that every coupled state must pass before it counts as a solution."""

from __future__ import annotations

import numpy as np

from netdesign.coupling.interface import SupportForces
from netdesign.coupling.solution import Balance, Solution
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.flow import compute_weight
from netdesign.snow.law import FlowProblem
from netdesign.snow.placed_mesh import PlacedMesh
from netdesign.words.message import Message, say

# Share of suction on a net above which the two-sided contact is no model of it. The
# last per cent of a net below the surface may be pulled: 2.4 % was seen at most
# where snow slips on a smooth net of usual inclination.
LARGEST_SUCTION = 0.05


class SuctionError(SolveError):
    """The snow would pull on a two-sided net more than such a contact stands for.

    Attributes
    ----------
    held : Solution or None
        The state in which it would, where meshes were refined to the end.
    """

    held: Solution | None = None

    def __init__(self, share: float) -> None:
        super().__init__(
            Outcome.OUT_OF_VALIDITY,
            say("balance.suction", share=float(share), accepted=LARGEST_SUCTION),
        )


def measure_balance(
    problem: FlowProblem,
    mesh: PlacedMesh,
    forces: SupportForces,
    held: Floats,
    tension: Floats | None,
    force_scale: float,
) -> Balance:
    """Balance of a state.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    forces : SupportForces
        Of the snow on net and ground.
    held : ndarray, shape (2,)
        Sum of the net's end pulls, or the wall's force [rho g d^2].
    tension : ndarray or None
        All tensions of the net [rho g d^2]; None for a wall.
    force_scale : float
        rho g d^2 [N/m].
    """
    weight = compute_weight(problem, mesh)
    size = float(np.hypot(*weight))
    missing = weight - forces.on_ground - held
    normal, tangential = _net_components(mesh, forces.on_net)
    pressed = np.maximum(normal, 0.0)
    excess = np.zeros(1)
    if np.isfinite(problem.friction):
        excess = np.abs(tangential) - problem.friction * pressed
    return Balance(
        weight_along_slope=float(weight[0]) * force_scale,
        relative_residual=max(float(np.hypot(*missing)), forces.unbalanced) / size,
        friction_excess=max(0.0, float(excess.max())) / size,
        smallest_tension=(
            None if tension is None else float(tension.min()) * force_scale
        ),
        suction_share=negative_share(normal),
        ground_tension_share=negative_share(forces.ground_normal),
    )


def measure_suction(mesh: PlacedMesh, on_net: Floats) -> float:
    """Pull of forces on the net over their pressure.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    on_net : ndarray, shape (2, n_net)
        Forces of the snow on the net, any unit.

    Returns
    -------
    float
        [-]; 1 where they pull as much as they press, or more.
    """
    return negative_share(_net_components(mesh, on_net)[0])


def check_balance(
    balance: Balance, tolerance: float, *, friction_tolerance: float | None = None
) -> None:
    """Refuse a state that is not in balance, or that hangs on what cannot hold it.

    Theory: coupling/THEORY.md, (K1) to (K4).

    Parameters
    ----------
    balance : Balance
        Of the state.
    tolerance : float
        Largest force missing, and shear beyond the friction limit, over the weight [-].
    friction_tolerance : float, optional
        The latter, where the contact is iterated less closely [-].

    Raises
    ------
    SolveError
        With outcome ``balance_violated`` and the figure that was not met; with
        ``out_of_validity`` if the snow would have to pull on the net.
    """
    if not balance.relative_residual <= tolerance:
        _refuse(say("balance.force_missing"), balance.relative_residual, tolerance)
    allowed = tolerance if friction_tolerance is None else friction_tolerance
    if not balance.friction_excess <= allowed:
        _refuse(say("balance.shear_beyond"), balance.friction_excess, allowed)
    tension = balance.smallest_tension
    if tension is not None and not tension > 0.0:
        raise SolveError(
            Outcome.BALANCE_VIOLATED, say("balance.net_pushes", tension=float(tension))
        )

    if tension is not None and not balance.suction_share <= LARGEST_SUCTION:
        raise SuctionError(balance.suction_share)


def _refuse(what: Message, value: float, tolerance: float) -> None:
    raise SolveError(
        Outcome.BALANCE_VIOLATED,
        say("balance.violated", what=what, value=float(value), tolerance=tolerance),
    )


def _net_components(mesh: PlacedMesh, on_net: Floats) -> tuple[Floats, Floats]:
    """Normal and tangential forces on the net above its foot."""
    normal_x, normal_y = mesh.net_normal[:, 1:]
    x, y = on_net[:, 1:]
    return normal_x * x + normal_y * y, normal_x * y - normal_y * x


def negative_share(forces: Floats) -> float:
    """Sum of negative entries over the sum of positive ones.

    Parameters
    ----------
    forces : ndarray
        Any shape and unit.

    Returns
    -------
    float
        0 to 1 [-]; 1 where they pull as much as they press, or more: also where nothing
        presses.
    """
    if forces.min(initial=0.0) >= 0.0:
        return 0.0
    positive = float(np.maximum(forces, 0.0).sum())
    negative = float(np.maximum(-forces, 0.0).sum())
    return negative / positive if negative < positive else 1.0
