"""The first page: verdict, rows, what is open."""

from dataclasses import replace

import pytest

from netdesign.checks import Proof
from netdesign.outcome import SEVERITY, Verdict
from netdesign.report.page.html import render_html
from netdesign.report.sections.decision import (
    build_matrix,
    list_open_points,
    name_verification,
)
from netdesign.report.words import ENGLISH, VERDICTS, Words
from netdesign.words.catalogue import LANGUAGES
from netdesign.words.message import say
from tests.report.build_study import as_given, build_study
from tests.turn import turn

STUDY = build_study()


def test_order_of_checks_and_cases_does_not_matter():
    turned = replace(
        STUDY,
        rows=[
            replace(row, checks=row.checks[::-1], cases=row.cases[::-1])
            for row in STUDY.rows
        ],
    )
    first, second = (render_html(one, detail="summary") for one in (STUDY, turned))
    start, end = (first.index(one) for one in ('class="summary"', 'id="todo"'))
    assert first[start:end] in second


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_check_that_does_not_pass_is_an_open_point(language):
    words = Words(language)
    points = list(list_open_points(STUDY, words))
    for row in STUDY.rows:
        is_open = any(one.verdict is not Verdict.PASS for one in row.checks)
        assert any(one.startswith(f"{row.id}, ") for one in points) is is_open
    assert any("2" in one and "5" in one for one in points)  # values to confirm


@pytest.mark.parametrize("verdict", [Verdict.FAIL, Verdict.NOT_PROVEN])
def test_a_point_without_a_force_names_its_cause(verdict):
    row = STUDY.rows[0]
    cause = as_given("The net of 1.9 m does not reach the 2.5 m that are needed.")
    check = next(one for one in row.checks if not one.is_of_force)
    check = turn(check, verdict, reason=cause)
    study = replace(STUDY, rows=[replace(row, checks=[check])])
    (first, *_) = list_open_points(study, ENGLISH)
    assert ENGLISH.show(cause) in first


def test_many_checks_with_one_cause_are_counted():
    row = STUDY.rows[0]
    lost = turn(row.checks[0], Verdict.NOT_PROVEN, reason=say("check.no_case_solved"))
    open_ = [
        replace(lost, id=f"c{k}", mode=mode, changes=[])
        for k, mode in enumerate(("tendon", "pull_out", "rope", "bearing", "sliding",
                                  "compression", "bending"))
    ]  # fmt: skip
    changed = replace(row, checks=open_)
    (first, *_) = list_open_points(replace(STUDY, rows=[changed]), ENGLISH)
    assert "and 3 more checks: no case could be calculated" in first


def test_what_is_proven_elsewhere_is_an_open_point_with_its_document():
    row = STUDY.rows[2]
    proof = Proof(
        document="Report EX-G9",
        author="C. Weber",
        date="2026-03-02",
        cell="Declared!B2",
    )
    checks = [
        turn(one, Verdict.DECLARED, proof=proof)
        if one.verdict is Verdict.NOT_PROVEN
        else one
        for one in row.checks
    ]
    study = replace(STUDY, rows=[replace(row, checks=checks)])
    told = " ".join(list_open_points(study, ENGLISH))
    for part in ("Report EX-G9", "C. Weber", "2026-03-02", "Declared!B2"):
        assert part in told


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
    assert list(list_open_points(bare, ENGLISH)) == []
    assert ENGLISH("todo.none") in render_html(bare, detail="summary")


def test_a_borehole_that_rises_is_a_point_to_settle_with_its_rows():
    study = build_study(rows=2)
    first, second = study.rows
    rising = replace(first, pulls=[replace(one, dip_deg=-0.4) for one in first.pulls])
    told = list(list_open_points(replace(study, rows=[rising, second]), ENGLISH))
    (point,) = [one for one in told if "grouted" in one]
    assert f"Net anchor (foot) ({first.id})" in point


def test_study_without_rows_is_shown():
    study = replace(STUDY, rows=[])
    assert ENGLISH("heading.no_rows") in render_html(study)


def test_the_built_in_example_is_verified_without_a_site_file():
    run = replace(STUDY.provenance, site_file="example.xlsx")
    command = name_verification(replace(STUDY, provenance=run))
    assert command == "netdesign verify --study study.json"


def test_the_matrix_shows_the_worst_verdict_of_each_member():
    table = build_matrix(STUDY, ENGLISH)
    assert [cells[0].text for cells in table.rows] == [row.id for row in STUDY.rows]
    for row, cells in zip(STUDY.rows, table.rows, strict=True):
        worst = min((one.verdict for one in row.checks), key=SEVERITY.index)
        symbols = {cell.text.split()[0] for cell in cells[1:]} - {"-"}
        assert VERDICTS[worst].symbol in symbols
        used = [one.utilisation for one in row.checks if one.utilisation is not None]
        shown = [float(c.text.split()[1]) for c in cells[1:] if " " in c.text]
        assert max(shown) == round(max(used), 2)


@pytest.mark.parametrize("count", [8, 9])
def test_a_large_site_has_the_matrix_on_its_first_page(count):
    row = STUDY.rows[0]
    rows = [replace(row, id=f"N{k}") for k in range(count)]
    page = render_html(replace(STUDY, rows=rows))
    first = page[: page.index('id="basis"')]
    assert ('class="matrix"' in first) is (count > 8)
