"""The use case on a small site: two rows, three densities, three friction angles."""

import math
import random
from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome, Verdict
from netdesign.structure.members import REPORTED_MEMBERS
from netdesign.study.judge import judge_site
from netdesign.words.names import as_given
from tests.grid import build_cases, solve_site, wrap_results
from tests.small_site import (
    RANGES,
    ROWS,
    RUN,
    WEAK,
    build_row,
    build_site,
    name_directions,
    name_force_checks,
    resist,
)

SITE = build_site(*ROWS)


@pytest.fixture(scope="module")
def standard():
    return load_standard("nf-p-95-304-style")


def gather(results, site=SITE):
    """Envelopes of rows by their cases; more of these than rows are refused."""
    return [wrap_results(site, site.rows[0], of_row, RUN) for of_row in results]


@pytest.fixture(scope="module")
def results():
    return [of_row.results for of_row in solve_site(SITE, RUN)]


@pytest.fixture
def judge(results, standard):
    """Judge row R1 alone, with changes of the row or of its results."""

    def judge_row(of_row=None, *, site=None, **changes):
        site = site or build_site(build_row("R1", **changes))
        return judge_site(site, gather([of_row or results[0]], site), standard, RUN)

    return judge_row


def fail(result):
    return CaseResult(
        case=result.case,
        outcome=Outcome.DIVERGED,
        reason=as_given("snow flow: spoilt"),
        member_forces={},
    )


def check_of(study, check_id):
    return next(check for check in study.rows[0].checks if check.id == check_id)


def test_study_is_complete(results, standard):
    study = judge_site(SITE, gather(results), standard, RUN)
    assert study.schema == "netdesign.study/4"
    assert study.project.name == "Combe"
    assert [row.id for row in study.rows] == ["R1", "R2"]
    for row in study.rows:
        assert [check.id for check in row.checks] == [
            *name_force_checks(),
            *name_directions(),
            "post.lateral",
            "geometry.anchors",
            "geometry.inclination",
            "geometry.slope",
            "geometry.height",
        ]
        assert len(row.cases) == 9
        assert {extreme.quantity for extreme in row.member_forces} == set(
            REPORTED_MEMBERS
        )
        assert all(check.reason for check in row.checks)
        assert row.inputs[0].cell == "default"
    assert study.verdict == study.rows[0].verdict == Verdict.PASS
    assert study.rows[0].unmet == []


def test_cases_are_counted_and_listed_in_the_order_of_the_grid(results, standard):
    study = judge_site(SITE, gather(results), standard, RUN)
    cases = build_cases(RANGES)
    for of_row, row in zip(results, study.rows, strict=True):
        assert [result.case for result in of_row] == list(cases)
        densities = [record.case.density_kg_m3 for record in row.cases]
        assert densities == [270.0] * 3 + [335.0] * 3 + [400.0] * 3
        assert [record.case.friction_deg for record in row.cases] == [15, 30, 45] * 3
        assert {record.case.inclination_deg for record in row.cases} == {30.0}


def test_each_row_gets_its_own_forces(results):
    """Snow that sticks to the ground hangs less on its net."""
    free, stuck = (of_row[0].member_forces["foot_anchor"].value for of_row in results)
    assert stuck < 0.8 * free


def test_extreme_is_the_largest_of_the_cases_in_kilonewton(judge, results):
    study = judge()
    for extreme in study.rows[0].member_forces:
        forces = [r.member_forces[extreme.quantity].value for r in results[0]]
        assert extreme.value_kN == max(forces) / 1000.0
        assert extreme.low_kN <= extreme.value_kN <= extreme.high_kN
        governing = results[0][forces.index(max(forces))]
        assert extreme.case.density_kg_m3 == governing.case.density


def test_a_missing_resistance_is_named(judge):
    study = judge(resistances=resist(foot_anchor__pull_out=None))
    check = check_of(study, "foot_anchor.pull_out")
    assert study.verdict == Verdict.NOT_PROVEN
    assert check.utilisation is None
    assert check.resistance_kN is None
    assert "resistance missing: " in str(check.reason)
    assert "Anchors!B2" in str(check.reason)
    end = check_of(study, "foot_anchor.pull_out.end")
    assert end.reason == check.reason
    others = [one for one in study.rows[0].checks if one.verdict is not Verdict.PASS]
    assert others == [check, end]


