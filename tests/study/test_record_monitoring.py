"""Measured series in a study: in the units of the edge, without a solve."""

from dataclasses import replace
from datetime import date, datetime

import pytest

from netdesign.site.further_sheets import MonitoringSeries
from netdesign.site.model import StationWinter
from netdesign.snow.heights import HeightSeries
from netdesign.study.notes import list_site_notes
from netdesign.study.record_monitoring import record_monitoring
from tests import small_site

DAY = 86400.0
SERIES = MonitoringSeries(
    row_id="R1",
    member="foot_anchor",
    times=(0.0, 0.5 * DAY, DAY),
    tensions=(10e3, None, 12e3),
    air_temperatures=(263.15, None, 263.15),
    source="Monitoring!A2",
    start=datetime(2003, 2, 18, 6),
)
WINTER = StationWinter(series=HeightSeries(first_day=date(2003, 1, 1), heights=(0.0,)))


def record(series=SERIES, winter=None):
    site = small_site.build_site(*small_site.ROWS, monitoring=(series,), winter=winter)
    (found,) = record_monitoring(site, site.rows[0])
    return found


def test_a_record_is_in_units_of_the_edge():
    found = record()
    assert found.times_d == [0.0, 0.5, 1.0]
    assert found.tensions_kN == [10.0, None, 12.0]
    assert found.air_temperatures_C == [pytest.approx(-10.0), None, pytest.approx(-10)]


@pytest.mark.parametrize(
    ("series", "winter", "told"),
    [
        (SERIES, None, "need daily snow heights (sheet Winter)"),
        (SERIES, WINTER, "netdesign winter"),
        (replace(SERIES, start=None), WINTER, "give date and time"),
    ],
)
def test_a_record_says_what_the_model_needs(series, winter, told):
    assert told in str(record(series, winter).model)


def test_a_sheet_without_winter_is_noted_on_the_first_page():
    for winter, count in ((None, 1), (WINTER, 0)):
        site = small_site.build_site(
            *small_site.ROWS, monitoring=(SERIES,), winter=winter
        )
        notes = map(str, list_site_notes(site, (), small_site.RUN.creep_law, 0.01))
        assert sum("sheet Winter" in note for note in notes) == count
    bare = small_site.build_site(*small_site.ROWS)
    assert record_monitoring(bare, bare.rows[0]) == []
