"""All that is to be done of a study: one list for page, terminal and workbook."""

from dataclasses import replace

from netdesign.outcome import Verdict
from netdesign.report.page import render_html
from netdesign.report.sections.basis import count_assumed, show_line
from netdesign.report.words import ENGLISH
from netdesign.study.to_do import list_to_do
from tests.report.build_study import build_study

STUDY = build_study()


def list_lines(study):
    """Every line to be done, in words."""
    return [show_line(line, study, ENGLISH) for line in list_to_do(study, None)]


def test_every_check_that_does_not_pass_is_an_open_point():
    lines = list_to_do(STUDY, None)
    for row in STUDY.rows:
        is_open = any(one.verdict is not Verdict.PASS for one in row.checks)
        assert any(row.id in line.rows for line in lines) is is_open
    assumed, count = count_assumed(STUDY)
    told = ENGLISH("todo.unconfirmed", assumed=assumed, count=count)
    assert told in render_html(STUDY)


def test_nothing_is_open_where_all_passes_and_is_confirmed():
    study = build_study(rows=1)
    values = [replace(one, status="read") for one in study.profile.values]
    row = replace(
        study.rows[0],
        inputs=[x for x in study.rows[0].inputs if x.cell != "default"],
    )
    bare = replace(
        study,
        rows=[row],
        profile=replace(study.profile, values=values),
        range_inputs=[],
    )
    assert list_lines(bare) == []
    assert ENGLISH("todo.none") in render_html(bare)
