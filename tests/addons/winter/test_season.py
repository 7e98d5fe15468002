"""Curve of a season: coarse where nothing is large, accurate where it may be."""

from dataclasses import dataclass, replace
from random import Random

import numpy as np
import pytest

from netdesign.addons.winter.day import COARSEST_CURVE, CURVE_SHARE, DaySolver
from netdesign.addons.winter.season import follow_season
from netdesign.addons.winter.settling import DELTA_SNOW, follow_heights
from netdesign.checks.inputs import Band
from netdesign.coupling.scene import SolverSettings
from netdesign.snow.ground import GroundLaw
from netdesign.words.message import say
from tests.addons.winter.made_up_row import a_solver, read_winter, slides
from tests.each import each

ACCURACY = 0.013


@dataclass(frozen=True, slots=True, kw_only=True)
class ErringSolver(DaySolver):
    """Formulas in error by the accuracy at most, each day in its own way."""

    failing: frozenset = frozenset()

    def _run(self, days):
        return [self._err(day) for day in days]

    def _err(self, day):
        is_coarse = self.settings.accuracy > ACCURACY
        if day.index in self.failing and not is_coarse:
            return replace(day, ending="failed", reason=say("balance.suction"))
        true = day.density**1.2 * day.thickness**1.9
        error = self.settings.accuracy * np.sin(37.0 * day.index)
        foot, head, post = (
            self._band(value * (1.0 + error))
            for value in (true, true / day.density, true * day.thickness)
        )
        forces = {"post": post}
        return replace(day, ending="solved", foot=foot, head=head, member_forces=forces)

    def _band(self, value):
        around = self.settings.accuracy * value
        return Band(low=value - around, value=value, high=value + around)


def follow(accuracy, failing=()):
    solver = ErringSolver(
        row=a_solver().row,
        settings=SolverSettings(accuracy=accuracy),
        failing=frozenset(failing),
    )
    packs = dict(enumerate(follow_heights(read_winter(), DELTA_SNOW)))
    return follow_season("2020/2021", packs, solver)


def share(band):
    return (band.high - band.low) / 2.0 / band.value


def test_largest_forces_have_the_full_accuracy_and_no_other_day_may_exceed_them():
    days = [day for day in follow(ACCURACY).curve if day.bands]
    coarse = CURVE_SHARE * ACCURACY
    assert coarse < COARSEST_CURVE
    seen = {round(share(day.foot), 6) for day in days}
    assert seen == {ACCURACY, coarse}
    for name in ("net foot", "net head", "post"):
        top = max((day.bands[name] for day in days), key=lambda band: band.value)
        assert share(top) == pytest.approx(ACCURACY)
        for day in days:
            band = day.bands[name]
            assert band.high <= top.value or share(band) == pytest.approx(ACCURACY)
    assert sum(share(day.foot) > ACCURACY * 1.5 for day in days) > len(days) / 2


GROUNDS = [None, GroundLaw(kind="free"), slides(1.6, 2.0)]


@pytest.mark.long
@each("number", [1, 18, 20, 21, 35, 69])
def test_the_governing_day_is_that_of_all_days(number):
    """Winters with plateaus, where many days pull nearly as much, and with thaws."""
    heights = draw_heights(Random(700 + number))
    packs = dict(enumerate(follow_heights(heights, DELTA_SNOW)))
    solver = a_solver(GROUNDS[number % 3])
    season = follow_season("2020/2021", packs, solver)
    every = follow_season("2020/2021", packs, solver, step=1)
    most = max(day.pull for day in every.curve if day.pull is not None and day.layers)
    assert season.governing.pull >= (1.0 - 2e-3) * most


def draw_heights(random):
    """Falls, and settling of a percent a day [m]; a thaw at the end."""
    heights, height = [], 0.0
    thaw = random.uniform(0.9, 0.97)
    for day in range(170):
        height *= 0.99 if day < 130 else thaw
        if day < 130 and random.random() < 0.25:
            height += random.expovariate(1.0 / 0.12)
        height = min(height, 3.2)
        heights.append(round(height, 2))
    return heights
