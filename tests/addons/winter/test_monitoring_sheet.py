"""Sheet Monitoring: series in SI, every fault with its cell."""

from datetime import datetime

import pytest

HEADINGS = ["net row", "member", "time [d]", "tension [kN]", "air temperature [°C]"]


def with_lines(book, *lines, headings=HEADINGS):
    book["Monitoring"] = [headings, *map(list, lines)]
    return book


def test_series_are_read_by_row_and_member(book):
    lines = [
        ["R1", "uphill anchor", 2.0, 31.5, -4.0],
        ["R1", "foot_anchor", 2.0, 80.0, None],
        ["R1", "ancrage amont", 2.25, None, -12.5],
    ]
    site = with_lines(book, *lines).read()
    uphill, foot = site.of_addons["Monitoring"]
    assert (uphill.row_id, uphill.member) == ("R1", "uphill_guy")
    assert uphill.times == (0.0, 0.25 * 86400.0)
    assert uphill.tensions == (31500.0, None)
    assert uphill.air_temperatures == pytest.approx((269.15, 260.65))
    assert uphill.source == "Monitoring!A2"
    assert foot.tensions == (80000.0,)
    assert foot.air_temperatures == (None,)
    assert uphill.start is None
    assert not [note for note in map(str, site.notes) if "Monitoring" in note]


@pytest.mark.parametrize(
    "moments",
    [
        ("2003-02-18 06:00", "2003-02-18 18:00"),
        (datetime(2003, 2, 18, 6), datetime(2003, 2, 18, 18)),
    ],
)
def test_dates_become_times_since_the_first(book, moments):
    headings = ["net row", "member", "date and time", "tension [kN]"]
    lines = [["R1", "post", moment, 10.0] for moment in moments]
    site = with_lines(book, *lines, headings=headings).read()
    assert site.of_addons["Monitoring"][0].times == (0.0, 43200.0)
    assert site.of_addons["Monitoring"][0].start == datetime(2003, 2, 18, 6)


@pytest.mark.parametrize(
    ("line", "cell", "rule"),
    [
        (["R9", "post", 1.0, 10.0, None], "A2", "is no id of sheet Rows"),
        (["R1", "roof", 1.0, 10.0, None], "B2", "is not a known word"),
        (["R1", "post", None, 10.0, None], "C2", "is empty: neither time nor"),
        (["R1", "post", 1.0, None, None], "A2", "without a measurement"),
        (["R1", "post", 1.0, -3.0, None], "D2", "out of range"),
        (["R1", "post", 1.0, 10.0, 260.0], "E2", "out of range"),
    ],
)
def test_each_fault_names_its_cell(book, line, cell, rule):
    (finding,) = with_lines(book, line).refuse()
    assert (finding.sheet, finding.cell) == ("Monitoring", cell)
    assert rule in str(finding.rule)
