import math
import zipfile

import openpyxl
import pytest

from netdesign.errors import OutputError, SiteDataError
from netdesign.site import template
from netdesign.site.columns import NETS, SHEETS
from netdesign.site.reader import read_site
from netdesign.site.template import load_example, write_site_workbook


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    path = tmp_path_factory.mktemp("example") / "example.xlsx"
    write_site_workbook(path, example=True)
    return path


def test_the_example_reads_clean_and_round_trips(example):
    site = read_site(example)
    lines = load_example()["Nets"]
    assert site.notes == ()
    assert [row.id for row in site.rows] == [line["id"] for line in lines]
    for row, line in zip(site.rows, lines, strict=True):
        assert row.slope_angle == math.radians(line["slope_angle"])
        assert row.net_height == line["net_height"]
        assert row.net_stiffness_per_m == 1000.0 * line["net_stiffness"]
        assert row.slack == line["slack"]
        assert row.layout.post_spacing == line["post_spacing"]
        if "snow_thickness" in line:
            assert row.snow_thickness == line["snow_thickness"]


def test_every_cell_of_the_example_is_echoed_as_typed(example):
    labels = {field.key: field.label for field in NETS.fields}
    site = read_site(example)
    for row, line in zip(site.rows, load_example()["Nets"], strict=True):
        shown = {echo.label: echo.value for echo in row.inputs}
        for key, value in line.items():
            assert shown[labels[key]] == value


def test_the_example_covers_what_it_promises(example):
    site = read_site(example)
    missing = {
        (row.id, resistance.member, resistance.mode)
        for row in site.rows
        for resistance in row.resistances
        if resistance.value is None
    }
    assert len(site.rows) == 7
    assert missing == {("R6", "foot_anchor", "pull_out")}
    assert {row.ground.kind for row in site.rows} == {"free", "no-slip", "sliding"}
    assert all(row.snow_thickness <= row.net_height for row in site.rows)


def test_the_same_bytes_come_out_each_time(example, tmp_path):
    again = tmp_path / "again.xlsx"
    write_site_workbook(again, example=True)
    assert again.read_bytes() == example.read_bytes()


def test_the_empty_workbook_asks_for_rows_and_ranges_only(tmp_path):
    path = tmp_path / "blank.xlsx"
    write_site_workbook(path)
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    assert [(f.sheet, f.cell, f.rule) for f in caught.value.findings] == [
        ("Nets", "", "has no net row"),
        *(("Ranges", cell, "is empty") for cell in ("C2", "D2", "C3", "D3")),
    ]


def test_headings_have_units_notes_and_stay_in_view(example):
    workbook = openpyxl.load_workbook(example)
    assert workbook.sheetnames == [plan.name for plan in SHEETS]
    nets = workbook["Nets"]
    headings = [cell.value for cell in nets[1]]
    assert headings == [field.heading for field in NETS.fields]
    assert nets.freeze_panes == "B2"
    assert all(cell.comment is not None for cell in nets[1])
    assert "units: [deg] or [%] or [rad]" in nets["B1"].comment.text
    assert "left empty: 0.02" in nets["K1"].comment.text


def test_bounds_and_words_are_offered_while_typing(example):
    nets = openpyxl.load_workbook(example)["Nets"]
    rules = {
        str(rule.sqref).split(":")[0]: rule
        for rule in nets.data_validations.dataValidation
    }
    slope, law, anchor = rules["B2"], rules["F2"], rules["P2"]
    assert (slope.type, slope.formula1, slope.formula2) == ("decimal", "10.0", "75.0")
    assert (law.type, law.formula1) == ("list", '"free,no-slip,sliding"')
    assert (anchor.type, anchor.errorStyle) == ("list", "warning")
    assert anchor.formula1 == "Anchors!$A$2:$A$201"


def test_text_never_becomes_a_formula(tmp_path, monkeypatch):
    lines = {"Project": [{"item": "name", "value": '=HYPERLINK("http://x")'}]}
    monkeypatch.setattr(template, "load_example", lambda: lines)
    path = tmp_path / "site.xlsx"
    write_site_workbook(path, example=True)
    cell = openpyxl.load_workbook(path)["Project"]["B2"]
    with zipfile.ZipFile(path) as archive:
        xml = archive.read("xl/worksheets/sheet1.xml")
    assert b"<f>" not in xml
    assert (cell.value, cell.hyperlink) == ('=HYPERLINK("http://x")', None)


def test_a_file_that_exists_is_kept_unless_told(tmp_path):
    path = tmp_path / "site.xlsx"
    path.write_text("mine")
    with pytest.raises(OutputError, match="exists already"):
        write_site_workbook(path)
    assert path.read_text() == "mine"
    write_site_workbook(path, overwrite=True)
    assert zipfile.is_zipfile(path)


def test_a_folder_that_does_not_exist_is_made(tmp_path):
    path = tmp_path / "new" / "site.xlsx"
    write_site_workbook(path)
    assert path.stat().st_size > 0


def test_a_file_in_the_place_of_a_folder_is_an_output_error(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="is not a folder"):
        write_site_workbook(tmp_path / "file" / "site.xlsx")
