import re
from dataclasses import replace

import pytest

from netdesign.report.page import html
from netdesign.report.sections.whole import build_report
from netdesign.report.words import ENGLISH, Words
from netdesign.study.document import compute_digest, read_document, write_document
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import MENTION, SCRIPT, build_study
from tests.report.filled import list_filled, list_sections
from tests.report.reading import PageReader


@pytest.fixture(scope="module")
def page():
    return html.render_html(build_study())


def test_nothing_of_the_site_comes_alive(page):
    reader = PageReader(page)
    assert "<script" not in page.lower()
    assert not {"script", "iframe", "object", "img", "form"} & set(reader.tags)
    assert SCRIPT in "".join(reader.text)
    assert MENTION in "".join(reader.text)


def test_page_is_self_contained_under_a_strict_policy(page):
    assert "default-src 'none'; style-src 'unsafe-inline'; img-src data:" in page
    for loading in ("src=", "@import", "url(http", 'href="http'):
        assert loading not in page
    assert len(page) < 2_000_000


def test_ids_are_unique(page):
    ids = PageReader(page).ids
    assert len(ids) == len(set(ids))


@each("detail", ["full", "summary"])
@each("rows", [0, 1, 3])
def test_every_section_is_there_and_says_something(detail, rows):
    study = build_study(rows=1) if rows < 3 else build_study()
    parts = study.rows[:rows]
    study = replace(study, rows=parts)
    expected = set(list_sections(study, detail))
    assert expected <= set(list_filled(build_report(study, ENGLISH, detail)))
    assert expected <= set(PageReader(html.render_html(study, "en", detail)).ids)


def test_empty_parts_say_none():
    study = build_study(rows=1)
    bare = replace(
        study.rows[0],
        checks=[],
        forces=[],
        cases=[],
        inputs=[],
        drawing=None,
        anchors=[],
        head=[],
        pulls=[],
        held_sideways=None,
        guideline=None,
        model_form=None,
    )
    study = replace(
        study,
        rows=[bare],
        notes=[],
        range_inputs=[],
        profile=replace(study.profile, values=[]),
    )
    page = html.render_html(study)
    assert len(re.findall('<p class="none">', page)) >= 12
    assert "NOT PROVEN" in page


def test_study_without_rows_has_a_page():
    study = replace(build_study(), rows=[])
    assert "none: the site has no net rows" in html.render_html(study)


def take_first_page(page):
    end = "basis" if 'id="basis"' in page else "quantities"
    return page[page.index('id="decision"') : page.index(f'id="{end}"')]


def test_first_page_lists_what_is_open_and_has_room_to_sign(page):
    first = take_first_page(page)
    assert "FAIL" in first
    assert "Confirm 2 of 5 values of the limit profile" in first
    assert "Prepared" in first
    assert "A. Moreau" in first


def test_summary_is_shorter_and_keeps_the_verdicts(page):
    short = html.render_html(build_study(), detail="summary")
    reader = PageReader(short)
    assert len(short) < 0.6 * len(page)
    assert set(reader.ids) >= {"decision", "quantities", "scope"}
    assert not {"schedule", "inputs", "notes"} & set(reader.ids)
    assert "annex-profile" not in reader.ids
    assert "row-1-worked" not in reader.ids
    assert 'href="#row-1' not in short
    assert reader.tables["decision"] == PageReader(page).tables["decision"]


@each("detail", ["summary", "full"])
@each("language", LANGUAGES)
def test_the_first_page_says_how_the_report_is_verified(language, detail):
    study, words = build_study(), Words(language)
    page = html.render_html(study, language, detail)
    shown = " ".join(PageReader(take_first_page(page)).text)
    assert "netdesign verify --study study.json --site combe.xlsx" in shown
    assert compute_digest(study) in shown
    whole = " ".join(PageReader(page).text)
    for key in ("verify_report", "what_that_does", "verify_explained"):
        text = words(f"heading.{key}")
        assert (text in whole) is (detail == "full")
        assert (text == ENGLISH(f"heading.{key}")) is (language == "en")


def test_the_digest_shown_is_that_of_the_document_written():
    study = build_study()
    again = read_document(write_document(study))
    digest = compute_digest(study)
    assert f'"digest": "{digest}"' in write_document(study)
    for one in (study, again):
        assert digest in take_first_page(html.render_html(one))
