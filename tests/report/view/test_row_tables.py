"""Support, guideline, intervals and changes as rows of words."""

from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.page.html import render_html
from netdesign.report.summary import list_changes
from netdesign.report.view.row_tables import (
    build_anchors,
    build_changes,
    build_guideline,
    build_head,
    build_spreads,
    describe_change,
)
from netdesign.report.view.steps import list_steps
from netdesign.report.words import ENGLISH, Words
from netdesign.study.flips import CLOSE
from netdesign.study.records import ChangeRecord
from netdesign.words.catalogue import LANGUAGES
from tests.report.build_study import build_study

ROW = build_study().rows[0]


def texts(table):
    return [[cell.text for cell in row] for row in table.rows]


def test_anchor_has_its_vector_and_direction_and_a_slack_one_says_so():
    loaded, slack = texts(build_anchors(ROW, ENGLISH))
    assert loaded == ["Foot anchor", "Net", "30.0", "40.0", "5.0", "50.0", "53.1"]
    assert slack[:2] == ["Downhill anchor", "Downhill guy, slack"]
    assert slack[-1] == "-"


def test_forces_on_the_head_are_listed_as_they_close():
    assert sum(
        cell[1].number for cell in build_head(ROW, ENGLISH).rows
    ) == pytest.approx(0.0)
    assert texts(build_head(ROW, ENGLISH))[0] == ["Net", "17.5", "-77.0"]


def test_guideline_stands_beside_the_solve_with_its_difference():
    table = build_guideline(ROW, ENGLISH)
    solved, same, second = texts(table)
    assert solved[0].startswith("Coupled solve: 450 kg/m³")
    assert (same[0], same[-2], same[-1]) == ("same snow", "25", "33")
    assert second[0].startswith("load case 2: the support fails")
    assert second[-1] == "-"


def test_guideline_that_could_not_be_asked_leaves_no_rows():
    table = build_guideline(replace(ROW, guideline=None), ENGLISH)
    assert table.rows == ()
    assert table.empty.startswith("none")


def test_interval_is_itemised_and_says_what_counts():
    check = ROW.checks[0]
    error, law = texts(build_spreads(check, ENGLISH))
    assert error[:2] == ["numerical error", "0.900 to 0.950"]
    low, high = 0.9 * 520 / 1.35, 0.95 * 520 / 1.35  # kN of the design resistance
    assert error[2:4] == [f"{low:.1f}", f"{high:.1f}"]
    below = 100 * (0.9 / check.utilisation - 1)
    assert error[4] == f"{below:.1f}"
    assert error[6:] == ["yes", "-"]
    assert law[1:7] == ["-", "-", "-", "-", "-", "no, for comparison"]
    assert build_spreads(None, ENGLISH).rows == ()


def test_changes_of_every_check_are_listed():
    lines = texts(build_changes(ROW, ENGLISH))
    assert len(lines) == 2 * sum(bool(check.changes) for check in ROW.checks)
    assert lines[1][2:5] == ["snow density: none", "450 kg/m³", "7"]


def test_change_in_words():
    change = ChangeRecord(
        quantity="snow thickness",
        unit="m",
        now=2.5,
        bound=1.26,
        sense="at most",
        solves=9,
    )
    assert describe_change(change, ENGLISH) == "snow thickness at most 1.26 m"


def test_worked_steps_lead_from_the_solved_force_to_the_utilisation():
    edge, coupled, floor, action, *others = list_steps(ROW.checks[0], ENGLISH)
    assert (edge.symbols, edge.numbers, edge.result) == (
        "b_e = b / 2 + f_R · Δl",
        "4.00 m / 2 + 1.60 · 1.50 m",
        "4.40 m",
    )
    assert coupled.symbols == "E_c = E_s · b_e / b"
    assert floor.symbols == "E_g = E_g0 · b_e / b"
    assert action.symbols == "E_k = max(E_c; E_g)"
    assert action.numbers == f"max({coupled.result}; {floor.result})"
    symbols = [one.symbols.partition(" = ")[0] for one in others]
    assert symbols[0] == "E_d"
    assert symbols[-2:] == ["R_d", "μ"]
    assert list_steps(replace(ROW.checks[0], steps=[]), ENGLISH) == ()


def test_page_draws_the_polygon_of_the_head():
    page = render_html(build_study(rows=1))
    assert 'aria-label="Force polygon of the post head. Net ' in page
    assert "<script" not in page


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("verdict", Verdict)
@pytest.mark.parametrize("used", [None, 0.371, 0.8999, 0.9001, 1.07])
def test_a_row_without_changes_needs_none_only_where_all_is_well(
    verdict, used, language
):
    """An overtopped row has checks that are not proven, and no change for them."""

    def build(verdict, used):
        steps = [
            replace(one, value=used, low=None, high=None) if one.symbol == "μ" else one
            for one in ROW.checks[0].steps
        ]
        return replace(ROW.checks[0], verdict=verdict, steps=steps, changes=[])

    checks = [build(Verdict.PASS, 0.4), build(verdict, used)]
    study = build_study(rows=1)
    study = replace(study, rows=[replace(study.rows[0], checks=checks)])
    words = Words(language)
    is_well = verdict is Verdict.PASS and (used is None or used < CLOSE)
    key = "no_change_needed" if is_well else "no_change_alone"
    assert build_changes(study.rows[0], words).empty == words(f"heading.{key}")
    key = "no_change" if is_well else "no_change_alone"
    assert list_changes(study, words) == [words(f"show.{key}")]
