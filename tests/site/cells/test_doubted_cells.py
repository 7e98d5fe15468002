"""Cells struck out, and formulas whose stored results are old, are asked about."""

import random

import openpyxl
import pytest
import xlsxwriter
from openpyxl.styles import Font

from netdesign.outcome import SiteDataError
from netdesign.site.cells.numbers import compute_constant
from netdesign.site.reader import read_site
from tests.each import each
from tests.make import find_cell, lay_out, write_site
from tests.site.plausible.office import draw_office

_LINES = {"Rows": 6, "Net types": 6, "Anchors": 6}  # first of the data


@pytest.fixture
def path(tmp_path):
    return write_site(tmp_path / "site.xlsx", draw_office(3, rows=3))


def list_filled(path):
    """Cells with data of a sheet; of sheet Parts those of ropes and posts."""
    book = openpyxl.load_workbook(path)
    types = {"rope", "post"}
    found = [
        (sheet, cell.coordinate)
        for sheet, first in _LINES.items()
        for line in book[sheet].iter_rows(min_row=first)
        for cell in line
        if cell.value is not None
    ]
    parts = [line for line in book["Parts"].iter_rows() if line[0].value in types]
    return found + [
        ("Parts", cell.coordinate)
        for line in parts
        for cell in line
        if isinstance(cell.value, int)
    ]


def strike(path, cells):
    book = openpyxl.load_workbook(path)
    for sheet, address in cells:
        book[sheet][address].font = Font(strike=True)
    book.save(path)


@each("seed", range(6))
def test_every_cell_that_is_struck_out_is_asked_about(path, seed):
    draw = random.Random(seed)
    cells = draw.sample(list_filled(path), draw.randint(1, 4))
    strike(path, cells)
    site = read_site(path)
    told = " ".join(map(str, site.questions))
    for sheet, address in cells:
        assert f"{sheet} › {address}" in told
    assert "is struck out" in told
    of_rows = {x[-1] for sheet, x in cells if sheet in ("Rows", "Net types")}
    for number, row in enumerate(site.rows, start=6):
        if str(number) in of_rows:
            assert row.questions
    write_site(path, draw_office(3, rows=3))


def test_a_line_that_is_struck_out_is_one_question(path):
    filled = list_filled(path)
    strike(path, [x for x in filled if x[0] == "Rows" and x[1].endswith("7")])
    site = read_site(path)
    assert len(site.questions) == 1
    assert [bool(row.questions) for row in site.rows] == [False, True, False]


def test_a_part_of_a_text_that_is_struck_out_is_asked_about(path):
    """As spreadsheets store it: one text with formats of its own."""
    write_formulas(path, {}, struck_part=find_cell("rows", "downhill_anchor"))
    (question,) = read_site(path).questions
    assert "Rows › L6" in str(question)
    assert "struck out" in str(question)
    assert len(read_site(path).rows) == 3


@each("sheet, address", [("Project", "B8"), ("Rows", "B3"), ("Declared", "B6")])
def test_what_no_net_row_rests_on_alone_is_refused_struck_out(path, sheet, address):
    book = openpyxl.load_workbook(path)
    line = ("all", "foot_anchor.pull_out", "Report 1", "B. N.", "2026-02-03")
    for column, value in enumerate(line, start=1):
        book["Declared"].cell(6, column).value = value
    book.save(path)
    strike(path, [(sheet, address)])
    with pytest.raises(SiteDataError, match="is struck out"):
        read_site(path)


