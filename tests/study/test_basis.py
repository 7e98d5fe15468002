"""What a pass of a solved row may rest on: snow of the law, proofs, nets above snow."""

from dataclasses import replace

import pytest

from netdesign.checks import Declaration, Proof, load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Outcome, Verdict
from netdesign.snow.snowpack import Layer
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
BEARING = Declaration(
    row_id="R2",
    member="post_base",
    mode="bearing",
    proof=Proof(
        document="Report G-17",
        author="B. Rüegg",
        date="2026-03-09",
        cell="Declared!B2",
    ),
)
PULL_OUT = replace(BEARING, row_id="", member="foot_anchor", mode="pull_out")


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


def test_what_surely_fails_fails_in_light_snow_too(judge):
    study = judge(build_row("R1", resistances=resist(WEAK)), ranges=LIGHT)
    assert forces(study.rows[0])["foot_anchor.tendon"].verdict is Verdict.FAIL


# --- checks declared as proven elsewhere ---------------------------------------------


def test_a_declared_check_is_no_pass_and_neither_is_its_row(judge):
    blank = resist(post_base__bearing=None)
    rows = [build_row("R1"), build_row("R2", resistances=blank)]
    open_ = judge(*rows)
    assert [row.verdict for row in open_.rows] == [Verdict.PASS, Verdict.NOT_PROVEN]
    study = judge(*rows, declared=(BEARING,))
    assert study.verdict is Verdict.DECLARED
    assert [row.verdict for row in study.rows] == [Verdict.PASS, Verdict.DECLARED]
    check = forces(study.rows[1])["post_base.bearing"]
    assert check.verdict is Verdict.DECLARED
    assert check.declared.document == "Report G-17"
    assert check.declared.cell == "Declared!B2"
    assert "resistance missing" in str(check.reason)
    assert check.demand_kN == forces(open_.rows[1])["post_base.bearing"].demand_kN
    assert "Report G-17" in str(check.reason)


def test_a_declaration_of_all_rows_holds_in_each_and_hides_no_pass(judge):
    study = judge(build_row("R1"), build_row("R2"), declared=(PULL_OUT,))
    for row in study.rows:
        declared = [k for k, c in forces(row).items() if c.verdict is Verdict.DECLARED]
        assert declared == ["foot_anchor.pull_out", "foot_anchor.pull_out.end"]
        assert row.verdict is Verdict.DECLARED


@pytest.mark.parametrize(
    ("position", "expected"),
    [
        ("", ["foot_anchor.pull_out", "foot_anchor.pull_out.second"]),
        ("edge", ["foot_anchor.pull_out.end"]),
    ],
)
def test_an_end_of_another_type_is_declared_by_its_own_line(judge, position, expected):
    ends = tuple(replace(one, type_id="T2") for one in resist())
    row = build_row("R1", end_resistances=ends)
    study = judge(row, declared=(replace(PULL_OUT, position=position),))
    checks = forces(study.rows[0])
    declared = [k for k, c in checks.items() if c.verdict is Verdict.DECLARED]
    assert declared == expected
    assert {c.verdict for k, c in checks.items() if k not in declared} == {Verdict.PASS}


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


def test_layers_of_an_overtopped_net_keep_their_proportions():
    layers = (Layer(thickness=1.5, density=420.0), Layer(thickness=1.0, density=310.0))
    row = build_row("R1", net_height=2.0, layers=layers)
    held = row.layers_at(row.mean_density)
    assert [layer.thickness for layer in held] == pytest.approx([1.2, 0.8])
    assert [layer.density for layer in held] == pytest.approx([420.0, 310.0])


@pytest.mark.parametrize(
    ("height", "expected"), [(2.5 * (1 - 0.9e-6), False), (2.5 * (1 - 1.1e-6), True)]
)
def test_a_net_counts_as_overtopped_beyond_rounding_only(height, expected):
    row = build_row("R1", net_height=height)
    assert row.is_overtopped is expected
    assert row.held_thickness == (height if expected else 2.5)
