"""Notes of a site and of its rows."""

import math
import random

import pytest

from netdesign.study.notes import bear_snow, list_site_notes
from tests.small_site import ROWS, RUN, build_site


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


def test_measured_forces_without_a_winter_say_what_they_need():
    for sheets, count in (({"Monitoring"}, 1), ({"Monitoring", "Winter"}, 0)):
        of_addons = dict.fromkeys(sheets, ("series",))
        site = build_site(*ROWS, of_addons=of_addons)
        notes = [one.key for one in list_site_notes(site, (), RUN.creep_law)]
        assert notes.count("monitoring.needs_winter") == count
