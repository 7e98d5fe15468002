"""The linear problem of a mesh, against a dense solution."""

import numpy as np
import pytest

from netdesign.snow.kernel import (
    SingularError,
    assemble_base_stiffness,
    assemble_stiffness,
    solve_matrix,
)

MU = 0.6


@pytest.fixture
def problem(a_mesh):
    """Matrix, forces, free unknowns and friction of five slipping nodes."""
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
    return mesh, assemble_stiffness(mesh, moduli), rng.normal(size=mesh.n_dofs), (
        free, friction,
    )  # fmt: skip


def solve_dense(matrix, force, free, friction):
    """Rows as (N14) has them: each tangential one with its share of the normal one."""
    matrix, right = matrix.toarray(), -force
    for tangential in np.flatnonzero(friction):
        matrix[tangential] += friction[tangential] * matrix[tangential - 1]
        right[tangential] += friction[tangential] * right[tangential - 1]
    unknowns = np.zeros_like(force)
    kept = np.flatnonzero(free)
    unknowns[kept] = np.linalg.solve(matrix[np.ix_(kept, kept)], right[kept])
    return unknowns


@pytest.mark.parametrize("ground", ["held", "slides"])
@pytest.mark.parametrize("slips", [True, False], ids=["slips", "sticks"])
@pytest.mark.parametrize("columns", [1, 3])
def test_it_is_the_dense_solution(problem, slips, columns, ground):
    mesh, matrix, force, (free, friction) = problem
    if ground == "slides":
        free[2 * mesh.template.ground[1:]] = True
        modulus = np.full(mesh.base_weights.shape, 0.3)
        matrix = matrix + assemble_base_stiffness(mesh, modulus)
    forces = np.stack([force * (k + 1.0) for k in range(columns)], axis=1)
    found = solve_matrix(
        mesh.template,
        matrix,
        force if columns == 1 else forces,
        free,
        friction if slips else None,
    )
    truth = solve_dense(matrix, force, free, friction if slips else 0 * friction)
    wanted = truth if columns == 1 else np.stack([truth * k for k in (1, 2, 3)], axis=1)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 * np.abs(truth).max())


def test_what_nothing_holds_is_singular(problem):
    mesh, matrix, force, (free, _) = problem
    with pytest.raises(SingularError):
        solve_matrix(mesh.template, 0.0 * matrix, force, free)
