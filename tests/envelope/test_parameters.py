import math
from dataclasses import replace

import pytest

from netdesign.envelope.ranges import (
    PARAMETERS,
    Case,
    Interval,
    Ranges,
    build_case,
    place_scene,
    require_valid,
)
from netdesign.outcome import ModelError
from netdesign.snow.ground import GROUND_KINDS, GroundLaw
from netdesign.snow.snowpack import Layer, build_layered_snowpack
from tests.each import each
from tests.solving.small_scene import build_scene

FREE = build_scene(Case(density=300.0, friction_angle=0.4, inclination=0.5))
SCENE = replace(FREE, ground=GroundLaw(kind="sliding", slip_length=1.37))
VALUES = {
    "density": 333.0,
    "friction_angle": 0.31,
    "inclination": 0.22,
    "slope_angle": 0.66,
    "thickness": 2.5,
    "slack": 0.03,
    "upslope_length": 7.3,
    "net_stiffness": 6.1e6,
    "glide_factor": 1.4,
}
ALSO = {"snow_height": 3.1, "slip_length": 0.83}  # instead of two of them


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
    assert placed.snowpack.upslope_length == 7.3
    assert placed.net.stiffness_per_m == 6.1e6
    assert placed.ground.kind == "sliding"
    assert placed.net.height_normal == SCENE.net.height_normal
    assert place_scene(SCENE, {}) == SCENE
    assert set(VALUES) | set(ALSO) == set(PARAMETERS)


def test_the_other_name_of_a_quantity_means_the_same():
    """Vertical height with the slope that ranges along, slip length as it is."""
    placed = place_scene(SCENE, ALSO | {"slope_angle": 0.66})
    assert placed.snowpack.thickness == pytest.approx(3.1 * math.cos(0.66), rel=1e-12)
    assert (placed.ground.kind, placed.ground.slip_length) == ("sliding", 0.83)


def test_layers_keep_their_proportions_as_their_thickness_ranges():
    layers = (
        Layer(thickness=0.7, density=410.0, temperature=271.0),
        Layer(thickness=1.6, density=233.0),
    )
    pack = build_layered_snowpack(layers, slope_angle=0.6, upslope_length=9.0)
    placed = place_scene(replace(SCENE, snowpack=pack), {"thickness": 2.99})
    shares = [one.thickness / 2.99 for one in placed.layers]
    assert shares == pytest.approx([0.7 / 2.3, 1.6 / 2.3], rel=1e-12)
    assert [one.density for one in placed.layers] == pytest.approx([410.0, 233.0])
    assert placed.layers[0].temperature == 271.0


def test_glide_takes_the_thickness_that_ranges_with_it():
    """The slip length of a glide factor is a share of the thickness."""
    both = place_scene(SCENE, {"glide_factor": 1.4, "thickness": 1.5})
    alone = place_scene(SCENE, {"glide_factor": 1.4})
    assert both.ground.slip_length == pytest.approx(alone.ground.slip_length / 2.0)


def test_a_case_knows_the_scenes_own_values_and_the_others():
    case = build_case(SCENE, {"friction_angle": 0.2, "slack": 0.1})
    assert (case.density, case.friction_angle) == (300.0, 0.2)
    assert case.others == (("slack", 0.1),)


@each(
    "spans, told",
    [
        ({"density": (250.0, 950.0)}, "snow density = 950.0"),
        ({"friction_angle": (0.1, 1.6)}, "friction"),
        (
            {"thickness": (2.0, 3.5)},
            "effective height D_K = 3 m is below the snow thickness",
        ),
        ({"slack": (0.0, 0.9)}, "slack = 0.9"),
        ({"glide_factor": (1.0, 99.0)}, "glide factor = 99.0"),
        ({"slope_angle": (0.5, math.pi)}, "slope angle"),
    ],
)
def test_a_corner_outside_the_model_is_refused_by_value(spans, told):
    with pytest.raises(ModelError, match=told):
        require_valid(SCENE, box(**spans))


@pytest.mark.parametrize("kind", [one for one in GROUND_KINDS if one != "sliding"])
@pytest.mark.parametrize("name", ["slip_length", "glide_factor"])
def test_glide_ranges_on_sliding_ground_only(kind, name):
    still = replace(SCENE, ground=GroundLaw(kind=kind))
    with pytest.raises(ModelError, match="does not slide, but the envelope"):
        place_scene(still, {name: 1.17})
    with pytest.raises(ModelError, match="does not slide"):
        require_valid(still, box(density=(250.0, 300.0), **{name: (1.1, 1.3)}))


def test_corners_are_met_exactly_and_single_values_are_no_axis():
    ranges = box(
        inclination=(0.1, 0.1), friction_angle=(0.2, 0.7), density=(250.0, 450.0)
    )
    assert ranges.axes == ("density", "friction_angle")
    assert ranges.place((0.0, 1.0)) == {
        "density": 250.0, "friction_angle": 0.7, "inclination": 0.1,
    }  # fmt: skip
    assert ranges.place((0.5, 0.5))["density"] == 350.0


@pytest.mark.parametrize("names", [["denisty"], ["slack", "slack"]])
def test_names_that_no_parameter_has_or_that_stand_twice_are_refused(names):
    span = Interval(low=0.03, high=0.07)
    with pytest.raises(ModelError, match=f"{names[0]}.*accepted are density"):
        Ranges(intervals=tuple((name, span) for name in names))
