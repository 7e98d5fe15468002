"""Measured forces on the dates of a winter."""

from datetime import datetime

from netdesign.addons.winter.measured import (
    explain_unused,
    list_measured_pulls,
    name_measured_winters,
)
from netdesign.site.further_sheets import MonitoringSeries
from tests import small_site

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
    return small_site.build_site(*small_site.ROWS, monitoring=(series,))


def test_readings_keep_their_moments():
    (pulls,) = list_measured_pulls(a_site(), "R1")
    assert pulls.forces == (11e3, 17e3, 23e3)
    assert pulls.moments[1] == datetime(2003, 2, 18, 23)
    assert list_measured_pulls(a_site(), "R2") == ()


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


def test_air_temperatures_alone_are_no_forces():
    assert list_measured_pulls(a_site(tensions=(None,) * 4), "R1") == ()
