"""Assembly: exact on fields that the elements hold. Against forms: test_forms.py."""

import math

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow import kernel
from netdesign.snow.placed_mesh import build_placed_mesh
from tests.each import each

SHAPES = [(0.0, 0.0), (0.0, 0.1), (30.0, 0.0), (30.0, 0.15)]


@pytest.fixture(params=SHAPES, ids=str)
def mesh(request, a_mesh):
    inclination, sag = request.param
    return a_mesh(inclination_deg=inclination, sag=sag)


def linear_velocity(mesh, gradient):
    """Nodal velocities, node axes, of v = gradient x + a translation."""
    return mesh.to_node_axes(gradient @ mesh.nodes + np.array([[0.3], [-0.7]]))


@each("size", MESH_LEVELS)
@each("inclination", [0.0, 30.0])
@each("sag", [0.0, 0.1])
def test_total_load_is_the_weight(a_mesh, size, inclination, sag):
    """d L, the wedge d^2 tan(theta) / 2, and the segment (2/3) chord sag."""
    mesh = a_mesh(inclination_deg=inclination, sag=sag, size=size)
    theta = math.radians(inclination)
    # placed at its fractions the parabola is exact in parabolic edges
    weight = 5.0 + math.tan(theta) / 2 + 2 / 3 * sag / math.cos(theta)
    assert mesh.load.sum() == pytest.approx(weight, rel=1e-12)
    assert mesh.area == pytest.approx(weight, rel=1e-12)


def test_node_axes_there_and_back(mesh):
    vectors = np.random.default_rng(1).normal(size=mesh.nodes.shape)
    back = mesh.to_slope_axes(mesh.to_node_axes(vectors))
    np.testing.assert_allclose(back, vectors, atol=1e-14)


@pytest.mark.parametrize("seed", [1, 2])
def test_linear_velocity_has_uniform_strain(mesh, seed):
    """Exact on curved edges too: the elements are isoparametric."""
    gradient = np.random.default_rng(seed).normal(size=(2, 2))
    strain = kernel.compute_strain(mesh, linear_velocity(mesh, gradient))
    (xx, xy), (yx, yy) = gradient
    # the smallest triangle is 1e-2 of its neighbour: differences lose two digits
    np.testing.assert_allclose(
        strain, np.broadcast_to([xx, yy, xy + yx], strain.shape), atol=1e-11
    )


def test_any_stress_field_is_in_balance_with_itself(mesh):
    """No net internal force along X or Y, and no moment, whatever the stress is."""
    stress = np.random.default_rng(3).normal(size=(*mesh.weights.shape, 3))
    force = mesh.to_slope_axes(kernel.assemble_stress(mesh, stress))
    np.testing.assert_allclose(force.sum(axis=1), 0.0, atol=1e-11)
    moment = (mesh.nodes[0] * force[1] - mesh.nodes[1] * force[0]).sum()
    assert moment == pytest.approx(0.0, abs=1e-11)


def test_uniform_stress_on_the_net_is_its_traction(mesh):
    """Forces on the net's inner nodes: the stress on the shares of normal they hold."""
    xx, yy, xy = 1.0, -2.0, 0.7
    field = np.broadcast_to([xx, yy, xy], (*mesh.weights.shape, 3))
    internal = mesh.to_slope_axes(kernel.assemble_stress(mesh, field))
    forces = internal[:, mesh.template.net[1:-1]].sum(axis=1)
    x, y = net_edge_normals(mesh)
    np.testing.assert_allclose(forces, [xx * x + xy * y, xy * x + yy * y], atol=1e-12)


def net_edge_normals(mesh):
    """Integral of the outward normal times the inner net nodes' shape functions."""
    x, y = mesh.nodes[:, mesh.template.net]
    chord = np.array([y[-1] - y[0], -(x[-1] - x[0])])
    start = _end_share(x[0], x[1], x[2], y[0], y[1], y[2])
    end = -_end_share(x[-1], x[-2], x[-3], y[-1], y[-2], y[-3])
    return chord - start - end


def _end_share(x0, x1, x2, y0, y1, y2):
    """Integral of the first shape function times (dy, -dx) over a parabolic edge.

    By hand: int N0 (N0', N1', N2') = (-1/2, 2/3, -1/6).
    """
    dx = -x0 / 2 + 2 * x1 / 3 - x2 / 6
    dy = -y0 / 2 + 2 * y1 / 3 - y2 / 6
    return np.array([dy, -dx])


def test_net_normals_point_out_of_the_snow(mesh):
    np.testing.assert_allclose(np.hypot(*mesh.net_normal), 1.0, rtol=1e-14)
    assert (mesh.net_normal[0] > 0.0).all()


def test_discrete_flux_through_the_net_vanishes(mesh):
    """Velocities along the nodal tangents: no volume leaves, edge by edge curved."""
    velocity = np.zeros(mesh.n_dofs)
    inner = mesh.template.net[1:-1]
    velocity[2 * inner + 1] = np.random.default_rng(4).normal(size=inner.size)
    strain = kernel.compute_strain(mesh, velocity)
    divergence = strain[..., 0] + strain[..., 1]
    assert (mesh.weights * divergence).sum() == pytest.approx(0.0, abs=1e-13)


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
