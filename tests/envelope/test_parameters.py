import math

import pytest

from netdesign.envelope.parameters import PARAMETERS, place_scene
from netdesign.envelope.ranges import Case, Interval, Ranges, build_case, require_valid
from netdesign.errors import ModelError
from netdesign.snow.wall import Wall
from tests.solving.small_scene import build_scene

SCENE = build_scene(Case(density=300.0, friction_angle=0.4, inclination=0.5))
VALUES = {
    "density": 333.0,
    "friction_angle": 0.31,
    "inclination": 0.22,
    "slope_angle": 0.66,
    "thickness": 2.5,
    "slack": 0.03,
    "glide_factor": 1.4,
}


def box(**spans):
    return Ranges(
        intervals=tuple(
            (name, Interval(low=low, high=high)) for name, (low, high) in spans.items()
        )
    )


def test_every_parameter_reaches_its_place_in_the_scene_and_nothing_else():
    placed = place_scene(SCENE, VALUES)
    assert placed.snowpack.density == 333.0
    assert placed.net.friction_angle == 0.31
    assert placed.net.inclination == 0.22
    assert placed.snowpack.slope_angle == 0.66
    assert placed.snowpack.thickness == 2.5
    assert placed.net.slack == 0.03
    assert placed.ground.kind == "sliding"
    assert placed.net.height_normal == SCENE.net.height_normal
    assert place_scene(SCENE, {}) == SCENE
    assert set(VALUES) == set(PARAMETERS)


def test_glide_takes_the_thickness_that_ranges_with_it():
    """The slip length of a glide factor is a share of the thickness."""
    both = place_scene(SCENE, {"glide_factor": 1.4, "thickness": 1.5})
    alone = place_scene(SCENE, {"glide_factor": 1.4})
    assert both.ground.slip_length == pytest.approx(alone.ground.slip_length / 2.0)


def test_corners_are_met_exactly_and_single_values_are_no_axis():
    ranges = box(
        inclination=(0.1, 0.1), friction_angle=(0.2, 0.7), density=(250.0, 450.0)
    )
    assert ranges.axes == ("density", "friction_angle")
    assert ranges.place((0.0, 1.0)) == {
        "density": 250.0, "friction_angle": 0.7, "inclination": 0.1,
    }  # fmt: skip
    assert ranges.place((0.5, 0.5))["density"] == 350.0


def test_a_case_knows_the_scenes_own_values_and_the_others():
    case = build_case(SCENE, {"friction_angle": 0.2, "slack": 0.1})
    assert (case.density, case.friction_angle) == (300.0, 0.2)
    assert case.others == (("slack", 0.1),)


@pytest.mark.parametrize("names", [("density", "density"), ("mass",)])
def test_unknown_and_repeated_names_are_refused(names):
    spans = tuple((name, Interval(low=0.0, high=1.0)) for name in names)
    with pytest.raises(ModelError, match="accepted are density, friction_angle"):
        Ranges(intervals=spans)


@pytest.mark.parametrize(
    ("spans", "told"),
    [
        ({"density": (250.0, 950.0)}, "snow density = 950.0"),
        ({"friction_angle": (0.1, 1.6)}, "friction"),
        ({"thickness": (2.0, 3.5)}, "net height = 3 m is below the snow thickness"),
        ({"slack": (0.0, 0.9)}, "slack = 0.9"),
        ({"glide_factor": (1.0, 99.0)}, "glide factor = 99.0"),
        ({"slope_angle": (0.5, math.pi)}, "slope angle"),
    ],
)
def test_a_corner_outside_the_model_is_refused_by_value(spans, told):
    with pytest.raises(ModelError, match=told):
        require_valid(SCENE, box(**spans))


def test_all_faults_come_at_once():
    spans = {"density": (-5.0, 300.0), "slack": (0.0, 0.9)}
    with pytest.raises(ModelError) as caught:
        require_valid(SCENE, box(**spans))
    assert "density = -5.0" in str(caught.value)
    assert "slack = 0.9" in str(caught.value)


def test_a_rigid_wall_has_no_envelope():
    from dataclasses import replace

    wall = Wall(height_normal=3.0, inclination=0.1, friction_angle=None)
    walled = replace(SCENE, net=wall)
    with pytest.raises(ModelError, match="rigid wall"):
        require_valid(walled, box(inclination=(0.1, 0.2)))
    with pytest.raises(ModelError, match="rigid wall"):
        build_case(walled, {})
