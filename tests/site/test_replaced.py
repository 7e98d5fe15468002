"""Cells that are read as if something else were typed there."""

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.declared_sheet import split_replacement
from netdesign.site.reader import read_site
from tests.each import each
from tests.make import find_cell, load_tables, write_site
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    tables = load_tables("tiny")
    tables["rows"].append({**tables["rows"][0], "id": "R2"})
    other = {**tables["anchor_types"][0], "id": "A2", "tendon": 900, "pull_out": 700}
    tables["anchor_types"].append(other)
    return write_site(tmp_path_factory.mktemp("site") / "site.xlsx", tables)


@each(
    "text, found",
    [
        ("Rows.P8=A40-tested", ("Rows!P8", "A40-tested")),
        ("Rows!p8= 3,0 m ", ("Rows!P8", "3,0 m")),
        ("site.Rows.AB12=a=b", ("site.Rows!AB12", "a=b")),
        ("P8=A40", None),
        ("Rows.P8", None),
        ("Rows.P8=", None),
        ("Rows.P0=1", None),
    ],
)
def test_a_replacement_names_sheet_cell_and_text(text, found):
    assert split_replacement(text) == found


def test_a_replaced_cell_is_read_and_told(workbook):
    built = read_site(workbook)
    foot, density = find_cell("rows", "foot_anchor", 1), find_cell("project", "density")
    site = read_site(workbook, instead={foot: "A2", density: "270 to 431"})
    ids = {one.type_id for one in site.rows[1].resistances_at("intermediate")}
    assert "A2" in ids
    assert site.ranges["density"].high == 431.0
    assert site.rows[0] == built.rows[0]
    assert [(one.cell, one.was, one.now) for one in site.what_if] == [
        (foot, "A1", "A2"),
        (density, "270 to 400", "270 to 431"),
    ]
    assert built.what_if == ()
    assert site.sha256 == built.sha256


@pytest.mark.parametrize("instead", [{}, {"Rows!B3": "33"}])
def test_a_second_table_of_one_name_is_refused_and_no_row_lost(tmp_path, instead):
    """The rows of the first once vanished without a word."""
    sheets = {**SOUND, "a-Rows": SOUND["Rows"]}
    folder = write_csv_folder(tmp_path / "site", sheets)
    with pytest.raises(SiteDataError) as caught:
        read_site(folder, instead=instead)
    told = [str(one.rule) for one in caught.value.findings]
    assert any("is a second sheet" in one for one in told), told
