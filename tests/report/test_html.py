from dataclasses import replace

import pytest
from build_study import MENTION, SCRIPT, build_study
from reading import PageReader

from netdesign.errors import NetDesignError
from netdesign.outcome import Verdict
from netdesign.report import html
from netdesign.report.view import build_view


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


def test_title_cannot_leave_the_style_sheet():
    study = build_study(rows=1)
    name = '"; } </style><script>alert(1)</script> \\'
    study = replace(study, project=replace(study.project, name=name))
    page = html.render_html(study)
    assert page.count("</style>") == 1
    assert "<script" not in page


def test_ids_are_unique(page):
    ids = PageReader(page).ids
    assert len(ids) == len(set(ids))


def test_every_section_is_there(page):
    expected = html.list_sections(build_view(build_study()))
    assert set(expected) <= set(PageReader(page).ids)
    assert len(expected) == 8 + 3 * 10


def test_a_missing_section_raises(monkeypatch):
    def list_more(view):
        return [*list_sections(view), "row-1-history"]

    list_sections = html.list_sections
    monkeypatch.setattr(html, "list_sections", list_more)
    with pytest.raises(NetDesignError, match="nothing in section row-1-history"):
        html.render_html(build_study(rows=1))


def test_empty_parts_say_none():
    study = build_study(rows=1)
    bare = replace(
        study.rows[0],
        checks=[],
        extremes=[],
        cases=[],
        inputs=[],
        drawing=None,
        anchors=[],
        head=[],
        guideline=None,
        verdict=Verdict.NOT_PROVEN,
    )
    study = replace(
        study,
        rows=[bare],
        notes=[],
        range_inputs=[],
        profile=replace(study.profile, values=[]),
        verdict=Verdict.NOT_PROVEN,
    )
    page = html.render_html(study)
    assert page.count('<p class="none">none') == 16
    assert "NOT PROVEN" in page


def test_study_without_rows_has_a_page():
    study = replace(build_study(), rows=[], verdict=Verdict.NOT_PROVEN)
    assert "none: the site has no net rows" in html.render_html(study)


def test_first_page_lists_the_assumed_values(page):
    card = page[page.index('id="verdict"') : page.index('id="identification"')]
    assert "Assumed: confirm in your copy of the standard" in card
    assert "Partial factor of a tendon" in card
    assert "FAIL" in card


def test_tables_have_captions_and_scopes(page):
    reader = PageReader(page)
    assert reader.tags.count("caption") == reader.tags.count("table")
    assert page.count("<th ") == page.count("<th scope=")
    assert "<th>" not in page


def test_page_repeats_byte_for_byte(page):
    assert page == html.render_html(build_study())
