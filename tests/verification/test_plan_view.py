"""Plan view of a row's end against integral equations, plane elements, closed forms.

Independent of the Bessel functions of ``planview``: the load is put back into the
integral equation by quadrature; finite elements on a half plane with a slit; the
closed forms of Wiener and Hopf, of Kontorovich and Lebedev, of a mast.
"""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import skfem
from scipy import sparse
from scipy.integrate import quad
from scipy.sparse.linalg import spsolve
from scipy.special import k0
from skfem.helpers import dot, grad

from netdesign.addons.evidence.verification.plan_view import (
    build_block,
    find_excess,
    find_plan_excess,
)
from netdesign.addons.evidence.verification.planview.gap import (
    find_excess_within,
    find_isolated_excess,
    find_isolated_load,
    find_load,
    solve_free_gap,
    solve_pulled_gap,
)
from netdesign.addons.evidence.verification.planview.waves import (
    find_row_load,
    find_row_velocity,
    solve_row,
)

SOLVERS = (solve_free_gap, solve_pulled_gap)


def held_back(load, start, stop, place):
    """Velocity that a load between two places takes away at a third, by K_0."""
    middle = (start + stop) / 2.0

    def at_start(root):  # the load is infinite at its ends, like a root
        return 2.0 * root * load(start + root**2) * k0(abs(start + root**2 - place))

    def at_stop(root):
        return 2.0 * root * load(stop - root**2) * k0(abs(stop - root**2 - place))

    return (
        sum(
            quad(
                part,
                0.0,
                math.sqrt(middle - start),
                points=[math.sqrt(at)] if 0.0 < at < middle - start else None,
                limit=400,
            )[0]
            for part, at in ((at_start, place - start), (at_stop, stop - place))
        )
        / math.pi
    )


@pytest.mark.parametrize("place", [0.13, 0.74, 1.9])
def test_load_beside_an_end_alone_stops_the_snow(place):
    """(W12) put back into the integral equation of the half plane."""
    load = lambda z: float(find_isolated_load(np.array([z]))[0])  # noqa: E731
    assert held_back(load, 0.0, 40.0, place) == pytest.approx(1.0, abs=1e-7)


def test_whole_load_beside_an_end_alone_is_the_integral_of_the_load():
    for distance in (0.037, 0.61, 3.3):
        got, _ = quad(
            lambda root: (
                2 * root * (float(find_isolated_load(np.array([root**2]))[0]) - 1.0)
            ),
            0.0,
            math.sqrt(distance),
        )
        assert find_isolated_excess(distance) == pytest.approx(got, rel=1e-9)
    assert find_isolated_excess(40.0) == pytest.approx(0.5, abs=1e-12)
    assert find_isolated_excess(math.inf) == 0.5


@pytest.mark.parametrize("half", [0.083, 0.61, 2.7])
def test_load_along_a_row_alone_stops_the_snow(half):
    row = solve_row(half)
    load = lambda z: float(find_row_load(row, np.array([z / half]))[0])  # noqa: E731
    for place in (-0.71, 0.0, 0.34):
        got = held_back(load, -half, half, place * half)
        assert got == pytest.approx(1.0, abs=2e-7)
    whole, _ = quad(
        lambda angle: half * math.sin(angle) * load(half * math.cos(angle)),
        0.0,
        math.pi,
    )
    assert row.total == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("half", [0.083, 0.61, 2.7])
def test_load_beside_a_free_gap_stops_the_snow_at_the_rows_and_not_between(half):
    gap = solve_free_gap(half)
    for place in (1.31 * half, half + 0.8):
        assert held_by_rows(gap, place) == pytest.approx(1.0, abs=2e-5)
    for number in (90, 260):
        slipped = 1.0 - held_by_rows(gap, float(gap.places[number]) * half)
        assert gap.velocities[number] == pytest.approx(slipped, abs=2e-5)


def held_by_rows(gap, place):
    """Velocity that the rows on both sides of a gap take away at a place."""
    near = 0.02 * gap.half  # closer to the gap the load is known by its sums
    ends = near * np.linspace(0.0, 1.0, 60) ** 2
    sums = np.array([0.0, *(find_excess_within(gap, end) + end for end in ends[1:])])
    middles = gap.half + (ends[1:] + ends[:-1]) / 2.0

    def load(z):
        return float(find_load(gap, np.array([z - gap.half]))[0])

    return sum(
        float(k0(np.abs(middles - at)) @ np.diff(sums)) / math.pi
        + held_back(load, gap.half + near, gap.half + 40.0, at)
        for at in (place, -place)
    )


@pytest.mark.parametrize("solve", SOLVERS)
def test_excess_up_to_a_distance_is_the_integral_of_the_load(solve):
    gap = solve(0.43)
    for near, far in ((0.17, 0.9), (0.31, 2.3)):
        got, _ = quad(
            lambda r: float(find_load(gap, np.array([r]))[0]) - 1.0, near, far
        )
        expected = find_excess_within(gap, far) - find_excess_within(gap, near)
        assert got == pytest.approx(expected, rel=1e-6)
    assert find_excess_within(gap, 30.0) == pytest.approx(gap.excess, rel=1e-9)


