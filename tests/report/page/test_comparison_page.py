"""Profiles beside each other by name: what the reports of each of them say."""

from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.report.page.comparison_page import render_comparison
from netdesign.report.words import ENGLISH, VERDICTS, Words, show_own
from netdesign.site.model import ReplacedCell
from netdesign.study.judge import judge_site
from netdesign.study.scopes import find_governing
from netdesign.words.catalogue import LANGUAGES, load_texts
from tests.grid import solve_site
from tests.report.reading import PageReader
from tests.small_site import ROWS, RUN, build_row, build_site, resist

NAMES = ("nf-p-95-304-style", "eurocode", "onr-24805-style")


@pytest.fixture(scope="module")
def studies():
    """Two rows, one with an anchor that only some of the profiles accept."""
    between = resist(foot_anchor__pull_out=BETWEEN)
    site = build_site(build_row("R7b", resistances=between), ROWS[1])
    solved = solve_site(site, RUN)
    return [judge_site(site, solved, load_standard(name), RUN) for name in NAMES]


BETWEEN = 511e3  # [N], on the free ground of the first row


def read_page(studies, language="en"):
    return PageReader(render_comparison(studies, language).decode())


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_member_has_its_verdict_utilisation_and_clause(studies, language):
    words, page = Words(language), read_page(studies, language)
    assert len(page.tables["rows"]) == 2
    for place, table in enumerate(page.tables["rows"]):
        for line in table[1:]:
            for study, cell in zip(studies, line[1:], strict=True):
                checks = [
                    one
                    for one in study.rows[place].checks
                    if one.is_of_force and words(f"member.{one.member}") == line[0]
                ]
                if not checks:
                    continue
                worst = find_governing(checks)
                assert cell.startswith(VERDICTS[worst.verdict].symbol)
                if worst.utilisation is not None:
                    shown = words.show_number("utilisation", worst.utilisation)
                    assert f" {shown}" in cell
                assert worst.clause == "-" or worst.clause in cell
    listed = [line[0] for line in page.tables["rows"][0]]
    assert words("member.foot_anchor") in listed
    assert listed[-1] == load_texts(language)["heading.rest"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_row_has_its_verdict_under_every_profile(studies, language):
    words, (table,) = Words(language), read_page(studies, language).tables["profiles"]
    assert table[0][1:] == list(NAMES)
    for place, line in enumerate(table[1:-1]):
        for study, cell in zip(studies, line[1:], strict=True):
            assert cell.endswith(words(f"verdict.{study.rows[place].verdict}"))
    for study, cell in zip(studies, table[-1][1:], strict=True):
        assert cell.endswith(words(f"verdict.{study.verdict}"))


def test_verdicts_that_depend_on_the_profile_are_named(studies):
    verdicts = {
        find_governing(
            [one for one in study.rows[0].checks if one.member == "foot_anchor"]
        ).verdict
        for study in studies
    }
    assert len(verdicts) > 1, "the drawn resistance tells no profiles apart"
    assert "R7b Net anchor (foot)" in " ".join(read_page(studies).text)
    same = read_page([studies[0], studies[0]])
    assert load_texts("en")["compare.same"] in " ".join(same.text)
    assert same.tables["values"] == []


def test_values_stand_by_what_they_are_where_they_differ(studies):
    (table,) = read_page(studies).tables["values"]
    named = {line[0]: line[1:] for line in table}
    profiles = [study.profile.values for study in reversed(studies)]
    texts = {v.id: show_own(ENGLISH, v.text) for values in profiles for v in values}
    values = [{v.id: v.value for v in study.profile.values} for study in studies]
    for name in set().union(*values):
        differs = len({one.get(name) for one in values}) > 1
        assert differs <= (texts[name] in named), name
        assert name not in named  # no key
    assert named[texts["resistance.pull_out.tested"]] == ["1.35", "1.15", "1.2"]


def test_a_what_if_is_marked(studies):
    cell = ReplacedCell(cell="Nets!P8", was="a", now="b")
    marked = render_comparison([replace(one, what_if=[cell]) for one in studies])
    assert marked.decode().count(load_texts("en")["what_if.mark"]) == 2
    assert load_texts("en")["what_if.mark"] not in render_comparison(studies).decode()
