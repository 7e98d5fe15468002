"""Settling by delta-snow, each event by the hand."""

import math

import numpy as np
import pytest

from netdesign.addons.winter.settling import (
    DELTA_SNOW,
    DELTA_SNOW_AGEING,
    Ageing,
    follow_heights,
)
from tests.addons.winter.made_up_row import a_pack

G, DAY = 9.81, 86400.0
RHO_0, RHO_MAX = 81.19417, 401.2588
ETA, K = 8523356.0, 0.02993175


def settled_by_hand(heights, densities):
    """Eq. (D1), layer after layer."""
    masses = [h * rho for h, rho in zip(heights, densities, strict=True)]
    found = []
    for place, (h, rho) in enumerate(zip(heights, densities, strict=True)):
        stress = G * sum(masses[place:])
        settled = h / (1 + DAY * stress / (ETA * math.exp(K * rho)))
        found.append(max(settled, masses[place] / RHO_MAX))
    return found


def test_first_snow_is_one_new_layer_and_bare_ground_has_none():
    packs = follow_heights([0.0, 0.37, 0.0, 0.11], DELTA_SNOW)
    assert [pack.heights.size for pack in packs] == [0, 1, 0, 1]
    assert packs[1].mass == pytest.approx(0.37 * RHO_0, rel=1e-14)
    assert packs[2].runoff == packs[1].mass
    assert packs[3].new_mass == pytest.approx(0.11 * RHO_0, rel=1e-14)


def test_given_density_of_the_first_day():
    (pack,) = follow_heights([0.83], DELTA_SNOW, first_density=317.0)
    assert pack.density == pytest.approx(317.0, rel=1e-14)


def test_snowfall_presses_what_lies_below():
    heights, densities = [0.71, 0.43], [263.0, 128.0]
    day = DELTA_SNOW.step(a_pack(heights, densities), 1.49)
    settled = settled_by_hand(heights, densities)
    load = RHO_0 * G * (1.49 - sum(settled))
    for place in (0, 1):
        rho = heights[place] * densities[place] / settled[place]
        pressed = 5.104722e-4 * load * math.exp(-0.37856737 * rho / (RHO_MAX - rho))
        expected = settled[place] * (1 - pressed)
        assert day.heights[place] == pytest.approx(expected, rel=1e-13)
    assert day.height == pytest.approx(1.49, rel=1e-14)
    assert day.new_mass == pytest.approx(RHO_0 * day.heights[2], rel=1e-14)
    assert day.ages.tolist() == [2, 1, 0]


def test_small_differences_keep_the_layers_in_proportion():
    heights, densities = [0.71, 0.43], [263.0, 128.0]
    total = sum(settled_by_hand(heights, densities)) - 0.021
    day = DELTA_SNOW.step(a_pack(heights, densities), total)
    expected = [h * total / 1.14 for h in heights]
    assert day.heights == pytest.approx(expected, rel=1e-13)
    assert day.masses == pytest.approx([0.71 * 263.0, 0.43 * 128.0], rel=1e-13)


def test_mass_beyond_the_largest_density_goes_to_the_top_first():
    before = a_pack([0.6, 0.2, 0.3], [401.0, 399.0, 140.0])
    height = sum(settled_by_hand([0.6, 0.2, 0.3], [401.0, 399.0, 140.0])) - 0.01
    day = DELTA_SNOW.step(before, height)
    share = height / 1.1
    excess = sum(
        max(h * rho - h * share * RHO_MAX, 0.0) for h, rho in ((0.6, 401), (0.2, 399))
    )
    assert day.masses[2] == pytest.approx(0.3 * 140.0 + excess, rel=1e-13)
    assert day.densities[:2] == pytest.approx([RHO_MAX, RHO_MAX], rel=1e-13)
    assert day.runoff == 0.0


def test_mass_without_room_runs_off():
    before = a_pack([0.6, 0.2], [RHO_MAX, RHO_MAX])
    day = DELTA_SNOW.step(before, 0.785)
    assert day.runoff == pytest.approx(0.015 * RHO_MAX, rel=1e-9)
    assert day.mass == pytest.approx(0.785 * RHO_MAX, rel=1e-13)


def test_wet_snow_goes_to_its_largest_density_from_the_top():
    heights, densities = [0.71, 0.43], [263.0, 128.0]
    settled = settled_by_hand(heights, densities)
    dense = 0.43 * 128.0 / RHO_MAX
    target = settled[0] + dense - 0.05  # the top alone is not enough
    day = DELTA_SNOW.step(a_pack(heights, densities), target)
    assert day.heights == pytest.approx([settled[0] - 0.05, dense], rel=1e-13)
    assert day.runoff == 0.0


def test_snow_at_its_largest_density_everywhere_runs_off_in_proportion():
    day = DELTA_SNOW.step(a_pack([0.6, 0.2], [380.0, 250.0]), 0.31)
    mass = 0.6 * 380.0 + 0.2 * 250.0
    assert day.densities == pytest.approx([RHO_MAX, RHO_MAX], rel=1e-13)
    assert day.runoff == pytest.approx(mass - 0.31 * RHO_MAX, rel=1e-13)


def test_ageing_limit_at_its_middle_and_far_from_it():
    ageing = DELTA_SNOW_AGEING.largest_density
    assert isinstance(ageing, Ageing)
    low, middle, high = ageing.find_largest(np.array([-(10**7), 80, 10**7]))
    assert middle == pytest.approx(490.0, rel=1e-14)
    assert [low, high] == pytest.approx([380.0, 600.0], rel=1e-6)