def test_excess_begins_at_the_end_of_the_row():
    """Whole excess by what is shed, against that of the load from the very end."""
    for half in (0.012, 0.43, 3.1):
        gap = solve_free_gap(half)
        assert abs(find_excess_within(gap, 1e-9)) < 4e-3 * math.sqrt(half)


@pytest.mark.parametrize("half", [0.29, 1.7])
@pytest.mark.parametrize(
    ("solve", "order"), [(solve_free_gap, 1.0), (solve_pulled_gap, 0.5)]
)
def test_plane_elements_tend_to_the_excess(solve, order, half):
    """Order of a mesh whose smallest element is halved: twice the power of the end."""
    is_pulled = solve is solve_pulled_gap
    sizes = (0.064, 0.016, 0.004)
    errors = [
        abs(plane_excess(half, size, is_pulled=is_pulled) / solve(half).excess - 1.0)
        for size in sizes
    ]
    assert errors[-1] < (0.001 if not is_pulled else 0.05)
    got = math.log(errors[-2] / errors[-1]) / math.log(sizes[-2] / sizes[-1])
    assert got == pytest.approx(order, abs=0.1)


def plane_excess(half, size, *, is_pulled):
    """Whole excess by quadratic elements graded to the gap's end and the row."""
    far = 9.0
    across = np.concatenate(
        [half - grade(size, half)[::-1], half + grade(size, far)[1:]]
    )
    mesh = skfem.MeshQuad.init_tensor(grade(size, far), across)
    basis = skfem.Basis(mesh, skfem.ElementQuad2())
    matrix = skfem.BilinearForm(lambda u, w, _: dot(grad(u), grad(w)) + u * w)
    above = matrix.assemble(basis)
    x, z = basis.doflocs
    row = (x == 0.0) & (z > half - 1e-12)
    gap = (x == 0.0) & ~row
    count = basis.N
    below = np.arange(count) + count
    below[gap] = np.arange(count)[gap]  # snow below hangs on that in the gap
    places = np.concatenate([np.arange(count), below])
    ones = (np.ones(2 * count), (np.arange(2 * count), places))
    joined = sparse.csr_matrix(ones, shape=(2 * count, 2 * count))
    whole = (joined.T @ sparse.block_diag([above, above]) @ joined).tocsr()
    if not is_pulled:
        whole = sparse.block_diag([above, sparse.identity(count)]).tocsr()
    known = np.zeros(2 * count, dtype=bool)
    known[:count] = row
    free = np.zeros(2 * count, dtype=bool)
    free[np.unique(places) if is_pulled else np.arange(count)] = True
    free &= ~known
    values = known.astype(float)
    values[free] = spsolve(
        whole[free][:, free].tocsc(), -whole[free][:, known] @ values[known]
    )
    return float((above @ values[:count])[row].sum()) - far


def grade(first, total):
    places, step = [0.0], first
    while places[-1] < total:
        places.append(places[-1] + step)
        step *= 1.15
    return np.array(places) * (total / places[-1])


def test_wide_gaps_tend_to_the_wedge():
    """(W18), its integral by quadrature."""
    for solve, angle in ((solve_free_gap, math.pi), (solve_pulled_gap, 2.0 * math.pi)):
        wedge, _ = quad(
            lambda mu, w=angle: math.tanh(w * mu) / math.tanh(math.pi * mu / 2.0) - 1.0,
            1e-12,
            40.0,
        )
        assert solve(7.7).excess == pytest.approx(wedge, abs=2e-5)
    assert solve_free_gap(7.7).excess == pytest.approx(0.5, abs=2e-6)


def test_narrow_gaps_tend_to_the_endless_wall():
    halves = np.array([0.04, 0.02, 0.01])
    left = [
        abs(solve_free_gap(half).excess / (half - math.pi * half**2 / 4.0) - 1.0)
        for half in halves
    ]
    assert left[-1] < 2e-6
    assert max(left[1:]) < 0.2 * left[0]
    pulled = [solve_pulled_gap(half).excess for half in (1e-4, 1e-5, 1e-6)]
    inverse = np.diff(1.0 / np.array(pulled))  # E goes as 1 / ln h
    assert inverse == pytest.approx(inverse[0], rel=0.02)


def test_short_rows_tend_to_a_mast_and_long_ones_to_two_ends():
    for half in (3e-4, 3e-3):
        mast = math.pi / (math.log(4.0 / half) - np.euler_gamma)
        assert solve_row(half).total == pytest.approx(mast, rel=3.0 * half**2 * 9.0)
    assert solve_row(7.7).total == pytest.approx(2 * 7.7 + 1.0, rel=1e-6)
    # the load on a mast, for each metre, is far above that of an endless wall
    assert solve_row(3e-3).total / 6e-3 > 70.0


