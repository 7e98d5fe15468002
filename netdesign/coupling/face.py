"""Snow's face on the net or wall: pressure and shear from the forces of its nodes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from netdesign.coupling.solution import Solution, WallSolution
from netdesign.numerics.arrays import Floats, Mask


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
    """Snow's face on the net or wall, and what the snow does to it.

    Attributes
    ----------
    points, forces : ndarray, shape (2, n)
        Foot to head [m], [N/m].
    slides : ndarray of bool, shape (n,)
        Where the snow slips.
    friction : float or None
        Tangent of the friction angle [-]; None if the snow adheres.
    is_quadratic : bool
        Every second point is the midpoint of an edge.
    """

    points: Floats
    forces: Floats
    slides: Mask
    friction: float | None
    is_quadratic: bool

    @property
    def inner(self) -> slice:
        """Nodes between the ends: at those the pressure is singular."""
        return slice(2, -2) if self.is_quadratic else slice(1, -1)

    @property
    def tractions(self) -> tuple[Floats, Floats]:
        """Pressure and shear of the nodes, foot to head positive [Pa]."""
        along = _bisect(self.points)
        normal = np.array([along[1], -along[0]])
        shares = self._lengths()
        return (
            (self.forces * normal).sum(axis=0) / shares,
            (self.forces * along).sum(axis=0) / shares,
        )

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


def find_face(solution: Solution | WallSolution) -> Face:
    """Face of a solution's net or wall, without a free end above the snow."""
    scene = solution.scene
    friction = scene.net.friction
    adheres = math.isinf(friction)
    if isinstance(solution, WallSolution):
        return Face(
            points=solution.wall_nodes,
            forces=solution.wall_forces,
            slides=solution.wall_slides,
            friction=None if adheres else friction,
            is_quadratic=True,
        )
    return find_net_face(solution, friction)


def find_net_face(net: NetState, friction: float | None) -> Face:
    """Face of the snow on a net, without the net's free end above it.

    Parameters
    ----------
    net : NetState
        From a solution.
    friction : float or None
        Tangent of the friction angle [-]; None where only forces are asked for.
    """
    count = net.net_slides.size
    return Face(
        points=net.net_curve[:, :count],
        forces=net.net_forces[:, :count],
        slides=net.net_slides,
        friction=friction,
        is_quadratic=net.method == "steady",
    )
