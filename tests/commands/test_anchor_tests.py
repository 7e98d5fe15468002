"""``netdesign tests``: a plan from a study, its form, and the form filled in."""

import openpyxl
import pytest

from netdesign.checks import load_standard
from netdesign.site.reader import read_site
from netdesign.site.template.form import build_form, read_form
from netdesign.study.planned_tests import STEPS, plan_tests
from tests.checks.given_pulls import study_row
from tests.digits import write_force
from tests.study.test_pull_out_tests import ROW, STEEL

HELD = {"en": "held", "fr": "tenu", "de": "gehalten"}
LOADS = (310.0, 290.0, 330.0)


@pytest.fixture
def planned(tmp_path):
    row = ROW | {"anchor": STEEL | {"ground": "till"}}
    study = study_row(tmp_path, "eurocode", **row)
    site = read_site(tmp_path / "site.xlsx")
    return study, plan_tests(study, site, load_standard("eurocode"))


def build(language="en", count=3):
    line = {"type": "A", "ground": "till", "proof_load": 300.0}
    return build_form([line] * count, [("R", 217.4)] * count, STEPS, language)


def fill(path, language, results=(None, None, None)):
    path.write_bytes(build(language))
    book = openpyxl.load_workbook(path)
    sheet = book.worksheets[0]
    for row, (load, result) in enumerate(zip(LOADS, results, strict=True), 2):
        sheet.cell(row, 3).value = load
        sheet.cell(row, 4).value = result or HELD[language]
    book.save(path)
    return book, sheet


def test_a_plan_has_the_largest_force_and_the_wanted_number(planned):
    """1.20 on the mean of three held tests, 1.15 on the resistance."""
    study, (tests, open_points) = planned
    (one,) = tests
    assert open_points == []
    forces = [
        check.read_band("E_d")[1]
        for check in study.rows[0].checks
        if check.mode == "pull_out" and check.resistance_type
    ]
    assert (one.type_id, one.ground, one.rows) == ("A", "till", ("R",) * 3)
    assert one.force == max(forces)
    assert one.proof_load == pytest.approx(1.2 * 1.15 * max(forces), rel=1e-12)
    assert one.steel == 500.0
    assert not one.is_beyond_steel


def test_as_many_held_tests_as_planned_prove_the_anchor(tmp_path, planned):
    _, ((one,), _) = planned
    load = one.proof_load * (1.0 + 1e-9)
    study = study_row(tmp_path, "eurocode", tests=[(load, "held", None)] * 3, **ROW)
    ratios = [
        check.utilisation_band[1]
        for check in study.rows[0].checks
        if check.mode == "pull_out" and check.tests
    ]
    assert max(ratios) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("language", HELD)
def test_a_form_is_read_as_it_was_filled_in(tmp_path, language):
    path = tmp_path / "form.xlsx"
    fill(path, language)
    rows, still_open = read_form(path)
    assert still_open == 0
    assert [row["force"].number for row in rows] == list(LOADS)
    assert {row["result"].word for row in rows} == {"held"}
    assert {row["ground"].word for row in rows} == {"till"}
    assert {row["proof_load"].number for row in rows} == {300.0}


def test_a_form_may_be_filled_in_by_and_by(tmp_path, call):
    book, sheet = fill(tmp_path / "form.xlsx", "en")
    for cell in ("C3", "D3"):
        sheet[cell] = None
    book.save(tmp_path / "form.xlsx")
    rows, still_open = read_form(tmp_path / "form.xlsx")
    assert (len(rows), still_open) == (len(LOADS) - 1, 1)
    ended = call("tests", "form.xlsx")
    assert ended.code == 0
    assert "not filled in yet: 1" in ended.out


def test_a_form_tells_resistance_acceptance_and_lines(tmp_path, call):
    fill(tmp_path / "form.xlsx", "en", ("held", "pulled out", "held"))
    ended = call("tests", "form.xlsx", "--standard", "eurocode")
    assert ended.code == 0
    assert "3 tests, 2 held, 2 held the planned proof load" in ended.out
    r_k = min(310.0 / 1.2, 290.0 / 1.05)
    assert f"R_k = {write_force(r_k)} kN by correlation factors" in ended.out
    assert "used in the check" in ended.out
    assert "two tests that pulled out" in ended.out
    assert "A\ttill\t290\tpulled out\t300\t" in ended.out


def test_faults_of_a_form_are_told_all_at_once(tmp_path, call):
    book, sheet = fill(tmp_path / "form.xlsx", "en")
    sheet["C2"], sheet["D3"], sheet["D4"] = "much", "perhaps", None
    book.save(tmp_path / "form.xlsx")
    ended = call("tests", "form.xlsx")
    assert ended.code == 3
    for place in ("C2", "D3", "D4"):
        assert place in ended.err
    assert "G1" not in ended.err  # the form's own columns are no fault


def test_an_empty_form_is_none(tmp_path, call):
    (tmp_path / "form.xlsx").write_bytes(build(count=0))
    ended = call("tests", "form.xlsx")
    assert ended.code == 3
    assert "no test is filled in" in ended.err


def test_a_form_is_no_output_of_a_site(call, planned):
    ended = call("tests", "site.xlsx", "--out", "form.xlsx")
    assert ended.code == 2


def test_a_plan_without_a_study_says_how_to_get_one(tmp_path, call, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ended = call("tests", "site.xlsx", "--plan")
    assert ended.code == 3
    assert "run 'netdesign check site.xlsx' first" in ended.err
