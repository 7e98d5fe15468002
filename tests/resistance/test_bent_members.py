"""Bent bars and posts: each resistance put back into the rule it comes from."""

import math
import random
from dataclasses import replace
from itertools import pairwise

import pytest

from netdesign.resistance.post import (
    PostSection,
    compute_bent_post_resistance,
    compute_post_moment,
)
from netdesign.resistance.steel import (
    RoundSection,
    compute_bent_bar_resistance,
    find_ground_lever,
)

POST = PostSection(
    width=0.12,
    length=3.1,
    modulus=131e-6,
    strength=237e6,
    critical=6.9e5,
    buckling=3.96e5,
    at_head=0.0,
    at_foot=0.0,
)


def test_resistance_of_a_bent_bar_uses_all_of_the_section():
    """(R8) holds as an equation at the resistance, with shear and without."""
    draw, sheared = random.Random(7), 0
    for _ in range(500):
        outer = draw.uniform(0.016, 0.11)
        inner = draw.choice([0.0, draw.uniform(0.1, 0.9) * outer])
        bar = RoundSection(outer=outer, inner=inner, strength=draw.uniform(2e8, 9e8))
        angle, lever = draw.uniform(0.0, 1.5), draw.choice([0.0, draw.uniform(0, 0.3)])
        pull = compute_bent_bar_resistance(bar, angle=angle, lever=lever).value
        area = math.pi / 4 * (outer**2 - inner**2)
        modulus = math.pi / 32 * (outer**4 - inner**4) / outer
        shear_area = area * (2 / math.pi if inner else 0.75)
        shear = pull * math.sin(angle) / (shear_area * bar.strength / math.sqrt(3))
        rho = (2 * shear - 1) ** 2 if shear > 0.5 else 0.0
        sheared += shear > 0.5
        used = pull * math.cos(angle) / area + lever * pull * math.sin(angle) / modulus
        assert used / bar.strength == pytest.approx(1.0 - rho, rel=1e-9)
        assert shear <= 1.0
    assert 100 < sheared < 400


def test_along_the_axis_a_bar_has_its_tendon():
    bar = RoundSection(outer=0.028, inner=0.011, strength=5e8)
    found = compute_bent_bar_resistance(bar, angle=0.0, lever=0.4)
    assert found.value == bar.axial_resistance


@pytest.mark.parametrize(
    ("key", "low", "high", "sense"),
    [
        ("free", 1e-4, 0.3, -1),
        ("angle", 0.02, 1.2, -1),
        ("outer", 0.02, 0.09, 1),
    ],
)
def test_a_bar_bears_less_in_softer_ground_and_farther_out(key, low, high, sense):
    """Monotone, and without a jump."""

    def bear(outer=0.04, angle=0.2, free=0.02):
        bar = RoundSection(outer=outer, strength=5e8)
        lever = free + find_ground_lever(bar, "till")
        return compute_bent_bar_resistance(bar, angle=angle, lever=lever).value

    values = [low * (high / low) ** (n / 900) for n in range(901)]
    found = [bear(**{key: value}) for value in values]
    steps = [sense * (two - one) for one, two in pairwise(found)]
    assert min(steps) >= 0.0
    assert max(steps) < 0.02 * max(found)


@pytest.mark.parametrize("moment", [0.0, 3.3e3, 17.9e3, 29.0e3])
def test_compression_beside_a_moment_uses_all_of_the_post(moment):
    factor = 1.05
    design = compute_bent_post_resistance(POST, moment=moment, partial_factor=factor)
    design /= factor
    amplified = moment / (1.0 - design / POST.critical)
    used = factor * (design / POST.buckling + amplified / POST.moment_resistance)
    assert used == pytest.approx(1.0, rel=1e-12)
    assert design < POST.critical


@pytest.mark.parametrize("key", ["at_head", "at_foot", "moment"])
def test_a_post_bears_less_with_each_eccentricity_without_a_jump(key):
    found = []
    for step in range(1200):
        given = {"at_head": 0.03, "at_foot": 0.0, "moment": 2e3}
        given[key] = step * (20.0 if key == "moment" else 1e-4)
        moment = given.pop("moment")
        post = replace(POST, **given)
        found.append(
            compute_bent_post_resistance(post, moment=moment, partial_factor=1.05)
        )
    steps = [one - two for one, two in pairwise(found)]
    assert min(steps) >= 0.0
    assert max(steps) < 0.004 * found[0]


def add_end_moments(snow, head, foot):
    """(R11a): of a parabola on a line between its ends the largest."""
    apart = abs(head - foot)
    if apart >= 4.0 * snow:
        return max(head, foot)
    return snow + 0.5 * (head + foot) + apart**2 / (16.0 * snow)


@pytest.mark.parametrize(
    ("moment", "head", "foot"),
    [(3.3e3, 0.06, 0.0), (3.3e3, 0.0, 0.2), (17.9e3, 0.06, 0.06), (0.0, 0.03, 0.01)],
)
def test_compression_beside_its_axis_uses_all_of_the_post(moment, head, foot):
    post = replace(POST, at_head=head, at_foot=foot)
    found = compute_bent_post_resistance(post, moment=moment, partial_factor=1.05)
    force = found / 1.05
    largest = add_end_moments(moment, force * head, force * foot)
    bent = largest / (1.0 - force / POST.critical) / POST.moment_resistance
    assert 1.05 * (force / POST.buckling + bent) == pytest.approx(1.0, rel=1e-12)


def test_without_a_moment_it_is_the_buckling_resistance():
    found = compute_bent_post_resistance(POST, moment=0.0, partial_factor=1.1)
    assert found == pytest.approx(POST.buckling, rel=1e-14)


@pytest.mark.parametrize("share", [1.0, 1.7])
def test_moment_that_is_too_much_alone_leaves_no_compression(share):
    moment = share * POST.moment_resistance / 1.1 * (1.0 + 1e-12)
    assert compute_bent_post_resistance(POST, moment=moment, partial_factor=1.1) is None


def test_moment_of_snow_on_a_hinged_post():
    found = compute_post_moment(POST, pressure=11e3, efficiency=1.7)
    assert found == pytest.approx(1.7 * 11e3 * 0.12 * 3.1**2 / 8, rel=1e-14)


def test_a_bent_bar_tells_what_it_follows_from():
    section = RoundSection(outer=0.0317, strength=5e8)
    found = compute_bent_bar_resistance(section, angle=0.31, lever=0.043)
    used = math.cos(0.31) / section.axial_resistance
    used += 0.043 * math.sin(0.31) / section.moment_resistance
    assert (found.angle, found.lever) == (0.31, 0.043)
    assert found.shear_ratio < 0.5  # shear takes no part of it
    assert found.value == pytest.approx(1.0 / used, rel=1e-12)
