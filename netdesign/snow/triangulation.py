"""Triangles between points, and their six nodes: edges, their middles, the boundary.

Numbers and places are those of scikit-fem to the last digit, without its import, which
takes longer than a solve (tests/snow/test_triangulation.py compares the two).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import Outcome, SolveError
from netdesign.words.message import say

# Vertices of each edge of a triangle; reference coordinates of its six nodes.
_EDGES = ((0, 1), (1, 2), (0, 2))
NODE_PLACES = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Triangulation:
    """Triangles with their edges; vertices are numbered first, then middles of edges.

    Attributes
    ----------
    nodes : ndarray, shape (2, n_nodes)
        Coordinates, of the unit of the points.
    triangles : ndarray of int, shape (6, n_triangles)
        Vertices in ascending order, then the middles of edges 01, 12 and 02.
    edges : ndarray of int, shape (2, n_edges)
        Vertices of each edge, in ascending order.
    boundary : ndarray of int, shape (n,)
        Edges of one triangle only.
    """

    nodes: Floats
    triangles: Ints
    edges: Ints
    boundary: Ints


def load_delaunay() -> Any:
    """SciPy's triangulation: the longest import of a solve, when first asked for."""
    from scipy.spatial import Delaunay

    return Delaunay


def connect_points(points: Floats) -> Ints:
    """Delaunay's triangles between points, those without area left out.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Of any unit.

    Returns
    -------
    ndarray of int, shape (n_triangles, 3)
        Points of each triangle.

    Raises
    ------
    SolveError
        If a point is in no triangle: the mesh is too fine for its digits.
    """
    triangles = load_delaunay()(points).simplices
    # collinear boundary points may leave triangles without area
    solid = np.abs(measure_twice_areas(points[triangles])) > 1e-15
    triangles = triangles[solid]
    if np.bincount(triangles.ravel(), minlength=len(points)).min() == 0:
        # found while solving, on a mesh that the refinement asked for: an outcome
        raise SolveError(
            Outcome.OUT_OF_VALIDITY,
            say("snow.mesh_too_fine"),
        )
    return np.asarray(triangles, dtype=np.int64)


def measure_twice_areas(corners: Floats) -> Floats:
    """Signed double areas of triangles.

    Parameters
    ----------
    corners : ndarray, shape (n, 3, 2)
        Of any unit.

    Returns
    -------
    ndarray, shape (n,)
        In the square of that unit.
    """
    (x0, y0), (x1, y1), (x2, y2) = (corners[:, k].T for k in range(3))
    return np.asarray((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0))


def number_nodes(points: Floats, triangles: Ints) -> Triangulation:
    """Triangulation with its edges and nodes numbered.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Vertices.
    triangles : ndarray of int, shape (n_triangles, 3)
        Vertices of each triangle, in any order.
    """
    vertices = np.sort(triangles.T, axis=0)
    starts = np.concatenate([vertices[first] for first, _ in _EDGES])
    ends = np.concatenate([vertices[second] for _, second in _EDGES])
    keys, number, uses = np.unique(
        starts * len(points) + ends, return_inverse=True, return_counts=True
    )
    six = np.concatenate([vertices, len(points) + number.reshape(vertices.shape)])
    return Triangulation(
        nodes=_place(points, six, len(points) + len(keys)),
        triangles=six,
        edges=np.array(np.divmod(keys, len(points))),
        boundary=np.flatnonzero(uses == 1),
    )


def _place(points: Floats, triangles: Ints, count: int) -> Floats:
    """Coordinates (2, n_nodes) of all nodes, mapped from the reference triangle."""
    origin, first, second = (points.T[:, corner] for corner in triangles[:3])
    nodes = np.zeros((2, count))
    for node, (x, y) in zip(triangles, NODE_PLACES, strict=True):
        nodes[:, node] = x * (first - origin) + y * (second - origin) + origin
    return nodes