def write_formulas(path, formulas, *, by_hand=False, struck_part=""):
    """The office's list with formulas and their stored results in some cells."""
    book = xlsxwriter.Workbook(str(path))
    if by_hand:
        book.set_calc_mode("manual")
    for name, lines in lay_out(draw_office(3, rows=3)).items():
        sheet = book.add_worksheet(name)
        for row, line in enumerate(lines):
            for column, value in enumerate(line):
                if value not in (None, ""):
                    sheet.write(row, column, value)
        for place, (formula, value) in formulas.items():
            if place.startswith(f"{name}!"):
                sheet.write_formula(place.partition("!")[2], formula, None, value)
        if struck_part.startswith(f"{name}!"):
            struck = book.add_format({"font_strikeout": True})
            bold = book.add_format({"bold": True})
            place = struck_part.partition("!")[2]
            sheet.write_rich_string(place, struck, "sh", bold, "ort")
    book.close()
    return path


SNOW, HEIGHT = find_cell("rows", "snow"), "Net types!B6"


def draw_formula(draw):
    """A formula of numbers alone of a snow thickness, and its result."""
    a, b = round(draw.uniform(1.5, 3.0), 2), round(draw.uniform(0.8, 0.95), 3)
    return draw.choice(
        [
            (f"={a}*{b}", a * b),
            (f"={a}+0.1*2-0.1", a + 0.1),
            (f"=({a}+{b})/1.25", (a + b) / 1.25),
        ]
    )


@each("seed", range(8))
def test_a_stored_result_that_its_formula_does_not_give_is_asked_about(path, seed):
    draw = random.Random(seed)
    formula, value = draw_formula(draw)
    site = read_site(write_formulas(path, {SNOW: (formula, value)}))
    assert not [one for one in map(str, site.questions) if "calculated anew" in one]
    old = value * draw.choice((0.9, 1.001, 1.1))
    site = read_site(write_formulas(path, {SNOW: (formula, old)}))
    (told,) = [one for one in map(str, site.questions) if "calculated anew" in one]
    assert "Rows › C6" in told
    assert site.rows[0].questions
    assert not site.rows[1].questions


def test_a_workbook_calculated_by_hand_is_asked_about_where_nothing_tells(path):
    """Formulas of numbers alone are worked out, whoever calculates."""
    odd = {SNOW: ("=VLOOKUP(A6,A6:I9,9)*0.9", 2.4)}
    assert not read_site(write_formulas(path, odd)).questions
    (question,) = read_site(write_formulas(path, odd, by_hand=True)).questions
    assert "calculated by hand" in str(question)
    plain = {SNOW: ("=3*0.8", 2.4)}
    assert not read_site(write_formulas(path, plain, by_hand=True)).questions


@each(
    "formula",
    ["='Net types'!$B$6*0.8", "=SUM('Net types'!B5:B7)*0.8", "=Rows!$G$7-1200"],
)
def test_a_what_if_makes_the_formulas_old_that_rest_on_its_cell(path, formula):
    """Named, within a range, by a chain of formulas; whichever way it is asked."""
    other = {SNOW: ("=$B$66*0.8", 2.4)}
    chain = {"Rows!G7": ("='Net types'!$B$6+1200", 1203.0)}  # the altitude of a row
    write_formulas(path, other)
    row_id = read_site(path).rows[0].id
    shared = {row.id: {"net_height": 3.6} for row in read_site(path).rows}
    ways = ({"instead": {HEIGHT: "3.6"}}, {"change": shared})
    for way in ways:
        assert not read_site(path, **way).questions
    write_formulas(path, {SNOW: (formula, 2.4), **chain})
    assert not read_site(path).questions
    for way in ways:
        rows = {row.id: row for row in read_site(path, **way).rows}
        assert "rest on a changed cell" in " ".join(map(str, rows[row_id].questions))


@each(
    "formula, value",
    [
        *(("=2+3*4", 14.0), ("=(2+3)*4", 20.0), ("=-2+5", 3.0), ("=7/2", 3.5)),
        *(("=B2/4", None), ("=SUM(1,2)", None), ("=2^3", None), ("=50%", None)),
        *(("=1/0", None), ("=__import__", None), ("=" + "1+" * 200 + "1", None)),
    ],
)
def test_sums_and_products_of_numbers_are_worked_out_and_nothing_else(formula, value):
    assert compute_constant(formula) == value
