"""Quality of the solutions, cases, second opinions as tables."""

from dataclasses import replace

from netdesign.report.blocks import Items
from netdesign.report.page.html import render_html
from netdesign.report.sections.annexes import (
    build_cases,
    build_opinions,
    show_quality,
)
from netdesign.report.words import ENGLISH
from netdesign.words.message import say
from tests.report.build_study import build_study
from tests.report.reading import PageReader

STUDY = build_study()


def test_failed_case_is_named_and_in_no_maximum():
    page = PageReader(render_html(STUDY, has_annexes=True))
    cases = page.tables["annex-cases"]
    assert [sum("60 iterations" in x[-1] for x in table) for table in cases] == [
        0,
        1,
        0,
    ]
    rows = build_cases(STUDY.rows[1], ENGLISH).rows
    assert len([cells for cells in rows if "-" in cells[3].text]) == 1


def test_second_opinions_stand_beside_this_calculation():
    table = build_opinions(STUDY, ENGLISH)
    row = STUDY.rows[0]
    cells = table.rows[0]
    assert cells[1].number == row.guideline.solved_foot_anchor_kN
    by_name = {one.name: one.foot_anchor_kN for one in row.guideline.cases}
    assert cells[2].number == by_name.get("load_case_1")
    assert cells[3].number == by_name.get("load_case_2")
    bare = replace(row, guideline=None, model_form=None)
    (line,) = build_opinions(replace(STUDY, rows=[bare]), ENGLISH).rows
    assert [cell.text for cell in line[1:]] == ["-"] * 4


def test_why_the_guideline_differs_and_what_is_information_stand_in_the_annex():
    note = say("row.guys_in_snow", guys=(), pressure=5.3)
    rows = [replace(STUDY.rows[0], notes=[note]), *STUDY.rows[1:]]
    annex = show_quality(replace(STUDY, rows=rows), ENGLISH)
    *_, items = [block.items for block in annex.blocks if isinstance(block, Items)]
    compared = [row.guideline.sentence for row in rows if row.guideline]
    for message in (*compared, note):
        assert any(text.endswith(ENGLISH.show(message)) for text in items)
