"""Annual maxima: which days are solved, what proves no maximum, the table."""

from random import Random

import numpy as np
import pytest

from netdesign.addons.winter.day import RowDay
from netdesign.addons.winter.maxima import (
    find_annual_maximum,
    find_equivalent,
)
from netdesign.addons.winter.settling import DELTA_SNOW, follow_heights
from netdesign.addons.winter.uniform_table import build_table
from tests.addons.winter.made_up_row import a_formula_solver, a_solver
from tests.each import each

QUICK = {"accuracy": 0.03}


def follow(heights):
    return dict(enumerate(follow_heights(heights, DELTA_SNOW)))


def test_equivalent_density_pulls_as_much():
    solver = a_solver(accuracy=0.005)
    spring = RowDay(index=0, thickness=1.6, density=401.0, ending="open")
    (governing,) = solver.solve([spring])
    density = find_equivalent(2.2, governing, solver)
    highest = RowDay(index=1, thickness=2.2, density=density, ending="open")
    (alike,) = solver.solve([highest])
    assert density < 300.0
    assert alike.foot.value == pytest.approx(governing.foot.value, rel=2e-3)


def test_winter_without_a_solved_day_proves_no_maximum():
    """New snow alone is lighter than the creep law allows; denser snow bounds it."""
    packs = follow([0.0, 0.9])
    maximum, _ = find_annual_maximum("1999/2000", packs, a_solver(**QUICK))
    assert (maximum.ending, maximum.foot) == ("doubtful", 0.0)
    assert 100.0 < maximum.bound < 2000.0
    assert maximum.reason


def test_table_is_the_solves_themselves():
    """Twenty drawn states; the solver's own noise is half a percent."""
    solver = a_solver(accuracy=0.01)
    table = build_table(solver, (1.0, 2.6), (190.0, 500.0))
    rng = np.random.default_rng(3)
    d, rho = rng.uniform(1.0, 2.6, 20), rng.uniform(190.0, 500.0, 20)
    foot, head = table.find_pulls(d, rho)
    days = solver.solve(
        [
            RowDay(index=k, thickness=float(a), density=float(b), ending="open")
            for k, (a, b) in enumerate(zip(d, rho, strict=True))
        ]
    )
    assert foot == pytest.approx([day.foot.value for day in days], rel=0.01)
    assert head == pytest.approx([day.head.value for day in days], rel=0.01)
    outside, _ = table.find_pulls(np.array([0.9, 1.5]), np.array([300.0, 520.0]))
    assert np.isnan(outside).all()
    pull = table.find_pulls(np.array([2.1]), np.array([307.0]))[0][0]
    assert table.find_density(2.1, pull) == pytest.approx(307.0, rel=1e-3)
    assert table.find_density(2.1, 1e9) is None


@each("number", range(8))
def test_days_outside_a_table_are_solved_beside_those_read(number):
    """Drawn winters and tables that hold some of their days, all of them, or none."""
    draw = Random(50 + number)
    heights = [0.0, *(round(draw.uniform(0.4, 2.6), 2) for _ in range(40))]
    packs = follow(heights)
    solver = a_formula_solver()
    low, high = sorted(draw.uniform(0.5, 2.4) for _ in range(2))
    table = build_table(solver, (low, high + 0.05), (150.0, draw.uniform(200.0, 520.0)))
    for is_alone in (True, False):
        solved, read = (
            find_annual_maximum(
                "2000/2001", packs, solver, is_alone=is_alone, table=one
            )
            for one in (None, table)
        )
        assert read[0].index == solved[0].index
        assert read[0].foot == pytest.approx(solved[0].foot, rel=1e-3)
        assert read[0].equivalent_density == pytest.approx(
            solved[0].equivalent_density, rel=2e-3
        )
        assert {day.ending for day in read[1]} == {"solved"}
    assert {day.index for day in read[1]} == {day.index for day in solved[1]}
    inside = {day.index for day in table.read_days(solved[1])}
    bands = {
        day.index: day.foot.high / day.foot.value - 1.0
        for day in read[1]
        if day.index in inside
    }
    assert list(bands.values()) == pytest.approx([0.01] * len(bands))
