"""Figure of a winter: lines inside the frame, broken where no force is known."""

import random
import re

import pytest

from netdesign.report.drawing.plain_svg import ACCENT
from netdesign.report.drawing.winter_figure import draw_winter
from netdesign.report.words import Words
from tests.report.drawing.drawn import build_winter


def find_sides(svg):
    """Left and right end of the frames [pt]."""
    left, right = re.search(r'd="M([\d.]+) [\d.]+V[\d.]+H([\d.]+)', svg).groups()
    return float(left), float(right)


def list_foot_lines(svg):
    """Abscissae of each piece of the foot's line [pt], not of the one at its name."""
    found = re.findall(
        rf'points="([^"]*)" fill="none" stroke="{ACCENT}"[^/]*1\.2"', svg
    )
    lines = [[float(x) for x in re.findall(r"(-?[\d.]+),", one)] for one in found]
    return [one for one in lines if min(one) < find_sides(svg)[1]]


@pytest.fixture
def winter():
    """Without members, whose panel has a line of the same stroke."""
    rng = random.Random(20413)
    made = next(one for _ in range(50) if len((one := build_winter(rng))["curve"]) > 9)
    for day in made["curve"]:
        day["members_kN"] = {}
        day["foot_kN_per_m"] *= rng.uniform(
            0.8, 1.2
        )  # no point lies on a straight line
    return made


def list_pieces(winter):
    return list_foot_lines(draw_winter(winter, {}, Words("en")))


def test_line_breaks_at_a_day_without_a_force(winter):
    (whole,) = list_pieces(winter)
    assert len(whole) == len(winter["curve"])
    winter["curve"][2]["foot_kN_per_m"] = None
    assert [len(one) for one in list_pieces(winter)] == [2, len(whole) - 3]


def test_lone_day_is_seen(winter):
    for k in (0, 2):
        winter["curve"][k]["foot_kN_per_m"] = None
    lone = list_pieces(winter)[0]
    assert lone[1] > lone[0]


def test_line_ends_at_the_frame(winter):
    """Days after the snow has gone are cut off as those before it comes."""
    for day in winter["curve"][-2:]:
        day.update(thickness_m=0.0)
        day.update(foot_kN_per_m=0.0)
    svg = draw_winter(winter, {}, Words("en"))
    foot, (left, right) = list_foot_lines(svg), find_sides(svg)
    assert len(foot) >= 1
    assert all(left <= x <= right + 0.1 for one in foot for x in one)
