"""Creep time: warm snow does the same things sooner."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from netdesign.coupling.history.clock import Clock
from netdesign.outcome import ModelError
from netdesign.snow.creep_law import PAPER_FLUIDITY, compute_fluidity

DAY = 86400.0
TIMES = np.array([0.0, 2.0, 5.0, 30.0]) * DAY
KELVIN = np.array([255.0, 261.0, 270.0, 268.0])


def constant(kelvin, fluidity):
    return Clock.of_temperatures(
        np.array([0.0, 10.0 * DAY]), np.array([kelvin, kelvin]), fluidity
    )


@pytest.mark.parametrize("time", [0.0, 1.0, 5e6])
def test_scene_without_temperatures_has_the_clock_on_the_wall(time):
    assert Clock().to_creep_time(time) == time
    assert Clock().to_time(time) == time


@pytest.mark.parametrize("days", [0.0, 0.3, 10.0, 40.0])
def test_snow_at_the_scenes_fluidity_keeps_time(days):
    """Before and after the last reading."""
    clock = constant(260.0, compute_fluidity(260.0))
    assert clock.to_creep_time(days * DAY) == pytest.approx(days * DAY, rel=1e-12)
    assert clock.to_time(days * DAY) == pytest.approx(days * DAY, rel=1e-12)


@pytest.mark.parametrize("days", [0.3, 10.0, 40.0])
def test_twice_the_fluidity_halves_the_time(days):
    clock = constant(260.0, compute_fluidity(260.0) / 2.0)
    assert clock.to_time(days * DAY) == pytest.approx(days * DAY / 2.0, rel=1e-12)
    assert clock.to_creep_time(days * DAY) == pytest.approx(2 * days * DAY, rel=1e-12)


def test_ten_degrees_rescale_time_by_the_law_of_arrhenius():
    """Below -10 C with an activation energy of 60 kJ/mol."""
    cold, warm = (constant(kelvin, PAPER_FLUIDITY) for kelvin in (250.0, 260.0))
    expected = math.exp(60e3 / 8.314 * (1.0 / 250.0 - 1.0 / 260.0))
    assert cold.to_time(DAY) / warm.to_time(DAY) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("days", [0.0, 1.0, 2.0, 4.3, 17.0, 30.0, 60.0])
def test_there_and_back(days):
    clock = Clock.of_temperatures(TIMES, KELVIN, PAPER_FLUIDITY)
    back = clock.to_time(clock.to_creep_time(days * DAY))
    assert back == pytest.approx(days * DAY, rel=1e-12)


@pytest.mark.parametrize("days", [2.0, 5.0, 30.0])
def test_creep_time_is_the_integral_of_the_fluidity(days):
    """Over temperatures linear in time; eight parts of an interval leave 0.5 %."""
    clock = Clock.of_temperatures(TIMES, KELVIN, PAPER_FLUIDITY)

    def rate(time):
        return compute_fluidity(float(np.interp(time, TIMES, KELVIN))) / PAPER_FLUIDITY

    kinks = [time for time in TIMES if 0.0 < time < days * DAY]
    # the law's own kink, 263.15 K on the second piece
    kinks.append((2.0 + 3.0 * (263.15 - 261.0) / 9.0) * DAY)
    inside = [kink for kink in kinks if kink < days * DAY]
    expected, _ = quad(rate, 0.0, days * DAY, points=inside or None, limit=200)
    assert clock.to_creep_time(days * DAY) == pytest.approx(expected, rel=5e-3)


def test_after_the_last_reading_the_clock_goes_on_as_there():
    clock = Clock.of_temperatures(TIMES, KELVIN, PAPER_FLUIDITY)
    gained = clock.to_creep_time(40.0 * DAY) - clock.to_creep_time(30.0 * DAY)
    rate = compute_fluidity(268.0) / PAPER_FLUIDITY
    assert gained == pytest.approx(rate * 10.0 * DAY, rel=1e-12)
    assert clock.last_rate == pytest.approx(rate, rel=1e-14)


def test_one_reading_is_a_constant_temperature():
    clock = Clock.of_temperatures(
        np.array([0.0]), np.array([260.0]), compute_fluidity(260.0) / 3.0
    )
    assert clock.to_creep_time(DAY) == pytest.approx(3.0 * DAY, rel=1e-12)
    assert clock.to_time(3.0 * DAY) == pytest.approx(DAY, rel=1e-12)


@pytest.mark.parametrize(
    ("times", "kelvin"),
    [
        ([], []),
        ([1.0, 2.0], [260.0, 261.0]),
        ([0.0, 2.0, 1.0], [260.0] * 3),
        ([0.0, 1.0, 1.0], [260.0] * 3),
        ([0.0, np.nan], [260.0] * 2),
        ([0.0, 1.0], [260.0]),
    ],
    ids=["none", "late", "back", "twice", "no number", "one missing"],
)
def test_readings_that_do_not_ascend_from_zero_are_refused(times, kelvin):
    with pytest.raises(ModelError, match="times must ascend from 0 s"):
        Clock.of_temperatures(np.array(times), np.array(kelvin), PAPER_FLUIDITY)


@pytest.mark.parametrize("wrong", [200.0, 275.0, np.nan])
def test_a_temperature_that_no_snow_has_is_refused(wrong):
    with pytest.raises(ModelError, match="snow temperature"):
        Clock.of_temperatures(
            np.array([0.0, 1.0]), np.array([260.0, wrong]), PAPER_FLUIDITY
        )


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_a_fluidity_that_is_none_is_refused(wrong):
    with pytest.raises(ModelError, match="fluidity"):
        constant(260.0, wrong)
