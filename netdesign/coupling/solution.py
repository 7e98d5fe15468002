"""What a solve returns: forces with their error and balances, or a reason."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from netdesign.coupling.scene import Scene
from netdesign.outcome import Outcome

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class EndPull:
    """What the net pulls with on one of its ends, per metre of width [N/m].

    ``error`` is the estimated discretisation error of the vector.
    """

    x: float
    y: float
    error: float

    @property
    def size(self) -> float:
        """Tension of the net at that end [N/m]."""
        return float(np.hypot(self.x, self.y))


@dataclass(frozen=True, slots=True, kw_only=True)
class Balance:
    """Tests that every solution carries; shares are pure numbers.

    Attributes
    ----------
    weight_along_slope : float
        Of the meshed snow [N/m].
    relative_residual : float
        Force missing from the global balance, over the weight.
    friction_excess : float
        Largest shear beyond the friction limit at a node, over the weight.
    smallest_tension : float
        Of the net [N/m].
    suction_share : float
        Share of the normal force by which the snow would pull on the net.
    ground_tension_share : float
        Share of the ground's normal force by which the ground would pull.
    """

    weight_along_slope: float
    relative_residual: float
    friction_excess: float
    smallest_tension: float
    suction_share: float
    ground_tension_share: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """What a solve took; no clock, so that equal solves are equal."""

    linear_solves: int
    rounds: int
    elements: int
    degrees_of_freedom: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Solution:
    """A converged state whose balances were checked. SI units.

    Attributes
    ----------
    scene : Scene
        What was solved.
    method : str
        ``steady``.
    foot, head : EndPull
        Pulls on the net's ends.
    tension_min, tension_max : float
        Along the net [N/m].
    sag : float
        Largest distance of the net from its chord, normal to it [m].
    net_curve : ndarray, shape (2, n)
        Net nodes in the snow, foot to head [m].
    net_forces : ndarray, shape (2, n)
        Forces of the snow on them [N/m].
    net_slides : ndarray of bool, shape (n,)
        Where the snow slips on the net.
    mesh_nodes : ndarray, shape (2, n_nodes)
        [m].
    mesh_edges : ndarray, shape (2, n_edges)
        Node numbers of the triangles' edges.
    balance, cost
        See there.
    """

    scene: Scene
    method: Literal["steady"]
    foot: EndPull
    head: EndPull
    tension_min: float
    tension_max: float
    sag: float
    net_curve: Floats
    net_forces: Floats
    net_slides: NDArray[np.bool_]
    mesh_nodes: Floats
    mesh_edges: NDArray[np.int64]
    balance: Balance
    cost: Cost

    @property
    def outcome(self) -> Outcome:
        """Always converged: anything else is a ``FailedSolution``."""
        return Outcome.CONVERGED


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedSolution:
    """A solve that gave no number that may be used."""

    outcome: Outcome
    reason: str
