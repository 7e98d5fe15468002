"""Notes of a site and of its rows."""

import math
import random

import pytest

from netdesign.envelope.ranges import Interval, Ranges
from netdesign.study.notes import bear_snow, list_site_notes
from tests.small_site import RANGES, ROWS, RUN, build_site


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


def list_of_accuracy(site, accuracy):
    notes = list_site_notes(site, (), RUN.creep_law, accuracy)
    return [one for one in notes if one.key == "note.accuracy_of_cases"]


@pytest.mark.parametrize(("accuracy", "count"), [(5e-4, 1), (1e-3, 0), (0.01, 0)])
def test_an_accuracy_finer_than_the_search_is_told_as_that_of_the_cases(
    accuracy, count
):
    assert len(list_of_accuracy(build_site(*ROWS), accuracy)) == count
    ends = {name: span.low for name, span in RANGES.intervals}
    single = Ranges.of(**{k: Interval(low=end, high=end) for k, end in ends.items()})
    site = build_site(*ROWS, ranges=single)
    assert list_of_accuracy(site, accuracy) == []  # one case has no gap


def test_measured_forces_without_a_winter_say_what_they_need():
    for sheets, count in (({"Monitoring"}, 1), ({"Monitoring", "Winter"}, 0)):
        of_addons = dict.fromkeys(sheets, ("series",))
        site = build_site(*ROWS, of_addons=of_addons)
        notes = [one.key for one in list_site_notes(site, (), RUN.creep_law, 0.01)]
        assert notes.count("monitoring.needs_winter") == count
