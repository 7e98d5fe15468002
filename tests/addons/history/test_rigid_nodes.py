"""The net on nodes that do not yield: friction, slack, robustness."""

import math
from typing import NamedTuple

import numpy as np
import pytest

from netdesign.addons.evidence.verification.closed_forms import slide_on
from netdesign.addons.history.net_pulls import (
    measure_arcs,
)
from netdesign.cable.net import compute_ratio_bounds, compute_turning_angles
from tests.addons.history.starts import find_breach
from tests.each import each

STIFFNESS = 2e7


class Case(NamedTuple):
    """A polygon and its unstressed lengths before the net slides."""

    points: np.ndarray
    old: np.ndarray
    friction: float

    @property
    def final(self):
        return measure_arcs(self.points)

    @property
    def bounds(self):
        return compute_ratio_bounds(compute_turning_angles(self.points), self.friction)

    def solve(self):
        return slide_on(self.points, self.old, self.friction, STIFFNESS)


def bulged_points(rng, n: int, grading: float):
    """Net from (0, 0) to (0, 3), uneven bulge, segments graded to both ends."""
    sizes = grading ** np.abs(np.linspace(-1.0, 1.0, n + 1))
    along = np.concatenate([[0.0], np.cumsum(sizes * rng.uniform(0.5, 1.0, n + 1))])
    along /= along[-1]
    rough = 0.1 * np.diff(along).min() * rng.normal(size=n + 2)
    rough[0] = 0.0
    return np.array([2.0 * along * (1.0 - along) + rough, 3.0 * along])


def random_case(seed: int) -> Case:
    """1 to 40 nodes, friction 0 to 45 deg, strains to 4 %, a fifth of them slack."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 41))
    points = bulged_points(rng, n, grading=rng.choice([1.0, 0.1, 1e-3]))
    final = measure_arcs(points)
    strains = rng.choice([1e-4, 1e-2]) * rng.normal(1.0, 2.0, n + 1)
    old = final / (1.0 + strains)
    old *= min(1.0, final.sum() / old.sum() / (1.0 + rng.choice([1e-6, 1e-3])))
    return Case(points, old, math.tan(math.radians(rng.integers(0, 46))))


@each("seed", range(200))
def test_optimality_of_random_nets(seed):
    case = random_case(seed)
    net = case.solve()
    # last digit of a length over the elongation, and the tolerance of the solve
    rounding = 2.0**-50 * (case.final / (case.final - net.lengths)).max()
    slides = np.cumsum(net.lengths - case.old)[:-1]
    glides = np.abs(slides) > 1e-14 * case.old.sum()
    strains = (case.final - net.lengths) / net.lengths  # of the new lengths alone
    breach = find_breach(case.points, case.friction, slides, glides, strains)
    assert breach <= 1e-9 + rounding
    assert net.tensions.min() > 0.0
    assert net.lengths.sum() == pytest.approx(case.old.sum(), rel=1e-13)
    # sum of forces, and of their moments about the foot
    size = np.hypot(*net.foot_pull)
    forces = np.column_stack([net.foot_pull, net.forces, net.head_pull])
    np.testing.assert_allclose(forces.sum(axis=1), 0.0, atol=1e-12 * size)
    moment = (case.points[0] * forces[1] - case.points[1] * forces[0]).sum()
    assert moment == pytest.approx(0.0, abs=1e-11 * size)


def arc_points(count, opening=1.2, exponent=1.0):
    """Foot, ``count`` nodes and head on a circle of radius 1."""
    angle = opening * (np.linspace(0.0, 1.0, count + 2) ** exponent - 0.5)
    return np.array([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("exponent", [1.0, 1.5], ids=["even", "graded"])
def test_arcs_of_a_circle_converge_at_order_four(exponent):
    errors = [
        abs(measure_arcs(arc_points(count, exponent=exponent)).sum() / 1.2 - 1.0)
        for count in (7, 15, 31)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-6
    assert orders.min() > 3.5


def test_arcs_of_even_nodes_by_hand():
    """Chord 2 R sin(beta / 2), longer by beta^2 / 24."""
    beta = 1.2 / 6
    expected = 2.0 * math.sin(beta / 2.0) * (1.0 + beta**2 / 24.0)
    np.testing.assert_allclose(measure_arcs(arc_points(5)), expected, rtol=1e-13)
