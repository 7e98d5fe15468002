"""What a moved quantity does to a check: as if it had been typed."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.addons.reliability.check_by_case import CheckByCase
from netdesign.checks import Band, load_standard
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.study.guideline_load import find_effects
from tests.each import each
from tests.guideline.one_floor import find_row_floor
from tests.small_site import build_row

STANDARD = load_standard("swiss-guideline-2007")
HEIGHTS = ("thickness",)
TYPED = {
    "thickness": "snow_thickness",
    "slack": "slack",
    "net_stiffness": "net_stiffness_per_m",
    "glide_factor": "glide_factor",
}


def draw_row(draw, **typed):
    values = {
        "snow_thickness": draw.uniform(1.7, 2.6),
        "slack": draw.uniform(0.01, 0.09),
        "net_stiffness_per_m": draw.uniform(2e6, 2e7),
        "glide_factor": draw.uniform(1.25, 3.1),
        **typed,
    }
    ground = build_ground_from_glide_factor(
        values["glide_factor"], values["snow_thickness"]
    )
    return build_row(
        "R", net_height=3.13, altitude=2137.0, gap=2.9, ground=ground, **values
    )


def draw_ranges(draw, **further):
    low = math.radians(draw.uniform(20.0, 30.0))
    return Ranges.of(
        density=Interval(low=263.0, high=391.0),
        friction_angle=Interval(low=0.31, high=0.72),
        inclination=Interval(low=low, high=low + draw.uniform(0.0, 0.1)),
        **further,
    )


def list_floor(row, ranges):
    floor = find_row_floor(row, ranges, STANDARD)
    return {one.member: one.force for one in floor.forces}


@each("name", TYPED)
@each("seed", [3, 11, 29])
def test_floor_of_a_moved_quantity_is_that_of_a_typed_one(name, seed):
    """Also of one that ranged: its range is gone."""
    row = draw_row(random.Random(seed))
    value = 1.073 * getattr(row, TYPED[name])
    typed = draw_row(random.Random(seed), **{TYPED[name]: value})
    plain = draw_ranges(random.Random(seed))
    ranged = draw_ranges(
        random.Random(seed), **{name: Interval(low=0.9 * value, high=1.1 * value)}
    )
    expected = list_floor(typed, plain)
    assert list_floor(row, plain.with_value(name, value)) == pytest.approx(expected)
    assert list_floor(row, ranged.with_value(name, value)) == pytest.approx(expected)
    # that of a net full of snow does not move with the snow
    is_same = list_floor(row, plain) == pytest.approx(expected)
    assert is_same is (name in HEIGHTS)


def test_floor_follows_a_moved_inclination():
    row = draw_row(random.Random(5))
    ranges = draw_ranges(random.Random(5))
    moved = ranges.with_value("inclination", math.radians(44.3))
    single = {**dict(ranges.intervals), "inclination": moved["inclination"]}
    assert list_floor(row, moved) == list_floor(row, Ranges.of(**single))
    post = list_floor(row, moved)["post"]
    assert post != pytest.approx(list_floor(row, ranges)["post"], rel=1e-3)


def build_check(added):
    """Post whose force is 1 N in its largest case."""
    case = Case(density=391.0, friction_angle=0.31, inclination=0.5)
    result = CaseResult(
        case=case,
        outcome=Outcome.CONVERGED,
        member_forces={"post": Band(low=1.0, value=1.0, high=1.0)},
    )
    return CheckByCase(
        row=build_row("R"),
        ranges=draw_ranges(random.Random(7)),
        scales={"post": 0.41},
        governing=case,
        results=[result],
        added=added,
    )


def test_what_is_added_stays_below_the_largest_force_and_grows_beyond_it():
    """As the post's: A = w k P / tan beta."""
    check = build_check(0.37)
    for share in (0.0, 0.31, 1.0):
        assert check.use(share) == pytest.approx(0.41 * share + 0.37, rel=1e-12)
    for share in (1.07, 2.3):
        assert check.use(share) == pytest.approx(share * (0.41 + 0.37), rel=1e-12)


def test_a_moved_thickness_keeps_the_glide_factor():
    """The slip length follows; it is not the one of the snow before."""
    row = draw_row(random.Random(13))
    case = Case(density=391.0, friction_angle=0.31, inclination=0.5)
    at = row.at(case.with_value("thickness", 1.37))
    assert at.ground == build_ground_from_glide_factor(row.glide_factor, 1.37)
    assert at.ground != replace(row, snow_thickness=1.37).ground


def test_at_an_end_the_largest_glide_factor_of_the_ranges_counts():
    """Of one slip length the thinnest snow has it."""
    draw = random.Random(17)
    row = replace(draw_row(draw), glide_factor=None)
    thin = 0.6 * row.snow_thickness
    span = Interval(low=thin, high=row.snow_thickness)
    wide, plain = draw_ranges(draw, thickness=span), draw_ranges(draw)
    widths = [
        find_effects(one, STANDARD, ranges).supports[-1].width
        for one, ranges in (
            (row, plain),
            (row, wide),
            (replace(row, snow_thickness=thin), plain),
        )
    ]
    assert widths[1] == pytest.approx(widths[2], rel=1e-12)
    assert widths[1] > 1.005 * widths[0]