@pytest.mark.parametrize("solve", [*SOLVERS, solve_row])
def test_functions_converge_and_the_error_says_so(solve):
    """Each function more takes away most of the error: no power, an exponential."""

    def read(count):
        one = solve(7.3, functions=count)
        return (one.total if solve is solve_row else one.excess), one.error

    best, _ = read(16)
    found = [read(count) for count in (6, 7, 8, 9)]
    least = 4.0 if solve is solve_pulled_gap else 15.0
    for (_, before), (_, after) in pairwise(found):
        assert before / after > least
    assert all(error > abs(value - best) for value, error in found)


def test_a_load_is_the_same_from_both_ends():
    row = solve_row(0.77)
    places = np.array([0.11, 0.58, 0.93])
    assert find_row_load(row, places) == pytest.approx(find_row_load(row, -places))
    for solve in SOLVERS:
        gap = solve(0.77)
        assert gap.velocities == pytest.approx(gap.velocities[::-1], rel=1e-9)


def test_space_without_flow_along_the_row_is_the_plan_view():
    """Mesh and averaging alone are left: two hundredths."""
    block = replace(build_block(1.3, 2.1, is_rough=False), is_straight=True)
    assert find_excess(block) == pytest.approx(find_plan_excess(1.3, 2.1), rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("slip", "gap", "is_rough", "whole", "within"),
    [
        (0.0, 2.0 / 3.0, False, 0.203, 0.186),
        (0.0, 2.0 / 3.0, True, 0.194, 0.176),
        (0.0, 5.0, False, 0.273, 0.249),
        (1.0, 2.0 / 3.0, False, 0.245, 0.214),
        (1.0, 2.0, True, 0.434, 0.340),
        (4.0, 2.0 / 3.0, False, 0.282, 0.234),
        (4.0, 12.0, False, 0.766, 0.555),
    ],
)
def test_fine_elements_in_space(slip, gap, is_rough, whole, within):
    """The figures in brackets of planview/THEORY.md, section 6."""
    coarse = build_block(slip, gap, is_rough=is_rough)
    fine = replace(coarse, size=0.05, layers=3)
    assert find_excess(fine) == pytest.approx((whole, within), abs=6e-4)
    assert find_excess(coarse) == pytest.approx((whole, within), rel=0.045)


def test_space_with_a_pulled_gap_tends_to_the_plan_view():
    """Root of the smallest element, as the pull at the gap's end goes as r^(-3/4)."""
    block = build_block(0.37, 0.9, is_rough=False)
    straight = replace(block, is_pulled=True, is_straight=True, layers=1)
    coarse, fine = (find_excess(replace(straight, size=size))[0] for size in (0.3, 0.1))
    limit = fine + (fine - coarse) / (math.sqrt(3.0) - 1.0)
    lateral = math.sqrt(0.37 + 1.0 / 3.0)
    plan = lateral * solve_pulled_gap(0.45 / lateral).excess
    assert coarse < fine < plan
    assert limit == pytest.approx(plan, rel=0.06)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("slip", "gap", "is_straight", "whole"),
    [
        (0.0, 2.0 / 3.0, False, (0.403, 0.453)),
        (1.0, 2.0 / 3.0, False, (0.542, 0.596)),
        (1.0, 2.0 / 3.0, True, (0.644, 0.710)),
        (1.0, 4.0, False, (0.779, 0.818)),
        (4.0, 12.0, False, (1.395, 1.494)),
        (4.0, 12.0, True, (1.758, 1.877)),
    ],
)
def test_elements_in_space_with_a_pulled_gap(slip, gap, is_straight, whole):
    """The second table of planview/THEORY.md, section 6."""
    block = build_block(slip, gap, is_rough=False)
    block = replace(block, is_pulled=True, is_straight=is_straight)
    got = [find_excess(replace(block, size=size))[0] for size in (0.15, 0.05)]
    assert got == pytest.approx(whole, abs=6e-4)


@pytest.mark.parametrize("half", [0.07, 0.6, 2.3])
def test_velocity_upslope_of_a_row_is_what_its_load_leaves(half):
    """By quadrature of the load; none at the row, all of it far away."""
    row = solve_row(half)
    for distance in (0.21, 1.3, 3.7):
        taken, _ = quad(
            lambda angle, x=distance: (
                float(find_row_load(row, np.array(np.cos(angle))))
                * math.sin(angle)
                * k0(math.hypot(x, half * math.cos(angle)))
            ),
            1e-9,
            math.pi - 1e-9,
            limit=400,
        )
        found = float(find_row_velocity(row, np.array(distance)))
        assert found == pytest.approx(1.0 - half * taken / math.pi, abs=1e-6)
    near, far = find_row_velocity(row, np.array([1e-4, 40.0]))
    assert abs(near) < 0.01
    assert far == pytest.approx(1.0, abs=1e-12)


def test_upslope_of_a_long_row_the_velocity_is_that_of_an_endless_wall():
    distances = np.array([0.2, 1.0, 2.5])
    found = find_row_velocity(solve_row(8.0), distances)
    assert found == pytest.approx(1.0 - np.exp(-distances), abs=2e-3)
