"""Placement of a mesh by the compiled core; the same as that of ``placed_mesh.py``.

Theory: core/THEORY.md.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.core.arguments import PlacementArgument, locate_all, to_floats
from netdesign.core.library import require_sound
from netdesign.core.plan import Words, build_plan
from netdesign.numerics.arrays import Floats
from netdesign.snow.element import reference_element
from netdesign.snow.mesh import MeshTemplate, edge_triples
from netdesign.snow.shared_mesh import find_once

_POINTS = 3  # of a triangle, as ``POINTS`` of core.h


class Numbers(NamedTuple):
    """Numbers of a template's nodes as the core takes them.

    Attributes
    ----------
    triangles : ndarray of int32, shape (n_triangles, 6)
        Their nodes.
    net, ground : ndarray of int32, shape (n,)
        As in the template.
    edges : ndarray of int32, shape (n_edges, 4)
        Triangle above each edge of the ground, and places of the edge's nodes in it.
    """

    triangles: Words
    net: Words
    ground: Words
    edges: Words


class Placed(NamedTuple):
    """Arrays of a placed mesh, as ``PlacedMesh`` describes them.

    Attributes
    ----------
    weights : ndarray, shape (n_triangles, n_points)
        Quadrature weights times the area element.
    gradients : ndarray, shape (2, n_triangles, n_points, 6)
        Of the shape functions [1 / thickness].
    load : ndarray, shape (n_nodes,)
        Integral of each shape function.
    net_normal : ndarray, shape (2, n_net)
        Unit normals [-].
    axes : ndarray, shape (2, n_nodes)
        Cosine and sine of the first node axis [-].
    """

    weights: Floats
    gradients: Floats
    load: Floats
    net_normal: Floats
    axes: Floats


def place_compiled(
    library: ctypes.PyDLL, template: MeshTemplate, nodes: Floats, tangents: Floats
) -> Placed:
    """Arrays of a mesh that depend on the places of its nodes, by the core.

    Parameters
    ----------
    library : PyDLL
        The core.
    template : MeshTemplate
        Reference mesh.
    nodes : ndarray, shape (2, n_nodes)
        Positions [thickness].
    tangents : ndarray, shape (3, 3)
        Tangents of an edge integrated with its shape functions, per node [-].

    Raises
    ------
    ValueError
        If an array is not of its shape, or the element has other points.
    """
    numbers, _ = _locate_template(template)
    n_triangles, n_points = len(numbers.triangles), _POINTS
    found = Placed(
        weights=np.empty((n_triangles, n_points)),
        gradients=np.empty((2, n_triangles, n_points, 6)),
        load=np.empty(nodes.shape[1]),
        net_normal=np.empty((2, numbers.net.size)),
        axes=np.empty(nodes.shape),
    )
    nodes = to_floats(nodes, template.nodes.shape)
    results = (found.gradients, found.weights, found.load, found.axes, found.net_normal)
    argument = describe_placement(template, tangents)
    names = ("nodes", "gradients", "weights", "load", "axes", "normal")
    for name, place in zip(names, locate_all(nodes, *results), strict=True):
        setattr(argument, name, place)
    require_sound(library.nd_place(ctypes.byref(argument)))
    return found


def describe_placement(template: MeshTemplate, tangents: Floats) -> PlacementArgument:
    """A template to place as the core takes it; nodes and results come later.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    tangents : ndarray, shape (3, 3)
        As ``place_compiled`` takes them; the caller keeps it.

    Raises
    ------
    ValueError
        If the element has other points.
    """
    numbers, places = _locate_template(template)
    shape, gradients, point_weights = _reference()
    if shape.shape != (_POINTS, 6):
        raise ValueError(f"the compiled core has {_POINTS} points a triangle")
    return PlacementArgument(
        *(template.nodes.shape[1], len(numbers.triangles), numbers.net.size),
        *places,
        *locate_all(gradients, shape, point_weights, tangents),
    )


@find_once
def _locate_template(template: MeshTemplate) -> tuple[Numbers, tuple[int, ...]]:
    """Numbers of a template, and where three of its arrays are while these live."""
    numbers = number_template(template)
    arrays = (numbers.triangles, numbers.net, template.orientation)
    return numbers, tuple(locate_all(*arrays))


@lru_cache(maxsize=1)
def _reference() -> tuple[Floats, Floats, Floats]:
    """``reference_element`` in contiguous arrays, (3, 6), (6, 2, 3) and (3,)."""
    shape, gradients, weights = map(np.ascontiguousarray, reference_element())
    return shape, gradients, weights


@find_once
def number_template(template: MeshTemplate) -> Numbers:
    """Numbers of a template."""
    triangles = np.ascontiguousarray(template.triangles.T, dtype=np.int32)
    return Numbers(
        triangles=triangles,
        net=np.ascontiguousarray(template.net, dtype=np.int32),
        ground=np.ascontiguousarray(template.ground, dtype=np.int32),
        edges=_find_edges(template, triangles),
    )


def plan_template(library: ctypes.PyDLL, template: MeshTemplate) -> Words | None:
    """Plan of a template, of shape (n_words,); None where it is too large."""
    numbers = number_template(template)
    nodes = np.ascontiguousarray(template.nodes, dtype=np.float64)
    return build_plan(library, numbers.triangles, nodes, numbers.net)


def _find_edges(template: MeshTemplate, triangles: Words) -> Words:
    triples = np.column_stack(edge_triples(template.ground))
    owner = np.empty(template.nodes.shape[1], dtype=np.int64)
    owner[triangles.T] = np.arange(len(triangles))  # an edge's midpoint has one
    above = owner[triples[:, 1]]
    places = (triangles[above][:, None] == triples[..., None]).argmax(axis=2)
    return np.ascontiguousarray(np.column_stack([above, places]), dtype=np.int32)
