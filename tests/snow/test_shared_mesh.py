"""Templates of like aspects are one triangulation, stretched."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow.element import find_preferred, list_dofs, share_template
from netdesign.snow.mesh import BESIDE, build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh

ASPECTS = st.floats(math.log(0.25), math.log(200.0)).map(math.exp)
TOPS = st.sampled_from([(), (0.317,), (0.274, 0.617), (0.131, 0.402, 0.871)])


@given(st.floats(-2.0, 4.0))
def test_a_preferred_number_is_near(exponent):
    value = 10.0**exponent
    found = find_preferred(value)
    assert abs(math.log(found / value)) < 0.065
    assert find_preferred(found) == found


def test_preferred_numbers_are_those_of_the_standard():
    found = {find_preferred(10.0 ** (k / 20.0 - 3.0)) for k in range(81)}
    assert {0.001, 0.0112, 0.125, 1.4, 3.15, 7.1, 9.0, 10.0} <= found
    assert len(found) == 81


@given(ASPECTS, st.integers(0, 1), TOPS)
def test_a_stretched_mesh_is_a_mesh_of_its_aspect(aspect, level, tops):
    template = share_template(aspect, MESH_LEVELS[level], tops)
    x, y = template.nodes
    assert template.aspect == aspect
    assert x.max() == aspect
    assert (x[template.upstream] == aspect).all()
    assert (x[template.net] == 0.0).all()
    assert (y[template.ground] == 0.0).all()
    assert (y[template.surface] == 1.0).all()
    assert (np.diff(x[template.ground]) > 0.0).all()
    height = template.net_fractions
    nodes = place_nodes(template, np.array([0.0 * height, height]))
    mesh = build_placed_mesh(template, nodes)
    assert mesh.is_valid
    assert mesh.area == pytest.approx(aspect, rel=1e-12)
    start, end = template.edges
    middles = template.nodes[:, template.n_vertices :]
    np.testing.assert_allclose(
        middles, (template.nodes[:, start] + template.nodes[:, end]) / 2.0, atol=1e-12
    )


@given(ASPECTS.filter(lambda one: one > 1.5), TOPS)
def test_rings_stay_and_numbers_are_shared(aspect, tops):
    template = share_template(aspect, MESH_LEVELS[0], tops)
    origin = build_template(find_preferred(aspect), MESH_LEVELS[0], tops)
    assert template.origin is origin
    near = origin.nodes[0, : origin.n_vertices] <= BESIDE
    of_both = (one.nodes[:, : origin.n_vertices][:, near] for one in (template, origin))
    np.testing.assert_array_equal(*of_both)
    np.testing.assert_array_equal(template.nodes[1], origin.nodes[1])
    assert list_dofs(template, "velocity") is list_dofs(origin, "velocity")
