"""Creep with prescribed velocities on a boundary: the bench for exact solutions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse.linalg import splu

from netdesign.errors import SolveError
from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import Outcome
from netdesign.snow.kernel import (
    assemble_body_force,
    assemble_stiffness,
    assemble_stress,
    compute_strain,
)
from netdesign.snow.law import (
    FlowProblem,
    advance_stress,
    linearise_creep,
    sample_material,
    squared_invariant,
)
from netdesign.snow.placed_mesh import PlacedMesh

_LARGEST_ITERATIONS = 60
_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PrescribedFlow:
    """Solution on one mesh.

    Attributes
    ----------
    velocity : ndarray, shape (2, n_nodes)
        In the mesh's axes.
    strain : ndarray, shape (n_triangles, n_points, 3)
        (xx, yy, engineering xy).
    stress : ndarray, shape (n_triangles, n_points, 3 or 4)
        As the law's element takes it.
    """

    velocity: Floats
    strain: Floats
    stress: Floats


def solve_prescribed(
    problem: FlowProblem,
    mesh: PlacedMesh,
    *,
    held: Mask,
    values: Floats,
    body_force: Floats,
) -> PrescribedFlow:
    """Velocities where some components are given.

    Parameters
    ----------
    problem : FlowProblem
        Creep law; its ground, friction and gravity are not used.
    mesh : PlacedMesh
        Of the law's element.
    held : ndarray of bool, shape (2, n_nodes)
        Components that are given; all or none of a node on the net's side.
    values : ndarray, shape (2, n_nodes)
        Their values.
    body_force : ndarray, shape (2, n_triangles, n_points)
        At the quadrature points.

    Raises
    ------
    SolveError
        If Newton's method does not converge.
    """
    material = sample_material(problem, mesh.template)
    given = mesh.to_node_axes(np.where(held, values, 0.0))
    free = np.ones(mesh.n_dofs, dtype=bool)
    free[: mesh.n_velocities] = ~held.T.ravel()
    places = np.flatnonzero(free)
    load = assemble_body_force(mesh, body_force)
    stress = np.zeros((*mesh.weights.shape, mesh.operator.shape[2]))
    current = replace(problem, exponent=1.0)  # a linear start
    for _ in range(_LARGEST_ITERATIONS):
        tangent = linearise_creep(current, material, stress)
        matrix = assemble_stiffness(mesh, tangent.modulus)
        force = assemble_stress(mesh, tangent.intercept) - load + matrix @ given
        unknowns = given.copy()
        unknowns[places] = splu(matrix[places][:, places].tocsc()).solve(-force[places])
        strain = compute_strain(mesh, unknowns)
        before, stress = stress, advance_stress(current, tangent, strain)
        change = _norm(problem, mesh, stress - before) / _norm(problem, mesh, stress)
        if current is problem and change < _TOLERANCE:
            velocity = mesh.to_slope_axes(unknowns)
            return PrescribedFlow(
                velocity=velocity, strain=strain[..., :3], stress=stress
            )
        current = problem
    raise SolveError(Outcome.MAX_ITERATIONS, "flow with prescribed velocities")


def _norm(problem: FlowProblem, mesh: PlacedMesh, stress: Floats) -> float:
    size = squared_invariant(problem, sample_material(problem, mesh.template), stress)
    return float(np.sqrt((mesh.weights * size).sum()))
