"""Plateau: found where the criterion's own words put it, on made-up histories."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from netdesign.addons.history.moments import (
    COUNTED_STRAIN,
    PULL_DRIFT,
    REST_SHARE,
    START_STRAIN,
    HistoryPoint,
    find_plateau,
    judge_plateau,
    select_counted,
)

TIMES = np.geomspace(1e-4, 1e3, 700)
STEP = 1.03  # more than the ratio of two neighbouring times


def moment(time, pull, *, nodes=None, way=0.1, speed=0.0, strain=1.0):
    nodes = np.full(5, pull / 5.0) if nodes is None else nodes
    return HistoryPoint(
        time=time,
        foot=np.array([0.6, 0.8]) * pull,
        head=np.array([0.8, -0.6]) * pull,
        tension_min=pull,
        tension_max=pull,
        on_net=np.array([nodes, 0.0 * nodes]),
        max_relative_density=0.4,
        way=way,
        speed=speed,
        strain=strain,
        residual=0.0,
    )


def history(pull_at, times=TIMES, **given):
    return [moment(time, pull_at(time), **given) for time in times]


# --- forces ------------------------------------------------------------------


def test_exponential_approach_has_its_plateau_where_the_drift_is_small():
    """1 - exp(-x): per e-fold of time x / (exp(x) - 1) of its size."""
    begin = brentq(lambda x: x / math.expm1(x) - PULL_DRIFT, 1.0, 10.0)
    plateau = find_plateau(history(lambda x: 1.0 - math.exp(-x)))
    assert plateau.reached
    assert begin / STEP < TIMES[plateau.index] < begin * STEP


@pytest.mark.parametrize(("drift", "reached"), [(0.9, True), (1.1, False)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_plateau_that_is_left_is_none(drift, reached, sign):
    """Quiet for some e-folds, then a drift that a longer history must see."""

    def pull(time):
        return 1.0 + sign * drift * PULL_DRIFT * 2.0 * max(0.0, math.log(time))

    times = np.geomspace(math.exp(-2.2), math.exp(2.2), 200)
    moments = history(pull, times)
    found = find_plateau(moments)
    assert found.reached
    judged = judge_plateau(moments, found)
    assert judged.index == found.index
    assert judged.reached is reached
    assert judged.was_left is not reached
    # twice the drift over half of the span
    assert judged.drift == pytest.approx(sign * drift * PULL_DRIFT, rel=1e-3)


@pytest.mark.parametrize("is_guessed", [False, True])
@pytest.mark.parametrize("rate", [1e-4, 2e-2])
def test_pulls_count_while_the_snow_is_the_scenes(is_guessed, rate):
    """However long the history; a guessed start's only once its plateau is proven."""
    times = np.geomspace(1e-2, 1e4, 500)
    moments = [
        moment(time, 1.0 + math.exp(-time) + 1e-5 * time, strain=rate * time)
        for time in times
    ]
    for count in (440, 500):
        plateau = judge_plateau(moments[:count], find_plateau(moments[:count]))
        counted = select_counted(moments[:count], plateau, is_guessed=is_guessed)
        proven = moments[plateau.end].time
        first = proven if is_guessed else START_STRAIN / rate
        assert counted[0].time / STEP < first <= counted[0].time
        last = max(
            proven if is_guessed else moments[plateau.index].time, COUNTED_STRAIN / rate
        )
        assert counted[-1].time <= last < counted[-1].time * STEP
    short = moments[:30]
    unproven = judge_plateau(short, find_plateau(short))
    assert select_counted(short, unproven, is_guessed=is_guessed) == short


def test_a_pull_that_turns_is_no_plateau():
    """Its size is constant, its direction is not."""
    moments = [
        replace(still, foot=np.array([math.cos(turn), math.sin(turn)]))
        for turn, still in zip(np.log(TIMES) * 0.1, history(lambda _: 1.0), strict=True)
    ]
    assert not find_plateau(moments).reached


# --- motion and strain -------------------------------------------------------


@pytest.mark.parametrize(("share", "reached"), [(0.9, True), (1.1, False)])
def test_net_that_still_moves(share, reached):
    """Velocity times time against its way so far."""
    moments = [
        moment(time, 1.0, way=0.1, speed=share * REST_SHARE * 0.1 / time)
        for time in TIMES
    ]
    assert find_plateau(moments).reached is reached
