"""Every way to solve the linear problem of a mesh, against a dense solution."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.linalg import splu

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.snow import linear
from netdesign.snow.kernel import build_stiffness
from netdesign.snow.linear import SingularError, solve_blocks
from netdesign.snow.mesh import build_template
from netdesign.snow.ordering import Blocks, _narrow, build_ordering

MU = 0.6


@pytest.fixture
def problem(a_mesh):
    """Blocks, forces, free unknowns and friction of five slipping nodes."""
    mesh = a_mesh(inclination_deg=30.0, sag=0.05)
    rng = np.random.default_rng(3)
    roots = rng.normal(size=(*mesh.weights.shape, 3, 3))
    moduli = roots @ roots.swapaxes(-1, -2) + 0.1 * np.eye(3)
    free = np.ones(mesh.n_dofs, dtype=bool)
    ground, net = mesh.template.ground, mesh.template.net
    free[2 * ground] = free[2 * ground + 1] = free[2 * net] = free[2 * net + 1] = False
    slipping = 2 * net[3:8] + 1
    free[slipping] = True
    friction = np.zeros(mesh.n_dofs)
    friction[slipping] = [-MU, -MU, MU, -MU, MU]
    return mesh, [build_stiffness(mesh, moduli)], rng.normal(size=mesh.n_dofs), (
        free, friction,
    )  # fmt: skip


def solve_dense(mesh, blocks, force, free, friction):
    """Rows as (N14) has them: each tangential one with its share of the normal one."""
    matrix = sum(block.to_matrix(mesh.n_dofs) for block in blocks).toarray()
    right = -force.copy()
    for tangential in np.flatnonzero(friction):
        matrix[tangential] += friction[tangential] * matrix[tangential - 1]
        right[tangential] += friction[tangential] * right[tangential - 1]
    unknowns = np.zeros_like(force)
    kept = np.flatnonzero(free)
    unknowns[kept] = np.linalg.solve(matrix[np.ix_(kept, kept)], right[kept])
    return unknowns


WAYS = {
    "Cholesky, LU where it slips": {},
    "LU": {"_WIDEST_CHOLESKY": 0},
    "SuperLU": {"_WIDEST_CHOLESKY": 0, "_WIDEST_LU": 0},
}


@pytest.fixture(params=[False, True], ids=["uniform", "layered"])
def is_layered(request):
    return request.param


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
@pytest.mark.parametrize("slips", [True, False], ids=["slips", "sticks"])
@pytest.mark.parametrize("columns", [1, 3])
def test_all_ways_give_the_dense_solution(
    monkeypatch, problem, way, slips, columns, is_layered
):
    for name, value in way.items():
        monkeypatch.setattr(linear, name, value)
    mesh, blocks, force, (free, friction) = problem
    forces = np.stack([force * (k + 1.0) for k in range(columns)], axis=1)
    ordering = build_ordering(mesh.template, has_pressures=False, couples_net=False)
    ordering = replace(ordering, is_layered=is_layered)
    found = solve_blocks(
        ordering,
        blocks,
        force if columns == 1 else forces,
        free,
        friction if slips else None,
        is_definite=True,
    )
    truth = solve_dense(mesh, blocks, force, free, friction if slips else 0 * friction)
    wanted = truth if columns == 1 else np.stack([truth * k for k in (1, 2, 3)], axis=1)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 * np.abs(truth).max())


def test_pattern_is_kept_and_sums_the_blocks_in_its_order(problem):
    mesh, blocks, _, (free, _) = problem
    ordering = build_ordering(mesh.template, has_pressures=False, couples_net=False)
    ordering = replace(ordering, patterns={})
    for share in (1.0, 0.31):
        parts = [
            linear._mask(b._replace(values=share * b.values), free) for b in blocks
        ]
        pattern = ordering.find_pattern(parts)
        summed = linear._sum_up(pattern, parts, ~free)
        wanted = sum(part.to_matrix(mesh.n_dofs).toarray() for part in parts)
        wanted[~free, ~free] = max(np.abs(part.values).max() for part in parts)
        found = summed.toarray()[np.ix_(pattern.place, pattern.place)]
        np.testing.assert_allclose(found, wanted, rtol=1e-13, atol=1e-13)
        assert summed.has_sorted_indices
    assert len(ordering.patterns) == 1


@pytest.mark.parametrize("level", [1, 2])
def test_order_of_least_degrees_fills_in_less_than_the_band(level):
    """A permutation, whose factor has less than the band of the narrow order."""
    template = build_template(5.3, MESH_LEVELS[level])
    ordering = build_ordering(template, has_pressures=False, couples_net=False)
    corners = template.triangles.T
    dofs = np.concatenate([2 * corners, 2 * corners + 1], axis=1)
    values = np.where(np.eye(12, dtype=bool), 12.0, 1.0) * np.ones((len(dofs), 1, 1))
    parts = [Blocks(dofs=dofs, values=values, n_paired=12)]
    pattern = ordering.find_pattern(parts)
    assert np.array_equal(np.sort(pattern.place), np.arange(ordering.place.size))
    matrix = linear._sum_up(pattern, parts, np.zeros(ordering.place.size, dtype=bool))
    factors = splu(matrix, permc_spec="NATURAL", options={"SymmetricMode": True})
    assert factors.L.nnz < 0.5 * ordering.place.size * ordering.band


@pytest.mark.parametrize("tops", [(), (0.37,)])
def test_layers_of_the_template_are_known(tops):
    template = build_template(4.31, MESH_LEVELS[0], tops)
    ordering = build_ordering(template, has_pressures=False, couples_net=False)
    assert ordering.is_layered is bool(tops)


def test_what_nothing_holds_is_singular(problem):
    mesh, blocks, force, (free, _) = problem
    ordering = build_ordering(mesh.template, has_pressures=False, couples_net=False)
    loose = blocks[0]._replace(values=np.zeros_like(blocks[0].values))
    with pytest.raises(SingularError):
        solve_blocks(ordering, [loose], force, free, None, is_definite=True)


@pytest.mark.parametrize("pressures", [False, True])
@pytest.mark.parametrize("level", [0, 1, 2])
def test_an_order_is_a_permutation_as_wide_as_it_says(level, pressures):
    template = build_template(5.0, MESH_LEVELS[level])
    ordering = build_ordering(template, has_pressures=pressures, couples_net=False)
    size = 2 * template.nodes.shape[1] + pressures * template.n_vertices
    assert np.array_equal(np.sort(ordering.place), np.arange(size))
    corners = template.triangles.T
    dofs = np.concatenate([2 * corners, 2 * corners + 1], axis=1)
    if pressures:
        first = 2 * template.nodes.shape[1]
        dofs = np.concatenate([dofs, first + corners[:, :3]], axis=1)
    rows = ordering.place[dofs]
    assert (rows.max(axis=1) - rows.min(axis=1)).max() <= ordering.band


def test_sweeps_narrow_an_order():
    """A chain of nodes numbered at random; in a row they reach only neighbours."""
    count = 60
    names = np.random.default_rng(5).permutation(count)
    links = [(k, k + step) for k in range(count) for step in (-1, 0, 1)]
    pairs = np.array([link for link in links if 0 <= link[1] < count])
    rows, columns = names[pairs[:, 0]], names[pairs[:, 1]]
    sort = np.argsort(rows, kind="stable")
    rows, columns = rows[sort], columns[sort]

    def reach(order):
        place = np.argsort(order)
        return np.abs(place[rows] - place[columns]).max()

    swapped = names.reshape(-1, 6)[:, ::-1].ravel()  # six by six the wrong way round
    narrow = _narrow(swapped, rows, columns)
    assert np.array_equal(np.sort(narrow), np.arange(count))
    assert reach(swapped) == 11
    assert reach(narrow) < 6
