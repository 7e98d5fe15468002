"""What must hold of every steady state, whatever its numbers are."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.evidence.verification.rigid import Wall, put_wall, solve_rigid
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow import snowpack
from netdesign.snow.creep_law import BOUTILLIER_2004
from tests.coupling.drawn_scenes import GROUNDS, draw_scene
from tests.each import each

COARSE = SolverSettings(
    accuracy=0.1,
    stress_tolerance=1e-8,
    shape_tolerance=1e-7,
    levels=MESH_LEVELS[1:3],
)


def pulls(solution) -> np.ndarray:
    """Both end pulls [N/m]."""
    foot, head = solution.foot, solution.head
    return np.array([foot.x, foot.y, head.x, head.y])


def meshed_area(solution) -> float:
    """L d and what lies under the net's curve, Simpson on its parabolic edges."""
    pack = solution.scene.snowpack
    n_net = solution.net_forces.shape[1]
    x, y = solution.net_curve[:, :n_net]
    x0, x1, x2 = x[:-2:2], x[1::2], x[2::2]
    y0, y1, y2 = y[:-2:2], y[1::2], y[2::2]
    # integral of x dy over a parabola through three points
    slopes = (4 * y1 - 3 * y0 - y2, y2 - y0, 3 * y2 - 4 * y1 + y0)
    under = (x0 * slopes[0] + 4 * x1 * slopes[1] + x2 * slopes[2]).sum() / 6
    return pack.upslope_length * pack.thickness + under


def weight(solution) -> float:
    return 9.81 * solution.scene.snowpack.density * meshed_area(solution)


# --- balance -----------------------------------------------------------------


@each("inclination", [0.0, 30.0])
@each("friction_deg", [0.0, 5.0, 20.0, 45.0])
def test_free_base_hangs_its_weight_on_the_net(solved, inclination, friction_deg):
    """Along X the pulls are the weight times sin psi, whatever phi is."""
    solution = solved(inclination_deg=inclination, friction_deg=friction_deg)
    expected = weight(solution) * math.sin(math.radians(40.0))
    found = solution.foot.x + solution.head.x
    assert found == pytest.approx(solution.balance.weight_along_slope, rel=1e-8)
    # the reported curve is one round younger than the mesh: 1e-7 of the thickness
    assert found == pytest.approx(expected, rel=1e-7)


def test_bulge_weighs_one_to_three_per_cent(solved):
    """FACTS.md, section 6: more than a straight net would hold."""
    for inclination in (0.0, 30.0):
        solution = solved(inclination_deg=inclination)
        pack = solution.scene.snowpack
        wedge = pack.thickness**2 * math.tan(math.radians(inclination)) / 2
        area = pack.upslope_length * pack.thickness + wedge
        stress = pack.stress_scale * math.sin(pack.slope_angle)
        straight = stress * area / pack.thickness
        share = solution.balance.weight_along_slope / straight - 1.0
        assert 0.01 <= share <= 0.03


def test_gravity_along_the_slope_alone_does_not_change_the_weight_along_it(solved):
    solution = solved(inclination_deg=30.0, gravity="parallel")
    expected = weight(solution) * math.sin(math.radians(40.0))
    assert solution.foot.x + solution.head.x == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("friction_angle", [None, 0.0, 0.5])
def test_level_free_ground_pushes_nothing_downslope(a_scene, friction_angle):
    """Slope 0: no force along X in sum, since the upslope end is free too."""
    level = a_scene(slope_deg=0.0)
    wall = Wall(height_normal=4.0, friction_angle=friction_angle)
    solution = solve_rigid(put_wall(level, wall))
    pack = level.snowpack
    weight_of_snow = pack.stress_scale * pack.upslope_length
    assert abs(solution.force.x) <= 1e-9 * weight_of_snow
    released = solve_steady(level)
    assert released.is_released
    assert released.scene == replace(level, net_contact="one-sided")
    assert abs(released.foot.x + released.head.x) <= 1e-8 * weight_of_snow
    assert released.tension_max <= 1e-4 * weight_of_snow


