"""Sheet Winter: a series in SI, every fault with its cell."""

from datetime import date, datetime

import pytest

HEADINGS = ["date", "snow height of the station [cm]", "air temperature [°C]"]


def with_lines(book, *lines, headings=HEADINGS):
    book["Winter"] = [headings, *map(list, lines)]
    return book


def days(*heights, first=1):
    return [
        [f"2003-02-{first + k:02d}", height, -4.5] for k, height in enumerate(heights)
    ]


def test_series_is_read_in_metres_and_kelvin(book):
    lines = [["2003-02-01", 0, None], [datetime(2003, 2, 2), 37.5, -4.5]]
    winter = with_lines(book, *lines).read().of_addons["Winter"]
    assert winter.series.first_day == date(2003, 2, 1)
    assert winter.series.heights == (0.0, 0.375)
    assert winter.series.air_temperatures == (None, pytest.approx(268.65))
    assert (winter.station, winter.altitude, winter.height_factor) == ("", None, None)
    assert [one.key for one in winter.notes] == ["winter_sheet.cut"]  # it ends in snow


def test_head_of_the_station_stands_on_the_first_line(book):
    headings = [
        "Datum",
        "Schneehöhe [m]",
        "Station",
        "Höhe über Meer",
        "Höhenfaktor [-]",
    ]
    headings[3] = "Höhe über Meer [m]"
    lines = [["2003-02-01", 0.0, "Weissfluhjoch", 2540, 0.85], ["2003-02-02", 0.2]]
    book = with_lines(book, *lines, headings=headings)
    winter = book.read().of_addons["Winter"]
    assert (winter.station, winter.altitude) == ("Weissfluhjoch", 2540.0)
    assert winter.height_factor == 0.85


def test_short_gap_in_snow_is_filled_and_told(book):
    lines = [*days(0, 80), ["2003-02-05", 110, None]]
    site = with_lines(book, *lines).read()
    assert site.of_addons["Winter"].series.heights == pytest.approx(
        (0, 0.8, 0.9, 1.0, 1.1)
    )
    told = [str(note) for note in site.notes if "straight line" in str(note)]
    assert len(told) == 1
    assert "2003-02-03, 2003-02-04" in told[0]


@pytest.mark.parametrize(
    ("lines", "cell", "told"),
    [
        (days(0, -1), "B3", "accepted: 0 to 8 m"),
        (days(0, 801), "B3", "accepted: 0 to 8 m"),
        ([["1/2/2003", 0, None]], "A2", "is no date"),
        ([*days(0, 20), ["2003-02-02", 21, None]], "A4", "second reading on its day"),
        ([*days(0, 20), ["2003-02-01", 21, None]], "A4", "before the line above"),
        ([*days(0, 20), ["2003-02-07", 21, None]], "A4", "4 days without a reading"),
        (
            [["2003-10-01", 0, None], ["2003-12-02", 0, None]],
            "A3",
            "61 days without a reading",
        ),
        ([["2003-02-01", None, -2.0]], "A2", "without a snow height"),
    ],
)
def test_faults_have_their_cell(book, lines, cell, told):
    findings = [
        one for one in with_lines(book, *lines).refuse() if one.severity == "error"
    ]
    (finding,) = findings
    assert (finding.sheet, finding.cell) == ("Winter", cell)
    assert told in str(finding.message)


def test_spikes_and_a_start_in_snow_are_told(book):
    site = with_lines(book, *days(30, 92, 40)).read()
    told = " ".join(map(str, site.notes))
    assert "2003-02-02: the snow rises or falls by more than 0.6 m" in told
    assert "300 kg/m³ (assumed)" in told
    assert len(site.of_addons["Winter"].notes) == 3  # it ends in snow, too


WITH_ROWS = [*HEADINGS, "height factor [-]", "net row"]


def rows_of(*factors):
    """Lines of February with a factor and a row each."""
    return [[*day, *one] for day, one in zip(days(0, 20, 40), factors, strict=True)]


def test_a_row_has_its_own_height_factor(book):
    lines = rows_of((0.93, None), (1.21, "R1"), (None, None))
    winter = with_lines(book, *lines, headings=WITH_ROWS).read().of_addons["Winter"]
    assert winter.find_factor("R1") == 1.21
    assert winter.find_factor("another") == 0.93
    lines = rows_of((1.21, "R1"), (None, None), (None, None))
    winter = with_lines(book, *lines, headings=WITH_ROWS).read().of_addons["Winter"]
    assert winter.find_factor("R1") == 1.21
    assert winter.find_factor("another") is None


@pytest.mark.parametrize(
    ("factors", "cell", "told"),
    [
        (((None, None), (1.2, "R1"), (1.3, "R1")), "E4", "has a height factor already"),
        (((0.9, None), (None, "R1"), (None, None)), "E3", "without a height factor"),
        (((0.9, None), (1.2, "r 77"), (None, None)), "E3", "is no id of sheet Rows"),
        (((0.9, None), (1.2, None), (None, None)), "D3", "height factor without a row"),
        (((0.9, None), (5.2, "R1"), (None, None)), "D3", "accepted: 0.2 to 5"),
    ],
)
def test_a_height_factor_that_cannot_be_placed_is_one_finding(
    book, factors, cell, told
):
    lines = rows_of(*factors)
    findings = with_lines(book, *lines, headings=WITH_ROWS).refuse()
    (finding,) = [one for one in findings if one.severity == "error"]
    assert (finding.sheet, finding.cell) == ("Winter", cell)
    assert told in str(finding)
