"""The friction problem of one step: optimality, slack, robustness. Truth: verification.

Polygons come from points, so that the angles are those of a real shape; unstressed
lengths before the step are random and may leave segments slack.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from netdesign.addons.history import sliding
from netdesign.addons.history.sliding import (
    SlidingStep,
    compute_segment_lengths,
    compute_tensions,
    solve_sliding,
)
from netdesign.cable.net import compute_ratio_bounds, compute_turning_angles
from netdesign.outcome import Outcome
from tests.each import each

STIFFNESS = 2e7
SEEDS = range(200)


@dataclass(frozen=True, kw_only=True)
class Case:
    final: np.ndarray
    old: np.ndarray
    bounds: np.ndarray

    def solve(self, **options) -> SlidingStep:
        return solve_sliding(
            self.final, self.old, self.bounds, stiffness=STIFFNESS, **options
        )


def bulged_points(rng, n: int, grading: float):
    """Net from (0, 0) to about (0, 3), uneven bulge, segments graded to both ends."""
    sizes = grading ** np.abs(np.linspace(-1.0, 1.0, n + 1))
    along = np.concatenate([[0.0], np.cumsum(sizes * rng.uniform(0.5, 1.0, n + 1))])
    along /= along[-1]
    rough = 0.1 * np.diff(along).min() * rng.normal(size=n + 2)
    return np.array([2.0 * along * (1.0 - along) + rough, 3.0 * along])


def random_case(seed: int) -> Case:
    """1 to 200 nodes, friction 0 to 45 deg, strains to 4 %, a fifth of them slack."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 201))
    points = bulged_points(rng, n, grading=rng.choice([1.0, 0.1, 1e-3]))
    final = compute_segment_lengths(points)
    strains = rng.choice([1e-4, 1e-2]) * rng.normal(1.0, 2.0, n + 1)
    old = final / (1.0 + strains)
    old *= min(1.0, final.sum() / old.sum() / (1.0 + rng.choice([1e-6, 1e-3])))
    friction = math.tan(math.radians(rng.integers(0, 46)))
    bounds = compute_ratio_bounds(compute_turning_angles(points), friction)
    return Case(final=final, old=old, bounds=bounds)


def largest_breach(case: Case, step: SlidingStep) -> float:
    """Of (C14), from its definition and from nothing but the new lengths."""
    strains = (case.final - step.lengths) / step.lengths
    jumps = np.diff(np.log(strains))
    slid = np.cumsum(step.lengths - case.old)[:-1]
    glides = np.abs(slid) > 1e-14 * case.old.sum()
    gliding = np.abs(jumps + np.sign(slid) * case.bounds)
    sticking = np.maximum(np.abs(jumps) - case.bounds, 0.0)
    return float(np.where(glides, gliding, sticking).max(initial=0.0))


@each("seed", SEEDS)
def test_optimality_of_random_nets(seed):
    case = random_case(seed)
    step = case.solve(max_iterations=10)
    assert step.outcome is Outcome.CONVERGED
    # last digit of a length over the elongation, and the tolerance of the solve
    rounding = 2.0**-50 * (case.final / (case.final - step.lengths)).max()
    assert largest_breach(case, step) <= 1e-10 + rounding
    assert step.tensions.min() > 0.0
    assert step.lengths.sum() == pytest.approx(case.old.sum(), rel=1e-14)


def compute_function(case: Case, lengths) -> float:
    """The function of (C13), ES = 1."""
    left = case.final - lengths
    stored = (lengths * np.log(lengths) + left * np.log(left)).sum()
    slid = np.cumsum(lengths - case.old)[:-1]
    return float(stored + (case.bounds * np.abs(slid)).sum())


@pytest.mark.parametrize("seed", [3, 17, 40])
def test_every_small_slide_raises_the_function(seed):
    rng = np.random.default_rng(seed)
    points = bulged_points(rng, 12, grading=0.3)
    final = compute_segment_lengths(points)
    bounds = compute_ratio_bounds(compute_turning_angles(points), 0.4)
    old = final / 1.02 * rng.uniform(0.99, 1.01, 13)
    case = Case(final=final, old=old, bounds=bounds)
    lengths = case.solve().lengths
    least = compute_function(case, lengths)
    reach = 0.1 * (final - lengths).min()
    for _ in range(50):
        travel = rng.uniform(-reach, reach, 12)
        moved = lengths + np.diff(travel, prepend=0.0, append=0.0)
        assert compute_function(case, moved) > least


def test_one_node_by_hand():
    """Lower segment 2 %, upper 0: glides to the foot until T_1 = T_0 exp(-kappa)."""
    final = np.array([1.02, 1.0])
    kappa = 0.3
    step = solve_sliding(final, np.ones(2), np.array([kappa]), stiffness=STIFFNESS)
    assert step.slide_signs.tolist() == [1]
    lower, upper = (final - step.lengths) / step.lengths
    assert upper == pytest.approx(lower * math.exp(-kappa), rel=1e-9)
    assert step.lengths[0] - 1.0 == pytest.approx(step.slides[0], rel=1e-12)
    np.testing.assert_allclose(step.tensions, STIFFNESS * np.array([lower, upper]))


