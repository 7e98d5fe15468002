"""Figure of a winter: lines inside the frame, broken where no force is known."""

import random
import re

import pytest

from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.drawing.style import ACCENT
from netdesign.report.drawing.winter_figure import _LEFT, _RIGHT, draw_winter
from netdesign.report.words import Words
from tests.report.drawing.drawn import build_winter


def list_foot_lines(svg):
    """Abscissae of each piece of the foot's line [pt]."""
    found = re.findall(rf'points="([^"]*)" fill="none" stroke="{ACCENT}"[^/]*1.4"', svg)
    return [[float(x) for x in re.findall(r"(-?[\d.]+),", one)] for one in found]


@pytest.fixture
def winter():
    """Without members, whose panel has a line of the same stroke."""
    rng = random.Random(20413)
    made = next(one for _ in range(50) if len((one := build_winter(rng))["curve"]) > 9)
    for day in made["curve"]:
        day["members_kN"] = {}
    return made


def count_pieces(winter):
    """Pieces of the line without the stroke beside its name."""
    lines = list_foot_lines(draw_winter(winter, {}, Words("en")))
    return [one for one in lines if max(one) <= WIDTH - _RIGHT + 0.1]


def test_line_breaks_at_a_day_without_a_force(winter):
    (whole,) = count_pieces(winter)
    assert len(whole) == len(winter["curve"])
    winter["curve"][2]["foot_kN_per_m"] = None
    assert [len(one) for one in count_pieces(winter)] == [2, len(whole) - 3]


def test_lone_day_is_seen(winter):
    for k in (0, 2):
        winter["curve"][k]["foot_kN_per_m"] = None
    lone = count_pieces(winter)[0]
    assert lone[1] > lone[0]


def test_line_ends_at_the_frame(winter):
    """Days after the snow has gone are cut off as those before it comes."""
    for day in winter["curve"][-2:]:
        day.update(thickness_m=0.0)
        day.update(foot_kN_per_m=0.0)
    svg = draw_winter(winter, {}, Words("en"))
    foot = [one for one in list_foot_lines(svg) if min(one) < WIDTH - _RIGHT]
    assert len(foot) >= 1
    assert all(_LEFT <= x <= WIDTH - _RIGHT + 0.1 for one in foot for x in one)
