import datetime
import zipfile

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.spreadsheet import read_workbook
from tests.site.cells.ods_files import write_ods

FORMULA = (
    '<table:table-cell table:formula="of:=[.A1]*2" office:value-type="float" '
    'office:value="5"><text:p>5</text:p></table:table-cell>'
)
NEVER_CALCULATED = '<table:table-cell table:formula="of:=[.A1]*2"/>'
BROKEN = (
    '<table:table-cell table:formula="of:=1/0" office:value-type="string" '
    'calcext:value-type="error"><text:p>#DIV/0!</text:p></table:table-cell>'
)
PERCENT = (
    '<table:table-cell office:value-type="percentage" office:value="0.7">'
    "<text:p>70 %</text:p></table:table-cell>"
)
DURATION = (
    '<table:table-cell office:value-type="time" office:time-value="PT02H30M00S"/>'
)
COMMENTED = (
    '<table:table-cell office:value-type="float" office:value="3"><office:annotation>'
    "<text:p>a remark</text:p></office:annotation><text:p>3</text:p>"
    "</table:table-cell>"
)
MERGED = (
    '<table:table-cell office:value-type="string" table:number-columns-spanned="2" '
    'table:number-rows-spanned="3"><text:p>title</text:p></table:table-cell>'
)


def read_cells(path):
    (sheet,) = read_workbook(path, lambda _: True).sheets
    return sheet


@pytest.mark.parametrize(
    ("typed", "value", "text"),
    [
        (2.5, 2.5, "2.5"),
        (40, 40, "40"),
        ("2,5", "2,5", "2,5"),
        (True, True, "True"),
        (datetime.datetime(2026, 5, 2), datetime.datetime(2026, 5, 2), None),
        (FORMULA, 5, "=[.A1]*2"),
        (NEVER_CALCULATED, None, "=[.A1]*2"),
        (DURATION, datetime.timedelta(hours=2, minutes=30), None),
        (COMMENTED, 3, "3"),
    ],
)
def test_a_cell_holds_what_was_typed(tmp_path, typed, value, text):
    path = write_ods(tmp_path / "a.ods", {"One": [[None, typed]]})
    cell = read_cells(path).cell(1, 2)
    assert (cell.value, type(cell.value)) == (value, type(value))
    if text is not None:
        assert cell.text == text


def test_errors_and_percentages_are_marked(tmp_path):
    sheet = read_cells(write_ods(tmp_path / "a.ods", {"One": [[BROKEN, PERCENT]]}))
    broken, percent = sheet.row(1)
    assert (broken.is_error, broken.text) == (True, "=1/0")
    assert (percent.is_percent, percent.value) == (True, 0.7)


def test_repeated_and_hidden_rows_and_columns_keep_their_addresses(tmp_path):
    rows = [
        ['<table:table-row table:number-rows-repeated="3"/>'],
        [
            '<table:table-row table:visibility="filter"><table:table-cell '
            'table:number-columns-repeated="4"/><table:table-cell '
            'office:value-type="float" office:value="1"/></table:table-row>'
        ],
        ['<table:table-row table:number-rows-repeated="1048000"/>'],
    ]
    sheet = read_cells(write_ods(tmp_path / "a.ods", {"One": rows}))
    assert [cell.address for cell in sheet.row(4)] == ["E4"]
    assert sheet.hidden_rows == {4}


def test_merged_cells_and_hidden_sheets_are_seen(tmp_path):
    style = (
        '<style:style style:name="ta2" style:family="table">'
        '<style:table-properties table:display="false"/></style:style>'
    )
    path = write_ods(
        tmp_path / "a.ods",
        {"One": [[None, MERGED]]},
        styles=style,
        attributes='table:style-name="ta2"',
    )
    sheet = read_cells(path)
    (merged,) = sheet.merged
    assert merged.text == "B1:C3"
    assert merged.covers(3, 3)
    assert not merged.covers(4, 3)
    assert sheet.is_hidden


def test_only_wanted_sheets_are_read(tmp_path):
    path = write_ods(tmp_path / "a.ods", {"One": [[1]], "Two": [[2]]})
    workbook = read_workbook(path, lambda name: name == "Two")
    assert [sheet.name for sheet in workbook.sheets] == ["Two"]
    assert workbook.unread == ("One",)


@pytest.mark.parametrize(
    ("row", "rule"),
    [
        (
            '<table:table-row table:number-rows-repeated="99999"><table:table-cell '
            'office:value-type="float" office:value="1"/></table:table-row>',
            "has cells filled down to row 2001",
        ),
        (
            '<table:table-row><table:table-cell table:number-columns-repeated="99999" '
            'office:value-type="float" office:value="1"/></table:table-row>',
            "has cells filled beyond column GR",
        ),
    ],
)
def test_few_bytes_that_fill_a_sheet_are_refused(tmp_path, row, rule):
    path = write_ods(tmp_path / "a.ods", {"One": [[row]]})
    with pytest.raises(SiteDataError, match=rule):
        read_cells(path)


def test_entities_are_refused(tmp_path):
    path = write_ods(tmp_path / "a.ods", {"One": [["x"]]})
    with zipfile.ZipFile(path) as archive:
        content = archive.read("content.xml")
    bad = content.replace(
        b'<?xml version="1.0"?>',
        b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY e "boom">]>',
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("content.xml", bad)
    with pytest.raises(SiteDataError, match="declares entities"):
        read_cells(path)


def test_macros_are_ignored_with_a_remark(tmp_path):
    path = write_ods(tmp_path / "a.ods", {"One": [["x"]]})
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("Basic/Standard/Module1.xml", "<module/>")
    (remark,) = read_workbook(path, lambda _: True).remarks
    assert str(remark.rule) == "holds macros: they are ignored"
    assert remark.severity == "note"