# --- similarity --------------------------------------------------------------


SCALED = [
    {"thickness_m": 2.0, "length_m": 10.0, "stiffness_kN_per_m": 2e4 / 4},
    {"thickness_m": 6.0, "length_m": 30.0, "stiffness_kN_per_m": 2e4 * 2.25},
]


@pytest.mark.parametrize(
    "base",
    [
        {"inclination_deg": 30.0},
        {"inclination_deg": 20.0, "friction_deg": 8.0, "slack": 0.03},
    ],
    ids=str,
)
@pytest.mark.parametrize("scaled", SCALED, ids=str)
def test_size_of_the_snowpack(solved, base, scaled):
    """ES / (rho g d^2), L / d, Dk / d kept: forces over rho g d^2 are the same."""
    one, other = solved(**base), solved(**base, **scaled)
    np.testing.assert_allclose(
        pulls(other) / other.scene.force_scale,
        pulls(one) / one.scene.force_scale,
        rtol=1e-9,
    )
    assert other.sag / other.scene.snowpack.thickness == pytest.approx(
        one.sag / one.scene.snowpack.thickness, rel=1e-9
    )


def test_slip_length_and_freeboard_scale_too(solved):
    base = {"inclination_deg": 15.0, "ground": "sliding"}
    one = solved(**base, slip_length_m=2.0, height_m=4.4)
    other = solved(**base, **SCALED[0], slip_length_m=1.0, height_m=2.2)
    np.testing.assert_allclose(
        pulls(other) / other.scene.force_scale,
        pulls(one) / one.scene.force_scale,
        rtol=1e-9,
    )


def test_gravity_scales_forces(a_scene, solved, monkeypatch):
    """On the moon, with a net softer by the same ratio."""
    moon = 1.62 / 9.81
    one = solved(inclination_deg=30.0)
    monkeypatch.setattr(snowpack, "GRAVITY", 1.62)
    scene = a_scene(inclination_deg=30.0, stiffness_kN_per_m=2e4 * moon)
    other = solve_steady(scene, COARSE, on_failure="raise")
    np.testing.assert_allclose(pulls(other), pulls(one) * moon, rtol=1e-9)


def test_density_enters_by_weight_and_by_a_over_b(a_scene):
    """A law whose a and b fall alike: density is then weight alone."""
    c0, c1 = BOUTILLIER_2004.shear_fit
    law = replace(BOUTILLIER_2004, shear_fit=(c0, c1), bulk_fit=(c0 - 0.6, c1))
    found = []
    for density in (0.3, 0.5):
        scene = a_scene(
            inclination_deg=30.0,
            relative_density=density,
            stiffness_kN_per_m=2e4 * density / 0.4,
            creep_law=law,
        )
        solution = solve_steady(scene, COARSE, on_failure="raise")
        found.append(pulls(solution) / density)
    np.testing.assert_allclose(found[1], found[0], rtol=1e-9)


# --- limits of friction ------------------------------------------------------


@pytest.mark.parametrize("inclination", [0.0, 30.0])
def test_without_friction_tension_tends_to_uniform(solved, inclination):
    """To first order in the mesh level: the pressure is singular at both ends."""
    spreads = []
    for level in (0, 1, 2):
        solution = solved(level, inclination_deg=inclination, friction_deg=0.0)
        spreads.append(solution.tension_max / solution.tension_min - 1.0)
    assert spreads[0] > 1.5 * spreads[1] > 1.5 * 1.5 * spreads[2]
    assert spreads[2] <= 5e-4


def test_little_friction_is_close_to_none(solved):
    """Continuous: phi = 0.01 deg can change tension by mu times a turning of 2."""
    none = solved(inclination_deg=30.0, friction_deg=0.0)
    little = solved(inclination_deg=30.0, friction_deg=0.01)
    bound = 2.0 * math.tan(math.radians(0.01))
    for end in ("foot", "head"):
        ratio = getattr(little, end).size / getattr(none, end).size
        assert abs(ratio - 1.0) <= bound


