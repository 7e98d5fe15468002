"""What a cell shows and what its column's heading says: never two units."""

import random

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.cells.cells import Cell
from netdesign.site.cells.numbers import (
    find_format_unit,
    show_percent,
)
from netdesign.site.columns.fields import KNOWN_UNITS, convert_unit, normalise_unit
from netdesign.site.columns.office import load_plan
from netdesign.site.reader import read_site
from netdesign.site.readings import read_cell
from netdesign.words.catalogue import write_unit
from tests.each import each
from tests.site.conftest import SOUND
from tests.site.csv_folder import write_csv_folder

# Formats as spreadsheet programs write them, with what they show beside a number.
FORMATS = [
    ("General", ""),
    ("0.00", ""),
    ("#,##0.0", ""),
    ("0.00E+00", ""),
    ("# ?/?", ""),
    ("@", ""),
    ("[Red]0.0", ""),
    ("[$-409]0.0", ""),
    ('_-* #,##0.00_-;-* #,##0.00_-;_-* "-"??_-;_-@_-', ""),
    ('0.0" m"', "m"),
    ('0"°"', "°"),
    ("0\\°", "°"),
    ('0"%"', "%"),
    ('General" kN/m"', "kN/m"),
    ('0.0" kg/m³"', "kg/m³"),
    ('0.0" kg/m3"', "kg/m3"),
    ("#,##0.00\\ [$€-407]", "€"),
    ('"CHF "0.00', ""),  # letters before a number name it; a unit stands behind
    ('"€ "0.00', "€"),
    ("#,##0.00 [$CHF]", "CHF"),
    ('[<1]0.0" m";0" cm"', "m"),
]


@each("number_format, shown", FORMATS)
def test_what_a_format_shows(number_format, shown):
    assert find_format_unit(number_format) == shown
    assert not show_percent(number_format)


@pytest.mark.parametrize("number_format", ["0%", "0.0 %", "[Red]0%", '0%;"-"0%'])
def test_a_percent_sign_outside_of_quotes_multiplies(number_format):
    assert show_percent(number_format)


def list_columns():
    """Every column of numbers with a sound value, its unit and its place."""
    for table in ("rows", "net_types", "anchor_types"):
        plan = load_plan(table)
        name = plan.name_in("en")
        for column, heading in enumerate(SOUND[name][0]):
            field = plan.find(heading)
            value = SOUND[name][1][column]
            is_number = isinstance(value, int | float) and field.unit not in ("", "-")
            if is_number and "normal" not in heading:
                yield name, column, field


COLUMNS = list(list_columns())
UNITS = [*sorted(KNOWN_UNITS - {"-", "%"}), "°", "%", "€", "ft", "Stück", "Grad", "m'"]


def set_format(name, column, number_format, value=None):
    def edit(workbook):
        cell = workbook[name].cell(2, column + 1)
        cell.number_format = number_format
        cell.value = cell.value if value is None else value

    return edit


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("name", "column", "field"), COLUMNS)
def test_a_unit_shown_is_the_heading_s_or_a_finding(book, name, column, field, seed):
    unit = random.Random(f"{seed} {name} {column}").choice(UNITS)
    edit = set_format(name, column, f'0.0" {unit}"')
    if normalise_unit(unit) == field.unit:
        assert len(book.read(edit).rows) == 2
        return
    (finding,) = book.refuse(edit)
    assert (finding.sheet, finding.cell) == (name, f"{chr(65 + column)}2")
    assert f"{unit}, the file holds" in str(finding.rule)


@pytest.mark.parametrize("number_format", ["0%", '0.0"%"'])
@pytest.mark.parametrize(("name", "column", "field"), COLUMNS)
def test_hundredths_are_findings(book, name, column, field, number_format):
    (finding,) = book.refuse(set_format(name, column, number_format))
    assert str(finding.rule).startswith("is ambiguous: its format shows ")
    assert write_unit(field.unit) in str(finding.rule)


SLACK = "sag or slack of net [% slack]"
SHARES = [0.03, 0.007, 0.285, 0.1234]


@pytest.mark.parametrize("slack", SHARES)
def test_a_share_may_be_shown_in_percent(book, slack):
    """The file holds 0.03 where 3 % is shown, whatever the heading's unit."""
    book["Net types"][0].append(SLACK)
    book["Net types"][1].append(slack)
    row = book.read(set_format("Net types", 5, "0.00%")).rows[0]
    assert row.slack == pytest.approx(slack, rel=2e-15)


@pytest.mark.parametrize("slack", SHARES)
@pytest.mark.parametrize("sign", ["%", " %"])
def test_a_share_may_be_typed_in_percent(tmp_path, sign, slack):
    book = {name: [*rows] for name, rows in SOUND.items()}
    book["Net types"][0] = [*book["Net types"][0], SLACK]
    book["Net types"][1] = [*book["Net types"][1], f"{100 * slack:.6g}{sign}"]
    row = read_site(write_csv_folder(tmp_path / "site", book)).rows[0]
    assert row.slack == pytest.approx(slack, rel=2e-15)
    echo = next(one for one in row.inputs if f"{one.label} [" in SLACK)
    assert echo.text.count("%") == 1


def test_a_percentage_under_a_plain_number_is_a_share():
    (field,) = (one for one in load_plan("rows").fields if one.key == "glide_factor")
    cell, findings = Cell(file="", sheet="", row=3, column=4, value="182.5 %"), []
    assert read_cell(cell, field, "-", findings).value == 1.825
    assert not findings


@pytest.mark.parametrize("text", ["65%", "65 %", "65,3%", "0.65 %"])
@pytest.mark.parametrize(("name", "column", "field"), COLUMNS)
def test_a_percentage_typed_elsewhere_is_a_finding(tmp_path, name, column, field, text):
    book = {key: [*rows] for key, rows in SOUND.items()}
    book[name][1] = [*book[name][1]]
    book[name][1][column] = text
    with pytest.raises(SiteDataError) as caught:
        read_site(write_csv_folder(tmp_path / "site", book))
    (finding,) = (one for one in caught.value.findings if one.severity == "error")
    assert finding.text == text
    assert str(finding.rule).endswith(f"of the column is {write_unit(field.unit)}")


def test_a_percent_slope_below_percent_is_read_whatever_shows_it(book):
    book["Rows"][0][1] = "slope ψ [%]"
    book["Rows"][2][1] = 65.7
    for value, number_format in ((65.7, '0.0"%"'), (0.657, "0.0%"), (65.7, "General")):
        rows = book.read(set_format("Rows", 1, number_format, value)).rows
        assert rows[0].slope_angle == rows[1].slope_angle
    assert convert_unit(65.7, "%", "deg") == pytest.approx(33.305, abs=1e-3)
