"""Checks beyond 1: they fail where they do at the best ends of what is assumed, too."""

import math
from dataclasses import replace

import pytest

from netdesign.checks import OpenKind, load_standard
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.outcome import Verdict
from netdesign.panel.inputs import STIFFNESSES, list_panels
from netdesign.site.assumed import assume
from netdesign.structure.splay import Guys
from netdesign.study.cases import search_site
from netdesign.study.judge import judge_row
from netdesign.study.row_to_check import (
    CaseSolver,
    list_variants,
    place_variant,
    read_values,
)
from tests.small_site import (
    RANGES,
    RUN,
    build_row,
    build_site,
    list_net_parts,
    resist,
)
from tests.study.test_variants import KEYS, assume_all

STANDARD = load_standard("swiss-guideline-2007")
SLACK = assume("slack")
ROW = build_row("R1", resistances=resist(1.1e5))
OF_SLACK = replace(ROW, assumed=(SLACK,))
WORSE = (Verdict.PASS, Verdict.NOT_PROVEN, Verdict.FAIL)


def judge(row, slack):
    """Study of a row over a range of its slack, or at one value of it."""
    low, high = slack
    span = ("slack", Interval(low=low, high=high))
    site = build_site(row, ranges=Ranges(intervals=(*RANGES.intervals, span)))
    (solved,) = search_site(site, RUN)
    solver = CaseSolver(RUN.settings, RUN.creep_law)
    return judge_row(site, row, solved, STANDARD, RUN, solver)


def index(study):
    return {one.id: one for one in study.checks}


@pytest.fixture(scope="module")
def of_slack():
    return index(judge(OF_SLACK, (SLACK.low, SLACK.high)))


@pytest.fixture(scope="module")
def typed():
    """Checks at some values of the slack."""
    return [index(judge(ROW, (x, x))) for x in (SLACK.low, 0.035, 0.07, SLACK.high)]


def list_decided(checks):
    """What decides, by check: the text with its numbers."""
    found = {
        check.id: point.message.arguments
        for check in checks.values()
        for point in check.open
        if point.kind is OpenKind.ASSUMED_DECIDES
        and point.message.key.startswith("check.assumed_decides")
    }
    return {key: (one["at"], one["bound"]) for key, one in found.items()}


def test_the_sentence_says_on_which_side_a_check_passes(of_slack):
    row = assume_all(build_row("R1", resistances=resist(2.2e5)), KEYS[:3])
    seen = set()
    for check in [*of_slack.values(), *index(judge(row, (0.05, 0.05))).values()]:
        for key, one in ((x.message.key, x.message.arguments) for x in check.open):
            if key.startswith("check.assumed_decides"):
                side = one["bound"].arguments["value"] < one["at"].arguments["value"]
                assert side == key.endswith("_up_to"), check.id
                seen.add(side)
    assert seen == {True, False}


def test_what_fails_fails_whatever_the_value_is(of_slack, typed):
    failing = [one.id for one in of_slack.values() if one.verdict is Verdict.FAIL]
    assert len(failing) > 4
    for one in failing:
        assert {checks[one].verdict for checks in typed} == {Verdict.FAIL}, one


def test_no_check_is_better_than_with_a_value(of_slack, typed):
    for checks in typed:
        for one in checks.values():
            worst = of_slack[one.id]
            assert WORSE.index(one.verdict) <= WORSE.index(worst.verdict) or (
                one.verdict is Verdict.FAIL and worst.verdict is Verdict.NOT_PROVEN
            )
            high = one.utilisation_band[1]
            if high is not None:
                assert high <= 1.003 * worst.utilisation_band[1], one.id


@pytest.mark.parametrize("held", [0.9e5, 1.25e5, 1.4e5])
def test_a_row_whose_posts_nobody_counts_fails_only_where_a_long_one_does(held):
    """It is used as the worst of few posts, and eased as a row of many."""
    row = build_row("R1", resistances=resist(held))
    few, many, nobody = (
        index(judge(replace(row, post_count=count), (0.05, 0.05)))
        for count in (2, 40, None)
    )
    for name, check in many.items():
        if check.verdict is not Verdict.FAIL:
            assert nobody[name].verdict is not Verdict.FAIL, name
    for name, check in few.items():
        if check.used is not None and name in nobody:
            assert check.used <= (nobody[name].used or 0.0) * (1.0 + 1e-9), name