@pytest.mark.parametrize(
    ("scene", "lowest"),
    [({}, 15.0), ({"ground": "no-slip", "inclination_deg": 30.0}, 30.0)],
    ids=str,
)
def test_where_all_sticks_more_friction_changes_nothing(solved, scene, lowest):
    reference = solved(**scene, friction_deg=lowest)
    assert not reference.net_slides.any()
    for friction_deg in (37.0, 45.0, 60.0):
        other = solved(**scene, friction_deg=friction_deg)
        np.testing.assert_allclose(pulls(other), pulls(reference), rtol=1e-9)


# --- sweep -------------------------------------------------------------------


@each("seed", range(18))
def test_tension_shear_and_balance_of_drawn_scenes(seed):
    """Uniform snow and layers, on every ground."""
    scene = draw_scene(seed, ground=GROUNDS[seed % 3])
    solution = solve_steady(scene, COARSE, on_failure="raise")
    net = solution.scene.net
    assert solution.tension_min > 0.0
    n_net = solution.net_forces.shape[1]
    curve, forces = solution.net_curve[:, :n_net], solution.net_forces
    along = (curve[:, 2:] - curve[:, :-2]) / np.hypot(*(curve[:, 2:] - curve[:, :-2]))
    normal = along[1] * forces[0, 1:-1] - along[0] * forces[1, 1:-1]
    shear = along[0] * forces[0, 1:-1] + along[1] * forces[1, 1:-1]
    # tangents of the parabolas at their midpoints, not the program's nodal normals
    middle = slice(0, None, 2)
    limit = net.friction * np.maximum(normal[middle], 0.0)
    assert (np.abs(shear[middle]) <= limit + 1e-3 * normal.max()).all()
    whole = solution.balance.weight_along_slope
    assert 0.0 < solution.foot.x + solution.head.x <= whole * (1 + 1e-8)
    assert solution.balance.relative_residual <= 1e-8


# --- the net's own length ------------------------------------------------------


# Tension is taken constant over an edge of the net, of which it is the mean: second
# order in edges of an eighth of the height, in a stretch of a few per cent.
TOLERANCE = 3e-5


def unstressed_length(solution) -> float:
    """Sum over the net's edges of stretched length over 1 + T / ES."""
    stiffness = solution.scene.net.stiffness_per_m
    curve, forces = solution.net_curve, solution.net_forces
    points, weights = np.polynomial.legendre.leggauss(6)
    slopes = np.array([points - 0.5, -2 * points, points + 0.5])
    vector = np.array([solution.foot.x, solution.foot.y]) - forces[:, 0]
    total = 0.0
    for middle in range(1, curve.shape[1], 2):
        ds = np.hypot(*(curve[:, middle - 1 : middle + 2] @ slopes))
        loaded = middle < forces.shape[1]  # a free end above the snow is not
        half = forces[:, middle] / 2 if loaded else 0.0
        tension = np.hypot(*(vector - half))
        total += float((weights * ds).sum()) / (1.0 + tension / stiffness)
        if middle + 1 < forces.shape[1]:
            vector = vector - 2 * half - forces[:, middle + 1]
    return total


@each("slack", [0.0, 0.02, 0.08])
@each(
    "scene",
    [
        {},
        {"inclination_deg": 30.0, "friction_deg": 5.0},
        {"inclination_deg": 20.0, "height_m": 5.0},
        {"ground": "no-slip", "stiffness_kN_per_m": 4e3},
    ],
)
def test_net_keeps_its_unstressed_length(solved, scene, slack):
    solution = solved(**scene, slack=slack)
    net = solution.scene.net
    np.testing.assert_allclose(solution.net_curve[:, -1], net.head, atol=1e-9)
    chord = float(np.hypot(*net.head))
    expected = (1.0 + slack) * chord
    assert unstressed_length(solution) == pytest.approx(expected, rel=TOLERANCE)
