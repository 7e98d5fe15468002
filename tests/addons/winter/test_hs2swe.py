"""Settling by HS2SWE, each event by the hand."""

import math

import pytest

from netdesign.addons.winter.settling import HS2SWE, follow_heights
from tests.addons.winter.made_up_row import a_pack

G, DAY = 9.81, 86400.0


def densities_by_hand(heights, densities, factor=1.0):
    """Eq. (D6) times a factor, layer after layer."""
    masses = [h * rho for h, rho in zip(heights, densities, strict=True)]
    found = []
    for place, rho in enumerate(densities):
        load = G * sum(masses[place + 1 :])
        pressed = load / (6.051e7 * math.exp(0.018 * rho))
        own = 2.8e-6 * math.exp(-0.046 * max(0.0, rho - 113.7))
        found.append(min(rho + factor * DAY * rho * (pressed + own), 571.6))
    return found


def settled_by_hand(heights, densities, factor=1.0):
    after = densities_by_hand(heights, densities, factor)
    return [
        h * rho / new for h, rho, new in zip(heights, densities, after, strict=True)
    ]


HEIGHTS, DENSITIES = [0.93, 0.38], [287.0, 131.0]


def test_rise_beyond_two_centimetres_is_new_snow():
    settled = settled_by_hand(HEIGHTS, DENSITIES)
    day = HS2SWE.step(a_pack(HEIGHTS, DENSITIES), sum(settled) + 0.0201)
    assert day.heights == pytest.approx([*settled, 0.0201], rel=1e-12)
    assert day.new_mass == pytest.approx(0.0201 * 113.7, rel=1e-12)


@pytest.mark.parametrize("share", [0.35, 0.8])
def test_smaller_excess_slows_settling_in_steps(share):
    full = sum(settled_by_hand(HEIGHTS, DENSITIES))
    height = full + share * 0.01
    day = HS2SWE.step(a_pack(HEIGHTS, DENSITIES), height)
    factors = [1 + k / 10 for k in range(1, 42)]
    sums = {f: settled_by_hand(HEIGHTS, DENSITIES, 1 / f) for f in factors}
    first = next(f for f in factors if sum(sums[f]) >= height)
    assert day.heights == pytest.approx(sums[first], rel=1e-12)
    assert day.runoff == day.new_mass == 0.0


def test_deficit_speeds_settling_up_and_keeps_the_mass():
    height = sum(settled_by_hand(HEIGHTS, DENSITIES, 2.45))
    day = HS2SWE.step(a_pack(HEIGHTS, DENSITIES), height)
    expected = settled_by_hand(HEIGHTS, DENSITIES, 2.5)
    assert day.heights == pytest.approx(expected, rel=1e-12)
    assert day.runoff == 0.0


def test_what_five_times_the_rate_cannot_settle_melts_from_the_top():
    fast = settled_by_hand(HEIGHTS, DENSITIES, 5.1)
    dense = densities_by_hand(HEIGHTS, DENSITIES, 5.1)
    height = fast[0] + 0.4 * fast[1]
    day = HS2SWE.step(a_pack(HEIGHTS, DENSITIES), height)
    assert day.height == pytest.approx(height, rel=1e-12)
    assert day.densities == pytest.approx(dense, rel=1e-12)
    assert day.runoff == pytest.approx(0.6 * fast[1] * dense[1], rel=1e-12)


def test_melt_takes_whole_layers():
    height = 0.5 * settled_by_hand(HEIGHTS, DENSITIES, 5.1)[0]
    day = HS2SWE.step(a_pack(HEIGHTS, DENSITIES), height)
    assert day.heights == pytest.approx([height], rel=1e-12)
    assert day.ages.tolist() == [2]


def test_densest_snow_does_not_settle_but_melts():
    day = HS2SWE.step(a_pack([0.7], [571.6]), 0.62)
    assert day.density == pytest.approx(571.6, rel=1e-12)
    assert day.runoff == pytest.approx(0.08 * 571.6, rel=1e-12)


def test_bare_ground_ends_a_snowpack():
    packs = follow_heights([0.2, 0.0, 0.3], HS2SWE)
    assert packs[1].runoff == pytest.approx(0.2 * 113.7, rel=1e-14)
    assert packs[2].masses.tolist() == pytest.approx([0.3 * 113.7])
