"""Quality of the solutions, cases, second opinions as tables."""

from dataclasses import replace

from netdesign.report.page.html import render_html
from netdesign.report.sections.quality import (
    build_cases,
    build_opinions,
    stack_tables,
)
from netdesign.report.words import ENGLISH
from netdesign.study.records import IndependentRecord
from tests.report.build_study import build_study
from tests.report.reading import PageReader

STUDY = build_study()


def test_failed_case_is_named_and_counted_and_in_no_maximum():
    page = PageReader(render_html(STUDY))
    quality, failed, *_ = page.tables["annex-quality"]
    assert quality[2][:3] == ["=1+1", "27", "1"]
    assert failed[1][:2] == ["=1+1", "350 kg/m³, φ 30°, θ 30°"]
    assert "60 iterations" in failed[1][3]
    assert sum(int(line[1]) for line in quality[1:]) == 81
    rows = build_cases(STUDY.rows[1], ENGLISH).rows
    assert len([cells for cells in rows if "-" in cells[3].text]) == 1


def test_a_law_that_is_not_met_is_named():
    row = STUDY.rows[2]
    laws = [
        IndependentRecord(name="global_balance", value=0.3, limit=1e-6, is_met=False),
        IndependentRecord(name="end_direction", value=1e-9, limit=1e-3, is_met=True),
    ]
    changed = replace(row, independent=laws)
    study = replace(STUDY, rows=[changed])
    (quality, *_) = PageReader(render_html(study)).tables["annex-quality"]
    name = ENGLISH("law.global_balance")
    assert quality[1][-1] == f"not met: {name}"


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


def test_columns_that_some_rows_lack_stay_empty_for_them():
    wide = build_cases(STUDY.rows[0], ENGLISH)
    narrow = replace(
        wide, columns=wide.columns[1:], rows=tuple(cells[1:] for cells in wide.rows)
    )
    stacked = stack_tables("", [("A", wide), ("B", narrow)], ENGLISH)
    assert len(stacked.columns) == len(wide.columns) + 1
    assert stacked.rows[0][1].text == wide.rows[0][0].text
    assert stacked.rows[len(wide.rows)][1].text == "-"
