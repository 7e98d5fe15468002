"""Upper bounds of winters whose thin snow has no force."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.winter import maxima
from netdesign.addons.winter.day import RowDay
from netdesign.addons.winter.maxima import find_annual_maximum, find_bound
from netdesign.addons.winter.settling import DELTA_SNOW, follow_heights
from netdesign.snow.ground import GroundLaw
from netdesign.words.message import say
from tests.addons.winter.made_up_row import (
    SLOPE,
    FormulaSolver,
    a_formula_solver,
    a_solver,
    slides,
)
from tests.each import each


def draw_solver(rng, kind, accuracy=0.02):
    height = rng.uniform(2.0, 4.5)
    grounds = {
        "no-slip": None,
        "sliding": slides(rng.uniform(1.2, 3.2), height / math.cos(SLOPE)),
        "free": GroundLaw(kind="free"),
    }
    return a_solver(
        grounds[kind],
        accuracy=accuracy,
        slack=rng.uniform(0.0, 0.12),
        net_height=height,
        inclination_deg=rng.uniform(15.0, 40.0),
    )


def solve_snow(solver, thicknesses, densities):
    days = [
        RowDay(index=k, thickness=float(d), density=float(rho), ending="open")
        for k, (d, rho) in enumerate(np.broadcast(thicknesses, densities))
    ]
    return [day.foot.value for day in solver.solve(days) if day.foot]


def rises(solver, rng, number):
    """Pulls of drawn snow that grows thicker, and of snow that grows denser, rise."""
    top = solver.row.scene.net.height_normal
    thick = np.geomspace(0.26, 0.999 * top, number)
    dense = np.geomspace(105.0, 520.0, number)
    each_way = (
        solve_snow(solver, thick, rng.uniform(110.0, 480.0)),
        solve_snow(solver, rng.uniform(0.2, 0.95) * top, dense),
    )
    return [bool(np.all(np.diff(pulls) > 0.0)) for pulls in each_way]


@pytest.mark.parametrize("kind", ["no-slip", "sliding", "free"])
def test_more_snow_never_pulls_less(kind):
    rng = np.random.default_rng(1905)
    found = [rises(draw_solver(rng, kind), rng, 8) for _ in range(4)]
    assert np.all(found)


def count_solves(solver):
    """The same solver, with the list of the days that it solves."""
    solved = []

    class Counting(type(solver)):
        def solve(self, days):
            solved.extend(days)
            return super().solve(days)

    return Counting(row=solver.row, settings=solver.settings), solved


@pytest.mark.parametrize("count", [2, pytest.param(5, marks=pytest.mark.long)])
@each("kind", ["no-slip", "sliding", "free"])
def test_a_maximum_alone_takes_fewer_solves_and_is_the_same(monkeypatch, count, kind):
    """Drawn winters on drawn rows: whatever their ranks say."""
    # that of both is of the same pull
    monkeypatch.setattr(maxima, "find_equivalent", lambda *_: None)
    rng = np.random.default_rng(417)
    compared, solves = 0, np.zeros(2)
    for _ in range(count):
        solver = draw_solver(rng, kind)
        top = solver.row.scene.net.height_normal / math.cos(SLOPE)
        heights = [0.45 * top * h for h in draw_winter(rng)]
        packs = dict(enumerate(follow_heights(heights, DELTA_SNOW)))
        (every, all_days), (few, some_days) = (count_solves(solver) for _ in range(2))
        truth, _ = find_annual_maximum("2001/2002", packs, every)
        found, _ = find_annual_maximum("2001/2002", packs, few, is_alone=True)
        assert found.ending == truth.ending
        if truth.is_proven and truth.index is not None:
            accuracy = solver.settings.accuracy
            assert found.foot == pytest.approx(truth.foot, rel=2.0 * accuracy)
            solves += len(some_days), len(all_days)
            compared += 1
    assert compared >= count - 2
    assert solves[0] < 0.9 * solves[1]


def hide_thin(base, solver, least):
    """The same solver, for which snow thinner than some thickness has no force."""

    class Hiding(base):
        def _run(self, days):
            return [
                replace(
                    day,
                    ending="failed",
                    foot=None,
                    head=None,
                    reason=say("net.would_touch_ground"),
                )
                if day.thickness < least
                else day
                for day in super()._run(days)
            ]

    return Hiding(row=solver.row, settings=solver.settings)


def draw_winter(rng):
    """Heights [m] of some storms between which the snow settles and melts."""
    height, heights = 0.0, [0.0]
    for _ in range(90):
        height = 0.985 * height + (rng.random() < 0.2) * rng.exponential(0.18)
        heights.append(height)
    scale = rng.uniform(0.5, 2.0) / max(heights)
    return [scale * h for h in heights]


def compare(base, solver, rng):
    """Winter as it is and with its thin snow hidden: how it ends, both ways."""
    packs = dict(enumerate(follow_heights(draw_winter(rng), DELTA_SNOW)))
    truth, _ = find_annual_maximum("2001/2002", packs, solver)
    hiding = hide_thin(base, solver, rng.uniform(0.3, 1.6))
    found, _ = find_annual_maximum("2001/2002", packs, hiding)
    alone, _ = find_annual_maximum("2001/2002", packs, hiding, is_alone=True)
    for one in (found, alone):
        if one.is_proven:
            assert one.foot == pytest.approx(truth.foot)
        else:
            assert one.reason == say("net.would_touch_ground")
            assert truth.foot <= one.bound
    return found.ending


def test_a_bound_is_never_below_the_maximum():
    """150 drawn winters whose pulls follow a formula."""
    rng = np.random.default_rng(61)
    solver = a_formula_solver()
    endings = [compare(FormulaSolver, solver, rng) for _ in range(150)]
    assert endings.count("doubtful") > 30
    assert endings.count("solved") > 30


def test_snow_without_a_force_up_to_the_head_has_no_bound():
    solver = hide_thin(FormulaSolver, a_solver(), 99.0)
    day = RowDay(index=0, thickness=1.3, density=290.0, ending="failed")
    assert find_bound([day], [], solver) is None
