"""The flow's Newton step in plain scikit-fem: a measure for the fast kernel.

Same equations, points and contacts as ``snow/flow.py``, written as one would with
the library's forms: a basis per placement of the mesh, matrices assembled and
condensed by scikit-fem, solved by SciPy's sparse direct solver. Pass ``advance`` as
``SolverSettings.step``. Theory: snow/THEORY.md, (N9) to (N14) and (N20).
"""

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import pytest
import scipy.sparse as sparse
import skfem
from skfem.element import DiscreteField

from netdesign.addons.evidence.benchmark.scenes import SCENES, build_tables
from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.numerics.arrays import Ints
from netdesign.snow.contact import FlowState, free_unknowns, friction_shares
from netdesign.snow.flow_step import linearise_base
from netdesign.snow.forms import (
    assemble_gravity_form,
    assemble_mixed_form,
    assemble_stress_form,
    assemble_tangent_form,
    build_basis,
)
from netdesign.snow.kernel import assemble_end_load
from netdesign.snow.law import advance_stress, linearise_creep
from netdesign.snow.placed_mesh import EDGE_SHAPE

_BASE_DEGREE = 7  # four Gauss points an edge, as the kernel


class _Base(NamedTuple):
    """Velocities on the ground; ``order`` takes the kernel's points to scikit-fem's."""

    basis: skfem.FacetBasis
    order: Ints


def advance(problem, material, mesh, state, contact):
    """One Newton step on the stress."""
    tangent = linearise_creep(problem, material, state.stress)
    matrix = _assemble_matrix(problem, mesh, tangent)
    force = _assemble_force(problem, material, mesh, tangent)
    base = None
    if state.base_shear is not None:
        base = linearise_base(problem, state.base_shear, contact)
        matrix = matrix + _assemble_base_matrix(mesh, base.modulus)
        force += _assemble_base_force(mesh, base.intercept)
    turn = _rotation(mesh)
    matrix, force = turn.T @ matrix @ turn, turn.T @ force
    unknowns = _solve(problem, mesh, contact, matrix, force)
    stress = advance_stress(problem, tangent, _compute_strain(mesh, turn @ unknowns))
    base_shear = None
    if base is not None:
        base_shear = base.intercept + base.modulus * _base_velocity(mesh, unknowns)
    return FlowState(
        unknowns=unknowns,
        reaction=force + matrix @ unknowns,
        stress=stress,
        base_shear=base_shear,
        contact=contact,
    )


def _assemble_matrix(problem, mesh, tangent):
    if problem.element == "mixed":
        return assemble_mixed_form(mesh, tangent.modulus)
    return assemble_tangent_form(mesh, tangent.modulus)


def _assemble_force(problem, material, mesh, tangent):
    """Forces of the kept stress less those of gravity (n_dofs,), slope's axes."""
    density = np.broadcast_to(np.asarray(material.density), mesh.weights.shape)
    force = assemble_stress_form(mesh, tangent.intercept[..., :3])
    force -= assemble_gravity_form(mesh, problem.gravity, density)
    if problem.end_load:
        force -= assemble_end_load(mesh, problem.end_load)[: mesh.n_velocities]
    if problem.element == "velocity":
        return force
    pressure = build_basis(mesh).with_element(skfem.ElementTriP1())
    form = skfem.LinearForm(lambda q, at: at.intercept * q)
    kept = form.assemble(pressure, intercept=DiscreteField(tangent.intercept[..., 3]))
    return np.concatenate([force, kept])


def _assemble_base_matrix(mesh, modulus):
    base = _build_base_basis(mesh)
    form = skfem.BilinearForm(lambda v, w, at: at.modulus * v[0] * w[0])
    matrix = form.assemble(base.basis, modulus=_on_base(base, modulus)).tocoo()
    entries = (matrix.data, (matrix.row, matrix.col))
    return sparse.csr_matrix(entries, shape=(mesh.n_dofs, mesh.n_dofs))


def _assemble_base_force(mesh, shear):
    base = _build_base_basis(mesh)
    form = skfem.LinearForm(lambda w, at: at.shear * w[0])
    force = np.zeros(mesh.n_dofs)
    force[: mesh.n_velocities] = form.assemble(base.basis, shear=_on_base(base, shear))
    return force


