import math
import zipfile
from dataclasses import replace
from io import BytesIO

import numpy as np
import openpyxl
import pytest
from PIL import Image

from netdesign.outcome import SiteDataError
from netdesign.resistance.post import PostSection
from netdesign.site.columns.all_tables import NETS
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import _read_picture, list_starting_lines
from netdesign.words.catalogue import LANGUAGES
from tests.old_example import load_example, write_old_example
from tests.site.template.geometry import draw_geometry


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    path = tmp_path_factory.mktemp("example") / "example.xlsx"
    write_old_example(path)
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


def test_the_same_bytes_come_out_each_time(example, tmp_path):
    again = tmp_path / "again.xlsx"
    write_old_example(again)
    assert again.read_bytes() == example.read_bytes()


def test_the_empty_workbook_asks_for_rows_only(tmp_path):
    path = tmp_path / "blank.xlsx"
    write_old_example(path, lines=list_starting_lines())
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    assert [(f.sheet, f.cell, str(f.rule)) for f in caught.value.findings] == [
        ("Nets", "", "has no net row"),
    ]


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


def test_text_never_becomes_a_formula(tmp_path):
    lines = {"Project": [{"item": "name", "value": '=HYPERLINK("http://x")'}]}
    path = tmp_path / "site.xlsx"
    write_old_example(path, lines=lines)
    cell = openpyxl.load_workbook(path)["Project"]["B2"]
    with zipfile.ZipFile(path) as archive:
        xml = archive.read("xl/worksheets/sheet2.xml")
    assert b"<f>" not in xml
    assert (cell.value, cell.hyperlink) == ('=HYPERLINK("http://x")', None)


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("kind", ["example", "blank"])
def test_what_is_written_in_each_language_is_read_clean(tmp_path, language, kind):
    english, path = tmp_path / "en.xlsx", tmp_path / "site.xlsx"
    write_old_example(english)
    write_old_example(
        path, language, None if kind == "example" else list_starting_lines()
    )
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
    assert {str(f.rule) for f in caught.value.findings} == {"has no net row"}


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
    """Without their cells; an eta has one of its own."""
    bare = [replace(one, source="") for one in resistances]
    return tuple(
        replace(one, dimensions=replace(one.dimensions, efficiency_place=""))
        if isinstance(getattr(one, "dimensions", None), PostSection)
        else one
        for one in bare
    )


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