def test_one_failed_case_is_a_gap_in_every_check(judge, results):
    study = judge([*results[0][:-1], fail(results[0][-1])])
    row = study.rows[0]
    assert row.verdict == Verdict.NOT_PROVEN
    for check in row.checks[:-3]:
        assert check.verdict == Verdict.NOT_PROVEN
        assert "1 of 9 cases failed (snow flow: spoilt)" in str(check.reason)
    record = row.cases[-1]
    assert (record.outcome, str(record.reason)) == (
        Outcome.DIVERGED,
        "snow flow: spoilt",
    )
    assert record.foot_anchor_kN is None
    assert record.error_percent is None


def test_without_any_result_nothing_is_proven(judge, results):
    study = judge([fail(result) for result in results[0]])
    row = study.rows[0]
    assert row.verdict == Verdict.NOT_PROVEN
    assert row.member_forces == []
    assert row.drawing is None
    assert {check.demand_kN for check in row.checks} == {None}


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(24.0, 35.0, Verdict.NOT_PROVEN), (10.0, 20.0, Verdict.FAIL)],
)
def test_range_of_inclination_is_checked(judge, low, high, verdict):
    inclination = Interval(low=math.radians(low), high=math.radians(high))
    site = build_site(
        ROWS[0],
        ranges=Ranges.of(**dict(RANGES.intervals) | {"inclination": inclination}),
    )
    study = judge(site=site)
    check = check_of(study, "geometry.inclination")
    assert check.verdict == study.verdict == verdict
    assert f"{low:g} to {high:g} degrees" in str(check.reason)
    assert check.demand_kN is None
    assert check.case is None


def test_drawing_shows_the_case_of_the_largest_utilisation(judge):
    study = judge()
    row, drawing = study.rows[0], study.rows[0].drawing
    worst = max(
        (check for check in row.checks if check.utilisation is not None),
        key=lambda check: check.utilisation,
    )
    assert drawing.case == worst.case
    assert drawing.net_m[0] == (0.0, 0.0)
    assert drawing.net_m[-1] == pytest.approx(drawing.head_m, abs=1e-4)
    assert drawing.head_m == pytest.approx(
        (2.5 * math.tan(math.radians(30)), 2.5), rel=1e-12
    )
    assert drawing.slope_deg == pytest.approx(38.0, rel=1e-12)


@pytest.mark.parametrize(
    ("low", "high", "is_noted"),
    [
        (0.4 * 917.0, 0.99 * 917.0, False),
        (0.399 * 917.0, 400.0, True),
    ],
)
def test_densities_outside_the_calibration_are_noted(judge, low, high, is_noted):
    density = Interval(low=low, high=high)
    ranges = Ranges.of(**dict(RANGES.intervals) | {"density": density})
    site = build_site(ROWS[0], ranges=ranges)
    notes = [str(note) for note in judge(site=site).notes]
    assert notes[0] == "column X was not read"
    assert len(notes) == 1 + 2 * is_noted  # and the evidence beside it
    assert all("boutillier-2004" in note for note in notes[1:])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_order_of_rows_and_cases_changes_nothing(results, standard, seed):
    rows = (
        replace(ROWS[0], resistances=resist(foot_anchor__tendon=None)),
        replace(ROWS[1], resistances=resist(post__compression=WEAK)),
    )
    straight = judge_site(build_site(*rows), gather(results), standard, RUN)
    draw = random.Random(seed)
    order = [1, 0] if seed % 2 else [0, 1]
    shuffled = [draw.sample(results[k], len(results[k])) for k in order]
    site = build_site(*(rows[k] for k in order))
    study = judge_site(site, gather(shuffled), standard, RUN)
    assert study.verdict == straight.verdict == Verdict.FAIL
    for k, row in zip(order, study.rows, strict=True):
        expected = straight.rows[k]
        assert row.verdict == expected.verdict
        assert row.checks == expected.checks
        assert row.member_forces == expected.member_forces
        assert row.drawing == expected.drawing
        assert row.unmet == expected.unmet


def test_results_must_belong_to_the_rows(results, standard):
    with pytest.raises(ValueError, match="shorter"):
        judge_site(SITE, gather(results[:1]), standard, RUN)


def test_a_site_without_rows_proves_nothing(standard):
    site = build_site()
    study = judge_site(site, solve_site(site, RUN), standard, RUN)
    assert study.rows == []
    assert study.verdict == Verdict.NOT_PROVEN


def test_provenance_is_enough_to_repeat_the_study(judge):
    provenance = judge().provenance
    assert provenance.started == "2026-01-02T03:04:05+00:00"
    assert (provenance.site_file, provenance.site_sha256) == ("site.xlsx", "0" * 64)
    assert provenance.settings["accuracy"] == "0.1"
    assert provenance.settings["creep_law"].startswith("boutillier-2004")
    assert {"python", "numpy", "scipy", "scikit-fem"} <= set(provenance.libraries)
    assert "" not in provenance.libraries.values()
