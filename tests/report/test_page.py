from dataclasses import replace

import pytest

from netdesign.report.page import render_html
from netdesign.report.sections.whole import build_report
from netdesign.report.words import ENGLISH, Words
from netdesign.study.document import compute_digest
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_study
from tests.report.filled import list_filled, list_sections
from tests.report.reading import PageReader


@pytest.fixture(scope="module")
def page():
    return render_html(build_study())


def test_page_is_self_contained_under_a_strict_policy(page):
    assert "default-src 'none'; style-src 'unsafe-inline'; img-src data:" in page
    for loading in ("src=", "@import", "url(http", 'href="http'):
        assert loading not in page
    assert len(page) < 2_000_000


def test_ids_are_unique(page):
    ids = PageReader(page).ids
    assert len(ids) == len(set(ids))


@each("has_annexes", [True, False])
@each("rows", [0, 1, 3])
def test_every_section_is_there_and_says_something(has_annexes, rows):
    study = build_study(rows=1) if rows < 3 else build_study()
    study = replace(study, rows=study.rows[:rows])
    expected = set(list_sections(study, has_annexes=has_annexes))
    blocks = build_report(study, ENGLISH, has_annexes=has_annexes)
    assert expected <= set(list_filled(blocks))
    page = render_html(study, "en", has_annexes=has_annexes)
    assert expected <= set(PageReader(page).ids)


def take_first_page(page):
    return page[page.index('id="decision"') : page.index('id="schedule"')]


def test_annexes_are_left_out_unless_they_are_asked_for(page):
    whole = render_html(build_study(), has_annexes=True)
    annexes = {x for x in PageReader(whole).ids if x.startswith("annex-")}
    assert len(annexes) >= 5
    assert not annexes & set(PageReader(page).ids)
    assert take_first_page(whole) == take_first_page(page)


@each("language", LANGUAGES)
def test_the_first_page_names_the_study_and_the_last_annex_how_it_is_verified(language):
    study, words = build_study(), Words(language)
    page = render_html(study, language, has_annexes=True)
    shown = " ".join(PageReader(take_first_page(page)).text)
    assert compute_digest(study) in shown
    whole = " ".join(PageReader(page).text)
    assert words("heading.verify_explained") in whole
    assert "netdesign verify --study study.json --site combe.xlsx" in whole