def test_the_value_that_decides_is_told_and_does(of_slack):
    decided = list_decided(of_slack)
    assert len(decided) > 1
    for key, (at, bound) in list(decided.items())[:3]:
        check = of_slack[key]
        assert check.verdict is Verdict.NOT_PROVEN
        low, high = check.utilisation_band
        assert low < 1.0 < high
        assert at.arguments["value"] in (SLACK.low, SLACK.high)
        value = bound.arguments["value"]
        assert SLACK.low < value < SLACK.high
        found = index(judge(ROW, (value, value)))[key]
        assert found.utilisation_band[1] <= 1.03  # of the case that governs


def test_statics_that_decide_are_told_by_all_cases():
    row = build_row("R1", resistances=resist(2.2e5))
    row = assume_all(row, KEYS[:3])
    checks = index(judge(row, (0.05, 0.05)))
    decided = list_decided(checks)
    assert decided
    corners = [(one, index(judge(one, (0.05, 0.05)))) for one in list_variants(row)]
    for key, (_, bound) in decided.items():
        worst, _ = max(corners, key=lambda one: one[1][key].utilisation)
        values = read_values(worst)
        name = next(
            point.message.arguments["name"]
            for point in checks[key].open
            if point.kind is OpenKind.ASSUMED_DECIDES
        )
        column = name.key.rpartition(".")[2]
        value = bound.arguments["value"]
        values[column] = math.radians(value) if "tilt" in column else value
        alone = index(judge(place_variant(row, values), (0.05, 0.05)))[key]
        assert alone.utilisation_band[1] <= 1.0 + 1e-3, key


@pytest.mark.parametrize("key", [KEYS[0], KEYS[1], KEYS[2], "guy_splay"])
def test_a_value_of_the_statics_that_decides_alone_is_told(key):
    """Whatever its ends are: those of the splay are no sums of each other in binary."""
    guys = Guys(count=2, splay=math.radians(17.0), are_shared=True)

    def judge_held(held):
        row = build_row("R1", resistances=resist(held), guys=guys)
        row = assume_all(row, [key])
        return [index(judge(one, (0.05, 0.05))) for one in (row, *list_variants(row))]

    _, low, high = judge_held(1e5)
    used = {
        name: sorted(checks[name].utilisation_band[1] for checks in (low, high))
        for name in low
        if name.endswith("tendon")
    }
    name = max(used, key=lambda each: used[each][1] / used[each][0])
    least, most = used[name]
    assert most > 1.03 * least
    check = judge_held(1e5 * math.sqrt(least * most))[0][name]
    told = {one.message.key: one.message.arguments for one in check.open}
    deciding = told.get("check.assumed_decides") or told["check.assumed_decides_up_to"]
    assert deciding["name"].key.endswith(key)


PANELS = list_panels(
    3.5,
    sags=(None, None),
    stiffnesses=(STIFFNESSES, STIFFNESSES),
    has_mid_anchors=False,
)[::4]


def test_what_fails_fails_with_every_panel_that_is_assumed():
    row = build_row(
        "R1",
        resistances=resist(1.6e5),
        panels=PANELS,
        net_parts=list_net_parts(6e4, has_ropes=True),
    )
    assumed = index(judge(row, (0.05, 0.05)))
    alone = [
        index(judge(replace(row, panels=(one,)), (0.05, 0.05))) for one in PANELS[::2]
    ]
    failing = [key for key, one in assumed.items() if one.verdict is Verdict.FAIL]
    assert any("rope" in key for key in failing)
    for checks in alone:
        for key in failing:
            assert checks[key].verdict is Verdict.FAIL, key
        for key, one in checks.items():
            if one.verdict is not Verdict.PASS:
                assert assumed[key].verdict is not Verdict.PASS, key
    beyond = [one for one in assumed.values() if one.eased is not None]
    assert any(one.verdict is Verdict.NOT_PROVEN for one in beyond)
