import math
import zipfile
from dataclasses import replace
from io import BytesIO

import numpy as np
import openpyxl
import pytest
from PIL import Image

from netdesign.checks import list_standards
from netdesign.outcome import OutputError, SiteDataError
from netdesign.site.columns.all_tables import NETS, SHEETS
from netdesign.site.model import LIFTED_MODE
from netdesign.site.reader import read_site
from netdesign.site.template import workbook as template
from netdesign.site.template.workbook import (
    _read_picture,
    load_example,
    write_site_workbook,
)
from netdesign.words.catalogue import LANGUAGES
from tests.site.template.geometry import SYMBOLS, draw_geometry


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
        shown = {str(echo.label): echo.value for echo in row.inputs}
        for key, value in line.items():
            assert shown[labels[key]] == value


def test_the_example_covers_what_it_promises(example):
    site = read_site(example)
    missing = {
        (row.id, resistance.member, resistance.mode)
        for row in site.rows
        for resistance in row.resistances
        if resistance.value is None and resistance.dimensions is None
        if (resistance.member, resistance.mode) != LIFTED_MODE
    }
    assert len(site.rows) == 7
    assert missing == {
        ("R3", "post_base", "bearing"), ("R6", "foot_anchor", "pull_out")
    }  # fmt: skip
    (declared,) = site.declared
    assert (declared.row_id, declared.member) == ("R3", "post_base")
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
    assert [(f.sheet, f.cell, str(f.rule)) for f in caught.value.findings] == [
        ("Nets", "", "has no net row"),
        *(("Ranges", cell, "is empty") for cell in ("C2", "D2", "C3", "D3")),
    ]


def test_headings_have_units_notes_and_stay_in_view(example):
    workbook = openpyxl.load_workbook(example)
    assert workbook.sheetnames == ["Notes", *(plan.name for plan in SHEETS)]
    nets = workbook["Nets"]
    headings = [cell.value for cell in nets[1]]
    assert headings == [field.heading_for("en") for field in NETS.fields]
    assert nets.freeze_panes == "B2"
    assert all(cell.comment is not None for cell in nets[1])
    assert "units: [deg], [%], [rad]" in nets["B1"].comment.text
    assert "left empty, calculated with: 0.02" in nets["K1"].comment.text


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
    assert anchor.formula1 == "'Anchors'!$A$2:$A$201"


@pytest.mark.parametrize(
    ("language", "name", "first"),
    [
        ("en", "Monitoring", "foot anchor"),
        ("fr", "Mesures", "ancrage de pied"),
        ("de", "Messungen", "Fußanker"),
    ],
)
def test_measurements_have_a_sheet_of_their_own(tmp_path, language, name, first):
    path = tmp_path / "site.xlsx"
    write_site_workbook(path, example=True, language=language)
    workbook = openpyxl.load_workbook(path)
    sheet = workbook[name]
    offered = {
        str(rule.sqref): rule.formula1 for rule in sheet.data_validations.dataValidation
    }
    assert offered["B2:B201"].startswith(f'"{first},')
    nets = workbook.sheetnames[2]
    sheet["A2"], sheet["B2"] = workbook[nets]["A2"].value, first
    sheet["D2"], sheet["E2"] = "2003-02-18 06:00", 80
    workbook.save(path)
    (series,) = read_site(path).monitoring
    assert (series.member, series.tensions) == ("foot_anchor", (80_000.0,))


def test_text_never_becomes_a_formula(tmp_path, monkeypatch):
    lines = {"Project": [{"item": "name", "value": '=HYPERLINK("http://x")'}]}
    monkeypatch.setattr(template, "load_example", lambda: lines)
    path = tmp_path / "site.xlsx"
    write_site_workbook(path, example=True)
    cell = openpyxl.load_workbook(path)["Project"]["B2"]
    with zipfile.ZipFile(path) as archive:
        xml = archive.read("xl/worksheets/sheet2.xml")
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


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("kind", ["example", "blank"])
def test_what_is_written_in_each_language_is_read_clean(tmp_path, language, kind):
    english, path = tmp_path / "en.xlsx", tmp_path / "site.xlsx"
    write_site_workbook(english, example=True)
    write_site_workbook(path, example=kind == "example", language=language)
    if kind == "example":
        site, truth = read_site(path), read_site(english)
        assert site.notes == ()
        assert site.ranges == truth.ranges
        assert [strip(row) for row in site.rows] == [strip(row) for row in truth.rows]
        assert strip_links(site) == strip_links(truth) != {}
        return
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    # nothing but what is for the engineer to fill in
    assert {str(f.rule) for f in caught.value.findings} == {
        "has no net row",
        "is empty",
    }


