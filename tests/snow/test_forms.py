"""The fast kernel against the readable forms, on nets straight and curved."""

import numpy as np
import pytest
import scipy.sparse as sparse

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow import forms, kernel
from netdesign.snow.placed_mesh import build_placed_mesh

# Both sum the same products in another order.
ROUNDING = 1e-13

SHAPES = [(0.0, 0.0), (0.0, 0.1), (30.0, 0.0), (30.0, 0.15), (50.0, 0.05)]


def rotation_to_slope_axes(mesh) -> sparse.csr_matrix:
    """Matrix whose transpose takes slope's axes to node axes, block by block."""
    cosine, sine = mesh.axes
    blocks = np.array([[cosine, -sine], [sine, cosine]]).transpose(2, 0, 1)
    count = len(blocks)
    return sparse.bsr_matrix((blocks, np.arange(count), np.arange(count + 1))).tocsr()


def random_moduli(mesh, seed: int):
    """Symmetric positive definite moduli, different at every point."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(*mesh.weights.shape, 3, 3))
    return root @ root.swapaxes(-1, -2) + np.eye(3)


@pytest.fixture(params=SHAPES, ids=str)
def mesh(request, a_mesh):
    inclination, sag = request.param
    return a_mesh(inclination_deg=inclination, sag=sag)


def test_tangent_matrix(mesh):
    moduli = random_moduli(mesh, seed=1)
    rotation = rotation_to_slope_axes(mesh)
    expected = rotation.T @ forms.assemble_tangent_form(mesh, moduli) @ rotation
    difference = kernel.assemble_stiffness(mesh, moduli) - expected
    assert abs(difference).max() <= ROUNDING * abs(expected).max()


def test_mixed_tangent_matrix(mesh):
    mixed = build_placed_mesh(mesh.template, mesh.nodes, "mixed")
    rng = np.random.default_rng(4)
    moduli = rng.normal(size=(*mesh.weights.shape, 4, 4))
    moduli = moduli + moduli.swapaxes(-1, -2)  # symmetric, not definite
    turn = sparse.block_diag(
        [rotation_to_slope_axes(mesh), sparse.eye(mesh.template.n_vertices)]
    ).tocsr()
    expected = turn.T @ forms.assemble_mixed_form(mixed, moduli) @ turn
    difference = kernel.assemble_stiffness(mixed, moduli) - expected
    assert abs(difference).max() <= ROUNDING * abs(expected).max()


def test_internal_forces(mesh):
    rng = np.random.default_rng(2)
    stress = rng.normal(size=(*mesh.weights.shape, 3))
    expected = forms.assemble_stress_form(mesh, stress)
    found = mesh.to_slope_axes(kernel.assemble_stress(mesh, stress))
    scale = np.abs(expected).max()
    np.testing.assert_allclose(found.T.ravel(), expected, atol=ROUNDING * scale)


def test_strain_rates(mesh):
    rng = np.random.default_rng(3)
    velocity = rng.normal(size=mesh.n_dofs)
    in_slope_axes = mesh.to_slope_axes(velocity).T.ravel()
    field = forms.build_basis(mesh).interpolate(in_slope_axes)
    (xx, xy), (yx, yy) = field.grad
    expected = np.moveaxis(np.array([xx, yy, xy + yx]), 0, -1)
    found = kernel.compute_strain(mesh, velocity)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(found, expected, atol=ROUNDING * scale)


@pytest.mark.parametrize("size", MESH_LEVELS[1:])
def test_gravity_load(a_mesh, size):
    mesh = a_mesh(inclination_deg=30.0, sag=0.1, size=size)
    gravity = (0.6, -0.8)
    expected = forms.assemble_gravity_form(mesh, gravity, np.ones_like(mesh.weights))
    # areas of at most 1; exactly 0 at the vertices of straight triangles
    np.testing.assert_allclose(
        np.outer(gravity, mesh.load).T.ravel(), expected, atol=1e-15
    )
