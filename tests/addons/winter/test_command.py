"""The commands ``winter`` and ``snowpack``: documents, page, refusals, exit codes."""

import json

import openpyxl
import pytest

from netdesign.addons.winter.command import _is_proven
from netdesign.addons.winter.settling import MODELS, follow_heights
from tests.make import load_rows, write_rows, write_site

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
    write_rows(path, ["R2"])
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
    station = {"station": "Alp Sura", "altitude": 2137, "height_factor": 1.27}
    heights = [
        {"date": "2003-02-01", "snow_height": 0, **station},
        {"date": "2003-02-02", "snow_height": 0.4},
    ]
    write_site(site, load_rows(["R2"], leans=False) | {"Winter": heights})
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
    write_rows(path, ["R2"])
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
    (told,) = row["not_compared"]
    assert "measured times without a date" in told
    page = (folder / "winter.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 2
    assert "Net anchor (foot): measured and computed force per support" in page
    assert told in page


@pytest.mark.parametrize("model", MODELS)
def test_document_has_the_days_of_the_model(call, tmp_path, model):
    path = write_heights(tmp_path / "station.csv")
    ended = call("snowpack", path, "--model", model, "--json", "--layers")
    document = json.loads(ended.out)
    packs = follow_heights([h / 100 for h in HEIGHTS], MODELS[model])
    assert (ended.code, document["schema"]) == (0, "netdesign.snowpack/1")
    masses = [day["swe_kg_m2"] for day in document["days"]]
    assert masses == pytest.approx([pack.mass for pack in packs], rel=1e-12)
    assert document["days"][8]["date"] == "2003-02-09"
    assert document["days"][0]["layers"] == []
    layers = document["days"][8]["layers"]
    total = sum(layer["height_m"] for layer in layers)
    assert total == pytest.approx(document["days"][8]["height_m"], rel=1e-12)


def test_faults_are_told_and_nothing_is_printed(call, tmp_path):
    path = write_heights(tmp_path / "station.csv", [0, -20])
    ended = call("snowpack", path)
    assert (ended.code, ended.out) == (3, "")
    assert "B3" in ended.err


def is_settled(largest, thin):
    winters = [{"is_proven": True}, {"is_proven": thin, "is_below_largest": largest}]
    return _is_proven({"rows": [{"winters": winters}]})


def test_a_bound_below_the_largest_maximum_is_enough():
    found = [is_settled(*one) for one in ((True, False), (False, False), (False, True))]
    assert found == [True, False, True]
