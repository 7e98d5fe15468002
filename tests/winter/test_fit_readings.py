"""Readings of a fit: which days, which forces, how uncertain."""

from datetime import date, datetime, timedelta

import numpy as np
import pytest

from netdesign.outcome import ModelError
from netdesign.snowpack.series import HeightSeries
from netdesign.winter.day import RowDay
from netdesign.winter.fit_inputs import (
    FitReading,
    Noise,
    build_covariance,
    choose_readings,
)
from netdesign.winter.measured import MeasuredPulls
from tests.each import each

FIRST = date(2007, 1, 3)


def a_series(count):
    return HeightSeries(first_day=FIRST, heights=(1.7,) * count)


def days(thicknesses, ending="open"):
    return [
        RowDay(index=k, thickness=d, density=310.0, ending=ending)
        for k, d in enumerate(thicknesses)
    ]


def pulls(member, forces, hours=(6,)):
    start = datetime(2007, 1, 3)
    moments = [
        (start + timedelta(days=day, hours=hour), force + hour)
        for day, force in enumerate(forces)
        for hour in hours
    ]
    return MeasuredPulls(
        member=member,
        moments=tuple(moment for moment, _ in moments),
        forces=tuple(force for _, force in moments),
    )


def choose(forces, thicknesses, **changes):
    measured = [pulls("foot_anchor", forces, **changes)]
    return choose_readings(measured, a_series(len(thicknesses)), days(thicknesses))


def test_days_are_five_apart_and_readings_the_mean_of_their_day():
    found = choose([4e4] * 33, [1.3] * 33, hours=(0, 12))
    assert [one.index for one in found] == [0, 5, 10, 15, 20, 25, 30]
    assert {one.force for one in found} == {4e4 + 6.0}


def test_a_long_season_has_seventeen_days_at_most():
    found = choose([4e4] * 151, [1.3] * 151)
    places = [one.index for one in found]
    assert len(places) == 16
    assert set(np.diff(places)) == {10}


def test_thin_snow_and_weak_readings_are_left_out():
    thicknesses = [0.6] * 10 + [1.3] * 10
    assert choose([4e4] * 20, thicknesses)[0].index == 10
    weak = [4e4] * 10 + [3.9e3] * 10
    assert {one.index for one in choose(weak, [1.3] * 20)} == {0, 5}


def test_days_that_cannot_be_solved_have_no_reading():
    measured = [pulls("post", [4e4] * 20)]
    assert choose_readings(measured, a_series(20), days([3.3] * 20, "overtopped")) == ()
    assert choose_readings([], a_series(20), days([1.3] * 20)) == ()


def test_both_members_of_a_day_are_taken():
    measured = [pulls("foot_anchor", [4e4] * 9), pulls("post", [3e4] * 9)]
    found = choose_readings(measured, a_series(9), days([1.3] * 9))
    members = [(one.index, one.member) for one in found]
    assert members == [
        *((0, "foot_anchor"), (0, "post"), (5, "foot_anchor"), (5, "post"))
    ]


def test_covariance_has_three_parts():
    readings = [
        FitReading(index=0, member="foot_anchor", force=4.1e4),
        FitReading(index=5, member="foot_anchor", force=7.7e4),
        FitReading(index=5, member="post", force=3.3e4),
    ]
    noise = Noise(reading=0.03, cell=0.07, rope=4.0)
    swings = {0: 4.1e3, 5: 5.3e3}
    found = build_covariance(readings, noise, swings)
    assert found[0, 1] == pytest.approx(0.07**2)
    assert found[1, 2] == 0.0
    ropes = [0.1, 5.3e3 / 7.7e4, 5.3e3 / 3.3e4]
    assert np.diag(found) == pytest.approx(
        [0.03**2 + 0.07**2 + rope**2 / 2 for rope in ropes]
    )


@each(
    "changes, told",
    [
        ({"reading": 0.0}, "noise of a reading"),
        ({"reading": 0.51}, "noise of a reading"),
        ({"reading": float("nan")}, "noise of a reading"),
        ({"cell": -0.01}, "common error of a cell"),
        ({"cell": 0.51}, "common error of a cell"),
        ({"rope": 30.1}, "wave of rope temperature"),
    ],
)
def test_noise_that_no_cell_has_is_refused(changes, told):
    with pytest.raises(ModelError, match=told):
        Noise(**changes)
