"""What a moved quantity does to a check: as if it had been typed."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.study.check_by_case import CheckByCase, Setting
from netdesign.study.effects import find_effects
from netdesign.study.record_guideline import find_row_floor
from tests.each import each
from tests.small_site import build_row

STANDARD = load_standard("swiss-guideline-2007")
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
    assert list_floor(row, plain) != pytest.approx(expected)


def test_floor_follows_a_moved_inclination():
    row = draw_row(random.Random(5))
    ranges = draw_ranges(random.Random(5))
    moved = ranges.with_value("inclination", math.radians(44.3))
    single = {**dict(ranges.intervals), "inclination": moved["inclination"]}
    assert list_floor(row, moved) == list_floor(row, Ranges.of(**single))
    post = list_floor(row, moved)["post"]
    assert post != pytest.approx(list_floor(row, ranges)["post"], rel=1e-3)


def build_check(row, ranges):
    return CheckByCase(
        row=row,
        ranges=ranges,
        member="post",
        scale=1.0,
        governing=Case(density=391.0, friction_angle=0.31, inclination=0.5),
        results=[],
        use_floor=lambda moved: 0.3 if moved is ranges else 0.4,
        widen=lambda one: find_effects(row, STANDARD, one).supports[-1].width,
    )


def test_end_effect_follows_what_is_moved_and_nothing_else():
    """A range of another quantity does not make the support narrower."""
    row = draw_row(random.Random(7))
    ranges = draw_ranges(random.Random(7), slack=Interval(low=0.01, high=0.08))
    check = build_check(row, ranges)
    assert check.use_least() == 0.3
    assert check.use_least(Setting(name="slack", value=0.02)) == 0.4
    larger = check.use_least(Setting(name="glide_factor", value=row.glide_factor + 0.1))
    typed = draw_row(random.Random(7), glide_factor=row.glide_factor + 0.1)
    widths = [
        find_effects(one, STANDARD, ranges).supports[-1].width for one in (typed, row)
    ]
    assert larger == pytest.approx(0.4 * widths[0] / widths[1])
    assert widths[0] > widths[1]


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


@pytest.mark.parametrize("ends", [(0.0, math.inf), (0.39, 1.02), (0.39, 0.44)])
def test_two_ends_of_the_floor_change_no_answer(ends):
    """The floor itself is found only where its ends leave the answer open."""
    found = []

    def use_floor(ranges):
        found.append(ranges)
        return 0.4

    row, ranges = draw_row(random.Random(9)), draw_ranges(random.Random(9))
    check = replace(
        build_check(row, ranges), use_floor=use_floor, bound_floor=lambda _: ends
    )
    setting = Setting(name="slack", value=0.0213)
    assert check.use_more(0.617, setting) == 0.617
    assert check.use_more(0.217, setting) == (0.4 if ends[1] > 1.0 else ends[0])
    assert check.use_about(setting) <= 1.0
    assert len(found) == 3 * (ends[1] > 1.0)
    found.clear()
    assert check.use_more(1.003, setting) == 1.003
    assert not found


@pytest.mark.parametrize("quantity", ["density", "friction_angle", "upslope_length"])
def test_a_quantity_that_the_floor_does_not_know_leaves_it(quantity):
    """Said of the guideline's own load, and used: its ranges stay as they are."""
    row, ranges = draw_row(random.Random(19)), draw_ranges(random.Random(19))
    value = {"density": 523.0, "friction_angle": 0.517, "upslope_length": 12.7}[
        quantity
    ]
    moved = ranges.with_value(quantity, value)
    assert list_floor(row, moved) == list_floor(row, ranges)
    check = build_check(row, ranges)
    assert check.use_least(Setting(name=quantity, value=0.37)) == 0.3


@pytest.mark.parametrize("ends", [(0.0, math.inf), (0.97, 1.09), (1.003, 1.09)])
def test_floor_that_is_not_met_is_so_by_its_ends_too(ends):
    row, ranges = draw_row(random.Random(9)), draw_ranges(random.Random(9))
    check = replace(
        build_check(row, ranges),
        use_floor=lambda _: 1.004,
        bound_floor=lambda _: ends,
    )
    assert check.use_about(Setting(name="slack", value=0.0213)) > 1.0
