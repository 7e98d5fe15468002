"""The input workbook as it is written: read again, alike in every language."""

from functools import cache
from io import BytesIO

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.columns.office import PARTS, TABLES, load_columns, load_plan
from netdesign.site.reader import read_site
from netdesign.site.template.office_workbook import (
    WITH,
    load_input_example,
    render_input,
)
from tests.each import each

LANGUAGES = ("en", "fr", "de")
ALL = tuple(WITH)


@cache
def render_form(language, sheets=()):
    """An empty workbook."""
    return render_input({}, language, sheets)


def write(path, content):
    path.write_bytes(content)
    return path


def read_example(tmp_path, language):
    content = render_input(load_input_example(), language)
    return read_site(write(tmp_path / f"{language}.xlsx", content))


def test_the_same_program_writes_the_same_bytes():
    lines = load_input_example()
    assert render_input(lines, "fr", ALL) == render_input(lines, "fr", ALL)


def test_the_example_is_one_site_in_every_language(tmp_path):
    sites = [read_example(tmp_path, one) for one in LANGUAGES]
    assert len(sites[0].rows) == 8
    for site in sites:
        assert [one for one in site.findings if one.severity != "note"] == []
    first, *others = ([bare(row) for row in site.rows] for site in sites)
    assert all(rows == first for rows in others)


def bare(row):
    """Numbers of a row, without what names sheets and columns."""
    resistances = tuple(
        (one.member, one.mode, one.type_id.split(" (")[0], one.value, one.basis)
        for one in row.resistances
    )
    size = (row.slope_angle, row.snow_thickness, row.slack, row.layout, row.guys)
    limits = (row.approval.spacing, row.approval.foot_force) if row.approval else ()
    stated = [one.value for one in limits if one]
    return *size, row.axes, row.panels, row.gap, row.ground_type, stated, resistances


@each("language", LANGUAGES)
def test_an_empty_form_asks_for_rows_alone(tmp_path, language):
    path = write(tmp_path / f"{language}.xlsx", render_form(language, ALL))
    with pytest.raises(SiteDataError) as refused:
        read_site(path)
    errors = [one for one in refused.value.findings if one.severity == "error"]
    assert {one.rule.key for one in errors} == {"nets.no_row"}


@each("language", LANGUAGES)
def test_every_column_has_its_heading_and_what_an_empty_cell_means(language):
    book = openpyxl.load_workbook(BytesIO(render_form(language, ALL)))
    for table in TABLES:
        if table in PARTS or table == "project":
            continue
        sheet = book[load_plan(table).name_in(language)]
        columns = [one for one in load_columns(table)]
        for number, column in enumerate(columns, start=1):
            heading = sheet.cell(3, number)
            assert heading.value.replace("-\n", "") == column.field.label_in(language)
            assert heading.comment is not None
            is_empty_told = bool(sheet.cell(5, number).value)
            assert is_empty_told or column.need == "yes"


@each("language", LANGUAGES)
def test_yellow_is_what_is_needed_in_a_line_that_is_begun(language):
    book = openpyxl.load_workbook(BytesIO(render_form(language)))
    for table in ("rows", "net_types", "anchor_types"):
        sheet = book[load_plan(table).name_in(language)]
        ruled = {
            cells.min_col
            for one in sheet.conditional_formatting
            for cells in one.sqref.ranges
        }
        shown = [one for one in load_columns(table) if one.group != "structure"]
        needed = {n for n, one in enumerate(shown, start=1) if one.need}
        assert ruled == needed
