"""Layers, one-sided contacts, temperature, and the two elements."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.creep_law import compute_fluidity, compute_shear_factor
from netdesign.snow.law import linearise_sliding
from netdesign.snow.snowpack import Layer, build_layered_snowpack
from tests.each import each

SETTINGS = SolverSettings(
    accuracy=0.1,
    stress_tolerance=1e-8,
    shape_tolerance=1e-7,
    levels=MESH_LEVELS[1:3],
)


def layered(scene, *layers):
    pack = build_layered_snowpack(
        tuple(layers),
        slope_angle=scene.snowpack.slope_angle,
        upslope_length=scene.snowpack.upslope_length,
    )
    return replace(scene, snowpack=pack)


def sound(scene, settings=SETTINGS):
    solution = solve_steady(scene, settings, on_failure="raise")
    assert solution.balance.relative_residual < 1e-8
    return solution


# --- layers ------------------------------------------------------------------


def draw_layers(seed):
    """Two to four layers of untidy thickness and density, 4 m together."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(0.2, 1.0, rng.integers(2, 5))
    thickness = 4.0 * shares / shares.sum()
    density = np.sort(rng.uniform(150.0, 500.0, shares.size))[::-1]
    return [
        Layer(thickness=float(t), density=float(d))
        for t, d in zip(thickness, density, strict=True)
    ]


@each("ground", ["free", "no-slip"])
@each("seed", range(3))
def test_layers_lie_at_their_heights_up_to_the_hanging_net(a_scene, ground, seed):
    """Straight, parallel to the ground: no triangle of the placed mesh crosses one."""
    scene = layered(
        a_scene(inclination_deg=27.0, slack=0.05, ground=ground), *draw_layers(seed)
    )
    solution = sound(scene)
    tops = np.cumsum([layer.thickness for layer in scene.layers])
    corners = solution.mesh_nodes[1, solution.mesh_triangles]
    for top in tops[:-1]:
        crosses = (corners.min(axis=0) < top - 1e-5) & (
            corners.max(axis=0) > top + 1e-5
        )
        assert not crosses.any()
    layer = np.searchsorted(tops, corners.mean(axis=0))
    densities = np.array([layer.density for layer in scene.layers])
    np.testing.assert_array_equal(solution.mesh_density, densities[layer])


GROUNDS = [("no-slip", 0.0), ("sliding", 1.7)]


@pytest.mark.parametrize("densities", [(487.3, 262.1), (213.9, 377.7)])
def test_slip_is_that_of_the_snow_on_the_ground(a_scene, densities):
    """A slip length over the creep rate of the lowest layer: FACTS.md, section 5.

    A base velocity D* B a^((n+1)/2) tau^n of the mean snow is that of the lowest layer
    with another D*: the scene's law must say which of the two it means.
    """
    scene = layered(
        a_scene(ground="sliding", slip_length_m=1.5),
        *(Layer(thickness=2.0, density=density) for density in densities),
    )
    law, shear = scene.flow_problem, np.array([[0.3, 0.7]])
    tangent = linearise_sliding(law, shear)
    velocity = (shear - tangent.intercept) / tangent.modulus
    a = [compute_shear_factor(scene.creep_law, d / 917.0) for d in densities]
    mean = compute_shear_factor(scene.creep_law, scene.snowpack.relative_density)
    rate = (a[0] / mean) ** 2.0  # n = 3
    expected = 1.5 / 4.0 * rate * (shear**2 + law.stress_floor**2) * shear
    np.testing.assert_allclose(velocity, expected, rtol=1e-12)


@pytest.mark.parametrize(("ground", "slip"), GROUNDS)
def test_temperature_of_all_layers_changes_no_force(a_scene, ground, slip):
    """Nor on a ground where the snow slips: slip is a shear of the same snow."""
    scene = a_scene(ground=ground, slip_length_m=slip, inclination_deg=20.0)
    density, found = scene.snowpack.density, [sound(scene)]
    for count, kelvin in ((1, 271.3), (2, 255.0), (2, 270.0)):
        one = Layer(thickness=4.0 / count, density=density, temperature=kelvin)
        found.append(sound(layered(scene, *[one] * count)))
    plain, warm, cold, warmer = found
    for one, other in ((warm, plain), (warmer, cold)):
        assert one.foot.size == pytest.approx(other.foot.size, rel=1e-7)
        assert one.head.size == pytest.approx(other.head.size, rel=1e-7)
    ratio = compute_fluidity(270.0) / compute_fluidity(255.0)
    assert warmer.largest_velocity / cold.largest_velocity == pytest.approx(
        ratio, rel=1e-5
    )


# --- contacts ----------------------------------------------------------------


@pytest.mark.parametrize("friction_deg", [0.0, 2.0])
def test_one_sided_net_on_rough_ground(a_scene, friction_deg):
    """FACTS.md, section 11: suction over the top 0.2 % of the net there."""
    scene = a_scene(ground="no-slip", inclination_deg=30.0, friction_deg=friction_deg)
    two, one = sound(scene), sound(replace(scene, net_contact="one-sided"))
    assert 0.0 < two.balance.suction_share < 0.005
    assert one.balance.suction_share < 1e-9
    # what lets go is a few thousandths of the pressure
    assert one.foot.size == pytest.approx(two.foot.size, rel=1e-3)
