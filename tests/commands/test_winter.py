"""The command ``winter``: document, page, refusals, exit codes."""

import json
from html import escape

import openpyxl
import pytest

from netdesign.commands.winter import _list_statistics
from netdesign.files.winter import _write_statistics
from netdesign.winter.statistics import Gumbel
from netdesign.words.catalogue import render
from tests.digits import write_force
from tests.report.accessible import list_violations
from tests.report.printing import PAPER_PX, PHONE_PX, list_too_wide
from tests.short_example import write_short_example

HEIGHTS = [0, 30, 60, 55, 90, 130, 125, 150, 160, 150, 140, 120, 90, 60, 20, 0]
QUICK = ("--accuracy", "0.05", "--jobs", "1", "--every", "5", "--quiet")


def write_heights(path, heights=HEIGHTS, year=2003):
    lines = ["date,HS [cm],air temperature [C]"]
    lines += [f"{year}-02-{k + 1:02d},{h},-3.5" for k, h in enumerate(heights)]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    path = tmp_path_factory.mktemp("winter") / "site.xlsx"
    write_short_example(path, ["R2"])
    return path


@pytest.fixture(scope="module")
def heights(tmp_path_factory):
    return write_heights(tmp_path_factory.mktemp("winter") / "station.csv")


def test_document_is_that_of_the_interface(call, site, heights):
    ended = call("winter", site, "--heights", heights, "--json", *QUICK)
    document = json.loads(ended.out)
    assert document["schema"] == "netdesign.winter/1"
    (row,) = document["rows"]
    (winter,) = row["winters"]
    assert (row["statistics"], row["fit"]) == (None, None)
    assert row["trend"]["winters"] is None
    assert winter["name"] == "2002/2003"
    assert winter["height_max_m"] == pytest.approx(1.6)
    assert winter["height_max_date"] == "2003-02-09"
    assert winter["outcome"] == "solved"
    assert ended.code == 0
    assert winter["is_proven"]
    assert not winter["complete"]
    assert 0 < winter["foot_peak_kN_per_m"] <= 1.05 * winter["uniform_peak_kN_per_m"]
    governing = [
        day for day in winter["curve"] if day["date"] == winter["governing_date"]
    ]
    assert governing[0]["foot_kN_per_m"] == winter["foot_peak_kN_per_m"]
    assert document["model"] == "delta-snow-ageing"
    assert set(winter["models"]) == {"delta-snow", "hs2swe"}
    assert winter["models"]["delta-snow"]["uniform_peak_kN_per_m"] > 0
    density = row["equivalent_density"]
    assert density["low_kg_m3"] <= density["high_kg_m3"]
    assert "equivalent density" in density["justification"]
    assert document["check_density_kg_m3"] == [270.0, 400.0]
    assert "station.csv" in density["justification"]
    assert document["station"]["height_factor_given"] is False


def test_terminal_has_each_return_value_with_its_ends_and_winters():
    fit = Gumbel(count=23, mean=17.3e3, deviation=5.2e3)
    statistics = _write_statistics(fit, None)
    row = {
        "id": "R1",
        "statistics": statistics,
        "statistics_notes": ["Two are left out."],
        "trend": {"why": "Flat."},
    }
    told = [render(one, "en") for one in _list_statistics(row)]
    ends = [
        tuple(f"{one[f'{end}_kN_per_m']:.1f}" for end in ("foot", "low", "high"))
        for one in statistics["return_values"]
    ]
    assert [one[0] for one in ends] == ["28.7", "33.6"]
    assert told == [
        f"R1: foot's pull once in {period} years {foot} kN/m, between {low} and {high}"
        " kN/m (5 and 95 %), from 23 winters"
        for period, (foot, low, high) in zip((30, 100), ends, strict=True)
    ] + ["R1: Two are left out.", "R1: Flat."]
    alone = [render(one, "en") for one in _list_statistics(row | {"statistics": None})]
    assert alone == told[2:]


def test_page_shows_the_document(call, site, heights, tmp_path):
    folder = tmp_path / "out"
    ended = call(
        "winter", site, "--heights", heights, "--out", folder, *QUICK,
    )  # fmt: skip
    assert ended.code == 0
    page = (folder / "winter.html").read_text(encoding="utf-8")
    document = json.loads((folder / "winter.json").read_text(encoding="utf-8"))
    (winter,) = document["rows"][0]["winters"]
    assert f">{write_force(winter['foot_peak_kN_per_m'])}<" in page
    assert page.count("<svg") == 1
    assert winter["why"].split(":")[0] in page
    trend = document["rows"][0]["trend"]["why"]
    assert escape(trend, quote=False) in page.replace("&#39;", "'")
    assert trend in ended.out
    assert "<script" not in page
    wide = list_too_wide(page, PHONE_PX, tmp_path, media="screen")
    assert {one.split()[1] for one in wide} <= {"table"}  # in what can be scrolled
    assert list_too_wide(page, PAPER_PX, tmp_path) == []
    assert list_violations(page, tmp_path, PHONE_PX) == []


def test_governing_day_solved_as_uniform_snow_says_so(call, site, tmp_path):
    """Snow too thin for layers governs although less high: not ripened, uniform."""
    thin = [0, 30, 70, 95, 104, 103, 99, 90, 60, 0]
    path = write_heights(tmp_path / "low.csv", thin)
    ended = call("winter", site, "--heights", path, "--json", *QUICK)
    (winter,) = json.loads(ended.out)["rows"][0]["winters"]
    day = {one["date"]: one for one in winter["curve"]}[winter["governing_date"]]
    assert (day["layers"], winter["basis"]) == ([], "uniform")
    assert "This day is calculated with uniform snow" in winter["why"]
    assert "ripened" not in winter["why"]


