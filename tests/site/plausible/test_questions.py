"""Questions about numbers of a workbook: which, of which net rows, how they end."""

import openpyxl
import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from netdesign.words.catalogue import LANGUAGES, render
from netdesign.words.message import say
from tests.each import each
from tests.old_example import write_old_example
from tests.site.plausible.slips import PLANS
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    path = tmp_path_factory.mktemp("plausible") / "site.xlsx"
    write_old_example(path)
    return path


def asked(path, **cells):
    """Questions with some cells replaced: the site, and their places."""
    site = read_site(
        path, instead={key.replace("_", "!"): v for key, v in cells.items()}
    )
    found = [one for one in site.findings if one.severity == "question"]
    return site, [f"{one.sheet}!{one.cell}" for one in found]


def rows_in_question(site):
    return [row.id for row in site.rows if row.questions]


def test_nothing_is_asked_of_the_example(example):
    site, places = asked(example)
    assert (places, rows_in_question(site), site.questions) == ([], [], ())


@each(
    "cell, typed, rows, told",
    [
        ("Posts_D2", "3175", ["R1"], "HEB120: 317.5 cm4 (EN 10365)"),
        ("Posts_C2", "340", ["R1"], "HEB120: 34.01 cm2"),
        ("Posts_M2", "1441", ["R1"], "HEB120: 144.1 or 52.92 cm3"),
        ("Ropes_B2", "3500", ["R1", "R2", "R3", "R6", "R7"], "50 to 1500 kN"),
        ("Anchors_C5", "3000", ["R1", "R2", "R3", "R6", "R7"], "40 to 2500 kN"),
        ("Posts_P2", "20", ["R1"], "the 0 mm of an empty cell"),
        ("Posts_N2", "62", ["R1"], "the 60 mm of an empty cell"),
        ("Nets_C3", "0.28", ["R2"], "0.8 to 6.5 m"),
        ("Nets_N2", "40", ["R1"], "effective height D_K 2.5 m in Nets!I2"),
        ("Nets_E4", "200", ["R3"], "4 to 100 m"),
        ("Nets_E2", "1.5", ["R1"], "4 to 100 m"),
        ("Ranges_C3", "1.5", ["R1", "R2", "R3", "R4", "R5", "R6", "R7"], "5 to 45 deg"),
        ("Ends_L2", "3", ["R1"], "5 to 65 deg"),
        ("Links_C2", "6200", ["R3", "R4"], "20 to 2000 kN"),
        ("Links_D11", "3000", [f"R{n}" for n in range(2, 8)], "5 to 1000 kN"),
        ("Ropes_G9", "145000", ["R2", "R3", "R4"], "1.62e+04 to 1.04e+05 kN"),
    ],
)
def test_a_slip_is_asked_for_with_its_cell_and_its_rows(
    example, cell, typed, rows, told
):
    """Those of the contract, and one of every sheet: none ends a study's other rows."""
    site, places = asked(example, **{cell: typed})
    assert places == [cell.replace("_", "!")]
    assert rows_in_question(site) == rows
    (question,) = site.questions
    assert told in str(question)
    assert f"= {typed}" in str(question)


def declare(path, tmp_path, line, **cells):
    workbook = openpyxl.load_workbook(path)
    for place, value in cells.items():
        sheet, cell = place.split("_")
        workbook[sheet][cell] = value
    for column, value in enumerate(line, start=1):
        workbook["Declared"].cell(3, column).value = value
    workbook.save(tmp_path / "declared.xlsx")
    return tmp_path / "declared.xlsx"


CONFIRMED = ("all", "Posts!D2 = 3175", "Drawing 12", "B. Rüegg", "2026-11-03")


def test_a_number_that_is_confirmed_is_not_asked_for_and_told(example, tmp_path):
    site, places = asked(declare(example, tmp_path, CONFIRMED, Posts_D2=3175))
    assert (places, rows_in_question(site)) == ([], [])
    (told,) = [str(one) for one in site.notes if "B. Rüegg" in str(one)]
    assert "Posts!D2 = 3175" in told
    assert len(site.declared) == 1  # that of R3: a number is no check


@pytest.mark.parametrize(
    ("line", "place", "told"),
    [
        (CONFIRMED, "B3", "holds"),
        (("all", "Posts!D2 = 3176", *CONFIRMED[2:4], None), "E3", "empty"),
        (("all", "Post!D2 = 3176", *CONFIRMED[2:]), "B3", "no longer true"),
        (("R17", "Posts!D2 = 3176", *CONFIRMED[2:]), "A3", "no id"),
        (("all", "Posts!D2 = 3176", None, *CONFIRMED[3:]), "C3", "empty"),
    ],
)
def test_a_confirmation_that_does_not_hold_is_refused(
    example, tmp_path, line, place, told
):
    path = declare(example, tmp_path, line, Posts_D2=3176)
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    found = [f"{one.sheet}!{one.cell} {one.rule}" for one in caught.value.findings
             if one.severity == "error"]  # fmt: skip
    assert any(one.startswith(f"Declared!{place} ") and told in one for one in found), (
        found
    )


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
def test_questions_are_marked_in_the_copy(example, language, tmp_path):
    path = declare(example, tmp_path, (), Posts_D2=3175)
    site = read_site(path)
    (tmp_path / "copy.xlsx").write_bytes(
        annotate_workbook(path, site.findings, language=language)
    )
    copy = openpyxl.load_workbook(tmp_path / "copy.xlsx")
    assert "HEB120" in copy["Posts"]["D2"].comment.text
    assert "Posts!D2 = 3175" in render(site.questions[0], language)


FIELDS = {
    (plan.name, field.key): field
    for plan in PLANS
    for field in (*plan.fields, *plan.items)
}


def test_bounds_are_wider_than_what_is_usual():
    """A number that is refused need not be asked for."""
    usual = {place: field for place, field in FIELDS.items() if field.usual}
    assert len(usual) > 50
    for place, field in usual.items():
        least, most = field.bounds
        assert least <= field.usual.least < field.usual.most <= most, place
        assert str(say(f"plausible.source_{field.usual.source}"))


MOST_FALSE_ALARMS = 0.01


@pytest.mark.parametrize("sites", [10, pytest.param(200, marks=pytest.mark.slow)])
def test_sensible_sites_are_asked_nothing(tmp_path, sites):
    """Drawn by what is built, not by what counts as usual here."""
    alarms = []
    for seed in range(5000, 5000 + sites):
        write_lines(tmp_path / "site.xlsx", draw_lines(seed))
        alarms += [str(one) for one in read_site(tmp_path / "site.xlsx").questions]
    assert len(alarms) <= MOST_FALSE_ALARMS * sites, alarms[:20]


def test_a_confirmed_number_is_confirmed_as_number(example, tmp_path):
    for typed in (3175, 3175.0, "3175", "3175,0", "3.175e3"):
        line = ("all", f"Posts!D2 = {typed}", *CONFIRMED[2:])
        path = declare(example, tmp_path, line, Posts_D2=3175)
        assert read_site(path).questions == ()
