"""Limits of single values: against closed forms, with made-up forces."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import Band
from netdesign.envelope.parameters import PARAMETERS
from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.site.columns.all_tables import FURTHER_QUANTITIES
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.study.check_by_case import CheckByCase
from netdesign.study.margins import find_margins, list_spans
from tests.each import each
from tests.small_site import build_row

RANGES = Ranges.of(
    density=Interval(low=263.0, high=391.0),
    friction_angle=Interval(low=0.31, high=0.72),
    inclination=Interval(low=0.52, high=0.52),
)
ROW = build_row(
    "R",
    snow_thickness=2.47,
    upslope_length=13.3,
    ground=build_ground_from_glide_factor(1.62, 2.47),
    glide_factor=1.62,
    net_height=3.1,
    net_stiffness_per_m=7.3e6,
    slack=0.037,
    resistances=(),
)
GOVERNING = Case(density=391.0, friction_angle=0.72, inclination=0.52)
RIVAL = Case(density=391.0, friction_angle=0.31, inclination=0.52)
OTHER = Case(density=263.0, friction_angle=0.31, inclination=0.52)


def _loosen(slack: float) -> float:
    """Share of a slack, finite at none, 1 as the row is."""
    return (slack + 0.004) / 0.041


def _slack_of(share: float) -> float:
    return 0.041 * share - 0.004


def tauter(row: NetRow, case: Case) -> dict[str, float]:
    """Foot: 1 N as the row is, more with a tauter and stiffer net; post the reverse."""
    at = row.at(case)
    foot = _loosen(at.slack) ** -0.21 * (at.net_stiffness_per_m / 7.3e6) ** 0.13
    foot *= (at.snow_thickness / 2.47) ** 2.1 * (at.glide_factor / 1.62) ** 1.2
    share = {GOVERNING.density: 1.0, OTHER.density: 0.6}.get(case.density, 1.0)
    share *= 1.0 if case.friction_angle == 0.72 else 0.95
    return {"foot_anchor": foot * share, "post": share / foot}


def never(*_):
    return False


def alone(*_):
    """No end effect."""
    return 1.0


class MadeUpSolver:
    """Stands for the coupled solve; solves each case once, like a solver."""

    def __init__(self, forces=tauter, fails=never):
        self.count, self._forces, self._fails = 0, forces, fails
        self._known, self.law = {}, BOUTILLIER_2004

    def solve_all(self, wanted):
        return [self._solve(row, case) for row, case, _ in wanted]

    def _solve(self, row, case):
        if (row, case) not in self._known:
            self.count += 1
            self._known[row, case] = a_result(self._forces, self._fails, row, case)
        return self._known[row, case]


def a_result(forces, fails, row, case):
    if fails(row, case):
        return CaseResult(
            case=case, outcome=Outcome.DIVERGED, reason="spoilt", member_forces={}
        )
    bands = {
        name: Band(low=force, value=force, high=force)
        for name, force in forces(row, case).items()
    }
    return CaseResult(case=case, outcome=Outcome.CONVERGED, member_forces=bands)


def a_check(used, member="foot_anchor", forces=tauter, row=ROW, ranges=RANGES):
    cases = (GOVERNING, RIVAL, OTHER)
    return CheckByCase(
        row=row,
        ranges=ranges,
        member=member,
        scale=used,
        governing=GOVERNING,
        results=[a_result(forces, never, row, case) for case in cases],
    )


def margin_of(check, quantity, solver=None, widen=alone):
    held = replace(check, widen=widen)
    found = find_margins(held, solver or MadeUpSolver(), {})
    return next(one for one in found if one.quantity == quantity)


def read_glide_factor(ranges):
    is_moved = "glide_factor" in ranges.further
    return ranges["glide_factor"].high if is_moved else ROW.glide_factor


@pytest.mark.parametrize("used", [0.86, 0.91, 0.97])
def test_a_pass_holds_down_to_the_slack_at_which_a_power_law_turns(used):
    margin = margin_of(a_check(used), "slack")
    exact = _slack_of(used ** (1.0 / 0.21))
    assert exact <= margin.least < 0.037
    at = used * _loosen(margin.least) ** -0.21
    assert 0.92 <= at <= 1.0
    assert margin.most is None
    assert (margin.low, margin.high) == (0.0, pytest.approx(0.137))


@pytest.mark.parametrize("used", [0.83, 0.9])
def test_the_other_member_turns_on_the_other_side(used):
    """Slack and stiffness act oppositely on foot and post."""
    foot, post = (
        margin_of(a_check(used, member), "thickness_m")
        for member in ("foot_anchor", "post")
    )
    assert foot.most == pytest.approx(2.47 * used ** (-1.0 / 2.1), rel=0.04)
    assert post.least == pytest.approx(2.47 * used ** (1.0 / 2.1), rel=0.04)
    assert foot.least is post.most is None


def test_limits_are_rounded_to_the_passing_side():
    margin = margin_of(a_check(0.93), "stiffness_kN_per_m")
    exact = 7300.0 * 0.93 ** (-1.0 / 0.13)
    assert margin.most <= exact
    assert margin.most == float(f"{margin.most:.3g}")
    assert margin.now == 7300.0


@pytest.mark.parametrize("exact", [4.4e-6, 2.3e-5, 0.00113])
def test_no_limit_is_told_finer_than_a_thousandth_of_its_search(exact):
    """A slack of 4e-6 is no number that anybody builds."""
    margin = margin_of(a_check(_loosen(exact) ** 0.21), "slack")
    assert exact <= margin.least == round(margin.least, 4)
    assert margin.least == pytest.approx(exact, abs=0.003)


@pytest.mark.parametrize("used", [1.04, 1.2])
def test_a_fail_would_pass_below_a_thickness_and_above_a_slack(used):
    check = a_check(used)
    thickness = margin_of(check, "thickness_m")
    assert thickness.most <= 2.47 * used ** (-1.0 / 2.1)
    assert thickness.most == pytest.approx(2.47 * used ** (-1.0 / 2.1), rel=0.04)
    assert thickness.least is None
    slack = margin_of(check, "slack")
    exact = _slack_of(used ** (1.0 / 0.21))
    assert slack.most is None
    assert slack.least is not None
    assert slack.least >= exact


def test_nothing_in_reach_is_no_limit():
    margin = margin_of(a_check(4.0), "slack")
    assert (margin.least, margin.most) == (None, None)
    assert margin_of(a_check(0.2), "upslope_length_m").least is None


def test_the_end_effect_that_grows_with_glide_brings_the_limit_nearer():
    plain = margin_of(a_check(0.85), "glide_factor")
    wide = margin_of(a_check(0.85), "glide_factor", widen=read_glide_factor)
    assert plain.most == pytest.approx(1.62 * 0.85 ** (-1 / 1.2), rel=0.05)
    assert wide.most == pytest.approx(1.62 * 0.85 ** (-1 / 2.2), rel=0.05)


def test_a_rival_that_overtakes_is_confirmed_too():
    """With less slack the rival's force grows faster: it sets the limit."""

    def crossing(row, case):
        power = -0.6 if case.friction_angle == 0.31 else -0.2
        share = 0.6 if case.density == 263.0 else 1.0
        near = 0.97 if case.friction_angle == 0.31 else 1.0
        force = share * near * _loosen(row.at(case).slack) ** power
        return {"foot_anchor": force}

    check = a_check(0.8, forces=crossing)
    margin = margin_of(check, "slack", MadeUpSolver(crossing))
    worst = max(crossing(ROW, case.with_value("slack", margin.least))["foot_anchor"]
                for case in (GOVERNING, RIVAL))  # fmt: skip
    assert 0.8 * worst <= 1.0


