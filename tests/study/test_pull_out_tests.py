"""Pull-out tests of sheet Tests, from the workbook to the judged study."""

import pytest

from netdesign.report.sections.schedule import list_anchors, show_tests
from netdesign.report.words import Words
from tests.checks.given_pulls import study_row

STEEL = {"kind": "rope anchor", "tendon": 500}
ROW = {
    "anchor": STEEL,
    "foot": (20.0, 18.0),
    "head": (5.0, -22.0),
    "gap": 0.5,
}
TESTS = [
    (300.0, "pulled out", 250.0),
    (340.0, "held", 340.0),
    (360.0, "pulled out", None),
]


def judge(tests=TESTS):
    study = study_row("eurocode", tests=tests, **ROW)
    checks = {check.id: check for check in study.rows[0].checks}
    return study, checks["foot_anchor.pull_out"]


def test_mean_and_least_count_each_over_its_factor():
    _, check = judge()
    expected = min(1000.0 / 3 / 1.2, 300.0 / 1.05)
    assert check.read("R_k") == pytest.approx(expected, rel=1e-12)


def test_a_result_left_out_never_helps():
    _, known = judge()
    for left_out in range(len(TESTS)):
        tests = [
            (load, None if k == left_out else result, proof)
            for k, (load, result, proof) in enumerate(TESTS)
        ]
        _, check = judge(tests)
        assert check.read("R_k") <= known.read("R_k") * (1 + 1e-12)


def test_held_tests_alone_give_lower_bounds():
    tests = [(300.0, "held", None)] * 3
    study, check = judge(tests)
    assert check.read("R_k") == pytest.approx(250.0)
    (singles,) = show_tests(study, Words("en"))
    assert len(singles.rows) == 3
    assert all("lower bound" in line[5].text for line in singles.rows)


def test_acceptance_follows_load_result_and_design_force():
    study, check = judge()
    wanted = 1.2 * 1.15 * check.read_band("E_d")[1]
    (singles,) = show_tests(study, Words("en"))
    assert wanted <= float(singles.rows[0][6].text) < wanted + 1.0
    assert [line[-1].text for line in singles.rows] == ["no", "yes", "no"]
    low = [(0.9 * wanted, "held", None), (1.1 * wanted, "held", 1.2 * wanted)]
    low.append((1.1 * wanted, None, None))
    study, _ = judge(low)
    (singles,) = show_tests(study, Words("en"))
    assert [line[-1].text for line in singles.rows] == ["no", "no", "open"]


def test_a_tendon_that_bears_less_than_the_ground_holds_is_told():
    """500 kN, loop 0.8, factor 1.5: 266.7 kN; five tests of 320 over 1.15: 278.3 kN."""
    strong = [(320.0, "held", None)] * 5
    for tests, is_told in ((strong, True), (TESTS, False)):
        study = study_row("eurocode", tests=tests, **ROW)
        lines = [x for x in list_anchors(study) if x.member == "foot_anchor"]
        assert ["weak" in line.notes for line in lines] == [is_told]
        if is_told:
            checks = {check.id: check for check in study.rows[0].checks}
            tendon = checks["foot_anchor.tendon"].read("R_d")
            assert tendon == pytest.approx(500 * 0.8 / 1.5)
            ground = checks["foot_anchor.pull_out"].read("R_d")
            assert ground == pytest.approx(320.0 / 1.15)


def judge_typed(**typed):
    anchor = STEEL | {"pull_out": 330} | typed
    study = study_row("eurocode", **(ROW | {"anchor": anchor}))
    return next(c for c in study.rows[0].checks if c.id == "foot_anchor.pull_out")


def test_a_tested_number_without_a_count_is_that_of_one_test():
    """1.40 for one test, by mean and least alike."""
    check = judge_typed(proven="tests")
    assert check.read("R_k") == pytest.approx(330.0 / 1.4)
    assert (check.tests.count, check.resistance_cell) == (1, "Anchors!A, pull_out")


def test_a_value_by_a_report_without_its_name_is_that_of_a_calculation():
    """A report that sheet Declared does not name proves no more than an empty cell."""
    checks = [judge_typed(proven=how) for how in ("report", "calculated", "")]
    assert {check.resistance_basis for check in checks} == {"computed"}
    assert len({(check.verdict, check.utilisation) for check in checks}) == 1
