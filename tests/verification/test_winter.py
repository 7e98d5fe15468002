"""A made-up winter on a net, against a prototype of the same chain."""

import math
from datetime import date, timedelta

import pytest

from netdesign.addons.evidence.verification.winters import (
    read_made_up_winter,
    solve_winter,
)
from netdesign.addons.winter.day import RowDay, build_day_scene, merge_layers
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Layer
from tests.addons.winter.made_up_row import SLOPE, a_scene, a_solver, slides

HIGHEST = 2.90  # [m], of this winter


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.slow)


def day_of(season_day):
    return date(2020, 11, 1) + timedelta(days=season_day.index)


@pytest.mark.parametrize(
    ("ground", "foot", "head", "at_highest", "density"),
    [
        (GroundLaw(kind="no-slip"), 18.2, 16.5, 14.9, 263.0),
        slow(slides(1.2, HIGHEST), 21.1, 18.1, 17.4, 269.0),
        slow(slides(2.4, HIGHEST), 36.5, 27.1, 30.1, 273.0),
        slow(GroundLaw(), 126.9, 81.6, 123.1, 305.0),
    ],
    ids=["no slip", "N 1.2", "N 2.4", "free"],
)
def test_made_up_winter(ground, foot, head, at_highest, density):
    """Peaks within 3 %; of the largest height up to 9 % above, by its layers."""
    season = solve_winter(ground)
    governing = season.governing
    assert governing.foot.value / 1e3 == pytest.approx(foot, rel=0.03)
    assert governing.head.value / 1e3 == pytest.approx(head, rel=0.03)
    assert date(2021, 4, 9) <= day_of(governing) <= date(2021, 4, 14)
    assert day_of(season.highest) == date(2021, 4, 6)
    assert 0.97 < season.highest.foot.value / 1e3 / at_highest < 1.09
    assert season.equivalent_density == pytest.approx(density, rel=0.03)
    assert season.maximum.is_proven
    assert season.maximum.foot >= 0.99 * governing.foot.value


def test_four_layers_pull_as_eight():
    """Two days of April: new snow on old, and a wet crust on light snow."""
    packs, solver = read_made_up_winter(), a_solver()
    for place in (156, 161):
        pack = packs[place]
        thicknesses = list(pack.heights * math.cos(SLOPE))
        pulls = [
            solve_layers(merge_layers(thicknesses, pack.densities, most), solver)
            for most in (4, 8)
        ]
        assert pulls[0] == pytest.approx(pulls[1], rel=0.03)


def solve_layers(layers, solver):
    thickness = sum(layer.thickness for layer in layers)
    mass = sum(layer.thickness * layer.density for layer in layers)
    day = RowDay(
        index=0,
        thickness=thickness,
        density=mass / thickness,
        layers=layers,
        ending="open",
    )
    (solved,) = solver.solve([day])
    return solved.foot.value


def test_ground_creeps_by_its_lowest_layer():
    """Light snow below slips more than dense: by (a_light / a_dense)^2, eq. (N12)."""
    light = Layer(thickness=0.9, density=260.0)
    dense = Layer(thickness=0.9, density=380.0)
    slip, ratio = 0.4, math.exp(2 * 19.25 * (380.0 - 260.0) / 917.0)
    scene = a_scene(GroundLaw(kind="sliding", slip_length=slip))
    problems = []
    for layers in ((dense, light), (light, dense)):
        day = RowDay(
            index=0, thickness=1.8, density=320.0, layers=layers, ending="open"
        )
        problems.append(build_day_scene(scene, day).flow_problem)
    seen = [one.slip_ratio * one.layers[0].fluidity_ratio for one in problems]
    assert seen[1] / seen[0] == pytest.approx(ratio, rel=1e-9)
