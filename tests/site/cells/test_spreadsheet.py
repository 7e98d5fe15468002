import hashlib
import re
import zipfile

import numpy as np
import openpyxl
import pytest
import xlsxwriter

from netdesign.outcome import NetDesignError, SiteDataError
from netdesign.site.cells import cells as limits
from netdesign.site.cells import spreadsheet
from netdesign.site.cells.spreadsheet import read_workbook
from tests.each import each


def read_all(path):
    return read_workbook(path, lambda _: True)


def refusal_of(path):
    with pytest.raises(SiteDataError) as caught:
        read_all(path)
    (finding,) = caught.value.findings
    assert finding.file == path.name
    return str(finding)


SHEET = "xl/worksheets/sheet1.xml"


def rewrite(path, change):
    """The workbook with each part changed by its name and bytes."""
    with zipfile.ZipFile(path) as archive:
        parts = {one: archive.read(one) for one in archive.namelist()}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, change(name, content))


def replace_part(path, change, part=SHEET):
    """Rewrite one part of a workbook, as no spreadsheet program would."""
    rewrite(path, lambda name, xml: change(xml) if name == part else xml)


@pytest.fixture
def small(tmp_path):
    path = tmp_path / "small.xlsx"
    workbook = openpyxl.Workbook()
    workbook.active.title = "One"
    workbook.active["B2"] = 2.5
    workbook.active["C4"] = "text"
    workbook.save(path)
    return path


def test_cells_come_with_address_and_value(small):
    workbook = read_all(small)
    (sheet,) = workbook.sheets
    assert sheet.row(2)[0].place == "One!B2"
    assert sheet.cell(2, 2).value == 2.5
    assert sheet.cell(4, 3).text == "text"
    assert sheet.cell(3, 3).is_blank
    assert sheet.cell(3, 3).address == "C3"
    assert workbook.sha256 == hashlib.sha256(small.read_bytes()).hexdigest()


def test_an_ods_file_is_saved_as_xlsx_first(tmp_path):
    path = tmp_path / "site.ods"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("content.xml", "<x/>")
    assert "is an OpenDocument workbook (.ods): save it as .xlsx" in refusal_of(path)


def test_formulas_keep_their_text_beside_their_stored_result(tmp_path):
    path = tmp_path / "formulas.xlsx"
    with xlsxwriter.Workbook(path) as workbook:
        sheet = workbook.add_worksheet("One")
        sheet.write_formula("A1", "=2*3", value=6)
        sheet.write_array_formula("A2:A2", "{=SUM(1,2)}", value=3)
    (sheet,) = read_all(path).sheets
    assert (sheet.cell(1, 1).value, sheet.cell(1, 1).text) == (6, "=2*3")
    assert (sheet.cell(2, 1).value, sheet.cell(2, 1).text) == (3, "=SUM(1,2)")


def test_a_formula_never_calculated_has_no_value(small):
    workbook = openpyxl.load_workbook(small)
    workbook["One"]["A1"] = "=1+1"
    workbook.save(small)
    cell = read_all(small).sheets[0].cell(1, 1)
    assert (cell.value, cell.formula, cell.is_blank) == (None, "=1+1", False)


def test_a_declared_size_of_the_sheet_is_not_trusted(small):
    replace_part(small, lambda xml: xml.replace(b'ref="B2:C4"', b'ref="A1:A1"'))
    (sheet,) = read_all(small).sheets
    assert sheet.cell(4, 3).text == "text"


def test_the_reader_refuses_to_run_without_hardened_xml(small, monkeypatch):
    monkeypatch.setattr(openpyxl, "DEFUSEDXML", False)
    with pytest.raises(NetDesignError, match="install defusedxml"):
        read_all(small)


@pytest.mark.parametrize(
    ("module", "limit", "told"),
    [
        (spreadsheet, "MAX_FILE_BYTES", "is too large"),
        (limits, "MAX_ENTRIES", "is an archive of {size} parts"),
        (limits, "MAX_EXPANDED_BYTES", "expands beyond"),
    ],
)
def test_size_is_limited_on_both_sides(small, monkeypatch, module, limit, told):
    with zipfile.ZipFile(small) as archive:
        parts = archive.infolist()
    size = {
        "MAX_FILE_BYTES": small.stat().st_size,
        "MAX_ENTRIES": len(parts),
        "MAX_EXPANDED_BYTES": sum(entry.file_size for entry in parts),
    }[limit]
    monkeypatch.setattr(module, limit, size)
    assert read_all(small).sheets
    monkeypatch.setattr(module, limit, size - 1)
    assert told.format(size=size) in refusal_of(small)


def test_two_parts_of_one_name_are_refused(small):
    with (
        pytest.warns(UserWarning, match="Duplicate name"),
        zipfile.ZipFile(small, "a") as archive,
    ):
        archive.writestr("xl/workbook.xml", "<workbook/>")
    assert "two parts of the same name" in refusal_of(small)


@pytest.mark.parametrize(
    ("column", "row", "told"),
    [
        ("A", 2001, "down to row 2001"),
        ("A", 1_000_000_000, "down to row 1000000000"),
        ("GS", 7, "beyond column GR"),
    ],
)
def test_cells_far_away_are_refused(small, column, row, told):
    cell = f'<row r="{row}"><c r="{column}{row}"><v>1</v></c></row></sheetData>'
    replace_part(small, lambda xml: xml.replace(b"</sheetData>", cell.encode()))
    assert f"has cells filled {told}" in refusal_of(small)


# --- fault 15: Strict Open XML, and a workbook of which no sheet is read ------------

TRANSITIONAL = (
    b"http://schemas.openxmlformats.org/spreadsheetml/2006/",
    b"http://schemas.openxmlformats.org/officeDocument/2006/",
)
STRICT = (
    b"http://purl.oclc.org/ooxml/spreadsheetml/",
    b"http://purl.oclc.org/ooxml/officeDocument/",
)


@each("seed", range(8))
def test_strict_open_xml_is_refused_by_its_name(tmp_path_factory, seed):
    """Drawn parts are strict, of which one says of what kind the file is."""
    path = tmp_path_factory.mktemp("strict") / "site.xlsx"
    workbook = openpyxl.Workbook()
    workbook.active["A1"] = 2.5
    workbook.save(path)
    rng = np.random.default_rng([61, 15, seed])
    root = ("_rels/.rels", "xl/workbook.xml")[seed % 2]

    def change(name, content):
        if name == root or rng.uniform() < 0.5:
            for old, new in zip(TRANSITIONAL, STRICT, strict=True):
                content = content.replace(old, new)
        return content

    rewrite(path, change)
    assert 'saved as "Strict Open XML Spreadsheet"' in refusal_of(path)


def test_a_workbook_of_which_no_sheet_is_read_is_refused(tmp_path, small):
    rewrite(small, lambda _, xml: re.sub(rb"<(/?)sheets>", rb"<\1s>", xml))
    assert "no sheet that can be read" in refusal_of(small)


@pytest.mark.parametrize("part", ["xl/workbook.xml", SHEET])
def test_xml_with_entities_is_refused(small, part):
    bomb = b'<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>'
    replace_part(small, lambda xml: bomb + xml, part)
    assert "declares entities" in refusal_of(small)


def test_a_part_that_hides_its_size_is_refused(small):
    content = small.read_bytes()
    with zipfile.ZipFile(small) as archive:
        size = archive.getinfo(SHEET).file_size
    spoilt = content.replace(size.to_bytes(4, "little"), (7).to_bytes(4, "little"))
    assert spoilt != content
    small.write_bytes(spoilt)
    assert "cannot be read as a workbook" in refusal_of(small)
