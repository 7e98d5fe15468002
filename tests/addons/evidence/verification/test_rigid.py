"""Rigid walls: what must hold exactly, and outcomes; other codes are in the pack."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from netdesign.addons.evidence.scene import build_scene
from netdesign.addons.evidence.verification.rigid import (
    Wall,
    WallSolution,
    put_wall,
    solve_rigid,
    solve_wall,
)
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.snow.creep_law import BOUTILLIER_2004, CREEP_LAWS
from netdesign.snow.ground import GroundLaw, compute_slip_length, load_glide_tables
from tests.each import each

COARSE = SolverSettings(
    accuracy=0.1,
    stress_tolerance=1e-8,
    shape_tolerance=1e-7,
    levels=MESH_LEVELS[1:3],
)
PRESSED = {"ground": "no-slip", "inclination_deg": 0.0}
FINE = SolverSettings(accuracy=0.001)
ROUGH = GroundLaw(kind="no-slip")


def press_by_recipe(law, ground, length):
    """Force on a wall normal to the slope and as high as the snow, which adheres."""
    scene = build_scene((3.0, 340.0), slope=40.0, length=length, ground=ground, lean=0)
    return solve_wall(replace(scene, creep_law=CREEP_LAWS[law]), FINE).force.x


def measure_glide_factor(law, slip_ratio, length=240.0):
    """Ratio of snow pressures on a rigid wall with and without sliding."""
    sliding = GroundLaw(kind="sliding", slip_length=3.0 * slip_ratio)
    pressed = [press_by_recipe(law, ground, length) for ground in (sliding, ROUGH)]
    return pressed[0] / pressed[1]


def walled(a_scene, friction_angle=None, inclination=0.0, **given):
    wall = Wall(
        height_normal=4.0, inclination=inclination, friction_angle=friction_angle
    )
    return put_wall(a_scene(**given), wall)


def press(*arguments, settings=COARSE, **given) -> WallSolution:
    solution = solve_rigid(walled(*arguments, **given), settings)
    assert isinstance(solution, WallSolution)
    assert solution.balance.relative_residual < 1e-8
    return solution


@pytest.mark.parametrize("inclination", [0.0, 0.5])
@pytest.mark.parametrize("friction_angle", [0.05, 0.2])
def test_friction_is_within_its_limit(a_scene, friction_angle, inclination):
    solution = press(a_scene, friction_angle, inclination, ground="no-slip")
    assert solution.balance.friction_excess <= 1e-8
    normal = np.array([math.cos(inclination), -math.sin(inclination)])
    along = np.array([math.sin(inclination), math.cos(inclination)])
    pressure, shear = (part @ solution.wall_forces[:, 1:] for part in (normal, along))
    slips = solution.wall_slides[1:]
    assert slips.any()
    limit = math.tan(friction_angle) * np.maximum(pressure, 0.0)
    scale = pressure.max()
    np.testing.assert_allclose(np.abs(shear[slips]), limit[slips], atol=1e-8 * scale)
    assert (np.abs(shear) <= limit + 1e-8 * scale).all()


@each("inclination", [0.0, 0.5])
@each("friction_angle", [None, 0.0, 0.4])
def test_free_ground_leaves_its_weight_to_the_wall(
    a_scene, friction_angle, inclination
):
    """Along X the wall carries weight times sin psi, whatever holds the snow on it."""
    solution = press(a_scene, friction_angle, inclination)
    area = 20.0 * 4.0 + 4.0**2 * math.tan(inclination) / 2.0
    expected = 0.4 * 917 * 9.81 * area * math.sin(math.radians(40))
    assert solution.force.x == pytest.approx(expected, rel=1e-8)


def test_smooth_wall_normal_to_the_slope_has_no_shear(a_scene):
    solution = press(a_scene, 0.0, **PRESSED)
    assert abs(solution.force.y) < 1e-9 * solution.force.x
    assert solution.wall_slides[1:].all()


def test_fluidity_leaves_the_force(a_scene):
    scene = walled(a_scene, **PRESSED)
    slow = solve_rigid(scene, COARSE)
    fast = solve_rigid(replace(scene, fluidity=9.0 * scene.creep_fluidity), COARSE)
    assert fast.force.x == slow.force.x


def test_one_sided_wall_and_ground_do_not_pull(a_scene):
    scene = walled(a_scene, 0.1, 0.5, ground="free")
    two = solve_rigid(scene, COARSE)
    assert two.balance.suction_share > 0.0
    assert two.balance.ground_tension_share > 0.0
    one = solve_rigid(
        replace(scene, net_contact="one-sided", ground_contact="one-sided"), COARSE
    )
    assert one.balance.suction_share < 1e-9
    assert one.balance.ground_tension_share < 1e-9


def test_stated_error_holds(a_scene):
    coarse = press(a_scene, **PRESSED)
    fine = press(a_scene, settings=replace(COARSE, levels=MESH_LEVELS[2:]), **PRESSED)
    apart = math.hypot(coarse.force.x - fine.force.x, coarse.force.y - fine.force.y)
    assert apart <= coarse.force.error


@pytest.mark.long
def test_a_longer_snowpack_leaves_the_largest_glide_factor():
    law = BOUTILLIER_2004.name
    recipe = measure_glide_factor(law, 31.5)
    assert measure_glide_factor(law, 31.5, 341.0) == pytest.approx(recipe, rel=5e-4)
    # too short: 20 thicknesses
    assert measure_glide_factor(law, 31.5, 61.0) < 0.99 * recipe


@pytest.mark.long
@each("law, ratio", [*product(load_glide_tables(), (0.025, 1.0, 31.5))][::2])
def test_recipe_gives_the_stored_table(law, ratio):
    table = load_glide_tables()[law]
    place = table.slip_ratios.index(ratio)
    measured = measure_glide_factor(law, ratio)
    assert measured == pytest.approx(table.glide_factors[place], abs=1e-4)  # as printed


@pytest.mark.long
@each("law, ratio", [*product(load_glide_tables(), (0.0281, 3.58, 14.1))][1::2])
def test_between_entries_factor_and_slip_length_are_those_of_the_recipe(law, ratio):
    measured = measure_glide_factor(law, ratio)
    table = load_glide_tables()[law]
    assert table.find_glide_factor(ratio) == pytest.approx(measured, rel=2e-3)
    assert compute_slip_length(measured, 1.0, law) == pytest.approx(ratio, rel=0.01)
