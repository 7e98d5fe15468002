"""Measured forces: on the dates of a winter, beside its curve."""

from dataclasses import replace
from datetime import date, datetime

import pytest

from netdesign.addons.winter.day import RowDay
from netdesign.addons.winter.heights import HeightSeries
from netdesign.addons.winter.maxima import AnnualMaximum
from netdesign.addons.winter.measured import (
    compare_season,
    explain_unused,
    find_swing,
    list_measured_pulls,
    name_measured_winters,
)
from netdesign.addons.winter.monitoring_sheet import MonitoringSeries
from netdesign.addons.winter.season import Season
from netdesign.checks.inputs import Band
from tests import small_site
from tests.addons.winter.made_up_row import a_solver

ROW = a_solver().row
FIRST = date(2003, 2, 1)


def a_day(index, force, thickness=1.9):
    """Solved day whose foot anchor carries 3.5 m of net."""
    foot = Band(low=0.98 * force, value=force, high=1.02 * force)
    member = Band(low=3.43 * force, value=3.5 * force, high=3.57 * force)
    return RowDay(
        index=index,
        thickness=thickness,
        density=310.0,
        ending="solved",
        foot=foot,
        head=foot,
        member_forces={"foot_anchor": member},
    )


def a_season(*days):
    return Season(
        name="2002/2003",
        maximum=AnnualMaximum(winter="2002/2003", ending="solved"),
        curve=days,
        highest=days[0],
        days=slice(0, 28),
        equivalent_density=None,
    )


def readings(*pairs):
    return MonitoringSeries(
        row_id="A",
        member="foot_anchor",
        times=tuple(86400.0 * day for day, _ in pairs),
        tensions=tuple(force for _, force in pairs),
        air_temperatures=(None,) * len(pairs),
        source="Monitoring!A2",
        start=datetime(2003, 2, 1),
    )


def a_series(warmth=None):
    air = tuple(warmth) if warmth else ()
    return HeightSeries(first_day=FIRST, heights=(1.5,) * 28, air_temperatures=air)


def compare(pulls, season, series=None):
    return compare_season(pulls, season, ROW, series or a_series())


def test_band_is_the_numerical_one_and_the_swing_of_the_ropes():
    warmth = [270.0] * 28
    warmth[5], warmth[6] = 262.0, 268.0
    season = a_season(a_day(5, 20e3), a_day(20, 20e3))
    compared = compare(readings((5.5, 70e3)), season, a_series(warmth))
    cold, level = compared.computed
    snow = replace(ROW.scene.snowpack, thickness=1.9, density=310.0, layers=())
    swing = find_swing(replace(ROW.scene, snowpack=snow), 4.0)
    assert cold.swing == pytest.approx(3.5 * swing, rel=1e-9)
    assert level.swing == 0.0


def test_days_without_a_force_are_left_out_and_bare_ones_have_none():
    failed = replace(a_day(8, 1.0), ending="failed", foot=None, head=None)
    failed = replace(failed, member_forces={})
    bare = replace(failed, index=2, ending="bare", thickness=0.0, density=0.0)
    compared = compare(readings((5.0, 30e3)), a_season(bare, a_day(5, 9e3), failed))
    assert [day.index for day in compared.computed] == [2, 5]
    assert compared.computed[0].force.value == 0.0


HOUR = 3600.0


def a_site(**changes):
    values = {
        "row_id": "R1",
        "member": "foot_anchor",
        "times": (0.0, 7 * HOUR, 19 * HOUR, 47 * HOUR),
        "tensions": (11e3, None, 17e3, 23e3),
        "air_temperatures": (None,) * 4,
        "source": "Monitoring!A2",
        "start": datetime(2003, 2, 18, 4),
    }
    series = MonitoringSeries(**{**values, **changes})
    return small_site.build_site(*small_site.ROWS, of_addons={"Monitoring": (series,)})


def test_times_without_a_date_stand_beside_no_winter():
    site = a_site(start=None)
    assert list_measured_pulls(site, "R1") == ()
    (told,) = explain_unused(site, "R1", ())
    assert "Monitoring!A2: measured times without a date" in str(told)
    (told,) = explain_unused(a_site(), "R1", ())
    assert "no reading lies on a day" in str(told)
    assert explain_unused(a_site(tensions=(None,) * 4), "R1", ()) == ()


def test_winters_with_readings_are_named():
    pulls = list_measured_pulls(a_site(), "R1")
    assert name_measured_winters(pulls) == {"2002/2003"}
