"""Placement, balance of forces and the net by the compiled core, against NumPy."""

import numpy as np
import pytest

from netdesign.cable.funicular import solve_funicular
from netdesign.cable.parted import CableParts, find_part_lengths
from netdesign.core.library import find_core
from netdesign.outcome import Outcome
from netdesign.snow.flow_step import compute_residual
from netdesign.snow.placed_mesh import build_placed_mesh
from tests.core.drawn import NUMBERS, assert_alike, draw_case

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("element", ["velocity", "mixed"])
def test_a_placed_mesh_is_that_of_numpy(number, element, in_numpy):
    _, mesh, _ = draw_case(number)
    arguments = (mesh.template, mesh.nodes, element)
    found = build_placed_mesh(*arguments)
    expected = in_numpy(build_placed_mesh, *arguments)
    for name in ("weights", "gradients", "load", "net_normal", "axes", "operator"):
        assert_alike(getattr(found, name), getattr(expected, name), 1e-13)
    np.testing.assert_array_equal(found.dofs, expected.dofs)
    assert found.n_dofs == expected.n_dofs


def test_a_triangle_that_is_turned_over_is_not_valid():
    _, mesh, _ = draw_case(0)
    nodes = mesh.nodes.copy()
    nodes[:, mesh.template.triangles[0, 0]] += 10.0
    assert not build_placed_mesh(mesh.template, nodes).is_valid


@pytest.mark.parametrize("number", NUMBERS)
def test_the_forces_of_a_state_are_those_of_numpy(number, in_numpy):
    case = draw_case(number)
    assert_alike(compute_residual(*case), in_numpy(compute_residual, *case), 1e-12)


def draw_cable(number):
    """Nodal forces, lengths, stiffness, head and start of a cable."""
    rng = np.random.default_rng([31, number])
    count = int(rng.integers(1, 30))
    forces = rng.normal([[1.0], [-0.2]], 0.3, (2, 2 * count + 1)) / count
    lengths = rng.uniform(0.2, 1.8, count) / count
    head = (
        np.array([rng.uniform(-0.5, 0.9), 1.0]) * lengths.sum() * rng.uniform(0.7, 1.01)
    )
    return forces, lengths, 10.0 ** rng.uniform(0.5, 4.0), head, rng.normal(size=2)


@pytest.mark.parametrize("number", range(40))
def test_a_cable_is_that_of_numpy(number, in_numpy):
    drawn = draw_cable(number)
    found, expected = solve_funicular(*drawn), in_numpy(solve_funicular, *drawn)
    assert found.outcome is expected.outcome is Outcome.CONVERGED
    for name in ("curve", "tension", "pull", "foot_pull", "head_pull"):
        assert_alike(getattr(found, name), getattr(expected, name), 1e-9)


@pytest.mark.parametrize("fault", [np.nan, np.inf])
def test_a_cable_without_equilibrium(fault, in_numpy):
    forces, lengths, stiffness, head, start = draw_cable(1)
    forces[0, 1] = fault
    with np.errstate(invalid="ignore"):
        drawn = (forces, lengths, stiffness, head, start)
        found, expected = solve_funicular(*drawn), in_numpy(solve_funicular, *drawn)
    assert found.outcome is expected.outcome is Outcome.NO_EQUILIBRIUM


def draw_parted(number):
    """A cable of some parts, forces and a start near or far from the equilibrium."""
    rng = np.random.default_rng([37, number])
    sizes = rng.integers(1, 6, int(rng.integers(2, 6)))
    shares = np.concatenate([one / one.sum() for one in map(rng.random, sizes)])
    rises = rng.uniform(0.2, 1.0, sizes.size)
    parts = CableParts(
        shares=shares,
        part=np.repeat(np.arange(sizes.size), sizes),
        firsts=np.append(0, np.cumsum(sizes)[:-1]),
        rises=rises,
    )
    head_x = float(rng.uniform(0.0, 0.5))
    length = float(rises.sum() * rng.uniform(1.02, 1.3))
    stiffness = float(10.0 ** rng.uniform(1.0, 4.0))
    pushed = rng.choice([0.0, -20.0])  # down: some parts cannot rise
    forces = rng.normal([[0.5], [pushed]], 0.2, (2, 2 * shares.size + 1)) / shares.size
    start = rng.normal([0.0, 1.0], 0.4)
    return parts, forces, head_x, length, stiffness, start


def test_parts_of_cables_are_those_of_numpy(in_numpy):
    found = 0
    for number in range(60):
        drawn = draw_parted(number)
        lengths = find_part_lengths(*drawn)
        expected = in_numpy(find_part_lengths, *drawn)
        assert (lengths is None) == (expected is None)
        if expected is not None:
            assert_alike(lengths, expected, 1e-10)
            found += 1
    assert 10 < found < 60
