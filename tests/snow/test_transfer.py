"""A flow on one mesh as the start of that on another."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow import flow
from netdesign.snow.contact import FlowState, start_contact
from netdesign.snow.element import interpolate_reference
from netdesign.snow.flow import transfer_state
from netdesign.snow.mesh import build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh

TOPS = (0.317, 0.574)


def straight_mesh(level):
    template = build_template(6.7, MESH_LEVELS[level], TOPS)
    heights = template.net_fractions
    curve = np.array([0.31 * heights, heights])
    return build_placed_mesh(template, place_nodes(template, curve), "velocity")


def number_layers(mesh):
    shape = mesh.weights.shape
    found = np.searchsorted(TOPS, interpolate_reference(mesh.template)[1])
    return np.broadcast_to(found, shape)


@pytest.mark.parametrize(("old", "new"), [(0, 2), (2, 0), (0, 1)])
def test_stress_stays_in_its_layer(old, new):
    """It jumps from layer to layer, however near to each other two points are."""
    source, target = straight_mesh(old), straight_mesh(new)
    state = FlowState(
        unknowns=np.zeros(source.n_dofs),
        reaction=np.zeros(source.n_dofs),
        stress=number_layers(source)[..., None] + np.array([0.0, 10.0, 20.0]),
        base_shear=None,
        contact=start_contact(source),
    )
    carried = transfer_state(state, source.template, target.template)
    np.testing.assert_array_equal(carried.stress[..., 0], number_layers(target))


@pytest.mark.parametrize("tops", [(), TOPS])
@pytest.mark.parametrize("at_once", [256, 7])
def test_nearest_points_are_those_of_a_tree(monkeypatch, tops, at_once):
    """Also where two are as near: any of them is right."""
    monkeypatch.setattr(flow, "_AT_ONCE", at_once)
    flow._nearest_points.cache_clear()
    source, target = (
        build_template(7.31, MESH_LEVELS[level], tops) for level in (0, 1)
    )
    known, wanted = map(flow._list_points, (source, target))
    near = known[flow._nearest_points(source, target)]
    distance, _ = cKDTree(known).query(wanted)
    np.testing.assert_allclose(np.hypot(*(near - wanted).T), distance, atol=1e-12)
