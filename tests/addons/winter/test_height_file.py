"""Files of stations as they are published: columns named, days in any one order."""

from datetime import date, timedelta

import numpy as np
import pytest

from netdesign.addons.winter.height_file import HeightColumns, read_height_file
from netdesign.addons.winter.heights import smooth, split_winters
from netdesign.addons.winter.season import list_complete
from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import TextFormat
from tests.each import each

# Each way of a publisher: how a day is written, separator, unit, words for no reading.
WAYS = (
    ("%Y-%m-%d", ",", "cm", ("NA", "NaN")),
    ("%Y%m%d", ";", "cm", ("-", "-999")),
    ("%d.%m.%Y 07:00:00", ";", "mm", ("Lücke",)),
    ("%d/%m/%Y", ";", "cm", ("",)),
    ("%m/%d/%Y", ",", "cm", ("M", "T")),
    ("%d.%m.%y", "\t", "m", ("9999",)),
    ("%Y-%m-%dT00:00+00:00", ",", "cm", ("-1",)),
    ("%Y%m%dT0600", "|", "cm", ("-9999",)),
)
PER_METRE = {"cm": 100.0, "mm": 1000.0, "m": 1.0}


def draw_winter(rng, count=150):
    """Heights of some days [m] from bare ground to bare ground, to the centimetre."""
    steps = rng.uniform(-0.05, 0.08, count)
    heights = np.round(np.maximum(0.0, np.cumsum(steps)), 2)
    heights[[0, -1]] = 0.0
    fall = np.arange(count)[::-1] * 0.05
    return np.round(np.minimum(heights, fall), 2)


@each("seed", range(32))
def test_a_file_is_read_as_it_is_published(tmp_path_factory, seed):
    rng = np.random.default_rng([61, 14, seed])
    form, mark, unit, words = WAYS[seed % len(WAYS)]
    heights = draw_winter(rng)
    first = date(2001 + seed % 20, 11, int(rng.integers(28)) + 1)
    lost = {int(k) for k in rng.integers(2, 140, 4)}
    names = ("STAT", f"WHEN {seed}", "QC", "HSx")
    lines = [f"# report of {seed}", mark.join(names)]
    for k, height in enumerate(heights):
        day = (first + timedelta(days=k)).strftime(form)
        told = f"{height * PER_METRE[unit]:.5f}"
        told = words[k % len(words)] if k in lost else told
        lines.append(mark.join(("X1", day, "0", told)))
    path = tmp_path_factory.mktemp("station") / "heights.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    columns = HeightColumns(
        date=names[1].lower(),
        height=names[3],
        unit=unit,
        missing=words,
    )
    form = TextFormat(delimiter=mark, decimal_mark=".")
    station, _ = read_height_file(path, form, columns=columns)
    assert station.series.first_day == first
    assert {first + timedelta(days=k) for k in lost} == set(station.series.filled)
    kept = [k for k in range(len(heights)) if k not in lost]
    found = np.array(station.series.heights)
    np.testing.assert_allclose(found[kept], heights[kept], atol=1e-5)


def write(path, days, heights):
    lines = ["date;HS [cm]", *(f"{a};{b}" for a, b in zip(days, heights, strict=True))]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_days_that_may_be_two_are_asked_about(tmp_path):
    path = write(tmp_path / "a.csv", ["01/02/2021", "02/03/2021"], [0, 0])
    with pytest.raises(SiteDataError, match="more than one day: 01/02/2021"):
        read_height_file(path)
    path = write(tmp_path / "b.csv", ["31/01/2021", "01/02/2021"], [0, 0])
    assert read_height_file(path)[0].series.first_day == date(2021, 1, 31)


def test_a_refused_file_is_told_the_options(tmp_path):
    path = write(tmp_path / "a.csv", ["2021-01-01"], ["none"])
    with pytest.raises(SiteDataError, match="--date COLUMN --height COLUMN"):
        read_height_file(path)
    with pytest.raises(SiteDataError, match='no columns "x" and "y"'):
        read_height_file(path, columns=HeightColumns(date="x", height="y"))


@each("seed", range(12))
def test_a_season_that_ends_in_late_snow_refuses_no_other(tmp_path_factory, seed):
    """Drawn winters with no reading from one to the next; some end in snow."""
    rng = np.random.default_rng([61, 14, 1, seed])
    days, heights, cut = [], [], []
    for year in range(2001, 2006):
        winter = draw_winter(rng, 151)
        if rng.uniform() < 0.4:
            winter[-1] = winter[-2] = 0.15
            cut.append(f"{year}/{year + 1}")
        days += [date(year, 12, 1) + timedelta(days=k) for k in range(151)]
        heights += [round(100.0 * one, 1) for one in winter]
    path = write(tmp_path_factory.mktemp("late") / "a.csv", days, heights)
    station, _ = read_height_file(path)
    assert station.series.cut == tuple(cut)
    assert list_complete(station.series) == tuple(
        name for name in split_winters(station.series) if name not in cut
    )
    summer = station.series.heights[151 : (date(2002, 12, 1) - days[0]).days]
    assert set(summer) == {0.0}


# --- fault 11: a winter that is cut, or whose gauge is dead, is told: no range --------


@each("seed", range(16))
def test_a_gauge_that_stands_still_or_loses_its_snow_makes_a_winter_incomplete(
    tmp_path_factory, seed
):
    rng = np.random.default_rng([61, 11, seed])
    heights = np.concatenate([np.linspace(0.0, 1.6, 80), np.linspace(1.6, 0.0, 100)])
    noise = np.where(heights > 0.1, rng.uniform(0, 0.05, 180), 0)
    heights = np.round(heights + noise, 2)
    kind = ("still", "lost", "ends", "sound")[seed % 4]
    at = int(rng.integers(65, 110))
    if kind == "still":
        heights[at : at + 35] = heights[at]
    if kind == "lost":
        heights[at:] = 0.0
    if kind == "ends":
        heights = heights[:at]
    days = [date(2015, 11, 1) + timedelta(days=k) for k in range(len(heights))]
    path = tmp_path_factory.mktemp("gauge") / "a.csv"
    write(path, days, [f"{100 * one:.0f}" for one in heights])
    station, remarks = read_height_file(path)
    assert station.series.cut == (() if kind == "sound" else ("2015/2016",))
    told = " ".join(str(one.message) for one in remarks)
    assert ("incomplete: 2015/2016" in told) == (kind != "sound")
    assert smooth(station.series).cut == station.series.cut
