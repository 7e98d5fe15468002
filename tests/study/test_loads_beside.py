"""Maker's forces beside ours, and guideline and model side by side."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from netdesign.checks import Approval, StatedValue, load_standard
from netdesign.outcome import Verdict
from netdesign.study.judge import judge_site
from netdesign.study.member_force import find_maker_force
from netdesign.study.scopes import Scope, list_of_scope
from tests.grid import solve_site, wrap_results
from tests.small_site import ROWS, RUN, STRONG, build_row, build_site, resist

STANDARD = load_standard("nf-p-95-304-style")
BY_GUIDELINE = replace(STANDARD, is_by_guideline=True)
FORCES = {
    "foot_anchor": "foot_force",
    "uphill_anchor": "uphill_force",
    "downhill_anchor": "downhill_force",
}


@pytest.fixture(scope="module")
def results():
    return solve_site(build_site(ROWS[0]), RUN)[0].results


@pytest.fixture(scope="module")
def judge(results):
    def judge_row(standard=STANDARD, **changes):
        site = build_site(build_row("R1", **changes))
        solved = wrap_results(site, site.rows[0], results, RUN)
        return judge_site(site, [solved], standard, RUN).rows[0]

    return judge_row


def state(**forces):
    return Approval(
        **{
            FORCES[anchor]: StatedValue(value=1e3 * force, cell="Net types!H4")
            for anchor, force in forces.items()
        }
    )


def list_anchor_checks(row):
    return [
        one for one in list_of_scope(row.checks, Scope.ANCHORS) if "μ" in one.step_of
    ]


@pytest.mark.parametrize("anchor", FORCES)
def test_the_larger_of_the_makers_force_and_ours_is_the_demand(judge, anchor):
    own = judge()
    largest = max(
        one.read("E_k") for one in list_anchor_checks(own) if one.member == anchor
    )
    row = judge(approval=state(**{anchor: 1.43 * largest}))
    for before, after in zip(own.checks, row.checks, strict=True):
        if before.member != anchor or "μ" not in before.step_of:
            assert before == after or after.mode == "connection"
        elif after.position == "intermediate":
            assert after.governs == "maker"
            assert after.read("E_k") == pytest.approx(1.43 * largest, rel=1e-12)
            assert after.step_of["E_m0"].source == "Net types!H4"
            assert after.utilisation_by_model == before.utilisation_by_model
    small = judge(approval=state(**{anchor: 1e-3}))
    for before, after in zip(own.checks, small.checks, strict=True):
        assert before.utilisation == after.utilisation
        assert before.governs == after.governs


def test_at_the_end_the_makers_force_grows_with_a_wide_support_alone(judge):
    """Half a bay with its end effect, less than a bay: the maker's force as it is."""
    for gap, spacing in ((None, 3.5), (0.3, 3.5)):
        changes = {} if gap is None else {"gap": gap}
        row = judge(approval=state(foot_anchor=5e3), **changes)
        (end,) = (one for one in row.checks if one.id == "foot_anchor.tendon.end")
        width = max(end.read("b_e"), spacing)
        assert end.read("E_m") == pytest.approx(5e3 * width / spacing, rel=1e-12)


def test_a_profile_may_leave_the_makers_forces_out(judge):
    without = replace(STANDARD, has_maker_floor=False)
    stated = judge(without, approval=state(foot_anchor=9e3))
    assert stated == judge(without)
    assert not find_maker_force(build_row("R1"), STANDARD, "foot_anchor")


def test_every_anchor_shows_guideline_and_model(judge):
    for one in list_anchor_checks(judge()):
        by_model, by_guideline = one.utilisation_by_model, one.utilisation_by_guideline
        assert max(by_model, by_guideline) == pytest.approx(one.utilisation, rel=1e-12)
        design = one.read("γ_E") / one.read("R_d")
        assert by_guideline == pytest.approx(design * one.read("E_g"), rel=1e-12)


def test_the_guideline_decides_where_the_profile_says_so(judge):
    for one in list_anchor_checks(judge(BY_GUIDELINE)):
        assert one.governs == "guideline"
        assert one.utilisation == pytest.approx(one.utilisation_by_guideline, rel=1e-12)
        assert one.utilisation_by_model > 0.0
        assert one.steps[-1].symbol == "μ"


@settings(max_examples=10, deadline=None)
@given(factor=st.floats(0.3, 3.0), of_maker=st.floats(0.01, 3.0))
def test_the_smaller_demand_decides_on_nothing_but_the_models_part(
    judge, factor, of_maker
):
    """Guideline's load and maker's force stay floors; what exceeds them is marked."""
    force = judge().checks[0].read("E_k")
    changes = {
        "resistances": resist(STRONG, foot_anchor__tendon=1e3 * factor * force),
        "approval": state(foot_anchor=of_maker * force),
    }
    larger, guided = judge(**changes), judge(BY_GUIDELINE, **changes)
    for one, other in zip(larger.checks, guided.checks, strict=True):
        if "E_g" not in one.step_of:
            continue
        floors = max(one.read("E_g"), one.read("E_m") or 0.0)
        assert other.read("E_k") == pytest.approx(floors, rel=1e-12)
        assert one.read("E_k") >= other.read("E_k") * (1.0 - 1e-12)
        assert one.utilisation_by_model == other.utilisation_by_model
        assert other.exceeds_by_model == (other.utilisation_by_model > 1.0)
        if other.exceeds_by_model:
            assert one.verdict is not Verdict.PASS


def test_no_load_governs_without_a_floor(tmp_path):
    assert not BY_GUIDELINE.overrule_floor("none").is_by_guideline
    assert BY_GUIDELINE.overrule_floor("guideline").is_by_guideline
