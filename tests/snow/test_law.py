"""The creep law of the mixed element, and properties sampled layer by layer."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow.flow import compute_weight, solve_flow
from netdesign.snow.flow_step import compute_residual
from netdesign.snow.law import (
    FlowLayer,
    Material,
    advance_stress,
    linearise_creep,
    linearise_sliding,
    sample_material,
    squared_invariant,
)
from netdesign.snow.mesh import build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh
from tests.each import each

RATIOS = [0.7, 1.8, 60.0]
UNIT = np.array([1.0, 1.0, 0.0])
COMPLIANCE = np.array([[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]])  # (N18)
STRESSES = np.array([[0.7, -0.4, 0.9], [-1.0, -0.2, 0.1], [0.02, 0.03, -0.01]])


def material_of(law) -> Material:
    layer = law.layers[0]
    return Material(layer.bulk_ratio, layer.fluidity_ratio, layer.density)


def split(stress, ratio):
    """(deviator, pressure) of plane stresses without strain across the plane.

    (N19): tr eps = 3/2 S^(n-1) (tau_xx + tau_yy) = -S^(n-1) p / r.
    """
    pressure = -(stress[..., 0] + stress[..., 1]) / (2.0 + 2.0 / (3.0 * ratio))
    deviator = stress + pressure[..., None] * UNIT
    return np.concatenate([deviator, pressure[..., None]], axis=-1)


def both(a_flow_problem, ratio, exponent=3.0, fluidity=1.0):
    """The same snow in the velocity and in the mixed element."""
    law = a_flow_problem(bulk_ratio=ratio, exponent=exponent)
    law = replace(law, layers=(replace(law.layers[0], fluidity_ratio=fluidity),))
    return law, replace(law, element="mixed")


# --- mixed element -----------------------------------------------------------


@pytest.mark.parametrize("ratio", RATIOS)
def test_invariant_is_the_same(a_flow_problem, ratio):
    """(N18) of the split stress is S^2 of (N8)."""
    plain, mixed = both(a_flow_problem, ratio)
    material = material_of(plain)
    np.testing.assert_allclose(
        squared_invariant(mixed, material, split(STRESSES, ratio)),
        squared_invariant(plain, material, STRESSES),
        rtol=1e-12,
    )


@each("ratio", RATIOS)
@each("exponent", [1.0, 3.0])
@each("fluidity", [1.0, 7.0])
def test_condensed_tangent_is_that_of_the_velocity_element(
    a_flow_problem, ratio, exponent, fluidity
):
    """Both linearise one law at one stress: without its pressure (N20) is (N10)."""
    plain, mixed = both(a_flow_problem, ratio, exponent, fluidity)
    material = material_of(plain)
    expected = linearise_creep(plain, material, STRESSES)
    moduli, intercept = linearise_creep(mixed, material, split(STRESSES, ratio))
    np.testing.assert_allclose(moduli, moduli.swapaxes(-1, -2), rtol=1e-14)
    coupling, compression = moduli[..., :3, 3], moduli[..., 3, 3]
    assert (compression < 0.0).all()  # quasi-definite
    # the fourth row is zero: p = -(intercept + coupling . eps) / compression
    outer = coupling[..., :, None] * coupling[..., None, :]
    condensed = moduli[..., :3, :3] - outer / compression[..., None, None]
    rest = intercept[..., :3] - coupling * (intercept[..., 3] / compression)[..., None]
    scale = np.abs(expected.modulus).max()
    np.testing.assert_allclose(condensed, expected.modulus, atol=1e-12 * scale)
    np.testing.assert_allclose(rest, expected.intercept, atol=1e-12)


@pytest.mark.parametrize("ratio", RATIOS)
def test_step_with_the_laws_own_strain_rate_changes_nothing(a_flow_problem, ratio):
    """(N19) written out, with the floor: a Newton step from the solution stays."""
    _, mixed = both(a_flow_problem, ratio)
    stress = split(STRESSES, ratio)
    deviator, pressure = stress[:, :3], stress[:, 3]
    size = ((deviator @ COMPLIANCE) * deviator).sum(axis=1) + pressure**2 / ratio
    rate = size + mixed.stress_floor**2  # n = 3
    strain = rate[:, None] * (deviator @ COMPLIANCE)
    np.testing.assert_allclose(strain[:, 0] + strain[:, 1], -rate * pressure / ratio)
    tangent = linearise_creep(mixed, material_of(mixed), stress)
    generalised = np.column_stack([strain, pressure])
    np.testing.assert_allclose(
        advance_stress(mixed, tangent, generalised), stress, atol=1e-13
    )
    fourth = tangent.intercept[:, 3] + (tangent.modulus[:, 3] * generalised).sum(axis=1)
    np.testing.assert_allclose(fourth, 0.0, atol=1e-13)


# --- layers ------------------------------------------------------------------

BOTTOM = FlowLayer(top=0.3, bulk_ratio=1.2, fluidity_ratio=2.0, density=1.5)
MIDDLE = FlowLayer(top=0.8, bulk_ratio=2.0, fluidity_ratio=0.5, density=0.9)
TOP = FlowLayer(top=1.0, bulk_ratio=3.0, fluidity_ratio=0.1, density=0.5)
TOPS = (0.3, 0.8)


def layered_mesh(inclination_deg=0.0, element="velocity", size=MESH_LEVELS[1]):
    template = build_template(5.0, size, TOPS)
    heights = template.net_fractions
    curve = np.array([heights * np.tan(np.radians(inclination_deg)), heights])
    return build_placed_mesh(template, place_nodes(template, curve), element)


def test_every_point_has_the_properties_of_its_layer(a_flow_problem):
    law = replace(a_flow_problem(), layers=(BOTTOM, MIDDLE, TOP))
    mesh = layered_mesh()
    material = sample_material(law, mesh.template)
    heights = mesh.template.nodes[1, mesh.template.triangles[:3]].mean(axis=0)
    for layer, low in ((BOTTOM, 0.0), (MIDDLE, 0.3), (TOP, 0.8)):
        inside = (heights > low) & (heights < layer.top)
        assert inside.any()
        assert (material.bulk_ratio[inside] == layer.bulk_ratio).all()
        assert (material.fluidity_ratio[inside] == layer.fluidity_ratio).all()
        assert (material.density[inside] == layer.density).all()


@pytest.mark.parametrize("inclination", [0.0, 30.0])
@pytest.mark.parametrize("element", ["velocity", "mixed"])
def test_load_of_layers_is_their_weight(a_flow_problem, inclination, element):
    """Each layer: 5 (top - bottom) and its slice of the wedge, times its density."""
    law = replace(a_flow_problem(), layers=(BOTTOM, MIDDLE, TOP), element=element)
    mesh = layered_mesh(inclination, element)
    wedge = np.tan(np.radians(inclination)) / 2.0
    expected = sum(
        layer.density * (5.0 * (layer.top - low) + wedge * (layer.top**2 - low**2))
        for layer, low in ((BOTTOM, 0.0), (MIDDLE, 0.3), (TOP, 0.8))
    )
    weight = expected * np.array(law.gravity)
    np.testing.assert_allclose(compute_weight(law, mesh), weight, rtol=1e-12)
    state = solve_flow(law, mesh, tolerance=1e-3).state
    unloaded = replace(state, stress=np.zeros_like(state.stress))
    load = -mesh.to_slope_axes(compute_residual(law, mesh, unloaded)).sum(axis=1)
    np.testing.assert_allclose(load, weight, rtol=1e-12)


@each("exponent", [1.0, 3.0])
@each("fluidity", [0.037, 1.0, 4.3])
def test_ground_slips_by_the_fluidity_of_the_snow_on_it(
    a_flow_problem, exponent, fluidity
):
    """N12 at its own stress: velocity = slip length times the snow's shear rate."""
    law = a_flow_problem(ground="sliding", slip_ratio=0.73, exponent=exponent)
    shear = np.array([[-0.61, 0.13, 0.47]])
    tangent = linearise_sliding(law, shear, np.array([[fluidity]]))
    size = shear**2 + law.stress_floor**2
    velocity = 0.73 * fluidity * size ** ((exponent - 1.0) / 2.0) * shear
    np.testing.assert_allclose(
        tangent.intercept + tangent.modulus * velocity, shear, rtol=1e-12
    )
