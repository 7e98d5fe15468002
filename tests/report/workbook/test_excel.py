"""The workbook: its numbers recalculated, its verdicts text, its sheets as printed."""

import io
import random
from dataclasses import replace

import pytest
from openpyxl.utils import get_column_letter

from netdesign.checks import load_standard
from netdesign.report.sections.rated import ANCHORS, list_anchor, rate
from netdesign.report.words import ENGLISH, VERDICTS
from netdesign.report.workbook.excel import SHEETS, render_workbook
from netdesign.site.reader import read_site
from netdesign.study.judge import judge_site
from netdesign.words.catalogue import LANGUAGES
from tests.calculation.evaluate import evaluate
from tests.golden.drawn import RUN
from tests.grid import solve_site
from tests.make import write_rows, write_site
from tests.report.build_study import FORMULA, SCRIPT, build_study
from tests.report.reading import read_checks, read_workbook, recalculate
from tests.study.knowing_less.drawn_tables import draw_tables

LIMIT = 1e-12  # relative: one rounding of a product, with room
STUDY = build_study()
COLUMNS = {-1: "G", 0: "H", 1: "I"}  # of low end, value and high end
SEED = 9000


def judge(path):
    site, standard = read_site(path), load_standard("nf-p-95-304-style")
    return judge_site(site, solve_site(site, RUN), standard, RUN)


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    """A built study; a drawn site with splayed guys and ends; a row of the example."""
    folder = tmp_path_factory.mktemp("sites")
    write_site(folder / "drawn.xlsx", draw_tables(SEED))
    write_rows(folder / "example.xlsx", ["R7"])
    judged = {name: judge(folder / f"{name}.xlsx") for name in ("drawn", "example")}
    return {"built": STUDY, **judged}


def draw_change(dice, leaf):
    """A leaf with another value."""
    share = dice.uniform(0.7, 1.3)
    ends = {
        name: None if end is None else share * end
        for name, end in (("low", leaf.low), ("value", leaf.value), ("high", leaf.high))
    }
    return replace(leaf, **ends)


def change(study, *, is_blank=False):
    """Workbook with leaves typed over, of every check one or more; its steps then."""
    dice, content = random.Random(SEED), render_workbook(study)
    checks = [check for row in study.rows for check in row.checks]
    lines, changed = [shown.steps for shown in read_checks(content)], {}
    for of_check, check in zip(lines, checks, strict=True):
        if leaves := [x for x in check.steps if not x.formula and x.value]:
            leaf = dice.choice(leaves)
            changed.setdefault(of_check[leaf.symbol], draw_change(dice, leaf))
    book = read_workbook(content, formulas=True)
    for line, leaf in changed.items():
        for end, column in COLUMNS.items():
            cell = book["Checks"][f"{column}{line}"]
            if cell.value is not None:
                cell.value = dice.choice(NO_NUMBERS) if is_blank else leaf.ends[end + 1]
    book.save(buffer := io.BytesIO())
    steps = [
        [changed.get(of_check.get(step.symbol), step) for step in check.steps]
        for of_check, check in zip(lines, checks, strict=True)
    ]
    return buffer.getvalue(), steps


NO_NUMBERS = (None, "", "abc", "1.5", "-", "=1/0", "=NA()")


@pytest.fixture(scope="module")
def changes(studies):
    return {name: change(study) for name, study in studies.items()}


@pytest.fixture(scope="module")
def books(studies):
    """The built study in each language, each other study in one."""
    named = [("built", one) for one in LANGUAGES] + [("drawn", "fr"), ("example", "de")]
    return {name: render_workbook(studies[name[0]], name[1]) for name in named}


@pytest.fixture(scope="module")
def content(books):
    return books["built", "en"]


@pytest.fixture(scope="module")
def fresh(books, changes, tmp_path_factory):
    """Workbooks that LibreOffice recalculated, all in one run."""
    books = {"-".join(name): book for name, book in books.items()}
    books |= {f"{name}-changed": book for name, (book, _) in changes.items()}
    books["built-blank"], _ = change(STUDY, is_blank=True)
    return recalculate(books, tmp_path_factory.mktemp("books"))


def compare_cells(content, live):
    """Formulas of a workbook whose result is not the stored one, and their number."""
    cached, formulas = read_workbook(content), read_workbook(content, formulas=True)
    book, off, count = read_workbook(live), [], 0
    for sheet in formulas:
        for cell in (cell for line in sheet.iter_rows() for cell in line):
            if cell.data_type != "f":
                continue
            count += 1
            value = cached[sheet.title][cell.coordinate].value
            shown = book[sheet.title][cell.coordinate].value
            is_number = isinstance(value, int | float)
            if shown != (pytest.approx(value, rel=LIMIT) if is_number else value):
                off.append((sheet.title, cell.coordinate, value, shown))
    return off, count


def test_no_number_is_off_when_recalculated(books, fresh):
    for name, stored in books.items():
        off, count = compare_cells(stored, fresh["-".join(name)])
        assert off == [], name
        assert count > 200


