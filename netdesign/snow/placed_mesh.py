"""A mesh whose nodes have been placed, with all that depends on the place.

Unknowns are velocities in node axes: (normal, tangential) to the net at its nodes and
(X, Y) elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, freeze, gather
from netdesign.snow.element import (
    Element,
    add_pressure_rows,
    build_strain_operator,
    find_once,
    list_dofs,
    map_gradients,
    reference_element,
)
from netdesign.snow.mesh import MeshTemplate, edge_triples

_EDGE_POINTS, EDGE_WEIGHTS = np.polynomial.legendre.leggauss(4)
# Quadratic shape functions (n_points, 3) of an edge's start, middle and end, and their
# derivatives; weighted products of the two (3, 3).
EDGE_SHAPE = np.column_stack(
    [
        _EDGE_POINTS * (_EDGE_POINTS - 1.0) / 2.0,
        1.0 - _EDGE_POINTS**2,
        _EDGE_POINTS * (_EDGE_POINTS + 1.0) / 2.0,
    ]
)
_EDGE_SLOPE = np.column_stack(
    [_EDGE_POINTS - 0.5, -2.0 * _EDGE_POINTS, _EDGE_POINTS + 0.5]
)
EDGE_TANGENT = (EDGE_WEIGHTS[:, None] * EDGE_SHAPE).T @ _EDGE_SLOPE


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedMesh:
    """A template whose nodes have been placed, with all that depends on the place.

    The number of rows R is 3 for the velocity element, whose generalised strains are
    (xx, yy, xy), and 4 for the mixed one, which adds the pressure. The number of
    columns C is 12, or 15 with the three vertex pressures.

    Attributes
    ----------
    template : MeshTemplate
        The reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions in the slope's axes [thickness].
    weights : ndarray, shape (n_triangles, n_points)
        Quadrature weights times the area element.
    gradients : ndarray, shape (2, n_triangles, n_points, 6)
        Of the shape functions, slope's axes [1 / thickness].
    dofs : ndarray, shape (n_triangles, C)
        Unknowns of each triangle.
    load : ndarray, shape (n_nodes,)
        Integral of each shape function: nodal share of a unit body force.
    net_normal : ndarray, shape (2, n_net)
        Unit normals of the net's nodes, pointing out of the snow.
    axes : ndarray, shape (2, n_nodes)
        Cosine and sine of the first node axis; (1, 0) away from the net and at its
        foot, which is held in both directions.
    """

    template: MeshTemplate
    nodes: Floats
    weights: Floats
    gradients: Floats
    dofs: Ints
    load: Floats
    net_normal: Floats
    axes: Floats

    @property
    def area(self) -> float:
        """Area of the snowpack [thickness^2]."""
        return float(self.weights.sum())

    @property
    def is_valid(self) -> bool:
        """No triangle is turned over or without area."""
        return bool(np.isfinite(self.weights).all() and self.weights.min() > 0)

    @property
    def n_velocities(self) -> int:
        """Number of velocity components, constrained ones included."""
        return 2 * int(self.nodes.shape[1])

    @property
    def n_dofs(self) -> int:
        """Number of unknowns, constrained ones included."""
        return self.n_velocities + (self.template.n_vertices if self.is_mixed else 0)

    @property
    def is_mixed(self) -> bool:
        """Its element has pressures."""
        return bool(self.dofs.shape[1] > 12)

    @cached_property
    def operator(self) -> Floats:
        """Generalised strains per unknown, shape (n_triangles, n_points, R, C)."""
        operator = build_strain_operator(self.template, self.gradients, self.axes)
        return add_pressure_rows(operator) if self.is_mixed else operator

    def to_node_axes(self, vectors: Sequence[Floats] | Floats) -> Floats:
        """Vectors as unknowns.

        Parameters
        ----------
        vectors : ndarray, shape (2, n_nodes), or two of them
            In the slope's axes, any unit.

        Returns
        -------
        ndarray, shape (n_dofs,)
            Unknowns in node axes; pressures are 0.
        """
        cosine, sine = self.axes
        x, y = vectors
        unknowns = np.zeros(self.n_dofs)
        unknowns[: self.n_velocities : 2] = cosine * x + sine * y
        unknowns[1 : self.n_velocities : 2] = -sine * x + cosine * y
        return unknowns

    def to_slope_axes(self, unknowns: Floats) -> Floats:
        """Unknowns as vectors.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            In node axes, any unit.

        Returns
        -------
        ndarray, shape (2, n_nodes)
            In the slope's axes.
        """
        return _turn(self.axes, *unknowns[: self.n_velocities].reshape(-1, 2).T)

    def net_in_slope_axes(self, unknowns: Floats) -> Floats:
        """Vectors of the net's nodes.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            In node axes, any unit.

        Returns
        -------
        ndarray, shape (2, n_net)
            In the slope's axes, foot to head.
        """
        net = self.template.net
        pairs = unknowns[: self.n_velocities].reshape(-1, 2)[net]
        return _turn(self.axes[:, net], *pairs.T)

    @property
    def base_dofs(self) -> Ints:
        """Unknowns along the ground of its edges' nodes, shape (n_edges, 3)."""
        return _list_edges(self.template)[1]

    @cached_property
    def base_weights(self) -> Floats:
        """Weights of the quadrature on the ground, shape (n_edges, n_points)."""
        ends = self.nodes[0, self.template.ground[::2]]
        half = np.abs(ends[1:] - ends[:-1]) / 2.0
        return np.asarray(half[:, None] * EDGE_WEIGHTS)


