"""Assembly: exact on fields that the elements hold. Against forms: test_forms.py."""

import numpy as np
import pytest

from netdesign.snow import kernel
from netdesign.snow.placed_mesh import build_placed_mesh

SHAPES = [(0.0, 0.0), (0.0, 0.1), (30.0, 0.0), (30.0, 0.15)]


@pytest.fixture(params=SHAPES, ids=str)
def mesh(request, a_mesh):
    inclination, sag = request.param
    return a_mesh(inclination_deg=inclination, sag=sag)


def linear_velocity(mesh, gradient):
    """Nodal velocities, node axes, of v = gradient x + a translation."""
    return mesh.to_node_axes(gradient @ mesh.nodes + np.array([[0.3], [-0.7]]))


def test_unit_shear_on_the_ground(a_mesh):
    mesh = a_mesh(inclination_deg=30.0, sag=0.1)
    force = kernel.assemble_base_force(mesh, np.ones_like(mesh.base_weights))
    assert force.sum() == pytest.approx(mesh.template.aspect, rel=1e-13)
    assert np.abs(force[1::2]).max() == 0.0
    nodes = np.flatnonzero(np.abs(force[::2]) > 0.0)
    assert set(nodes) <= set(mesh.template.ground)


def test_ground_velocity_and_power(a_mesh):
    """v_x = x: integral of x^2 over the ground is aspect^3 / 3."""
    mesh = a_mesh(sag=0.1)
    velocity = linear_velocity(mesh, np.array([[1.0, 0.0], [0.0, 0.0]]))
    velocity -= linear_velocity(mesh, np.zeros((2, 2)))
    along = kernel.compute_base_velocity(mesh, velocity)
    cube = mesh.template.aspect**3 / 3
    assert (mesh.base_weights * along**2).sum() == pytest.approx(cube, rel=1e-13)
    matrix = kernel.assemble_base_stiffness(mesh, np.ones_like(mesh.base_weights))
    assert velocity @ matrix @ velocity == pytest.approx(cube, rel=1e-13)


def test_folded_mesh_is_not_valid(a_mesh):
    """A net pushed further upslope than the snow is long, and a missing node."""
    assert not a_mesh(sag=-8.0).is_valid
    mesh = a_mesh()
    nodes = np.array(mesh.nodes)
    nodes[0, -1] = np.nan
    assert not build_placed_mesh(mesh.template, nodes).is_valid