def test_without_friction_tension_is_uniform():
    case = random_case(5)
    frictionless = Case(
        final=case.final, old=case.old, bounds=np.zeros_like(case.bounds)
    )
    step = frictionless.solve()
    strain = case.final.sum() / case.old.sum() - 1.0
    np.testing.assert_allclose(step.tensions, STIFFNESS * strain, rtol=1e-8)


@pytest.mark.parametrize("bound", [20.0, math.inf])
def test_nothing_glides_under_large_friction(bound):
    rng = np.random.default_rng(8)
    old = rng.uniform(1e-3, 1.0, 41)
    final = old * rng.uniform(1.001, 1.02, 41)
    step = solve_sliding(final, old, np.full(40, bound), stiffness=STIFFNESS)
    assert not step.slide_signs.any()
    np.testing.assert_array_equal(step.lengths, old)  # to the last digit
    np.testing.assert_array_equal(
        step.tensions, compute_tensions(final, old, STIFFNESS)
    )


def test_infinite_bounds_part_the_net():
    """Each part is solved as if it were alone."""
    rng = np.random.default_rng(9)
    old = rng.uniform(0.5, 1.0, 12)
    final = old * rng.uniform(1.0, 1.02, 12)
    bounds = np.full(11, 0.1)
    bounds[[3, 8]] = math.inf
    whole = solve_sliding(final, old, bounds, stiffness=STIFFNESS)
    for part in (slice(0, 4), slice(4, 9), slice(9, 12)):
        inner = bounds[part.start : part.stop - 1]
        alone = solve_sliding(final[part], old[part], inner, stiffness=STIFFNESS)
        np.testing.assert_array_equal(alone.lengths, whole.lengths[part])
    assert whole.slide_signs[[3, 8]].tolist() == [0, 0]


def test_mirrored_net_slides_the_other_way():
    case = random_case(30)
    mirrored = Case(
        final=case.final[::-1], old=case.old[::-1], bounds=case.bounds[::-1]
    )
    here, there = case.solve(), mirrored.solve()
    np.testing.assert_array_equal(there.slide_signs[::-1], -here.slide_signs)
    np.testing.assert_allclose(there.tensions[::-1], here.tensions, rtol=1e-8)


SLACK_SURPLUS = [1.0, 1.0 + 1e-12, 1.05]


@pytest.mark.parametrize("surplus", SLACK_SURPLUS)
def test_net_longer_than_its_polygon_is_slack(surplus):
    final = np.array([1.0, 2.0, 0.5])
    old = np.array([1.5, 1.0, 1.0]) * surplus  # middle one tight at first
    step = solve_sliding(final, old, np.full(2, 0.2), stiffness=STIFFNESS)
    assert step.outcome is Outcome.CONVERGED
    np.testing.assert_array_equal(step.tensions, 0.0)
    assert (step.lengths >= final).all()
    assert step.lengths.sum() == pytest.approx(old.sum(), rel=1e-14)
    assert step.slide_signs.tolist() == [-1, 1]


def test_slack_net_that_fits_keeps_its_lengths():
    old = np.array([1.5, 2.5, 1.0])
    final = np.array([1.0, 2.5, 0.5])
    step = solve_sliding(final, old, np.full(2, 0.2), stiffness=STIFFNESS)
    assert not step.tensions.any()
    np.testing.assert_array_equal(step.lengths, old)
    assert not step.slide_signs.any()


def test_slack_segment_beside_tight_ones_is_drawn_tight():
    final = np.array([1.02, 1.0, 1.02])
    old = np.array([1.0, 1.01, 1.0])  # slack in the middle, tight on the whole
    step = solve_sliding(final, old, np.full(2, 0.2), stiffness=STIFFNESS)
    assert step.slide_signs.tolist() == [1, -1]  # both neighbours draw it in
    assert step.tensions[1] == pytest.approx(step.tensions[0] / math.exp(0.2), rel=1e-8)


@pytest.mark.parametrize("n", [10, 20, 40, 80, 160])
def test_no_stall_at_any_friction_angle(n):
    """Where others stalled: phi of 2 to 10 deg, fine meshes. At most 6 steps seen."""
    rng = np.random.default_rng(n)
    points = bulged_points(rng, n, grading=0.03)
    final = compute_segment_lengths(points)
    old = final / (1.01 + 0.001 * np.sin(np.linspace(0.0, 9.0, n + 1)))
    old[-1] *= 0.99  # pulled at the head; the more friction, the more nodes stick
    for degrees in range(46):
        friction = math.tan(math.radians(degrees))
        bounds = compute_ratio_bounds(compute_turning_angles(points), friction)
        case = Case(final=final, old=old, bounds=bounds)
        step = case.solve(max_iterations=10)
        assert step.outcome is Outcome.CONVERGED
    assert {0} < set(step.slide_signs)  # at 45 deg, where most nodes stick


def test_iteration_limit_is_an_outcome():
    step = random_case(4).solve(max_iterations=1)
    assert step.outcome is Outcome.MAX_ITERATIONS
    assert step.tensions.min() >= 0.0


def test_no_descent_is_an_outcome(monkeypatch):
    monkeypatch.setattr(sliding, "_SHORTEST_STEP", 2.0)
    assert random_case(4).solve().outcome is Outcome.DIVERGED