def _turn(axes: Floats, first: Floats, second: Floats) -> Floats:
    """Components along node axes (2, n) to those in the slope's axes."""
    cosine, sine = axes
    return np.array([cosine * first - sine * second, sine * first + cosine * second])


def build_placed_mesh(
    template: MeshTemplate, nodes: Floats, element: Element = "velocity"
) -> PlacedMesh:
    """Everything that assembly needs on placed nodes.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions [thickness].
    element : str
        ``velocity`` or ``mixed``.
    """
    gradients, area_element = map_gradients(template, nodes)
    shape, _, point_weights = reference_element()
    weights = area_element * point_weights
    net_normal = _net_normals(template, nodes)
    axes = np.zeros_like(nodes)
    axes[0] = 1.0
    axes[:, template.net[1:]] = net_normal[:, 1:]
    return PlacedMesh(
        template=template,
        nodes=nodes,
        weights=weights,
        gradients=gradients,
        dofs=list_dofs(template, element),
        load=gather(template.triangles.T, weights @ shape, nodes.shape[1]),
        net_normal=net_normal,
        axes=axes,
    )


def _net_normals(template: MeshTemplate, nodes: Floats) -> Floats:
    """Unit normals, each the normal integrated with the node's shape function."""
    shares = nodes[:, _list_edges(template)[0]] @ EDGE_TANGENT.T
    tangents = np.zeros((2, template.net.size))
    tangents[:, :-2:2] = shares[..., 0]
    tangents[:, 1::2] = shares[..., 1]
    tangents[:, 2::2] += shares[..., 2]
    along, up = tangents / np.hypot(*tangents)
    return np.array([up, -along])


def turn_normals(mesh: PlacedMesh) -> Floats:
    """Angle by which each net node's normal turns as net nodes move.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.

    Returns
    -------
    ndarray, shape (n_net, 2, n_net)
        Counter-clockwise [rad per thickness].
    """
    weights = _weigh_tangents(mesh.template.net.size)
    tangent = mesh.nodes[:, mesh.template.net] @ weights.T
    unit = tangent / (tangent**2).sum(axis=0)
    return np.stack([-unit[1][:, None] * weights, unit[0][:, None] * weights], axis=1)


@lru_cache(maxsize=32)
def _weigh_tangents(count: int) -> Floats:
    """Tangents of the net integrated with the shape functions of its nodes, (n, n)."""
    weights = np.zeros((count, count))
    for first in range(0, count - 2, 2):
        weights[first : first + 3, first : first + 3] += EDGE_TANGENT
    return freeze(weights)


@find_once
def _list_edges(template: MeshTemplate) -> tuple[Ints, Ints]:
    """Starts, middles and ends (n, 3): nodes of the net, X unknowns of the ground."""
    net, ground = (
        np.column_stack(edge_triples(chain))
        for chain in (template.net, template.ground)
    )
    return net, freeze(2 * ground)
