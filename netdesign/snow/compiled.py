"""Mesh and laws of the snow as the compiled core takes them.

Only of the velocity element; the mixed one is taken in NumPy. The plan is the order in
which the nodes of a template are eliminated. Theory: core/THEORY.md, section 1.
"""

from __future__ import annotations

import ctypes
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from netdesign.core.arguments import (
    LawArgument,
    PlacementArgument,
    RulesArgument,
    locate,
    locate_all,
)
from netdesign.core.library import TOO_LARGE, require_sound
from netdesign.numerics.arrays import Floats
from netdesign.snow.element import find_once, reference_element
from netdesign.snow.law import FlowProblem, Material
from netdesign.snow.mesh import MeshTemplate, edge_triples
from netdesign.snow.placed_mesh import EDGE_TANGENT

Words = NDArray[np.int32]

# Triangles of a smallest part: fewer make more fronts than they save work (measured at
# 63 to 700 triangles).
LEAF = 6
_MOST_NUMBERS = 2**31 - 1  # of a factor: places in it are int32
_WORDS_PER_TRIANGLE = 40  # room for most plans; others are asked for again


def build_plan(
    library: ctypes.PyDLL, triangles: Words, nodes: Floats, net: Words
) -> Words | None:
    """Plan of a template; None where its factor would be too large for the core.

    Parameters
    ----------
    library : PyDLL
        The core.
    triangles : ndarray of int32, shape (n_triangles, 6)
        Their nodes.
    nodes : ndarray, shape (2, n_nodes)
        Reference coordinates [thickness].
    net : ndarray of int32, shape (n_net,)
        Nodes of the net, eliminated last.

    Raises
    ------
    ValueError
        If a node lies in no triangle, or a triangle has nodes that are not there.
    """
    room = _WORDS_PER_TRIANGLE * len(triangles)
    while True:
        plan = np.zeros(room, dtype=np.int32)
        code = library.nd_plan(
            nodes.shape[1],
            len(triangles),
            net.size,
            *(ctypes.c_void_p(locate(array)) for array in (triangles, nodes, net)),
            *(LEAF, _MOST_NUMBERS),
            ctypes.c_void_p(locate(plan)),
            room,
        )
        if code == TOO_LARGE:
            return None
        count = require_sound(code)
        if count <= room:
            plan = plan[:count].copy()
            plan.setflags(write=False)
            return plan
        room = count


class Described(NamedTuple):
    """A template as the core takes it.

    Attributes
    ----------
    kept : tuple of ndarray, each of any shape
        Arrays whose addresses the others are; the plan is the last.
    counts : tuple of int
        Of nodes, triangles, the net's nodes, edges on the ground.
    numbers : tuple of int
        Addresses of the nodes of triangles (n_triangles, 6), net and ground; and of
        the triangle above each edge of the ground with the places of the edge's nodes
        in it (n_edges, 4).
    plan : int
        Address of the order of the nodes.
    """

    kept: tuple[np.ndarray[Any, Any], ...]
    counts: tuple[int, int, int, int]
    numbers: tuple[int, ...]
    plan: int


@find_once
def describe_template(
    template: MeshTemplate, library: ctypes.PyDLL
) -> Described | None:
    """A template as the core takes it; None where it is too large.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    library : PyDLL
        The core.
    """
    nodes = np.ascontiguousarray(template.nodes, dtype=np.float64)
    triangles = np.ascontiguousarray(template.triangles.T, dtype=np.int32)
    net = np.ascontiguousarray(template.net, dtype=np.int32)
    plan = build_plan(library, triangles, nodes, net)
    if plan is None:
        return None
    numbers = (
        triangles,
        net,
        np.ascontiguousarray(template.ground, dtype=np.int32),
        _find_edges(template, triangles),
    )
    counts = (template.nodes.shape[1], len(triangles))
    return Described(
        kept=(*numbers, plan),
        counts=(*counts, template.net.size, len(numbers[-1])),
        numbers=tuple(locate_all(*numbers)),
        plan=locate(plan),
    )


def _find_edges(template: MeshTemplate, triangles: Words) -> Words:
    triples = np.column_stack(edge_triples(template.ground))
    owner = np.empty(template.nodes.shape[1], dtype=np.int64)
    owner[triangles.T] = np.arange(len(triangles))  # an edge's midpoint has one
    above = owner[triples[:, 1]]
    places = (triangles[above][:, None] == triples[..., None]).argmax(axis=2)
    return np.ascontiguousarray(np.column_stack([above, places]), dtype=np.int32)


def describe_placement(described: Described, orientation: Floats) -> PlacementArgument:
    """A template to place as the core takes it; nodes and results come later.

    Parameters
    ----------
    described : Described
        The template.
    orientation : ndarray, shape (n_triangles,)
        Of its triangles; the caller keeps it.
    """
    n_nodes, n_triangles, n_net, _ = described.counts
    triangles, net, *_ = described.numbers
    shape, gradients, weights = _reference()
    return PlacementArgument(
        *(n_nodes, n_triangles, n_net, triangles, net),
        *locate_all(orientation, gradients, shape, weights, EDGE_TANGENT),
    )


@lru_cache(maxsize=1)
def _reference() -> tuple[Floats, Floats, Floats]:
    """``reference_element`` in contiguous arrays, (3, 6), (6, 2, 3) and (3,)."""
    shape, gradients, weights = map(np.ascontiguousarray, reference_element())
    return shape, gradients, weights


def describe_law(
    problem: FlowProblem,
    material: Material,
    shape: tuple[int, ...],
    slip: Floats | None = None,
) -> tuple[LawArgument, tuple[Floats, Floats, Floats]]:
    """Laws as the core takes them, and their arrays: one number, or of the shape.

    Parameters
    ----------
    problem, material : FlowProblem, Material
        Creep and ground.
    shape : tuple of int
        Of the quadrature points.
    slip : ndarray, shape (n_ground_edges,) or (1,), optional
        Velocity over the shear stress that is linear [-]; default is the lowest
        layer's.
    """
    if slip is None:
        slip = np.array([problem.slip_ratio * problem.layers[0].fluidity_ratio])
    bulk = np.asarray(material.bulk_ratio, dtype=np.float64)
    fluidity = np.asarray(material.fluidity_ratio, dtype=np.float64)
    if bulk.size > 1 or fluidity.size > 1:
        bulk, fluidity = np.broadcast_to(bulk, shape), np.broadcast_to(fluidity, shape)
    bulk, fluidity = np.ascontiguousarray(bulk), np.ascontiguousarray(fluidity)
    exponent, slips = problem.exponent, problem.slip_exponent
    law = LawArgument(
        *(exponent, exponent if slips is None else slips, problem.stress_floor),
        *(int(bulk.size > 1), int(slip.size > 1)),
        *locate_all(bulk, fluidity, slip),
    )
    return law, (bulk, fluidity, slip)


def describe_rules(problem: FlowProblem, lifts: int) -> RulesArgument:
    """Rules of contact as the core takes them.

    Parameters
    ----------
    problem : FlowProblem
        Contacts and friction.
    lifts : int
        Address of the marks (n_ground - 1,) of ground nodes that may lift [-].
    """
    return RulesArgument(
        problem.friction,
        problem.net_contact == "one-sided",
        problem.ground_contact == "one-sided",
        problem.ground == "no-slip",
        lifts,
    )
