"""Every figure of every check follows from report.html alone; what it is on paper.

Who reads here has the page and its formulas, nothing of the program. Two sites: the
example, and one of drawn numbers with what the example lacks.
"""

import copy
import random
import re
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.report.page.html import render_html
from netdesign.site.reader import read_site
from netdesign.site.template.workbook import write_site_workbook
from netdesign.study.cases import search_site
from netdesign.study.check_run import CheckRun
from netdesign.study.judge import judge_site
from netdesign.words.catalogue import LANGUAGES
from tests.report.printing import (
    PAPER_PX,
    PHONE_PX,
    PRINTED_PX,
    count_pages,
    list_hidden,
    list_too_wide,
    measure_bottom,
    measure_pages,
)
from tests.report.reading import PageReader
from tests.verification.page_again import read_page, work_out, work_out_page
from tests.verification.untidy_site import PROFILE, write_untidy_site

SWISS = "swiss-guideline-2007"
RUN = CheckRun(settings=SolverSettings(accuracy=0.05), command="", started="")
SEED = 7
TABLES = ("states", "floors", "actions", "by_panel", "checks", "turns")
KEYED = ("widths", "resistances", "tests")
# Nothing that is printed follows from these alone: errors of the pulls.
GIVEN = ("±f", "±h")
# A hundredth of these may change nothing: an end of a band that another load covers;
# the small component of a pull; the mean of tests where the least counts.
MAY_HIDE = {
    *(("actions", "Es⁻"), ("by_panel", "Ep0⁻"), ("by_panel", "Ep⁺")),
    *(("states", one) for one in ("fx", "fy", "hx", "hy")),
    ("tests", "Rm"),
}


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    folder = tmp_path_factory.mktemp("alone")
    write_site_workbook(folder / "example.xlsx", example=True)
    with pytest.MonkeyPatch.context() as patch:
        write_untidy_site(folder / "untidy.xlsx", patch, SEED)
    return {
        name: judge(folder / f"{name}.xlsx", profile)
        for name, profile in (("example", SWISS), ("untidy", PROFILE))
    }


def judge(path, profile):
    site = read_site(path)
    return judge_site(site, search_site(site, RUN), load_standard(profile), RUN)


@pytest.fixture(scope="module")
def pages(studies):
    return {name: render_html(study) for name, study in studies.items()}


@pytest.mark.parametrize(("name", "least"), [("example", 4900), ("untidy", 2000)])
def test_every_figure_follows_from_the_page_alone(pages, name, least):
    again = work_out_page(pages[name])
    assert again.wrong == []
    assert again.count >= least


def test_the_drawn_site_has_what_the_example_lacks(pages):
    printed, page = read_page(pages["untidy"]), pages["untidy"]
    floored, shared, free = printed.rows.values()
    governed = [one for one in floored.actions if one["Eg"] >= one["Ec⁺"]]
    assert len(governed) > len(floored.actions) / 2
    gap = float(floored.inputs["gap to next work"])
    (edge,) = (v for t, v in printed.profile.items() if t.startswith("From this gap A"))
    assert 0.9 * edge < gap < 1.1 * edge  # two widths; the wider counts
    assert all(one["xU"] == 0.0 for one in shared.states)
    assert any(one["Td"] > 0.0 for one in shared.states)
    assert shared.held == {}
    assert free.widths == {}
    assert floored.held["β"] != free.held["β"]
    told = "; ".join(g["Rk="] for row in printed.rows.values()
                     for g in row.resistances.values())  # fmt: skip
    for part in ("min(", "π/4 · ((", "π · ", "1770 MPa", "kPa", "cos ", "γ C of"):
        assert part in told
    assert "Partial factors of EN 1990" in page
    assert "DECLARED" in {one["Verdict"] for one in floored.checks}
    assert "slack, low" in printed.ranges


def list_figures(printed):
    """Row, table, line and symbol of every number of the tables of figures."""
    for name, row in printed.rows.items():
        tables = {key: getattr(row, key) for key in TABLES}
        tables |= {key: list(getattr(row, key).values()) for key in KEYED}
        for table, lines in tables.items():
            for place, line in enumerate(lines):
                for symbol, value in line.items():
                    if isinstance(value, float) and value and symbol not in GIVEN:
                        yield name, table, place, symbol


