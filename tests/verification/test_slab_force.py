"""Closed form of creep and glide pressure: limits, balance, two dimensions, tables."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import netdesign.addons.evidence.verification
from netdesign.addons.evidence.verification.exact_solutions import (
    Slab,
    compute_influence_length,
    compute_slab_force,
    scale_slip_length,
)
from netdesign.addons.evidence.verification.rigid import Wall, put_wall, solve_rigid
from netdesign.coupling.scene import SolverSettings
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.snowpack import GRAVITY
from tests.scenes import ICE

PAGE = (
    Path(netdesign.addons.evidence.verification.__file__)
    .with_name("THEORY.md")
    .read_text("utf-8")
)
SLAB = Slab(thickness=2.3, slope_angle=math.radians(37.5), density=317.0)
WEIGHT = 317.0 * GRAVITY * 2.3 * math.sin(math.radians(37.5))  # a metre of slope


def read_table(heading):
    """Rows of the page's table whose first column has this heading, as texts."""
    lines = PAGE[PAGE.index(f"| {heading} |") :].splitlines()
    rows = (re.split(r" *\| *", line.strip("| ")) for line in lines[2:])
    return [row for row, line in zip(rows, lines[2:], strict=False) if line[:1] == "|"]


def integrate(slab, slip, length):
    """Force by finite differences of (H4) with the ends of (H5), in weights of 1 m."""
    count = 4000
    x, step = np.linspace(-length, 0.0, count + 1, retstep=True)
    reach = compute_influence_length(slab, slip)
    matrix = np.zeros((3, count + 1))  # banded, u over u_0
    matrix[0, 2:] = matrix[2, :-2] = -((reach / step) ** 2)
    matrix[1] = 1.0 + 2.0 * (reach / step) ** 2
    load = np.ones(count + 1)
    # free end: P = 0 by a ghost node; face: u = 0
    slope = slab.side_length / reach**2
    matrix[0, 1] = -2.0 * (reach / step) ** 2
    load[0] -= 2.0 * slope * reach**2 / step
    matrix[1, -1], matrix[2, -2], load[-1] = 1.0, 0.0, 0.0
    from scipy.linalg import solve_banded

    u = solve_banded((1, 1), matrix, load)
    drag = step * (u.sum() - 0.5 * (u[0] + u[-1]))  # of the ground, in weights
    assert x[0] == -length
    return length - drag


@pytest.mark.parametrize(("slip", "length"), [(0.0, 5.1), (1.7, 7.3), (23.0, 11.9)])
def test_force_is_weight_less_drag(slip, length):
    force = compute_slab_force(SLAB, slip_length=slip, upslope_length=length)
    expected = integrate(SLAB, slip, length)
    assert force / WEIGHT == pytest.approx(expected, rel=2e-5)


def test_without_drag_the_face_holds_all_of_the_snow():
    nearly = compute_slab_force(SLAB, slip_length=9e5, upslope_length=17.7)
    assert nearly == pytest.approx(WEIGHT * 17.7, rel=1e-4)


def test_long_slabs_are_endless():
    endless = compute_slab_force(SLAB, slip_length=1.1)
    length = compute_influence_length(SLAB, 1.1)
    long = compute_slab_force(SLAB, slip_length=1.1, upslope_length=25.0 * length)
    assert long == pytest.approx(endless, rel=1e-10)
    assert endless / WEIGHT == pytest.approx(length + SLAB.side_length)


def test_glide_factor_is_the_ratio_of_forces():
    for factor in (1.0, 1.7, 3.1):
        slip = scale_slip_length(SLAB, 0.0, factor)
        ratio = compute_slab_force(SLAB, slip_length=slip) / compute_slab_force(
            SLAB, slip_length=0.0
        )
        assert ratio == pytest.approx(factor, rel=1e-12)


def solve_in_two_dimensions(a_scene, slip_ratio, aspect, friction_angle):
    """Force on a wall over rho g d^2 by finite elements with n = 1."""
    scene = a_scene(
        thickness_m=3.0,
        length_m=aspect * 3.0,
        relative_density=300.0 / ICE,
        ground="sliding" if slip_ratio else "no-slip",
        slip_length_m=slip_ratio * 3.0,
        creep_law=replace(BOUTILLIER_2004, exponent=1.0),
    )
    scene = put_wall(scene, Wall(height_normal=3.0, friction_angle=friction_angle))
    solution = solve_rigid(scene, SolverSettings(accuracy=0.01))
    return solution.force.x / (300.0 * GRAVITY * 9.0)


@pytest.mark.parametrize(
    ("row", "column", "friction_angle"),
    [(0, 3, 0.0), (1, 4, None), (2, 3, 0.0), (5, 3, 0.0), (8, 4, None)],
)
def test_page_holds_what_two_dimensions_give(a_scene, row, column, friction_angle):
    texts = read_table("D* / d")[row]
    slip, aspect, closed = (float(texts[i]) for i in range(3))
    slab = Slab(thickness=3.0, slope_angle=math.radians(40.0), density=300.0)
    force = compute_slab_force(slab, slip_length=3.0 * slip, upslope_length=3 * aspect)
    scaled = force / (300.0 * GRAVITY * 9.0)
    assert scaled == pytest.approx(closed, abs=6e-4)
    flow = solve_in_two_dimensions(a_scene, slip, aspect, friction_angle)
    assert scaled / flow == pytest.approx(float(texts[column]), abs=2e-3)


def test_page_holds_the_published_figure():
    for depth, dynamic, whole in read_table("d [m]"):
        thickness = float(depth)
        for density, printed in zip((250, 350, 450), whole.split(" / "), strict=True):
            slab = Slab(
                thickness=thickness, slope_angle=math.radians(30.0), density=density
            )
            slip = scale_slip_length(slab, 10.0, 0.5)
            assert slip == pytest.approx(float(printed), abs=6e-3)
        third = thickness / 3.0
        alone = (10.0 + third) / 4.0 - third
        assert alone == pytest.approx(float(dynamic), abs=6e-3)
