"""Snow's face on the net: pressure from the forces of its nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

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
