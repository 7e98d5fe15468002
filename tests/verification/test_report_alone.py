"""Checks follow from report.html alone; what the page is on paper."""

import copy
import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.report.page import render_html
from netdesign.report.sections.decision import ALTITUDE
from netdesign.site.reader import read_site
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from netdesign.words.catalogue import LANGUAGES
from tests.grid import solve_site
from tests.make import VERTICAL, draw_untidy, write_rows, write_site
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
from tests.verification.page_again import divide, read_annex, read_ratios, work_out

SWISS = "swiss-guideline-2007"
RUN = CheckRun(settings=SolverSettings(accuracy=0.05), started="")
SEED = 7


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    folder = tmp_path_factory.mktemp("alone")
    write_rows(folder / "example.xlsx", leans=True)
    drawn = draw_untidy(random.Random(SEED))
    write_site(folder / "untidy.xlsx", drawn, measures=VERTICAL)
    return {
        "example": judge(folder / "example.xlsx", SWISS),
        "untidy": judge(folder / "untidy.xlsx", "eurocode", search_site),
    }


def judge(path, profile, solve=solve_site):
    site = read_site(path)
    return judge_site(site, solve(site, RUN), load_standard(profile), RUN)


@pytest.fixture(scope="module")
def pages(studies):
    return {
        name: render_html(study, has_annexes=True) for name, study in studies.items()
    }


@pytest.mark.parametrize(("name", "least"), [("example", 2500), ("untidy", 800)])
def test_every_check_follows_from_the_annex_alone(pages, name, least):
    again = work_out(read_annex(pages[name]))
    assert again.wrong == []
    assert again.count >= least


@pytest.mark.parametrize("name", ["example", "untidy"])
def test_every_utilisation_follows_from_the_forces_beside_it(studies, pages, name):
    again = divide(read_ratios(pages[name]))
    assert again.wrong == []
    members = {
        (row.id, one.member)
        for row in studies[name].rows
        for one in row.checks
        if one.utilisation is not None and one.is_of_force
    }
    assert again.count > 0.8 * len(members) > 15


def test_a_utilisation_that_is_off_by_a_twentieth_is_noticed(pages):
    ratios = [one for one in read_ratios(pages["example"]) if one[1] != "-"]
    for title, demand, resistance, used in ratios:
        if used != "-" and float(used) > 0.4:
            changed = f"{1.05 * float(used):.2f}"
            assert divide([(title, demand, resistance, changed)]).wrong, title


def test_the_drawn_site_has_what_the_example_lacks(pages):
    checks, page = list(read_annex(pages["untidy"])), pages["untidy"]
    floored = [one for one in checks if "E_g" in one.printed]
    governed = [one for one in floored if one.printed["E_g"] >= one.printed["E_c"]]
    assert len(governed) > len(floored) / 2
    told = " ".join(one.derived for one in checks)
    for part in ("kPa", "cos ", "sin ", "γ C of", "67 years in fill ground"):
        assert part in told
    assert "Partial factors of EN 1990" in page
    assert "PROVEN ELSEWHERE" in page


@pytest.mark.parametrize("name", ["example", "untidy"])
def test_a_number_that_is_off_by_a_hundredth_is_noticed(pages, name):
    checks, draw = list(read_annex(pages[name])), random.Random(SEED)
    places = [
        (place, symbol)
        for place, check in enumerate(checks)
        for symbol in ("E_k", "V_k", "E_d", "R_k", "γ_R", "R_d", "μ")
        if math.isfinite(check.printed.get(symbol, (math.nan,) * 3)[1])
        and check.printed[symbol][1]
    ]
    for place, symbol in draw.sample(places, 100):
        changed = copy.deepcopy(checks[place])
        ends = changed.printed[symbol]
        changed.printed[symbol] = tuple(1.01 * end for end in ends)
        pair = {"R_k": "γ_R", "γ_R": "R_k"}
        other = checks[place].printed.get(pair.get(symbol, ""), (math.nan,) * 3)
        is_alone = symbol in pair and not math.isfinite(other[1])
        assert is_alone or work_out([changed]).wrong, (changed.title, symbol)


@pytest.fixture(scope="module")
def twelve(studies):
    """Twelve rows: the example's, and five of them again under other names."""
    study = studies["example"]
    again = [
        replace(row, id=f"{row.id}b", inputs=move_down(row.inputs))
        for row in study.rows[:5]
    ]
    return replace(study, rows=[*study.rows, *again])


def move_down(inputs):
    """Inputs as of a lower row: rows alike would share a place."""
    return [
        replace(one, value=one.value - 7.0) if one.label == ALTITUDE else one
        for one in inputs
    ]


# The longest words; the others in the long run.
MOST_WORDS = pytest.mark.parametrize(
    "language", ["de", *(pytest.param(x, marks=pytest.mark.long) for x in ("en", "fr"))]
)


@pytest.mark.parametrize(
    "language",
    ["en", *(pytest.param(x, marks=pytest.mark.long) for x in ("fr", "de"))],
)
def test_twelve_rows_have_few_pages(twelve, tmp_path, language):
    """So many where a font as narrow as Arial is installed; others are wider."""
    assert count_pages(render_html(twelve, language), tmp_path) <= 14


@pytest.fixture(scope="module")
def seven_rows(tmp_path_factory):
    """The seven rows with numbers worked out by hand, under their own profile."""
    path = tmp_path_factory.mktemp("own") / "example.xlsx"
    write_rows(path, leans=True)
    return judge(path, "nf-p-95-304-style")


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
def test_seven_rows_have_few_pages(seven_rows, tmp_path, language):
    """Decision, schedule with what it rests on, seven rows, worked checks."""
    assert count_pages(render_html(seven_rows, language), tmp_path) <= 9


@MOST_WORDS
def test_the_decision_stands_on_the_first_page(twelve, tmp_path, language):
    page = render_html(twelve, language)
    assert measure_bottom(page, ".key", tmp_path) <= PRINTED_PX


@pytest.mark.long
def test_no_page_but_the_last_is_three_quarters_empty(twelve, tmp_path):
    """Nor that of the signatures, for which twelve rows leave no room on page 1."""
    first, _, *shares = measure_pages(render_html(twelve, "fr"), tmp_path)
    assert len(shares) > 6
    assert min(first, *shares[:-1]) > 0.25


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_is_wider_than_the_paper(twelve, tmp_path, language):
    """A browser would shrink the whole report so that its widest table fits."""
    assert (
        list_too_wide(
            render_html(twelve, language, has_annexes=True), PAPER_PX, tmp_path
        )
        == []
    )


@MOST_WORDS
def test_on_a_phone_only_tables_are_moved_sideways(twelve, tmp_path, language):
    page = render_html(twelve, language)
    wide = list_too_wide(page, PHONE_PX, tmp_path, media="screen")
    assert {one.split()[1] for one in wide} <= {"table", "svg"}


def test_paper_leaves_out_nothing(pages, tmp_path):
    assert list_hidden(pages["example"], tmp_path) == set()
