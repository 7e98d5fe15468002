"""What a pass of a solved row may rest on: snow of the law, proofs, nets above snow."""

from dataclasses import replace

import pytest

from netdesign.checks import load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Outcome, Verdict
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CaseSolver
from tests.grid import solve_site
from tests.small_site import (
    RANGES,
    RUN,
    STRONG,
    WEAK,
    build_row,
    build_site,
    name_directions,
    name_force_checks,
    resist,
)

LAW = RUN.creep_law.name
LIGHT = Ranges.of(
    **dict(RANGES.intervals) | {"density": Interval(low=213.0, high=287.0)}
)
SEARCHED = replace(RANGES)


@pytest.fixture(scope="module")
def standard():
    return load_standard("nf-p-95-304-style")


@pytest.fixture
def judge(standard):
    def judge_rows(*rows, solver=None, **changes):
        site = build_site(*rows, **changes)
        solve = search_site if site.ranges is SEARCHED else solve_site
        return judge_site(site, solve(site, RUN), standard, RUN, solver)

    return judge_rows


def forces(row):
    """Checks of forces by id."""
    return {check.id: check for check in row.checks if check.member != "net"}


# --- snow that the creep law is not given for ----------------------------------------


def test_light_snow_is_used_and_what_other_laws_change_is_listed(judge):
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    study = judge(build_row("R1"), ranges=LIGHT, solver=solver)
    assert study.verdict is Verdict.PASS
    notes = {note.key: note for note in study.notes}
    assert notes["note.outside_calibration"].arguments["law"] == LAW
    form, told = study.rows[0].model_form, notes["note.other_laws"].arguments
    assert told["low"] == pytest.approx(100.0 * (form.ratios[0] - 1.0))
    assert told["high"] == pytest.approx(100.0 * (form.ratios[1] - 1.0))
    assert any("within a factor of 7" in str(note) for note in study.notes)


@pytest.mark.parametrize("used", [0.999, 0.25])
def test_a_row_that_another_law_would_turn_is_named(judge, used):
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    tried = build_row("R1", resistances=resist(foot_anchor__tendon=2e5))
    checks = forces(judge(tried, ranges=LIGHT).rows[0]).items()
    tendons = [x for name, x in checks if name.startswith("foot_anchor.tendon")]
    given = 2e5 * max(x.utilisation for x in tendons) / used
    row = build_row("R1", resistances=resist(foot_anchor__tendon=given))
    study = judge(row, ranges=LIGHT, solver=solver)
    turned = [note for note in study.notes if note.key == "note.turned_by_law"]
    form = study.rows[0].model_form
    assert bool(turned) is (form.utilisation <= 1.0 < form.utilisation * form.ratios[1])
    assert bool(turned) is (used > 0.9)


# --- checks declared as proven elsewhere ---------------------------------------------


# --- snow above the net --------------------------------------------------------------


def test_forces_of_an_overtopped_net_are_those_of_snow_up_to_its_head(judge):
    buried = judge(build_row("R1", net_height=2.2)).rows[0]
    level = judge(build_row("R1", net_height=2.2, snow_thickness=2.2)).rows[0]
    assert {case.outcome for case in buried.cases} == {Outcome.CONVERGED}
    assert buried.forces == level.forces
    assert level.verdict is Verdict.PASS
    assert buried.verdict is Verdict.FAIL
    assert buried.drawing.snow_thickness_m == 2.2
    (height,) = (one for one in buried.checks if one.id == "geometry.height")
    assert height.verdict is Verdict.FAIL


@pytest.mark.parametrize("ranges", [RANGES, SEARCHED], ids=["grid", "search"])
@pytest.mark.parametrize("strength", [STRONG, WEAK])
def test_an_overtopped_row_leaves_its_forces_open_and_the_others_alone(
    judge, strength, ranges
):
    low = build_row("R1", net_height=2.2, resistances=resist(strength))
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    study = judge(low, build_row("R2"), ranges=ranges, solver=solver)
    first, second = study.rows
    assert first.verdict is study.verdict is Verdict.FAIL
    count = len(name_force_checks()) + len(name_directions())
    assert len(forces(first)) == count + 1  # and the load along the row
    for check in forces(first).values():
        assert check.verdict is Verdict.NOT_PROVEN
        if check.mode != "direction":  # of a force beyond what a rope anchor turns by
            assert (check.utilisation is None) is (check.mode == "lateral")
        assert "snow overtops the net" in str(check.reason)
        assert check.changes == []
    assert second.verdict is Verdict.PASS


@pytest.mark.parametrize(
    ("height", "expected"), [(2.5 * (1 - 0.9e-6), False), (2.5 * (1 - 1.1e-6), True)]
)
def test_a_net_counts_as_overtopped_beyond_rounding_only(height, expected):
    row = build_row("R1", net_height=height)
    assert row.is_overtopped is expected
    assert row.held_thickness == (height if expected else 2.5)
