"""Plane creep law and whole flows of homogeneous snow against closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.outcome import Outcome
from netdesign.snow.creep_law import (
    ZWINGER_2007,
    compute_bulk_factor,
    compute_shear_factor,
    compute_strain_rate,
)
from netdesign.snow.flow import solve_flow
from netdesign.snow.law import FlowLayer, FlowProblem, Material, linearise_creep
from netdesign.snow.mesh import MeshSize, build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh
from tests.each import each

DENSITY = 0.5  # of ice
A = compute_shear_factor(ZWINGER_2007, DENSITY)
B_BULK = compute_bulk_factor(ZWINGER_2007, DENSITY)
N, FLUIDITY = 3.0, 20.0  # [-], [MPa^-3 a^-1]
RATIO = A / B_BULK


def a_law(**changes) -> FlowProblem:
    values = {
        "exponent": N,
        "gravity": (0.0, -1.0),
        "stress_floor": 1e-9,  # the closed forms know of no linear creep
    }
    layers = (FlowLayer(bulk_ratio=changes.pop("bulk_ratio", RATIO)),)
    return FlowProblem(layers=layers, **{**values, **changes})


def plane_strain_rate(stress, **changes):
    """Strain rates (xx, yy, 2 xy) of the program's law, from its own tangent (N10)."""
    law = a_law(**changes)
    (layer,) = law.layers
    material = Material(layer.bulk_ratio, layer.fluidity_ratio, layer.density)
    moduli, kept = linearise_creep(law, material, stress)
    return np.linalg.solve(moduli, stress - kept)


def close_with_no_strain_across(stress, a, b):
    """Stress in space of plane strain: sigma_zz from e_zz = 0, linear in it."""
    xx, yy, xy = stress
    # (a/2)(zz - m) + (b/3) m = 0 with m = (xx + yy + zz) / 3
    in_plane = (a / 2 - b / 3) * (xx + yy) / 3
    zz = in_plane / (a / 2 - (a / 2 - b / 3) / 3)
    return np.array([[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]])


@each("n", [1.0, 2.0, 3.0])
@each("seed", [1, 2, 3])
def test_plane_law_is_the_law_in_space(seed, n):
    stress = np.random.default_rng(seed).normal(size=3)
    law = replace(ZWINGER_2007, exponent=n)
    a, b = (f(law, DENSITY) for f in (compute_shear_factor, compute_bulk_factor))
    in_space = close_with_no_strain_across(stress, a, b)
    rate = compute_strain_rate(law, DENSITY, 1.0, in_space)
    assert rate[2, 2] == pytest.approx(0.0, abs=1e-9 * np.abs(rate).max())
    expected = np.array([rate[0, 0], rate[1, 1], 2 * rate[0, 1]]) / a ** ((n + 1) / 2)
    found = plane_strain_rate(stress, exponent=n, bulk_ratio=a / b)
    np.testing.assert_allclose(found, expected, 1e-10)


def uniform_mesh(
    aspect: float,
    step: float,
    subdivisions: int = 0,
    interfaces: tuple[float, ...] = (),
):
    """Straight net normal to the slope; all triangles about as large."""
    size = MeshSize(
        net_spacing=min(step, 0.34),
        corner=step / 3,
        sectors=2,
        upslope_spacing=step,
        subdivisions=subdivisions,
    )
    template = build_template(aspect, size, interfaces)
    fractions = template.net_fractions
    curve = np.array([np.zeros_like(fractions), fractions])
    return build_placed_mesh(template, place_nodes(template, curve))


def flow_of(law, mesh):
    result = solve_flow(law, mesh, tolerance=1e-9, max_iterations=80)
    assert result.outcome is Outcome.CONVERGED
    return mesh.to_slope_axes(result.state.unknowns), result.state


# With 3 a = 2 b confined snow does not press sideways. Then the confined column is
# exact for the whole region: free upslope end, smooth ground, smooth net.
NO_SIDE_PRESSURE = 2.0 / 3.0


def test_settlement_of_level_snow_is_exact_for_linear_creep():
    """Quadratic velocity, linear stress: both lie in the elements' space."""
    law = a_law(exponent=1.0, bulk_ratio=NO_SIDE_PRESSURE)
    mesh = uniform_mesh(1.0, 0.25)
    velocity, state = flow_of(law, mesh)
    expected = -(1 - (1 - mesh.nodes[1]) ** 2) / 4  # over a, with 4/3 + r = 2
    np.testing.assert_allclose(velocity[1], expected, atol=1e-12)
    np.testing.assert_allclose(velocity[0], 0.0, atol=1e-12)
    # stress at the points: (0, -(1 - y), 0); heights from the linear load of eps
    strain = -state.stress[..., 1] / 2.0
    total = (mesh.weights * strain).sum()  # integral of (1 - y) / 2
    assert total == pytest.approx(1 / 4, rel=1e-12)
    assert np.abs(state.stress[..., [0, 2]]).max() <= 1e-12


