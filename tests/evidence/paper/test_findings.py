"""Each call follows from numbers: studies made so that the answer is known."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.evidence.paper.findings import (
    Growth,
    count_swings,
    judge_growth,
    last_swing,
    list_findings,
)
from netdesign.evidence.paper.runs import find_history, find_paper_time
from tests.build_paper import build_study


def call_of(study, key):
    return next(one for one in list_findings(study) if one.key == key)


def test_forces_that_grow_with_friction_agree():
    study = build_study(lambda case: 3e5 * (1.0 + case.friction_deg / 100.0))
    assert call_of(study, "growth").call == "agrees"
    assert {one.trend for one in judge_growth(study)} == {"grows"}
    foot = judge_growth(study)[0]
    assert foot.change == pytest.approx(1.45 / 1.15 - 1.0)


@pytest.mark.parametrize("slope", [0.0, 1e-4, -0.01])
def test_forces_that_stay_or_fall_do_not_agree(slope):
    study = build_study(lambda case: 3e5 * (1.0 + slope * case.friction_deg))
    assert call_of(study, "growth").call == "does not agree"


def test_a_missing_run_leaves_statements_open():
    middle = find_history(0.0)
    study = build_study(failing=[middle])
    calls = {one.key: one.call for one in list_findings(study)}
    assert set(calls.values()) == {"not decided", "does not agree"}
    assert calls["growth"] == "not decided"
    assert calls["seconds"] == "not decided"


def test_oscillation_needs_both_swings_and_a_plateau():
    assert call_of(build_study(swings=9), "oscillation").call == "agrees"
    assert call_of(build_study(), "oscillation").call == "does not agree"
    restless = build_study(swings=9, plateau=None)
    assert call_of(restless, "oscillation").call == "does not agree"


@pytest.mark.parametrize(("share", "call"), [(0.96, "agrees"), (0.9, "does not agree")])
def test_settlement_is_the_change_of_the_gravity(share, call):
    study = build_study(
        lambda case: 3e5 * (share if case.gravity == "parallel" else 1.0)
    )
    finding = call_of(study, "settlement")
    assert finding.call == call
    assert finding.numbers["history_foot_0"] == pytest.approx(share - 1.0)


@pytest.mark.parametrize(("share", "call"), [(1.04, "agrees"), (1.1, "does not agree")])
def test_effect_of_densification_is_against_the_run_without(share, call):
    study = build_study(lambda case: 3e5 * (1.0 if case.densifies else share))
    finding = call_of(study, "densification")
    assert finding.call == call
    assert finding.numbers["straight"] == pytest.approx(1.0 / share - 1.0)


def test_density_is_that_of_the_area_after_the_papers_time():
    assert call_of(build_study(), "density").call == "agrees"
    study = build_study()
    early = find_paper_time()
    shape = replace(study[early].shape, density=np.array([380.0]))
    runs = {**study.runs, early: replace(study[early], shape=shape)}
    finding = call_of(replace(study, runs=runs), "density")
    assert finding.call == "does not agree"
    assert finding.numbers["rise"] == pytest.approx(380.0 / 366.8 - 1.0)


def test_eight_seconds_suffice_if_the_plateau_begins_in_them():
    assert call_of(build_study(plateau=6.0), "seconds").call == "agrees"
    finding = call_of(build_study(plateau=1000.0), "seconds")
    assert finding.call == "does not agree"
    assert finding.numbers["ratio"] == pytest.approx(1000.0 / 8.0, rel=0.15)


def test_trends():
    def trend(*values):
        one = Growth(method="m", inclination_deg=0.0, quantity="foot", values=values)
        return one.trend

    assert trend(100.0, 102.0, 104.0) == "grows"
    assert trend(100.0, 100.9, 101.8) == "level"
    assert trend(100.0, 98.0, 98.5) == "falls"
    assert trend(100.0, 98.0, 101.0) == "mixed"
    assert trend(100.0, None, 101.0) == "unknown"


def test_swings_are_counted_above_their_least_size():
    assert count_swings(np.array([0.0, 1.0, 2.0])) == 0
    assert count_swings(np.array([0.0, 1.0, 0.0, 1.0, 0.0])) == 3
    assert count_swings(np.array([1.0, 1.0 - 0.009, 1.0])) == 0
    assert count_swings(np.array([1.0, 0.98, 1.0, 0.98])) == 2


def test_the_last_swing_is_the_last_jump():
    study = build_study()
    run = study[find_history(0.0)]
    foot = np.full(101, 100.0)
    foot[40] = 104.0
    shaken = replace(run, track=replace(run.track, foot=foot))
    assert last_swing(shaken) == run.track.times[41]
    calm = replace(run, track=replace(run.track, foot=np.full(101, 100.0)))
    assert last_swing(calm) == 0.0