def test_the_guidelines_load_limits_what_the_coupled_solve_would_allow():
    """A floor of 0.9 that rises with the thickness to the power of three."""

    def use_floor(ranges):
        is_moved = "thickness" in ranges.further
        return 0.9 * (ranges["thickness"].high / 2.47 if is_moved else 1.0) ** 3

    floor = replace(a_check(0.6), use_floor=use_floor)
    margin = margin_of(floor, "thickness_m")
    assert margin.most <= 2.47 * 0.9 ** (-1 / 3)
    assert margin.most == pytest.approx(2.47 * 0.9 ** (-1 / 3), rel=0.03)
    assert margin_of(a_check(0.6), "thickness_m").most is None


def test_a_case_without_a_result_gives_no_limit_and_says_so():
    solver = MadeUpSolver(fails=lambda row, case: row.at(case).slack < 0.02)
    margin = margin_of(a_check(0.9), "slack", solver)
    assert (margin.least, margin.low) == (None, 0.037)
    assert "without a result" in str(margin.note)


def test_only_what_does_not_range_is_moved():
    names = [span.name for span in list_spans(ROW, RANGES)]
    assert names == [
        "inclination", "thickness", "upslope_length", "slack", "net_stiffness",
        "glide_factor",
    ]  # fmt: skip
    wider = Ranges.of(
        **dict(RANGES.intervals),
        snow_height=Interval(low=2.1, high=3.3),
        slip_length=Interval(low=0.4, high=2.9),
    )
    left = [span.name for span in list_spans(ROW, wider)]
    assert left == ["inclination", "upslope_length", "slack", "net_stiffness"]
    slip = replace(ROW, glide_factor=None)
    assert list_spans(slip, RANGES)[-1].name == "slip_length"
    rough = replace(slip, ground=GroundLaw(kind="no-slip"))
    assert list_spans(rough, RANGES)[-1].name == "net_stiffness"


