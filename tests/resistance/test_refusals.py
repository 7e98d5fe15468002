"""Every number that a resistance follows from: its bounds, its name, its unit."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.resistance.ground import PullOutTests
from netdesign.resistance.post import (
    PostSection,
    compute_bent_post_resistance,
    compute_buckling_resistance,
    compute_post_moment,
)
from netdesign.resistance.steel import (
    RoundSection,
    compute_bent_bar_resistance,
    compute_rope_resistance,
)
from tests.each import each

POST = {
    "width": 0.137,
    "length": 2.93,
    "modulus": 1.13e-4,
    "strength": 2.35e8,
    "critical": 6.1e5,
    "buckling": 3.7e5,
    "at_head": 0.061,
    "at_foot": 0.0,
}
BUCKLING = {
    "area": 3.3e-3,
    "second_moment": 8.7e-6,
    "length": 3.07,
    "yield_strength": 2.35e8,
    "modulus": 2.1e11,
    "imperfection": 0.49,
}
ROPE = {
    "diameter": 0.0183,
    "grade": 1.77e9,
    "breaking_factor": 0.33,
    "termination": 0.9,
}
BAR = {"outer": 0.0317, "strength": 5e8}
TUBE = BAR | {"inner": 0.011}
LEVER = {"angle": 0.31, "lever": 0.043}
SECTION = RoundSection(outer=0.0317, strength=5e8)
SNOW = {"pressure": 6.3e3, "efficiency": 2.0}
MOMENT = {"moment": 3.1e3, "partial_factor": 1.05}


def bend(**changes):
    return compute_bent_bar_resistance(SECTION, **changes)


def press(**changes):
    return compute_post_moment(PostSection(**POST), **changes)


def bend_post(**changes):
    return compute_bent_post_resistance(PostSection(**POST), **changes)


WITHIN = [
    (compute_buckling_resistance, BUCKLING, "yield_strength", 1e8, 1e9, " Pa"),
    (compute_buckling_resistance, BUCKLING, "imperfection", 0.0, 1.0, ""),
    (PostSection, POST, "width", 0.01, 1.0, " m"),
    (PostSection, POST, "at_head", 0.0, 1.0, " m"),
    (PostSection, POST, "at_foot", 0.0, 1.0, " m"),
    (press, SNOW, "efficiency", 0.1, 50.0, ""),
    (bend_post, MOMENT, "moment", 0.0, math.inf, " N m"),
    (bend_post, MOMENT, "partial_factor", 0.1, 10.0, ""),
    (RoundSection, BAR, "outer", 0.005, 0.2, " m"),
    (RoundSection, TUBE, "inner", 0.0, 0.98 * 0.0317, " m"),
    (RoundSection, BAR, "strength", 1e8, 2.5e9, " Pa"),
    (bend, LEVER, "angle", 0.0, math.radians(89.0), " rad"),
    (bend, LEVER, "lever", 0.0, 2.0, " m"),
    (compute_rope_resistance, ROPE, "diameter", 0.004, 0.1, " m"),
    (compute_rope_resistance, ROPE, "grade", 1e9, 2.5e9, " Pa"),
    (compute_rope_resistance, ROPE, "breaking_factor", 0.1, 0.7, ""),
    (compute_rope_resistance, ROPE, "termination", 0.1, 1.0, ""),
]
POSITIVE = [
    (compute_buckling_resistance, BUCKLING, "area", " m2"),
    (compute_buckling_resistance, BUCKLING, "second_moment", " m4"),
    (compute_buckling_resistance, BUCKLING, "length", " m"),
    (compute_buckling_resistance, BUCKLING, "modulus", " Pa"),
    (PostSection, POST, "length", " m"),
    (PostSection, POST, "modulus", " m3"),
    (PostSection, POST, "strength", " Pa"),
    (PostSection, POST, "critical", " N"),
    (PostSection, POST, "buckling", " N"),
    (press, SNOW, "pressure", " Pa"),
]
# Names in refusals, where they are not those of the argument.
NAMES = {
    (compute_buckling_resistance, "second_moment"): "second moment of area",
    (compute_buckling_resistance, "length"): "buckling length",
    (compute_buckling_resistance, "imperfection"): "imperfection factor",
    (PostSection, "width"): "post width",
    (PostSection, "length"): "buckling length",
    (PostSection, "modulus"): "section modulus",
    (PostSection, "strength"): "yield strength",
    (PostSection, "critical"): "critical load",
    (PostSection, "buckling"): "buckling resistance",
    (PostSection, "at_head"): "eccentricity",
    (PostSection, "at_foot"): "eccentricity",
    (press, "pressure"): "snow pressure",
    (press, "efficiency"): "efficiency factor",
    (bend_post, "moment"): "design moment",
    (RoundSection, "outer"): "bar diameter",
    (RoundSection, "inner"): "inner diameter",
    (RoundSection, "strength"): "steel strength",
    (bend, "angle"): "angle of the pull",
    (bend, "lever"): "lever arm",
    (compute_rope_resistance, "diameter"): "rope diameter",
    (compute_rope_resistance, "grade"): "rope grade",
    (compute_rope_resistance, "termination"): "termination factor",
}


def name_of(build, argument):
    return NAMES.get((build, argument), argument.replace("_", " "))


def refuse(build, given, argument, value):
    with pytest.raises(ModelError) as refused:
        build(**(given | {argument: value}))
    return str(refused.value)


@each("build, given, argument, low, high, unit", WITHIN)
def test_what_lies_outside_is_refused_and_both_ends_are_not(
    build, given, argument, low, high, unit
):
    for end in (low, min(high, 1e30)):
        build(**(given | {argument: end}))
    below = low * (1.0 - 1e-9) if low else -1e-9
    for value in (below, high * (1.0 + 1e-9), math.nan, math.inf):
        told = refuse(build, given, argument, value)
        assert told.startswith(f"{name_of(build, argument)} = ")
        assert told.endswith(f"must lie between {low:.6g} and {high:.6g}{unit}")


@each("build, given, argument, unit", POSITIVE)
@each("value", [0.0, -1e-9, math.nan, math.inf])
def test_what_is_not_above_zero_is_refused(build, given, argument, unit, value):
    told = refuse(build, given, argument, value)
    assert told.startswith(f"{name_of(build, argument)} = ")
    assert told.endswith(f"must be a finite number above 0{unit}")


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"count": 0}, "number of tests = 0: "),
        ({"least": 0.0}, "least tested resistance = 0.0: must be a finite number"),
        ({"least": 301e3}, "least tested resistance = 301000.0: must lie between 0"),
        ({"mean": math.nan}, "least tested resistance = 271000.0: must lie between 0"),
    ],
)
def test_tests_that_cannot_be_are_refused(changes, told):
    given = {"count": 3, "least": 271e3, "mean": 293e3} | changes
    with pytest.raises(ModelError) as refused:
        PullOutTests(**given)
    assert str(refused.value).startswith(told)
    assert "count" in changes or str(refused.value).endswith(" N")
