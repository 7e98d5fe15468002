"""Tests that every coupled state must pass before it counts as a solution."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from netdesign.coupling.interface import SupportForces
from netdesign.coupling.solution import Balance, Solution
from netdesign.errors import SolveError
from netdesign.outcome import Outcome
from netdesign.snow.flow import compute_weight
from netdesign.snow.kernel import PlacedMesh
from netdesign.snow.law import FlowLaw
from netdesign.words.message import Message, say

Floats = NDArray[np.float64]

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
    law: FlowLaw,
    mesh: PlacedMesh,
    forces: SupportForces,
    held: Floats,
    tension: Floats | None,
    force_scale: float,
) -> Balance:
    """Balance of a state, whose forces are scaled by ``force_scale`` [N/m].

    ``held`` is the sum of the net's end pulls, or the wall's force, shape (2,);
    ``tension`` holds all tensions of the net, None for a wall.
    """
    weight = compute_weight(law, mesh)
    size = float(np.hypot(*weight))
    missing = weight - forces.on_ground - held
    normal, tangential = _net_components(mesh, forces.on_net)
    pressed = np.maximum(normal, 0.0)
    excess = np.zeros(1)
    if np.isfinite(law.friction):
        excess = np.abs(tangential) - law.friction * pressed
    return Balance(
        weight_along_slope=float(weight[0]) * force_scale,
        relative_residual=max(float(np.hypot(*missing)), forces.unbalanced) / size,
        friction_excess=max(0.0, float(excess.max())) / size,
        smallest_tension=(
            None if tension is None else float(tension.min()) * force_scale
        ),
        suction_share=measure_suction(mesh, forces.on_net),
        ground_tension_share=negative_share(forces.ground_normal),
    )


def measure_suction(mesh: PlacedMesh, on_net: Floats) -> float:
    """What forces (2, n_net) pull on the net, over what they press [-]."""
    return negative_share(_net_components(mesh, on_net)[0])


def check_balance(
    balance: Balance, tolerance: float, *, friction_tolerance: float | None = None
) -> None:
    """Refuse a state that is not in balance, or that hangs on what cannot hold it.

    ``friction_tolerance`` is how far the contact was iterated; the other figures keep
    ``tolerance``.

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
    """Sum of negative entries over the sum of positive ones, from 0 to 1.

    1 where they pull as much as they press, or more: also where nothing presses.
    """
    positive = float(np.maximum(forces, 0.0).sum())
    negative = float(np.maximum(-forces, 0.0).sum())
    if negative == 0.0:
        return 0.0
    return negative / positive if negative < positive else 1.0
