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
