"""Rigid walls: other codes and limits are in the pack; here what must hold exactly."""

import math
from dataclasses import replace

import pytest

from netdesign.addons.evidence.verification.rigid import Wall, put_wall, solve_rigid
from netdesign.coupling.scene import SolverSettings
from tests.each import each

SETTINGS = SolverSettings(accuracy=0.02)


def press(a_scene, *, friction_angle=None, inclination=0.0, **scene):
    wall = Wall(
        height_normal=4.0, inclination=inclination, friction_angle=friction_angle
    )
    return solve_rigid(put_wall(a_scene(**scene), wall), SETTINGS)


@each("inclination", [0.0, 0.5])
@each("friction_angle", [None, 0.0, 0.4])
def test_free_ground_leaves_its_weight_to_the_wall(
    a_scene, friction_angle, inclination
):
    """Along X the wall carries weight times sin psi, whatever holds the snow on it."""
    solution = press(a_scene, friction_angle=friction_angle, inclination=inclination)
    area = 20.0 * 4.0 + 4.0**2 * math.tan(inclination) / 2.0
    expected = 0.4 * 917 * 9.81 * area * math.sin(math.radians(40))
    assert solution.force.x == pytest.approx(expected, rel=1e-8)
    assert solution.balance.relative_residual < 1e-8


def test_smooth_wall_normal_to_the_slope_has_no_shear(a_scene):
    solution = press(a_scene, friction_angle=0.0, ground="no-slip")
    assert abs(solution.force.y) < 1e-9 * solution.force.x
    assert solution.wall_slides[1:].all()


def test_adhering_snow_hangs_on_the_wall(a_scene):
    """Held by the wall, the settling snow pulls it towards the ground."""
    solution = press(a_scene, ground="no-slip")
    assert solution.force.y < 0.0
    assert not solution.wall_slides.any()


def test_moment_is_that_of_the_nodal_forces(a_scene):
    solution = press(a_scene, ground="no-slip", inclination=0.3)
    (x, y), (force_x, force_y) = solution.wall_nodes, solution.wall_forces
    moment = (y * force_x - x * force_y).sum()
    assert solution.moment_about_foot == pytest.approx(moment, rel=1e-12)
    arm = solution.moment_about_foot / solution.force.size
    assert 0.0 < arm < 4.0  # it tips the upper edge downslope, about the foot


def test_fluidity_leaves_the_force(a_scene):
    wall = Wall(height_normal=4.0)
    scene = replace(a_scene(ground="no-slip"), net=wall)
    slow = solve_rigid(scene, SETTINGS)
    fast = solve_rigid(replace(scene, fluidity=9.0 * scene.creep_fluidity), SETTINGS)
    assert fast.force.x == slow.force.x
    assert fast.largest_velocity == pytest.approx(
        9.0 * slow.largest_velocity, rel=1e-12
    )