def test_settlement_of_level_snow_converges_for_power_law_creep():
    """Velocity of fourth degree; stress vanishes at the surface, n = 3."""
    errors = []
    for subdivisions in (0, 1, 2):
        mesh = uniform_mesh(1.0, 0.25, subdivisions)
        velocity, _ = flow_of(a_law(bulk_ratio=NO_SIDE_PRESSURE), mesh)
        expected = -(1 - (1 - mesh.nodes[1]) ** 4) / 16
        errors.append(np.abs(velocity[1] - expected).max() * 16)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    # third order where the viscosity is smooth; it is unbounded at the surface
    assert orders.min() >= 2.0
    assert errors[-1] <= 2e-4


def slab_surface_velocity(slope, n, bulk_ratio):
    """Infinite slab on rough ground: (shear, settlement) rates over the height.

    tau = (1 - y) sin psi, sigma_yy = -(1 - y) cos psi, no strain along X; both rates
    go with S^(n-1), S^2 = tau^2 + sigma_yy^2 / (4/3 + r), and with (1 - y)^n.
    """
    stiff = 4 / 3 + bulk_ratio
    size = math.hypot(math.sin(slope), math.cos(slope) / math.sqrt(stiff))
    rates = np.array([math.sin(slope), -math.cos(slope) / stiff])
    return size ** (n - 1) * rates / (n + 1)


def surface_velocity_at_half_length(mesh, velocity):
    surface = np.flatnonzero(np.abs(mesh.nodes[1] - 1.0) < 1e-12)
    halfway = np.abs(mesh.nodes[0, surface] + mesh.template.aspect / 2)
    return velocity[:, surface[np.argmin(halfway)]]


@pytest.mark.parametrize("slope", [0.0, math.radians(40.0)])
def test_infinite_slab_linear_creep(slope):
    """The ends die out as exp(-0.9 x / d): thirty thicknesses away nothing is left."""
    law = a_law(
        exponent=1.0, gravity=(math.sin(slope), -math.cos(slope)), ground="no-slip"
    )
    mesh = uniform_mesh(60.0, 0.5)
    velocity, _ = flow_of(law, mesh)
    found = surface_velocity_at_half_length(mesh, velocity)
    expected = slab_surface_velocity(slope, 1.0, RATIO)
    np.testing.assert_allclose(found, expected, atol=1e-9)


def test_infinite_slab_power_law_creep():
    """n = 3: the stiff surface carries the ends' influence further, see the decay."""
    slope = math.radians(40.0)
    law = a_law(gravity=(math.sin(slope), -math.cos(slope)), ground="no-slip")
    expected = slab_surface_velocity(slope, 3.0, RATIO)
    errors = []
    for aspect in (15.0, 30.0, 60.0):
        mesh = uniform_mesh(aspect, 0.25)
        found = surface_velocity_at_half_length(mesh, flow_of(law, mesh)[0])
        errors.append(np.abs(found / expected - 1.0).max())
    assert errors[1] <= errors[0] / 3
    assert errors[2] <= errors[1] / 3
    assert errors[2] <= 3e-3


@pytest.mark.parametrize("seed", range(3))
def test_layered_slab_slides_by_its_lowest_layer(seed):
    """v(0) = D* w_1 tau_0, v(1) = v(0) + sum of w_i times the integral of tau."""
    rng = np.random.default_rng(seed)
    top, slip = rng.uniform(0.2, 0.8), rng.uniform(0.1, 1.0)
    fluidities, densities = rng.uniform(0.3, 3.0, 2), rng.uniform(0.6, 1.4, 2)
    slope = math.radians(rng.uniform(30.0, 50.0))
    law = replace(
        a_law(exponent=1.0, gravity=(math.sin(slope), -math.cos(slope))),
        layers=tuple(
            FlowLayer(
                top=high, bulk_ratio=RATIO, fluidity_ratio=fluidity, density=density
            )
            for high, fluidity, density in zip(
                (top, 1.0), fluidities, densities, strict=True
            )
        ),
        ground="sliding",
        slip_ratio=slip,
    )
    mesh = uniform_mesh(60.0, 0.5, interfaces=(top,))
    velocity, _ = flow_of(law, mesh)
    light = densities[1] * (1.0 - top) * math.sin(slope)  # shear at the interface
    whole = light + densities[0] * top * math.sin(slope)
    base = slip * fluidities[0] * whole
    shear = fluidities @ [top * (whole + light) / 2, (1.0 - top) * light / 2]
    ground = mesh.template.ground
    middle = ground[np.abs(mesh.nodes[0, ground] + 30.0).argmin()]
    assert velocity[0, middle] == pytest.approx(base, rel=1e-4)
    found = surface_velocity_at_half_length(mesh, velocity)
    assert found[0] == pytest.approx(base + shear, rel=1e-4)


def test_column_of_the_elmer_manual():
    """Printed for h = 1 m, rho = 450, n = 3: w(h) = -0.002132 m/a."""
    law = a_law(ground="no-slip")
    mesh = uniform_mesh(60.0, 0.25)
    found = surface_velocity_at_half_length(mesh, flow_of(law, mesh)[0])
    weight = 0.5 * 900 * 9.81 * 1e-6  # rho g h [MPa]
    speed = FLUIDITY * A ** ((N + 1) / 2) * weight**N  # of one unit [m/a]
    # four layers of elements, end effects as above
    assert speed * found[1] == pytest.approx(-0.002132, rel=5e-3)
