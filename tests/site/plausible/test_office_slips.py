"""Slips in an office's list without names of a catalogue, and who notices them.

Of the slope only two heights tell: its slips are noticed where net or snow is given
across the slope and vertically. Angles that stand alone nothing in a list can tell.
"""

import math
import random
from collections import Counter

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.each import each
from tests.site.plausible.office import alter, draw_office, list_office_slips
from tests.site_lines import write_lines

OF_HEIGHTS = ("slope_angle", "snow_thickness", "net_height")


def is_noticed(path, lines):
    write_lines(path, lines)
    try:
        return bool(read_site(path).questions)
    except SiteDataError:
        return True


@each("seed", range(6))
def test_an_office_s_list_with_both_heights_is_asked_nothing(tmp_path, seed):
    lines = draw_office(seed, has_heights=True)
    assert not is_noticed(tmp_path / "site.xlsx", lines)


def test_slips_of_slope_and_heights_are_noticed_where_two_are_given(tmp_path):
    lines = draw_office(7, has_heights=True)
    draw, kinds, silent = random.Random(7), Counter(), Counter()
    slips = [one for one in list_office_slips(lines) if one[1][2] in OF_HEIGHTS]
    for kind, place, value in draw.sample(slips, 24):
        kinds[kind] += 1
        silent[kind] += not is_noticed(
            tmp_path / "site.xlsx", alter(lines, place, value)
        )
    assert {"gon for degrees", "cosine taken again"} <= kinds.keys()
    assert silent.total() <= 2, silent  # a neighbour's value that is nearly the same


@pytest.mark.slow
def test_few_slips_by_ten_are_silent(tmp_path):
    kinds, silent = Counter(), Counter()
    for seed in range(3):
        lines = draw_office(seed)
        for kind, place, value in list_office_slips(lines):
            if kind in ("times ten", "a tenth"):
                kinds[kind] += 1
                altered = alter(lines, place, value)
                silent[kind] += not is_noticed(tmp_path / "site.xlsx", altered)
    assert silent.total() <= 0.01 * kinds.total(), silent


@each("seed", range(40))
def test_heights_as_they_are_rounded_are_not_asked_about(tmp_path, seed):
    """Half a digit each way; 3 % more are, where centimetres are typed."""
    draw = random.Random(seed)
    lines = draw_office(seed, rows=1)
    (net,) = lines["Nets"]
    digits = draw.choice((1, 2))
    net["slope_angle"] = round(draw.uniform(28.0, 50.0), draw.choice((0, 1)))
    exact = net["net_height"] / math.cos(math.radians(net["slope_angle"]))
    net["vertical_height"] = round(exact, digits)
    assert not is_noticed(tmp_path / "site.xlsx", lines)
    net["net_height"] = 3.01
    net["slope_angle"] = round(net["slope_angle"], 1) + 0.03
    exact = 3.01 / math.cos(math.radians(net["slope_angle"]))
    net["vertical_height"] = round(exact * draw.choice((0.97, 1.03)), 2) + 0.001
    assert is_noticed(tmp_path / "site.xlsx", lines)
