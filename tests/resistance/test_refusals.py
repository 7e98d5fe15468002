"""Every number that a resistance follows from: its bounds, its name, its unit."""

import math

import pytest

from netdesign.outcome import ModelError
from netdesign.resistance.ground import PullOutTests
from netdesign.resistance.steel import (
    RoundSection,
    compute_bent_bar_resistance,
)
from tests.each import each

BAR = {"outer": 0.0317, "strength": 5e8}
TUBE = BAR | {"inner": 0.011}
LEVER = {"angle": 0.31, "lever": 0.043}
SECTION = RoundSection(outer=0.0317, strength=5e8)


def bend(**changes):
    return compute_bent_bar_resistance(SECTION, **changes)


WITHIN = [
    (RoundSection, BAR, "outer", 0.005, 0.2, " m"),
    (RoundSection, TUBE, "inner", 0.0, 0.98 * 0.0317, " m"),
    (RoundSection, BAR, "strength", 1e8, 2.5e9, " Pa"),
    (bend, LEVER, "angle", 0.0, math.radians(89.0), " rad"),
    (bend, LEVER, "lever", 0.0, 2.0, " m"),
]
# Names in refusals, where they are not those of the argument.
NAMES = {
    (RoundSection, "outer"): "bar diameter",
    (RoundSection, "inner"): "inner diameter",
    (RoundSection, "strength"): "steel strength",
    (bend, "angle"): "angle of the pull",
    (bend, "lever"): "lever arm",
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
