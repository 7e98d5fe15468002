"""Equations of a panel: their derivatives, and what they say of its ropes."""

import numpy as np
import pytest

from netdesign.panel.equations import (
    build_problem,
    derive_missing,
    guess_points,
    read_point,
)
from netdesign.panel.inputs import Panel, Rope
from netdesign.panel.strips import take_strip


@pytest.fixture(params=[False, True], ids=["even", "mid"])
def problem(solved, request):
    panel = Panel(
        post_spacing=3.3,
        lower=Rope(stiffness=1.9e7, sag=0.041),
        upper=Rope(stiffness=1.1e7, sag=0.072),
        cut="fitted",
        has_mid_anchors=request.param,
    )
    section = solved(inclination_deg=27.0, slack=0.021, ground="no-slip")
    return build_problem(take_strip(section), [panel], 5)


def draw_point(problem, seed):
    (point,) = guess_points(problem)
    return point * np.random.default_rng(seed).uniform(0.8, 1.1, point.size)


@pytest.mark.parametrize("seed", [4, 9])
def test_derivatives_are_those_of_what_is_missing(problem, seed):
    """Against central differences."""
    point, step = draw_point(problem, seed), 1e-6
    found = derive_missing(problem, 0, read_point(problem, 0, point))
    for column, way in enumerate(step * np.eye(point.size)):
        up, down = (
            read_point(problem, 0, point + s * way).missing for s in (1.0, -1.0)
        )
        change = (up - down) / (2.0 * step)
        scale = np.abs(change).max()
        np.testing.assert_allclose(found[:, column], change, atol=2e-8 * scale)


def test_ropes_bend_as_their_loads_ask(problem):
    """H u of a uniform pull is a parabola in each span; none moves at its supports."""
    point = draw_point(problem, 2)
    stations = problem.ropes.stations
    count = stations.xi.size
    point[:-2] = np.repeat(problem.strip.foot_pull / problem.load_size, count + 1)
    state = read_point(problem, 0, point)
    xi = np.append(stations.xi, 0.0)
    is_held = problem.ropes.panels[0].has_mid_anchors
    shape = (xi - xi**2 if is_held else 1.0 - xi**2) * problem.half**2 / 2.0
    expected = np.outer(problem.strip.foot_pull, shape) / state.loads.along[0]
    np.testing.assert_allclose(state.loads.displacements[0], expected, atol=1e-12)
    both = state.loads.pulls.sum(axis=0)
    np.testing.assert_allclose(both.T, np.tile(problem.strip.load, (count + 1, 1)))
