"""Ropes: length of a parabola, the root of (P2) over twenty orders of magnitude."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from netdesign.errors import SolveError
from netdesign.panel.inputs import Rope
from netdesign.panel.ropes import (
    compute_excess_length,
    estimate_force_along,
    solve_force_along,
)
from netdesign.panel.stations import ROPE_POINTS


@pytest.mark.parametrize("sag", [0.02, 0.0731, 0.17, 0.3])
def test_length_of_a_parabola(sag):
    b = 4 * sag
    closed = (math.sqrt(1 + b**2) + math.asinh(b) / b) / 2 - 1
    assert compute_excess_length(sag) == pytest.approx(closed, rel=1e-12)


def test_flat_parabola_keeps_its_digits():
    sag = 1.7e-7
    assert compute_excess_length(sag) == pytest.approx(8 / 3 * sag**2, rel=1e-12)
    assert compute_excess_length(0.0) == 0.0


@pytest.mark.parametrize("start", [1e-3, 1e5, 1e14])
@pytest.mark.parametrize("sag", [0.0, 0.051, 0.15])
@pytest.mark.parametrize("stiffness", [1.3e6, 1.8e7, 1e13])
def test_rope_has_its_length(stiffness, sag, start):
    """The length under tension, integrated by other means."""
    rope = Rope(stiffness=stiffness, sag=sag)
    pull = np.array([[21e3], [-73e3]])
    along = solve_force_along(pull * ROPE_POINTS, rope, start)
    size = float(np.hypot(*pull)[0])

    def unstressed(xi):
        stretched = math.hypot(1.0, size * xi / along)
        return stretched / (1.0 + along / stiffness * stretched)

    length, _ = quad(unstressed, 0.0, 1.0, epsabs=1e-14)
    assert length - 1.0 == pytest.approx(compute_excess_length(sag), abs=1e-13)


def test_force_along_falls_with_sag_and_rises_with_stiffness():
    pull = np.array([[0.0], [41e3]]) * ROPE_POINTS

    def along(stiffness, sag):
        rope = Rope(stiffness=stiffness, sag=sag)
        return solve_force_along(pull, rope, 1e5)

    by_sag = [along(18e6, sag) for sag in (0.0, 0.02, 0.05, 0.1, 0.2)]
    assert (np.diff(by_sag) < 0.0).all()
    by_stiffness = [along(stiffness, 0.05) for stiffness in (1e6, 1e7, 1e8, 1e9)]
    assert (np.diff(by_stiffness) > 0.0).all()


@pytest.mark.parametrize("pull", [0.0, math.nan])
def test_rope_that_nothing_pulls_on_has_no_force(pull):
    rope = Rope(stiffness=18e6, sag=0.05)
    with pytest.raises(SolveError, match="No force along the row"):
        solve_force_along(np.full((2, 24), pull), rope, 1e4)


@pytest.mark.parametrize("sag", [0.0, 0.06])
def test_first_figure_solves_its_equation(sag):
    load, span, rope = 37.1e3, 3.85, Rope(stiffness=14.2e6, sag=sag)
    along, hung = estimate_force_along(load, span, rope)
    assert along == pytest.approx(load * span**2 / (8 * hung), rel=1e-12)
    stretched = 8 / 3 * (hung / span) ** 2
    assert stretched == pytest.approx(8 / 3 * sag**2 + along / 14.2e6, rel=1e-9)
