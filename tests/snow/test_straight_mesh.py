"""The mesh of moving snow against the readable forms, net midpoints folded away."""

import math

import numpy as np
import pytest
import scipy.sparse as sparse

from netdesign.coupling.history.settings import TRANSIENT_LEVELS
from netdesign.snow import forms, kernel
from netdesign.snow.mesh import build_template, place_nodes
from netdesign.snow.straight_mesh import (
    build_straight_mesh,
    fold_load,
    unfold_velocity,
)

ROUNDING = 1e-13
ASPECT = 3.0
SHAPES = [(0.0, 0.0), (0.0, 0.1), (30.0, 0.1)]


def place(inclination_deg, sag, level=0):
    """Template and its vertices against a parabola; edges on the net are chords."""
    template = build_template(ASPECT, TRANSIENT_LEVELS[level])
    part = template.net_fractions
    head_x = math.tan(math.radians(inclination_deg))
    bulge = 4.0 * sag * part * (1.0 - part)
    curve = np.array([head_x * part + bulge, part - bulge * head_x])
    return template, place_nodes(template, curve)[:, : template.n_vertices]


@pytest.fixture(params=SHAPES, ids=str)
def mesh(request):
    return build_straight_mesh(*place(*request.param))


def folding(mesh):
    """Matrix that gives all velocities from those of the nodes that have their own."""
    template = mesh.template
    matrix = sparse.identity(mesh.n_dofs, format="lil")
    net = template.net
    for below, middle, above in zip(net[:-2:2], net[1::2], net[2::2], strict=True):
        for axis in range(2):
            matrix[2 * middle + axis, 2 * middle + axis] = 0.0
            matrix[2 * middle + axis, 2 * below + axis] = 0.5
            matrix[2 * middle + axis, 2 * above + axis] = 0.5
    return matrix.tocsr()


def random_field(mesh, *shape, seed):
    return np.random.default_rng(seed).normal(size=(*mesh.weights.shape, *shape))


def test_edges_are_straight(mesh):
    template = mesh.template
    middles = mesh.nodes[:, template.edges].mean(axis=1)
    np.testing.assert_array_equal(mesh.nodes[:, template.n_vertices :], middles)
    assert mesh.is_valid


def test_area_is_that_of_the_polygons(mesh):
    """Shoelace around foot, net vertices, surface and upstream end."""
    template = mesh.template
    net = mesh.nodes[:, template.net[::2]]
    around = np.column_stack([net, [-ASPECT, 1.0], [-ASPECT, 0.0]])
    x, y = around
    shoelace = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2.0
    assert mesh.area == pytest.approx(shoelace, rel=1e-13)


def test_tangent_matrix(mesh):
    root = random_field(mesh, 3, 3, seed=1)
    moduli = root @ root.swapaxes(-1, -2) + np.eye(3)
    fold = folding(mesh)
    expected = fold.T @ forms.assemble_tangent_form(mesh, moduli) @ fold
    difference = kernel.assemble_stiffness(mesh, moduli) - expected
    assert abs(difference).max() <= ROUNDING * abs(expected).max()


def test_mixed_tangent_matrix():
    mesh = build_straight_mesh(*place(30.0, 0.1), "mixed")
    moduli = random_field(mesh, 4, 4, seed=4)
    moduli = moduli + moduli.swapaxes(-1, -2)
    fold = folding(mesh)
    expected = fold.T @ forms.assemble_mixed_form(mesh, moduli) @ fold
    difference = kernel.assemble_stiffness(mesh, moduli) - expected
    assert abs(difference).max() <= ROUNDING * abs(expected).max()


def test_internal_forces(mesh):
    stress = random_field(mesh, 3, seed=2)
    expected = folding(mesh).T @ forms.assemble_stress_form(mesh, stress)
    found = kernel.assemble_stress(mesh, stress)
    np.testing.assert_allclose(found, expected, atol=ROUNDING * np.abs(found).max())


