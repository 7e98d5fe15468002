"""Placed mesh whose edges are straight and whose net is a polygon of vertices.

Midpoints on the net carry no unknowns of their own: they move with the mean of their
vertices, so that what the snow does to the net acts at vertices only.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.snow.element import (
    Element,
    add_pressure_rows,
    build_strain_operator,
)
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh

# Places in a triangle of each midpoint and of the two vertices beside it.
_MIDPOINTS = ((3, 0, 1), (4, 1, 2), (5, 0, 2))


def build_straight_mesh(
    template: MeshTemplate,
    vertices: Floats,
    element: Element = "velocity",
    top_axis: Floats | None = None,
) -> PlacedMesh:
    """Everything that assembly needs on placed vertices.

    Node axes are X and Y, but for the net's top vertex. Columns of the net's midpoints
    are zero; ``load`` has their shares at the vertices.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    vertices : ndarray, shape (2, n_vertices)
        Positions [thickness].
    element : str
        ``velocity`` or ``mixed``.
    top_axis : ndarray, shape (2,), optional
        Unit vector, first axis of the net's top vertex [-]; default is X.
    """
    nodes = np.concatenate([vertices, vertices[:, template.edges].mean(axis=1)], axis=1)
    mesh = build_placed_mesh(template, nodes, element)
    axes = np.zeros_like(nodes)
    axes[0] = 1.0
    operator = build_strain_operator(template, mesh.gradients, axes)
    _fold_midpoints(template, operator)
    if top_axis is not None:
        axes[:, template.net[-1]] = top_axis
        _turn_node(template, operator, int(template.net[-1]), top_axis)
    return replace(
        mesh,
        folded=add_pressure_rows(operator) if mesh.is_mixed else operator,
        net_normal=np.zeros_like(mesh.net_normal),
        axes=axes,
    )


def fold_load(template: MeshTemplate, load: Floats) -> Floats:
    """Nodal loads with those of the net's midpoints at their vertices.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    load : ndarray, shape (.., n_nodes)
        Nodal loads, any unit.

    Returns
    -------
    ndarray, shape (.., n_nodes)
        In that unit.
    """
    folded = load.copy()
    net = template.net
    half = load[..., net[1::2]] / 2.0
    folded[..., net[:-1:2]] += half
    folded[..., net[2::2]] += half
    folded[..., net[1::2]] = 0.0
    return folded


def unfold_velocity(template: MeshTemplate, velocity: Floats) -> Floats:
    """Nodal velocities with the net's midpoints between their vertices.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    velocity : ndarray, shape (2, n_nodes)
        Any unit.

    Returns
    -------
    ndarray, shape (2, n_nodes)
        In that unit.
    """
    whole = velocity.copy()
    net = template.net
    whole[:, net[1::2]] = (velocity[:, net[:-1:2]] + velocity[:, net[2::2]]) / 2.0
    return whole


def _fold_midpoints(template: MeshTemplate, operator: Floats) -> None:
    triangle, middle, first, second = _find_midpoints(template)
    for axis in range(2):
        half = operator[triangle, :, :, 2 * middle + axis] / 2.0
        operator[triangle, :, :, 2 * first + axis] += half
        operator[triangle, :, :, 2 * second + axis] += half
        operator[triangle, :, :, 2 * middle + axis] = 0.0


def _turn_node(
    template: MeshTemplate, operator: Floats, node: int, axis: Floats
) -> None:
    triangle, place = np.nonzero(np.isin(template.triangles.T, node))
    along_x = operator[triangle, :, :, 2 * place]
    along_y = operator[triangle, :, :, 2 * place + 1]
    operator[triangle, :, :, 2 * place] = axis[0] * along_x + axis[1] * along_y
    operator[triangle, :, :, 2 * place + 1] = axis[0] * along_y - axis[1] * along_x


@lru_cache(maxsize=16)
def _find_midpoints(template: MeshTemplate) -> tuple[Ints, Ints, Ints, Ints]:
    """Triangle, place of the midpoint and of its two vertices, per edge on the net."""
    on_net = np.isin(template.triangles, template.net[1::2])
    found = [
        (triangle, middle, first, second)
        for middle, first, second in _MIDPOINTS
        for triangle in np.flatnonzero(on_net[middle])
    ]
    triangle, middle, first, second = np.array(found, dtype=np.int64).T
    return triangle, middle, first, second