def _base_velocity(mesh, unknowns):
    """Velocity along the ground in the kernel's order (n_edges, n_points)."""
    base = _build_base_basis(mesh)
    along = np.asarray(base.basis.interpolate(unknowns[: mesh.n_velocities])[0])
    in_order = np.empty(along.size)
    in_order[base.order] = along.ravel()
    return in_order.reshape(mesh.base_weights.shape)


def _solve(problem, mesh, contact, matrix, force):
    shares = friction_shares(problem, mesh, contact)
    if shares is not None:
        # normal rows are added to the tangential rows after them, eq. (N14)
        friction = sparse.identity(mesh.n_dofs) + sparse.diags(shares[1:], -1)
        matrix = sparse.csr_matrix(friction @ matrix)
        force = np.asarray(friction @ force)
    held = np.flatnonzero(~free_unknowns(problem, mesh, contact))
    condensed = skfem.condense(sparse.csc_matrix(matrix), -force, D=held)
    return np.asarray(skfem.solve(*condensed))


def _compute_strain(mesh, velocity):
    """Generalised strains (n_triangles, n_points, 3 or 4) of slope's axes unknowns."""
    basis = build_basis(mesh)
    (xx, xy), (yx, yy) = basis.interpolate(velocity[: mesh.n_velocities]).grad
    strains = [xx, yy, xy + yx]
    if mesh.n_dofs > mesh.n_velocities:
        pressure = basis.with_element(skfem.ElementTriP1())
        strains.append(np.asarray(pressure.interpolate(velocity[mesh.n_velocities :])))
    return np.stack(strains, axis=-1)


@lru_cache(maxsize=2)
def _rotation(mesh):
    """Node axes to slope's axes, a block a node; pressures stay."""
    cosine, sine = mesh.axes
    blocks = np.array([[cosine, -sine], [sine, cosine]]).transpose(2, 0, 1)
    count = len(blocks)
    turn = sparse.bsr_matrix((blocks, np.arange(count), np.arange(count + 1)))
    pressures = sparse.identity(mesh.n_dofs - mesh.n_velocities)
    return sparse.csr_matrix(sparse.block_diag([turn, pressures]))


@lru_cache(maxsize=2)
def _build_base_basis(mesh):
    curved = build_basis(mesh).mesh
    at_rest = np.abs(curved.p[1][curved.facets]).max(axis=0) == 0.0
    basis = skfem.FacetBasis(
        curved,
        skfem.ElementVector(skfem.ElementTriP2()),
        facets=np.flatnonzero(at_rest),
        intorder=_BASE_DEGREE,
    )
    places = np.asarray(basis.global_coordinates())[0].ravel()
    ends = mesh.nodes[0, mesh.base_dofs // 2]
    own = (ends @ EDGE_SHAPE.T).ravel()
    order = np.empty(own.size, dtype=np.int64)
    order[np.argsort(places)] = np.argsort(own)
    return _Base(basis, order)


def _on_base(base, values):
    """Values of the kernel's points at scikit-fem's."""
    shape = base.basis.dx.shape
    return DiscreteField(values.ravel()[base.order].reshape(shape))


# The same steps with sums and eliminations in another order. The free ground lets
# rounding grow: nothing but the net holds the snow along X.
ROUNDING = 1e-9
SETTINGS = SolverSettings(levels=MESH_LEVELS[:2], accuracy=0.1)
WITH_PRESSURES = {
    **SCENES["dense-firn"],
    "snow": {**SCENES["dense-firn"]["snow"], "density_kg_m3": 880.0},
}
CHOSEN = {
    name: SCENES[name]
    for name in (
        *("paper-30", "slipping-part", "smooth-net", "rough-ground"),
        *("layered", "dense-firn", "freeboard"),
    )
} | {"with-pressures": WITH_PRESSURES}


@pytest.mark.parametrize("name", CHOSEN)
def test_paths_agree(name):
    scene = build_tables(CHOSEN[name])
    fast = solve_steady(scene, SETTINGS, on_failure="raise")
    plain = solve_steady(scene, replace(SETTINGS, step=advance), on_failure="raise")
    assert isinstance(fast, Solution)
    assert isinstance(plain, Solution)
    assert plain.cost == fast.cost
    for end in ("foot", "head"):
        expected, found = getattr(fast, end), getattr(plain, end)
        assert (found.x, found.y) == pytest.approx(
            (expected.x, expected.y), abs=ROUNDING * expected.size
        )