@pytest.mark.parametrize("name", ["example", "untidy"])
def test_a_figure_that_is_off_by_a_hundredth_is_noticed(pages, name):
    printed, draw, missed = read_page(pages[name]), random.Random(SEED), []
    for row, table, place, symbol in draw.sample(list(list_figures(printed)), 250):
        changed = copy.deepcopy(printed.rows[row])
        lines = getattr(changed, table)
        line = list(lines.values())[place] if table in KEYED else lines[place]
        line[symbol] *= 1.01
        if not work_out(replace(printed, rows={row: changed})).wrong:
            missed.append((row, table, place, symbol))
    assert {one[1:4:2] for one in missed} <= MAY_HIDE
    assert len(missed) <= 6


@pytest.mark.parametrize("language", ["fr", "de"])
def test_other_languages_print_the_same_figures(studies, pages, language):
    for name, study in studies.items():
        mine, other = (
            PageReader(page) for page in (pages[name], render_html(study, language))
        )
        for row in (one for one in mine.ids if one.endswith("-figures")):
            for table, theirs in zip(mine.tables[row], other.tables[row], strict=True):
                told = list_numbers(theirs)
                assert "." not in "".join(number for *_, number in told)
                pointed = [(i, j, cell.replace(",", ".")) for i, j, cell in told]
                assert list_numbers(table) == pointed


def list_numbers(table):
    """Whole cells that are numbers, by place; their marks are those of the page."""
    return [
        (i, j, cell)
        for i, line in enumerate(table)
        for j, cell in enumerate(line)
        if re.fullmatch(r"-?[\d.,]+(e[+-]\d+)?", cell)
    ]


@pytest.fixture(scope="module")
def twelve(studies):
    """Twelve rows: the example's, and five of them again under other names."""
    study = studies["example"]
    again = [replace(row, id=f"{row.id}b") for row in study.rows[:5]]
    return replace(study, rows=[*study.rows, *again])


@pytest.mark.parametrize(
    ("detail", "language", "most"),
    [
        ("full", "en", 54),
        ("full", "fr", 54),
        ("summary", "en", 12),
        ("summary", "de", 12),
    ],
)
def test_twelve_rows_have_few_pages(twelve, tmp_path, detail, language, most):
    """54 and 12 where a font as narrow as Arial is installed; others are wider."""
    page = render_html(twelve, language, detail)
    assert count_pages(page, tmp_path) <= most


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_verdict_stands_on_the_first_page(twelve, tmp_path, language):
    page = render_html(twelve, language, "summary")
    assert measure_bottom(page, ".card", tmp_path) <= PRINTED_PX
    assert ".card { break-inside: avoid; }" in page  # one that is longer than a page


def test_no_page_but_the_last_is_three_quarters_empty(twelve, tmp_path):
    shares = measure_pages(render_html(twelve, "fr"), tmp_path)
    assert len(shares) > 20
    assert min(shares[:-1]) > 0.25


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_is_wider_than_the_paper(twelve, tmp_path, language):
    """A browser would shrink the whole report so that its widest table fits."""
    assert list_too_wide(render_html(twelve, language), PAPER_PX, tmp_path) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_on_a_phone_only_tables_are_moved_sideways(twelve, tmp_path, language):
    page = render_html(twelve, language, "summary")
    wide = list_too_wide(page, PHONE_PX, tmp_path, media="screen")
    assert {one.split()[1] for one in wide} <= {"table", "svg"}


def test_paper_leaves_out_only_what_is_meant(twelve, tmp_path):
    """A fold in another section once took that section with it."""
    hidden = list_hidden(render_html(twelve), tmp_path)
    kinds = {re.sub(r"^row-\d+-", "", one) for one in hidden}
    assert kinds == {"figures", "extremes", "inputs", "formulas"}
    opened = list_hidden(render_html(twelve, detail="figures"), tmp_path)
    assert {re.sub(r"^row-\d+-", "", one) for one in opened} == {"extremes", "inputs"}