def test_every_quantity_of_a_workbook_has_a_limit_where_it_does_not_range():
    """One name of each quantity, whichever the row was given by."""
    slips = replace(ROW, glide_factor=None)
    names = {span.name for row in (ROW, slips) for span in list_spans(row, RANGES)}
    further = {one.key for one in FURTHER_QUANTITIES}
    assert further - names == {"snow_height"}  # its thickness has


def test_every_search_holds_what_is_given():
    for span in list_spans(ROW, RANGES):
        assert span.low <= span.now <= span.high
        assert span.low < span.high
        assert PARAMETERS[span.name].show(span.now) > 0.0


def test_a_moved_case_drops_the_other_name_of_the_quantity():
    case = Case.of({**GOVERNING.values, "snow_height": 3.0, "slack": 0.02})
    moved = case.with_value("thickness", 2.2)
    assert dict(moved.others) == {"slack": 0.02, "thickness": 2.2}
    assert moved.density == GOVERNING.density
    assert math.isclose(ROW.at(moved).snow_thickness, 2.2)


MIDDLE = Case(density=391.0, friction_angle=0.5, inclination=0.52)


def apart(row, case):
    """Foot largest with much friction, post with little, both 0.9 of it between."""
    lean = {0.72: (1.0, 0.7), 0.5: (0.9, 0.91), 0.31: (0.69, 1.0)}
    foot, post = lean[case.friction_angle]
    at = row.at(case)
    grown = (at.snow_thickness / 2.47) ** 2.2 * _loosen(at.slack) ** -0.2
    # cases grow apart by as much as was seen of others
    way = math.log(at.snow_thickness / 2.47)
    grown *= math.exp(0.03 * way * (case.friction_angle - 0.5))
    return {"foot_anchor": foot * grown, "post": post * grown}


def an_apart(used, member, governing):
    cases = (GOVERNING, MIDDLE, RIVAL)
    return CheckByCase(
        row=ROW,
        ranges=RANGES,
        member=member,
        scale=used,
        governing=governing,
        results=[a_result(apart, never, ROW, case) for case in cases],
    )


@each("used", [0.57, 0.83, 0.94, 0.99, 1.03, 1.21])
@each("member, at", [("foot_anchor", GOVERNING), ("post", RIVAL)])
def test_a_limit_holds_in_every_case(used, member, at):
    """Told on the passing side, not far from where the check turns."""
    check = an_apart(used, member, at)
    margin = margin_of(check, "thickness_m", MadeUpSolver(apart))
    most = used * max(
        apart(ROW, one.case.with_value("thickness", margin.most or ROW.net_height))[
            member
        ]
        for one in check.results
    )
    assert most <= 1.0
    if margin.most is not None:
        assert most > 0.9
    else:
        assert used < 0.9


@pytest.mark.parametrize(("used", "told"), [(0.93, 2.53), (1.17, 2.29)])
def test_what_a_change_told_is_no_more_looked_for(used, told):
    check, solvers = a_check(used), [MadeUpSolver(), MadeUpSolver()]
    plain, known = (
        next(
            one
            for one in find_margins(check, solver, values)
            if one.quantity == "thickness_m"
        )
        for solver, values in zip(solvers, ({}, {"thickness": told}), strict=True)
    )
    assert known.most == told
    assert plain.most == pytest.approx(told, rel=0.02)
    assert (known.least, known.low, known.high) == (plain.least, plain.low, plain.high)
    assert solvers[1].count < solvers[0].count
    wrong_side = find_margins(check, MadeUpSolver(), {"thickness": 2.47})
    most = next(one.most for one in wrong_side if one.quantity == "thickness_m")
    assert most == plain.most