@pytest.mark.parametrize("name", ["built", "drawn", "example"])
def test_numbers_of_a_check_follow_what_is_typed_and_no_verdict_does(
    name, studies, changes, fresh
):
    """Each check has another value at some of its leaves, as its calculation again."""
    content = fresh[f"{name}-changed"]
    sheet, compared = read_workbook(content)["Checks"], 0
    checks = [check for row in studies[name].rows for check in row.checks]
    for shown, check, steps in zip(
        read_checks(content), checks, changes[name][1], strict=True
    ):
        assert shown.verdict == ENGLISH(f"verdict.{check.verdict}")
        for key, found in evaluate(steps).items():
            if found.value is None:  # the calculation refuses such a value
                continue
            value = sheet[f"H{shown.steps[key]}"].value
            for end, number in ((-1, found.low), (0, found.value), (1, found.high)):
                own = sheet[f"{COLUMNS[end]}{shown.steps[key]}"].value
                got = value if own is None else own
                assert got == pytest.approx(number, rel=1e-9, abs=1e-12), (
                    check.id,
                    key,
                )
                compared += 1
            if key == "μ":
                assert shown.used[1] == value
    assert compared > 500


def test_what_is_no_number_gives_no_utilisation(fresh):
    checks = [check for row in STUDY.rows for check in row.checks]
    for shown, check in zip(read_checks(fresh["built-blank"]), checks, strict=True):
        assert shown.verdict == ENGLISH(f"verdict.{check.verdict}")
        if any(step.value for step in check.steps if not step.formula):
            assert shown.used[1] == "-", check.id


def test_first_sheet_has_the_largest_utilisation_of_each_anchor_as_a_number(content):
    sheet = read_workbook(content)["Decision"]
    for line, row in enumerate(STUDY.rows, 7):
        for column, members in zip("CDEF", ANCHORS.values(), strict=True):
            rated = rate(list_anchor(row, members))
            cell = sheet[f"{column}{line}"]
            if rated is None or rated.used is None:
                assert cell.data_type == "s"
                continue
            assert cell.value == pytest.approx(rated.used, rel=LIMIT)
            assert VERDICTS[rated.verdict].symbol in cell.number_format


WITH_FORMULAS = ("Checks",)


def test_only_our_formulas_exist(content):
    book = read_workbook(content, formulas=True)
    for sheet in book:
        for line in sheet.iter_rows():
            for cell in line:
                if cell.hyperlink is not None:  # only inside the workbook
                    assert cell.hyperlink.target is None
                    assert cell.hyperlink.location.startswith("'")
                if cell.data_type == "f":
                    assert sheet.title in WITH_FORMULAS
                    assert cell.value != FORMULA
    names = {cell.value for cell in book["Checks"]["A"]}
    inputs = [cell.value for line in book["Inputs"].iter_rows() for cell in line]
    assert any(FORMULA in str(value) for value in inputs)
    assert {f"Ridge {SCRIPT}", FORMULA} <= names


def test_sheets_are_ready_to_read_and_print(content):
    book = read_workbook(content)
    assert book.sheetnames == [ENGLISH(f"heading.{name}") for name in SHEETS]
    for sheet in book:
        assert sheet.freeze_panes
        assert sheet.page_setup.fitToHeight == 0  # one page wide, any length
        # the heading of one table would stand above columns of another
        is_one = sheet.title in ("Decision", "Checks", "Inputs")
        assert bool(sheet.print_title_rows) is is_one, sheet.title
    assert book["Checks"].auto_filter.ref.startswith("A4:K")


def test_no_text_runs_out_of_its_sheet(books):
    """One that does makes the whole sheet small on paper, down to 4 pt as seen."""
    book = read_workbook(books["built", "de"])  # whose words are the longest
    for sheet in list(book)[1:]:
        table = find_table_columns(sheet)
        merged = {str(area).split(":")[0] for area in sheet.merged_cells.ranges}
        for line in sheet.iter_rows(min_row=2):
            for cell in line:
                if not isinstance(cell.value, str) or cell.coordinate in merged:
                    continue
                last = max(cell.column, len(table))
                room = sum(table[cell.column - 1 : last])
                is_wrapped = cell.alignment.wrap_text or cell.alignment.shrink_to_fit
                fits = is_wrapped or len(cell.value) * 0.72 <= room + 1.0
                assert fits, (sheet.title, cell.coordinate)


def find_table_columns(sheet):
    """Widths of the columns of a sheet, as far as its widest table goes."""
    last = max(c.column for line in sheet.iter_rows() for c in line if c.font.b)
    letters = [get_column_letter(k) for k in range(1, last + 1)]
    return [sheet.column_dimensions[letter].width for letter in letters]


def test_a_number_has_as_many_digits_as_on_the_page(books):
    """A decimal comma is a mark, too: without it a cell showed all sixteen digits."""
    english, german = (
        [
            [cell.number_format for line in sheet.iter_rows() for cell in line]
            for sheet in read_workbook(book)
        ]
        for book in (books["built", "en"], books["built", "de"])
    )
    assert english == german
    assert sum("0.0" in form for sheet in english for form in sheet) > 300


def test_summary_leads_to_every_sheet_and_back(content):
    book = read_workbook(content)
    targets = {
        cell.hyperlink.location.split("!")[0].strip("'")
        for line in book["Decision"].iter_rows()
        for cell in line
        if cell.hyperlink
    }
    assert targets == {ENGLISH(f"heading.{name}") for name in SHEETS[1:]}
    for sheet in list(book)[1:]:
        back = [c.hyperlink for line in sheet.iter_rows() for c in line if c.hyperlink]
        assert [link.location for link in back] == ["'Decision'!A1"]
