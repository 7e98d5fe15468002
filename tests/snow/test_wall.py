"""Guards of a rigid wall."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.snow.wall import Wall
from tests.each import each

STEEPEST, ROUGHEST = math.radians(80.0), math.radians(60.0)


def test_friction():
    assert Wall(height_normal=1.0).friction == math.inf
    assert Wall(height_normal=1.0, friction_angle=0.0).friction == 0.0
    rough = Wall(height_normal=1.0, friction_angle=math.pi / 4)
    assert rough.friction == pytest.approx(1.0, rel=1e-15)


@each(
    "field, value",
    [
        ("height_normal", 1e-9),
        ("inclination", 0.0),
        ("inclination", STEEPEST),
        ("friction_angle", 0.0),
        ("friction_angle", ROUGHEST),
        ("friction_angle", None),
    ],
)
def test_bounds_are_accepted(field, value):
    wall = Wall(**{"height_normal": 3.0, field: value})
    assert getattr(wall, field) == value


@each(
    "field, value, name",
    [
        ("height_normal", 0.0, "wall height"),
        ("height_normal", -1.0, "wall height"),
        ("inclination", -1e-12, "wall inclination"),
        ("inclination", math.nextafter(STEEPEST, 2.0), "wall inclination"),
        ("friction_angle", -1e-12, "friction angle"),
        ("friction_angle", math.nextafter(ROUGHEST, 2.0), "friction angle"),
        *(
            (field, value, name)
            for field, name in (
                ("height_normal", "wall height"),
                ("inclination", "wall inclination"),
                ("friction_angle", "friction angle"),
            )
            for value in (math.nan, math.inf, -math.inf)
        ),
    ],
)
def test_beyond_is_refused(field, value, name):
    with pytest.raises(ModelError, match=f"{name} = .*must"):
        Wall(**{"height_normal": 3.0, field: value})
