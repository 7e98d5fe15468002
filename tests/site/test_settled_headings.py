"""Headings that the other columns, or the cells below them, settle."""

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.resistance.post import PostSection
from netdesign.site.reader import read_site
from tests.short_example import write_short_example


@pytest.fixture
def change(tmp_path):
    """Reader of the built-in example with one sheet changed."""

    def read(sheet, edit):
        path = tmp_path / "site.xlsx"
        write_short_example(path, [f"R{number}" for number in range(1, 8)])
        book = openpyxl.load_workbook(path)
        edit(book[sheet])
        book.save(path)
        return read_site(path)

    return read


def find(sheet, heading):
    return next(one for one in sheet[1] if one.value == heading)


def fill(sheet, cell, values):
    for row, value in enumerate(values, 2):
        sheet.cell(row, cell.column).value = value


def echoes(site, key):
    """Values of a column as they were understood, by net row."""
    return [
        next(
            (one.value for one in row.inputs if one.label.key == f"column.Nets.{key}"),
            None,
        )
        for row in site.rows
    ]


def told(site):
    return " ".join(map(str, site.findings))


def test_one_guy_without_a_side_is_both(change):
    def merge(sheet):
        find(sheet, "downhill guy").value = "Remarks"
        find(sheet, "uphill guy").value = "Guy"

    site = change("Nets", merge)
    assert echoes(site, "uphill_guy") == echoes(site, "downhill_guy")
    assert "names neither side" in told(site)


def test_beside_a_guy_with_a_side_it_is_asked_for(change):
    def rename(sheet):
        find(sheet, "uphill guy").value = "Guy"

    with pytest.raises(SiteDataError, match='"Guy" is ambiguous'):
        change("Nets", rename)


def test_a_column_n_is_the_glide_factor_where_its_numbers_say_so(change):
    def rename(sheet):
        find(sheet, "glide factor [-]").value = "N"

    site = change("Nets", rename)
    assert echoes(site, "glide_factor")[2:5] == [1.2, 1.8, 2.4]
    assert "by what its cells hold" in told(site)


def test_one_guy_is_asked_for_where_one_side_has_no_anchor(change):
    def merge(sheet):
        find(sheet, "downhill guy").value = "Remarks"
        find(sheet, "downhill anchor").value = "Supplier"
        find(sheet, "uphill guy").value = "Guy"

    with pytest.raises(SiteDataError, match='"Guy" is ambiguous'):
        change("Nets", merge)


def test_a_length_is_told_to_be_read_as_the_buckling_length(change):
    def rename(sheet):
        find(sheet, "buckling length [m]").value = "Length [m]"

    assert "hinge at both ends" in told(change("Posts", rename))


@pytest.mark.parametrize("numbers", [(None, None, 2, 2, 3), (None, None, 1.2, 8, 2.4)])
def test_a_column_n_of_pieces_is_asked_for(change, numbers):
    def count(sheet):
        cell = find(sheet, "glide factor [-]")
        cell.value = "N"
        fill(sheet, cell, numbers)

    with pytest.raises(SiteDataError, match='"N" is ambiguous: "glide factor'):
        change("Nets", count)


def test_what_another_column_gives_is_not_asked_for(change):
    def add(sheet):
        sheet.cell(1, sheet.max_column + 1).value = "Werkhöhe HK [m]"
        fill(sheet, sheet.cell(1, sheet.max_column), [2.9] * 7)

    site = change("Nets", add)
    assert echoes(site, "net_height")[0] == 2.5
    assert "which another column gives" in told(site)


@pytest.mark.parametrize("heading", ["Section", "profile"])
def test_a_post_has_a_name_and_a_section(change, heading):
    def name(sheet):
        area = find(sheet, "section area [cm2]")
        fill(sheet, area, ["HEB 120", *["HEB 140"] * 4])
        area.value = heading
        find(sheet, "second moment of area [cm4]").value = "Remarks"
        find(sheet, "id").value = "Post"

    site = change("Posts", name)
    post = next(
        one
        for one in site.rows[1].resistances
        if isinstance(one.dimensions, PostSection)
    )
    assert post.dimensions.length == pytest.approx(3.2)
    assert len(site.rows) == 7


def test_a_section_with_a_unit_is_an_area(change):
    def rename(sheet):
        find(sheet, "section area [cm2]").value = "Section [cm2]"

    assert len(change("Posts", rename).rows) == 7


def test_a_symbol_below_its_heading_is_no_unit(change):
    def put(sheet):
        sheet.insert_rows(2)
        confirmed = sheet.parent["Declared"]  # a gap of 0, now a line below
        confirmed.cell(confirmed.max_row, 2).value = "Nets!X8 = 0"
        find(sheet, "glide factor [-]").value = "glide factor"
        find(sheet, "net height [m]").value = "net height"
        sheet.cell(2, find(sheet, "glide factor").column).value = "N"
        sheet.cell(2, find(sheet, "net height").column).value = "m"

    site = change("Nets", put)
    assert echoes(site, "glide_factor")[2:5] == [1.2, 1.8, 2.4]