def test_strain_rates(mesh):
    velocity = np.random.default_rng(3).normal(size=mesh.n_dofs)
    field = forms.build_basis(mesh).interpolate(folding(mesh) @ velocity)
    (xx, xy), (yx, yy) = field.grad
    expected = np.moveaxis(np.array([xx, yy, xy + yx]), 0, -1)
    found = kernel.compute_strain(mesh, velocity)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(found, expected, atol=ROUNDING * scale)


def test_gravity_load(mesh):
    gravity = (0.6, -0.8)
    whole = forms.assemble_gravity_form(mesh, gravity)
    loads = fold_load(mesh.template, np.outer(gravity, mesh.load))
    np.testing.assert_allclose(loads.T.ravel(), folding(mesh).T @ whole, atol=ROUNDING)


def test_midpoints_on_the_net_are_folded_away(mesh):
    """They carry no load and no stiffness; their vertices carry all of it."""
    middles = mesh.template.net[1::2]
    load = fold_load(mesh.template, mesh.load)
    assert not load[middles].any()
    assert load.sum() == pytest.approx(mesh.load.sum(), rel=1e-14)
    moduli = np.broadcast_to(np.eye(3), (*mesh.weights.shape, 3, 3))
    matrix = kernel.assemble_stiffness(mesh, moduli)
    for axis in range(2):
        rows = matrix[2 * middles + axis]
        assert abs(rows).max() <= ROUNDING * abs(matrix).max()


def test_unfolded_midpoints_lie_between_their_vertices(mesh):
    net = mesh.template.net
    velocity = np.random.default_rng(5).normal(size=mesh.nodes.shape)
    whole = unfold_velocity(mesh.template, velocity)
    ends = whole[:, net[:-1:2]] + whole[:, net[2::2]]
    np.testing.assert_array_equal(2.0 * whole[:, net[1::2]], ends)
    others = np.setdiff1d(np.arange(velocity.shape[1]), net[1::2])
    np.testing.assert_array_equal(whole[:, others], velocity[:, others])


def test_folding_keeps_power(mesh):
    """Loads folded, or velocities unfolded: the same power."""
    load, velocity = np.random.default_rng(6).normal(size=(2, *mesh.nodes.shape))
    folded = (fold_load(mesh.template, load) * velocity).sum()
    unfolded = (load * unfold_velocity(mesh.template, velocity)).sum()
    assert folded == pytest.approx(unfolded, rel=1e-12)


def test_turned_top_is_the_same_mesh_in_other_axes():
    template, vertices = place(30.0, 0.1)
    axis = np.array([math.cos(0.4), math.sin(0.4)])
    plain = build_straight_mesh(template, vertices)
    turned = build_straight_mesh(template, vertices, "velocity", axis)
    top = template.net[-1]
    np.testing.assert_array_equal(turned.axes[:, top], axis)
    vectors = np.random.default_rng(7).normal(size=plain.nodes.shape)
    unknowns = turned.to_node_axes(vectors)
    assert unknowns[2 * top] == pytest.approx(axis @ vectors[:, top])
    np.testing.assert_allclose(
        kernel.compute_strain(turned, unknowns),
        kernel.compute_strain(plain, plain.to_node_axes(vectors)),
        atol=1e-11,
    )
    stress = random_field(plain, 3, seed=8)
    np.testing.assert_allclose(
        turned.to_slope_axes(kernel.assemble_stress(turned, stress)),
        plain.to_slope_axes(kernel.assemble_stress(plain, stress)),
        atol=1e-13,
    )


def test_finer_mesh_is_folded_alike():
    mesh = build_straight_mesh(*place(30.0, 0.1, level=1))
    stress = random_field(mesh, 3, seed=9)
    expected = folding(mesh).T @ forms.assemble_stress_form(mesh, stress)
    found = kernel.assemble_stress(mesh, stress)
    np.testing.assert_allclose(found, expected, atol=ROUNDING * np.abs(found).max())


def test_folded_mesh_is_not_valid():
    template, vertices = place(0.0, 0.0)
    wrong = vertices.copy()
    wrong[0, template.net[::2]] -= 2.0 * ASPECT
    assert not build_straight_mesh(template, wrong).is_valid
    missing = vertices.copy()
    missing[0, 0] = np.nan
    assert not build_straight_mesh(template, missing).is_valid