def strip(row):
    """A row without its cells: their sheets are named in another language."""
    row = replace(
        row,
        inputs=(),
        resistances=bare_resistances(row.resistances),
        net_parts=bare_resistances(row.net_parts),
        end_resistances=None,
    )
    if row.row_end is None:
        return row
    held = bare_resistances(row.row_end.resistances)
    return replace(row, row_end=replace(row.row_end, resistances=held))


def strip_links(site):
    return {kind: bare_resistances(chain) for kind, chain in site.links.items()}


def bare_resistances(resistances):
    return tuple(replace(one, source="") for one in resistances)


@pytest.mark.parametrize("language", ["fr", "de"])
def test_sheets_headings_and_words_are_in_their_language(tmp_path, language):
    path = tmp_path / "site.xlsx"
    write_site_workbook(path, example=True, language=language)
    workbook = openpyxl.load_workbook(path)
    names = {
        "fr": ["Notice", "Projet", "Filets", "Plages", "Neige", "Ancrages"],
        "de": ["Hinweise", "Projekt", "Netze", "Bereiche", "Schnee", "Anker"],
    }[language]
    assert workbook.sheetnames[:6] == names
    nets = workbook[names[2]]
    slope = {"fr": "pente [deg]", "de": "Hangneigung [deg]"}[language]
    assert nets["B1"].value == slope
    law = {"fr": "sans glissement", "de": "kein Gleiten"}[language]
    assert nets["F2"].value == law
    sheet, check = {
        "fr": ("Déclarées", "Pied de montant, appui au sol"),
        "de": ("Erklärte", "Stützenfuß, Fundation, Druck"),
    }[language]
    assert workbook[sheet]["B2"].value == check
    quantity = {"fr": "masse volumique", "de": "Dichte"}[language]
    assert workbook[names[3]]["A2"].value == quantity


def test_sheets_are_set_up_for_printing(example):
    workbook = openpyxl.load_workbook(example)
    for sheet in workbook.worksheets:
        assert sheet.page_setup.paperSize == 9  # A4
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
    nets = workbook["Nets"]
    assert nets.print_title_rows == "$1:$1"
    assert nets.print_title_cols == "$A:$A"
    assert nets.page_setup.orientation == "landscape"
    assert "&P" in nets.oddFooter.right.text
    assert nets.print_area == "'Nets'!$A$1:$AV$25"


def test_profiles_and_quantities_are_offered(example):
    workbook = openpyxl.load_workbook(example)
    offers = {
        str(rule.sqref): rule.formula1
        for name in ("Project", "Ranges")
        for rule in workbook[name].data_validations.dataValidation
    }
    assert offers["B7"] == f'"{",".join(list_standards())}"'
    quantities = offers["A2:A201"]
    assert quantities.startswith('"density,friction angle,net inclination,')
    assert quantities.endswith('slack,net stiffness,slip length,glide factor"')
    assert offers["B2:B201"].startswith('"kg/m3,')


def test_the_notes_show_a_drawing_and_every_symbol_of_it(example):
    notes = openpyxl.load_workbook(example)["Notes"]
    (picture,) = notes._images
    assert (picture.width, picture.height) == (1472, 1080)
    symbols = {row[0].value for row in notes.iter_rows(min_row=30)} - {None, ""}
    assert symbols == {"symbol", *SYMBOLS.values()}


@pytest.mark.parametrize("language", ["en", "fr", "de"])
def test_the_stored_picture_is_the_drawing(language):
    """Of fewer colours, and of letters that another release may set otherwise."""
    stored, drawn = (
        np.asarray(Image.open(BytesIO(content)).convert("RGB"), dtype=float)
        for content in (_read_picture(language), draw_geometry(language))
    )
    assert stored.shape == drawn.shape
    apart = np.abs(stored - drawn).max(axis=2)
    assert apart.mean() < 1.0
    assert (apart > 60.0).mean() < 2e-3


def test_pictures_of_other_languages_are_another_one():
    pictures = {_read_picture(language) for language in ("en", "fr", "de")}
    assert len(pictures) == 3
