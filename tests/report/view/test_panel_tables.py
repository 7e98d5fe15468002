"""Panel between the posts on the page and in the workbook, in every language."""

import math
import re
import xml.etree.ElementTree as ElementTree

import pytest

from netdesign.report.drawing.panel_figure import LEFT, LONGEST, SPAN, draw_panel
from netdesign.report.page.html import list_sections, render_html
from netdesign.report.view.check_view import view_check
from netdesign.report.view.panel_tables import view_panel
from netdesign.report.view.steps import list_steps
from netdesign.report.view.whole import build_view
from netdesign.report.words import ENGLISH, Words
from netdesign.report.workbook.excel import render_workbook
from netdesign.words.catalogue import LANGUAGES
from tests.report.reading import read_workbook
from tests.study.test_panel_study import a_panel, an_end, checks_of, judge, with_panel


@pytest.fixture(scope="module")
def study():
    return judge(with_panel(a_panel(), end=an_end(angle=37.0)))[1]


@pytest.fixture(scope="module")
def plain():
    return judge(with_panel(None))[1]


def test_both_sets_stand_side_by_side(study):
    row = study.rows[0]
    shown = view_panel(row, Words("en"))
    by_panel = {one.quantity: one.max_kN for one in row.panel.extremes}
    by_section = {one.quantity: one.max_kN for one in row.extremes}
    for cells, member in zip(shown.forces.rows, by_section, strict=True):
        assert cells[1].number == by_section[member]
        assert cells[2].number == by_panel[f"panel_{member}"]
    assert shown.forces.rows[1][3].number > 1.1


def test_an_engineer_reads_why_the_guy_is_larger(study):
    sentences = view_panel(study.rows[0], Words("en")).sentences
    drawing = study.rows[0].panel.drawing
    assert "Why the uphill guy is larger" in sentences[0]
    for force in (drawing.foot_kN, drawing.section_foot_kN, drawing.head_kN):
        assert f"{force[0]:.1f} kN" in sentences[0]
    # foot and head keep their sum
    both = drawing.foot_kN[0] + drawing.head_kN[0]
    before = drawing.section_foot_kN[0] + drawing.section_head_kN[0]
    assert both == pytest.approx(before, rel=1e-8)
    assert "at most 2.19 times" in sentences[2]


def test_ropes_are_information_with_their_limits(study):
    shown = view_panel(study.rows[0], Words("en"))
    for cells, rope in zip(shown.ropes.rows, study.rows[0].panel.ropes, strict=True):
        assert cells[5].number == rope.tension_kN
        assert cells[7].number == pytest.approx(rope.tension_kN / 290.0)
    assert "Information, not a check" in shown.ropes.caption
    assert any("upper figure to a tenth" in one for one in shown.sentences)


def test_a_row_without_a_panel_shows_none(plain):
    assert view_panel(plain.rows[0], Words("en")) is None
    assert "row-1-panel" not in render_html(plain)


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_has_the_panel_in_every_language(study, language):
    page = render_html(study, language)
    assert "row-1-panel" in list_sections(build_view(study, language))
    assert 'id="row-1-panel"' in page
    assert Words(language)("panel_view.tensions") in page
    assert "row-1-panel" not in render_html(study, language, "summary")


def test_the_workbook_has_the_same_tables(study):
    book = read_workbook(render_workbook(study))
    cells = [one.value for sheet in book for line in sheet.iter_rows() for one in line]
    texts = {round(one, 9) if isinstance(one, float) else one for one in cells}
    shown = view_panel(study.rows[0], Words("en"))
    for table in (shown.forces, shown.ropes):
        assert table.caption in texts
        for line in table.rows:
            numbers = {one.number for one in line if one.number is not None}
            assert {round(one, 9) for one in numbers} <= texts


def work_out(check):
    return {one.symbols.partition(" = ")[0]: one for one in list_steps(check, ENGLISH)}


def test_the_worked_check_gives_the_demand(study):
    check = checks_of(study)["uphill_guy.rope"]
    steps = work_out(check)
    assert steps["E_k"].symbols == "E_k = max(E_c; E_p; E_g)"
    assert "E_p" in steps
    assert steps["E_k"].result == f"{check.read('E_k'):.1f} kN"
    assert "by the panel between posts" in view_check(check, Words("en")).load


def test_the_worked_check_of_the_end_gives_its_demand(study):
    check = checks_of(study)["end_guy.rope.end"]
    steps = work_out(check)
    assert steps["E_k"].symbols == "E_k = H / cos(γ)"
    assert steps["E_k"].result == f"{check.read('E_k'):.1f} kN"
    cosine = math.cos(math.radians(check.read("γ")))
    assert check.read("E_k") == pytest.approx(check.read("H") / cosine, rel=1e-12)
    post = work_out(checks_of(study)["post.compression.end"])
    assert post["Z"].symbols == "Z = H · tan(γ)"
    assert post["E_p"].symbols.endswith(" + Z")


def test_arrows_are_to_one_scale(study):
    panel = study.rows[0].panel
    drawing = draw_panel(panel)
    ElementTree.fromstring(drawing)
    heads = re.findall(r'<polygon points="([-\d., ]+)" fill="#b23a1e"', drawing)
    assert len(heads) == 8
    tips = [tuple(map(float, one.split()[0].split(","))) for one in heads]
    (left, top), (inner, _) = tips[0], tips[2]
    at_end = panel.drawing.lower_along_kN
    assert left - LEFT == pytest.approx(LONGEST, abs=0.2)
    assert at_end == max(panel.drawing.lower_along_kN, panel.drawing.upper_along_kN)
    assert inner == pytest.approx(LEFT + SPAN, abs=0.2)
    assert (
        f"{math.hypot(at_end, math.hypot(*panel.drawing.foot_kN) / 2):.1f}" in drawing
    )
    assert top > 0.0
