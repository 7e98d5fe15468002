"""Snow that a guy bears beside its force; the height of a loaded net."""

import math
import random

import pytest

from netdesign.study.notes import bear_snow


def test_force_and_snow_together_use_up_the_resistance():
    draw = random.Random(11)
    for _ in range(100):
        resistance = draw.uniform(20.0, 400.0)
        force, angle = draw.uniform(0.0, resistance), draw.uniform(0.0, math.pi / 2)
        snow = bear_snow(force, resistance, math.cos(angle))
        both = (force + snow * math.cos(angle), snow * math.sin(angle))
        assert math.hypot(*both) == pytest.approx(resistance, rel=1e-12)
        assert bear_snow(0.9 * force, resistance, math.cos(angle)) >= snow
        assert snow <= math.hypot(resistance, force)


@pytest.mark.parametrize(
    ("force", "resistance", "cosine", "snow"),
    # in line: what is left; square: the other side of a right triangle
    [(60.0, 100.0, 1.0, 40.0), (60.0, 100.0, 0.0, 80.0), (101.0, 100.0, 0.4, 0.0)],
)
def test_snow_by_hand(force, resistance, cosine, snow):
    assert bear_snow(force, resistance, cosine) == pytest.approx(snow)