def test_heights_of_a_file_keep_the_factor_of_the_sheet(call, tmp_path):
    """Station, altitude and height factor belong to the rows, not to the series."""
    site, folder = tmp_path / "site.xlsx", tmp_path / "out"
    write_short_example(site, ["R2"])
    book = openpyxl.load_workbook(site)
    lines = ["2003-02-01", 0, None, "Alp Sura", 2137, 1.27], ["2003-02-02", 0.4]
    for number, line in enumerate(lines, start=2):
        for column, value in enumerate(line, start=1):
            book["Winter"].cell(number, column, value)
    book.save(site)
    path = write_heights(tmp_path / "other.csv", [0, 60, 80, 70, 0])
    ended = call("winter", site, "--heights", path, "--out", folder, *QUICK)
    document = json.loads((folder / "winter.json").read_text(encoding="utf-8"))
    station = document["station"]
    assert (station["name"], station["altitude_m"]) == ("Alp Sura", 2137.0)
    assert (station["height_factor"], station["file"]) == (1.27, "other.csv")
    note = "those of sheet Winter apply"
    assert note in ended.err
    page = (folder / "winter.html").read_text(encoding="utf-8")
    assert note in page
    assert "Alp Sura, 2137 m (other.csv)" in page
    (row,) = document["rows"]
    assert "Alp Sura, other.csv" in row["equivalent_density"]["justification"]


def test_snow_above_the_net_is_not_proven(call, site, tmp_path):
    path = write_heights(tmp_path / "deep.csv", [0, 60, 120, 700, 650, 600])
    ended = call("winter", site, "--heights", path, "--json", *QUICK)
    (winter,) = json.loads(ended.out)["rows"][0]["winters"]
    assert ended.code == 4
    assert (winter["outcome"], winter["is_proven"]) == ("overtopped", False)


@pytest.mark.parametrize(
    ("arguments", "told", "code"),
    [
        ((), "no snow heights", 3),
        (("--heights", "thin"), "Were metres taken for centimetres", 3),
        (
            ("--heights", "good", "--row", "R77"),
            "R77: no net row of the site",
            2,
        ),
    ],
)
def test_refusals(call, site, heights, tmp_path, arguments, told, code):
    thin = write_heights(tmp_path / "thin.csv", [0, 1, 3, 2])
    paths = {"thin": thin, "good": heights}
    given = [paths.get(one, one) for one in arguments]
    ended = call("winter", site, *given, "--json", *QUICK)
    assert ended.code == code
    assert told in ended.err


def test_medians_are_taken_where_asked_for(call, site, tmp_path):
    path = write_heights(tmp_path / "noisy.csv", [0, 50, 100, 190, 100, 100, 100])
    plain, smoothed = (
        json.loads(call("winter", site, "--heights", path, "--json", *more, *QUICK).out)
        for more in ((), ("--median",))
    )
    assert smoothed["station"]["is_smoothed"]
    (winter,) = smoothed["rows"][0]["winters"]
    assert winter["height_max_m"] == 1.0
    assert plain["rows"][0]["winters"][0]["height_max_m"] == 1.9


def write_monitoring(path, lines):
    book = openpyxl.load_workbook(path)
    if "Monitoring" in book.sheetnames:
        del book["Monitoring"]
    sheet = book.create_sheet("Monitoring")
    sheet.append(["net row", "member", "time [d]", "date and time", "tension [kN]"])
    for line in lines:
        sheet.append(line)
    book.save(path)


def test_measured_forces_stand_beside_the_chain(call, heights, tmp_path):
    path, folder = tmp_path / "site.xlsx", tmp_path / "out"
    write_short_example(path, ["R2"])
    hours = [
        f"2003-02-{day:02d} {hour:02d}:00"
        for day in range(4, 14)
        for hour in (2, 9, 21)
    ]
    lines = [["R2", "foot anchor", None, at, 8.0 + k] for k, at in enumerate(hours)]
    lines += [["R2", "post", 3.5, None, 20.0]]
    write_monitoring(path, lines)
    ended = call("winter", path, "--heights", heights, "--out", folder, *QUICK)
    assert ended.code == 0
    document = json.loads((folder / "winter.json").read_text(encoding="utf-8"))
    (row,) = document["rows"]
    (one,) = row["measured"]
    (winter,) = row["winters"]
    assert (one["member"], one["winter"]) == ("foot_anchor", "2002/2003")
    assert len(one["readings"]) == 30
    assert one["readings"][3] == {"time": "2003-02-05T02:00:00", "force_kN": 11.0}
    by_day = {day["date"]: day for day in winter["curve"]}
    for day in one["computed"]:
        force = by_day[day["date"]]["members_kN"].get("foot_anchor", 0.0)
        assert day["force_kN"] == force
        assert day["low_kN"] <= force <= day["high_kN"]
    assert one["temperature_amplitude_assumed"] is False
    assert 0.0 <= one["readings_in_band"] <= 1.0
    (told,) = row["not_compared"]
    assert "measured times without a date" in told
    page = (folder / "winter.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 2
    assert "Foot anchor: measured and computed force per support" in page
    assert told in page
