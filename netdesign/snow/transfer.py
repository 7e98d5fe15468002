"""A flow on one mesh as the start of that on another."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.snow.contact import Contact, FlowState
from netdesign.snow.element import interpolate_reference
from netdesign.snow.mesh import MeshTemplate

# Added between layers, more than any distance in one [thickness].
_FAR_APART = 1e4
# Points whose distances from all others are in the processor's cache. A tree of points
# finds the nearest sooner, but is imported for as long as twenty meshes take.
_AT_ONCE = 256


def transfer_state(
    state: FlowState, source: MeshTemplate, target: MeshTemplate
) -> FlowState:
    """State carried to another mesh: a guess, in equilibrium with nothing.

    Stresses are those of the nearest quadrature point, contacts those of the nearest
    support node, both in the coordinates of what was triangulated; velocities and
    reactions are 0 and take the first step to be right.

    Parameters
    ----------
    state : FlowState
        On the old mesh.
    source, target : MeshTemplate
        Of the old and of the new mesh, both of the same snowpack.
    """
    source, target = source.origin, target.origin
    points = _nearest_points(source, target)
    per_triangle, rows = state.stress.shape[1:]
    stress = state.stress.reshape(-1, rows)[points]
    n_dofs = 2 * target.nodes.shape[1] + (target.n_vertices if rows > 3 else 0)
    on_net, on_ground = _nearest_nodes(source, target)
    base_shear = None
    if state.base_shear is not None:
        base_shear = _resample_base(state.base_shear, source, target)
    contact = state.contact
    return FlowState(
        unknowns=np.zeros(n_dofs),
        reaction=np.zeros(n_dofs),
        stress=stress.reshape(-1, per_triangle, rows),
        base_shear=base_shear,
        contact=Contact(
            sign=contact.sign[on_net],
            is_pressed=contact.is_pressed[on_net],
            is_open=contact.is_open[on_net],
            is_lifted=contact.is_lifted[on_ground],
        ),
    )


@lru_cache(maxsize=256)
def _nearest_points(source: MeshTemplate, target: MeshTemplate) -> Ints:
    known, wanted = _list_points(source), _list_points(target)
    layers, own = known[:, 1] // _FAR_APART, wanted[:, 1] // _FAR_APART
    nearest = np.empty(own.size, dtype=np.int64)
    for layer in range(len(source.interfaces) + 1):
        there, here = np.flatnonzero(layers == layer), np.flatnonzero(own == layer)
        for k in range(0, here.size, _AT_ONCE):
            piece = here[k : k + _AT_ONCE]
            nearest[piece] = there[_find_nearest(known[there], wanted[piece])]
    return nearest


def _find_nearest(known: Floats, wanted: Floats) -> Ints:
    """Nearest of some points (n, 2) to each of some others."""
    (x_known, y_known), (x, y) = known.T, wanted.T[..., None]
    distance, across = x - x_known, y - y_known
    distance *= distance
    across *= across
    distance += across
    return np.asarray(distance.argmin(axis=1), dtype=np.int64)


@lru_cache(maxsize=256)
def _nearest_nodes(source: MeshTemplate, target: MeshTemplate) -> tuple[Ints, Ints]:
    """Nearest nodes on the net and on the ground, those of the foot left out."""
    on_ground = (one.nodes[0, one.ground[1:]] for one in (source, target))
    return (
        _nearest(source.net_fractions[1:], target.net_fractions[1:]),
        _nearest(*on_ground),
    )


def _list_points(template: MeshTemplate) -> Floats:
    """Reference coordinates (n, 2) of all quadrature points, layers far apart.

    Stress jumps from layer to layer: none is nearest to a point of another.
    """
    points = interpolate_reference(template).reshape(2, -1).T
    if not template.interfaces:
        return points
    layer = np.searchsorted(template.interfaces, points[:, 1])
    return points + np.outer(layer, [0.0, _FAR_APART])


def _nearest(known: Floats, wanted: Floats) -> Ints:
    return np.asarray(np.abs(wanted[:, None] - known[None]).argmin(axis=1))


def _resample_base(shear: Floats, source: MeshTemplate, target: MeshTemplate) -> Floats:
    """Mean shear of the edges, at the nearest edge's."""
    middles = [
        template.nodes[0, template.ground[1::2]] for template in (source, target)
    ]
    return np.asarray(shear[_nearest(*middles)])
