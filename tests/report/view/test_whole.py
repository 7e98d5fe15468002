from dataclasses import replace

import pytest

from netdesign.outcome import Verdict
from netdesign.report.view.check_view import find_governing, find_highest
from netdesign.report.view.tables import build_cases, build_quality
from netdesign.report.view.whole import build_view
from netdesign.report.words import ENGLISH
from tests.report.build_study import build_row, build_study


def test_governing_check_is_the_worst_verdict_then_the_largest_ratio():
    row = build_row("A", 2, scale=0.62, missing_resistance=True)
    assert find_governing(row.checks).id == "downhill_anchor.pull_out"
    assert find_highest(row.checks).id == "foot_anchor.pull_out"
    failing = build_row("B", 2, scale=0.72)
    assert find_governing(failing.checks).id == "foot_anchor.pull_out"


def test_order_of_checks_and_cases_does_not_matter():
    study = build_study()
    turned = replace(
        study,
        rows=[
            replace(row, checks=row.checks[::-1], cases=row.cases[::-1])
            for row in study.rows
        ],
    )
    for one, other in zip(build_view(study).rows, build_view(turned).rows, strict=True):
        assert one.governing == other.governing
        assert one.failed == other.failed
        assert one.worked == other.worked


def test_governing_row_is_the_failing_one():
    view = build_view(build_study())
    assert view.governing_row.id == "=1+1"
    assert view.verdict.word == "FAIL"


def test_failed_case_is_named_and_counted_and_in_no_maximum():
    study = build_study()
    view = build_view(study)
    (failed,) = view.rows[1].failed.rows
    assert failed[0].text == "350 kg/m³, φ 30°, θ 30°"
    assert "60 iterations" in failed[2].text
    assert ("Cases", "80 solved, 1 without a result") in view.counts
    assert build_quality(study, ENGLISH).rows[1][2].number == 1
    numbers = [
        cells
        for cells in build_cases(study.rows[1], ENGLISH).rows
        if "-" in cells[3].text
    ]
    assert len(numbers) == 1


def test_missing_resistance_shows_a_dash_and_its_reason():
    check = build_view(build_study()).rows[2].governing
    assert (check.resistance, check.utilisation, check.band) == ("-", "-", "-")
    assert check.reason == "No resistance is given in Anchors!E7."
    assert check.verdict.word == "NOT PROVEN"


def test_worked_check_shows_symbols_numbers_and_result():
    row = build_row("A", 2, scale=0.6)
    steps = build_view(build_study()).rows[0].worked.steps
    demand, derivation, resistance, ratio = steps[-4:]
    assert derivation.symbols == "R_k"
    force = row.extremes[0].max_kN
    assert demand.numbers == f"1.5 · {force:.1f} kN"
    assert demand.result == f"{1.5 * force:.1f} kN"
    assert resistance.result == f"{480 / 1.35:.1f} kN"
    assert ratio.result.startswith(f"{1.5 * force / (480 / 1.35):.3f} (")


def test_slack_member_passes_with_a_utilisation_of_nothing():
    check = build_view(build_study()).rows[0].checks[6]
    assert (check.utilisation, check.band) == ("0.000", "0.000 to 0.000")
    assert (check.resistance, check.verdict.word) == ("133.3", "PASS")


def test_assumed_values_are_listed():
    view = build_view(build_study())
    assert view.assumed_line == "factor.action = 1.5, factor.tendon = 1.35"
    assert [cells[0].text for cells in view.assumed.rows] == [
        "5.2, factor.action",
        "6.1, factor.tendon",
    ]


@pytest.mark.parametrize("verdict", [Verdict.PASS, Verdict.FAIL, Verdict.NOT_PROVEN])
def test_study_without_rows_is_shown_only_if_not_proven(verdict):
    study = replace(build_study(), rows=[], verdict=verdict)
    if verdict is Verdict.NOT_PROVEN:
        assert build_view(study).governing_row is None
    else:
        with pytest.raises(Exception, match="its parts give NOT PROVEN"):
            build_view(study)


def test_the_built_in_example_is_verified_without_a_site_file():
    study = build_study()
    run = replace(study.provenance, command="netdesign check --example --language fr")
    (_, command), *_ = build_view(replace(study, provenance=run)).verification
    assert command == "netdesign verify --study study.json"
