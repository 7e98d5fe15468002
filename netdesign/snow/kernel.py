"""Fast assembly of the creep problem on one placed mesh, and its linear problems.

Same integrals as the readable forms in ``snow/forms.py`` (tests compare them),
written with arrays over (triangle, quadrature point). Unknowns are velocities in node
axes, (normal, tangential) to the net at its nodes and (X, Y) elsewhere, interleaved;
then, in the mixed element, one pressure per vertex. Plane tensors are stored as
(xx, yy, xy); strain rates with the engineering shear. Element blocks become a sparse
matrix, whose order of elimination depends on the template alone and is found once.
Theory: snow/THEORY.md, section 5. SciPy is imported where it is called: with the
compiled core it seldom is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask, gather
from netdesign.snow.element import find_once, list_dofs, reference_element
from netdesign.snow.mesh import MeshTemplate, edge_triples
from netdesign.snow.placed_mesh import EDGE_SHAPE, PlacedMesh

if TYPE_CHECKING:
    import scipy.sparse as sparse


def interpolate(mesh: PlacedMesh, nodal: Floats) -> Floats:
    """Values at the quadrature points.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    nodal : ndarray, shape (.., n_nodes)
        Any unit.

    Returns
    -------
    ndarray, shape (.., n_triangles, n_points)
        In that unit.
    """
    shape, _, _ = reference_element()
    return np.asarray(nodal[..., mesh.template.triangles.T] @ shape.T)


def compute_strain(mesh: PlacedMesh, unknowns: Floats) -> Floats:
    """Generalised strains at the quadrature points.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    unknowns : ndarray, shape (n_dofs,)
        Velocities, and pressures of the mixed element.

    Returns
    -------
    ndarray, shape (n_triangles, n_points, R)
        (xx, yy, xy) and, in the mixed element, the pressure.
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    operator = mesh.operator.reshape(n_triangles, n_points * n_rows, n_columns)
    strains = operator @ unknowns[mesh.dofs][..., None]
    return np.asarray(strains.reshape(n_triangles, n_points, n_rows))


def assemble_stress(mesh: PlacedMesh, stress: Floats) -> Floats:
    """Nodal forces of stresses.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    stress : ndarray, shape (n_triangles, n_points, R)
        Generalised stresses [rho g d].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    operator = mesh.operator.reshape(n_triangles, n_points * n_rows, n_columns)
    weighted = (stress * mesh.weights[..., None]).reshape(n_triangles, 1, -1)
    return gather(mesh.dofs, weighted @ operator, mesh.n_dofs)


def assemble_stiffness(mesh: PlacedMesh, moduli: Floats) -> Matrix:
    """Matrix of moduli.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    moduli : ndarray, shape (n_triangles, n_points, R, R)
        Stress over strain rate [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        In node axes.
    """
    n_triangles, n_points, n_rows, n_columns = mesh.operator.shape
    flat = (n_triangles, n_points * n_rows, n_columns)
    stresses = (moduli * mesh.weights[..., None, None]) @ mesh.operator
    values = mesh.operator.reshape(flat).transpose(0, 2, 1) @ stresses.reshape(flat)
    return sum_blocks(mesh.dofs, values, mesh.n_dofs)


def assemble_body_force(mesh: PlacedMesh, force: Floats) -> Floats:
    """Nodal loads of a body force.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    force : ndarray, shape (2, n_triangles, n_points)
        In the slope's axes [rho g].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    shape, _, _ = reference_element()
    n_nodes = mesh.nodes.shape[1]
    nodal = [
        gather(mesh.template.triangles.T, (mesh.weights * part) @ shape, n_nodes)
        for part in force
    ]
    return mesh.to_node_axes(np.array(nodal))


def assemble_end_load(mesh: PlacedMesh, force: float) -> Floats:
    """Nodal loads of a uniform traction on the upslope end.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    force : float
        Along X, for each metre of width [rho g d^2].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    along = force * share_end_load(mesh.template)
    return mesh.to_node_axes(np.array([along, np.zeros_like(along)]))


@find_once
def share_end_load(template: MeshTemplate) -> Floats:
    """Shares of the nodes in a uniform traction on the upslope end.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh, which is the placed one there.

    Returns
    -------
    ndarray, shape (n_nodes,)
        [-]
    """
    eta = template.nodes[1]
    start, middle, stop = edge_triples(template.upstream)
    lengths = eta[stop] - eta[start]
    shares = np.zeros(eta.size)
    np.add.at(shares, start, lengths / 6.0)
    np.add.at(shares, middle, lengths * 4.0 / 6.0)
    np.add.at(shares, stop, lengths / 6.0)
    return shares


def assemble_base_force(mesh: PlacedMesh, shear: Floats) -> Floats:
    """Nodal forces of a shear stress on the ground.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    shear : ndarray, shape (n_edges, n_points)
        Shear stress on the ground [rho g d].

    Returns
    -------
    ndarray, shape (n_dofs,)
        In node axes [rho g d^2].
    """
    forces = (mesh.base_weights * shear) @ EDGE_SHAPE
    return gather(mesh.base_dofs, forces, mesh.n_dofs)


def assemble_base_stiffness(mesh: PlacedMesh, modulus: Floats) -> Matrix:
    """Matrix of a base modulus.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    modulus : ndarray, shape (n_edges, n_points)
        Shear stress over velocity [-].

    Returns
    -------
    sparse matrix, shape (n_dofs, n_dofs)
        In node axes.
    """
    weighted = mesh.base_weights * modulus
    values = np.einsum("eq,qi,qj->eij", weighted, EDGE_SHAPE, EDGE_SHAPE)
    return sum_blocks(mesh.base_dofs, values, mesh.n_dofs)


def compute_base_velocity(mesh: PlacedMesh, velocity: Floats) -> Floats:
    """Velocity along the ground.

    Parameters
    ----------
    mesh : PlacedMesh
        Mesh against the net's curve.
    velocity : ndarray, shape (n_dofs,)
        Unknowns in node axes [velocity scale].

    Returns
    -------
    ndarray, shape (n_edges, n_points)
        [velocity scale].
    """
    return np.asarray(velocity[mesh.base_dofs] @ EDGE_SHAPE.T)


Matrix: TypeAlias = "sparse.csr_matrix"

# Pivots on the diagonal are kept while they are so large, over the largest of their
# column: they fill in little, and one refinement gives the digits back.
_LEAST_PIVOT = 0.01


class SingularError(Exception):
    """The linear problem has no unique solution."""


def sum_blocks(dofs: Ints, values: Floats, size: int) -> Matrix:
    """Matrix whose dense blocks these are.

    Parameters
    ----------
    dofs : ndarray of int, shape (n, C)
        Unknowns of each block.
    values : ndarray, shape (n, C, C)
        Its entries, any unit.
    size : int
        Number of unknowns.

    Returns
    -------
    sparse matrix, shape (size, size)
        Sum of the blocks.
    """
    import scipy.sparse as sparse

    count = dofs.shape[1]
    rows, columns = np.repeat(dofs, count, axis=1), np.tile(dofs, (1, count))
    entries = (values.ravel(), (rows.ravel(), columns.ravel()))
    return sparse.csr_matrix(entries, shape=(size, size))


def solve_matrix(
    template: MeshTemplate,
    matrix: Matrix,
    force: Floats,
    free: Mask,
    friction: Floats | None = None,
) -> Floats:
    """Unknowns u with K u = -force, 0 where held.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    matrix : sparse matrix, shape (n_dofs, n_dofs)
        K.
    force : ndarray, shape (n_dofs,) or (n_dofs, m)
        Out-of-balance forces, or several of them.
    free : ndarray of bool, shape (n_dofs,)
        Unknowns that nothing holds.
    friction : ndarray, shape (n_dofs,), optional
        At each tangential (odd) unknown, what of the row before it is added to its
        own row, eq. (N14); 0 elsewhere.

    Returns
    -------
    ndarray, of the shape of ``force``
        In the unit of velocities [velocity scale].

    Raises
    ------
    SingularError
        If there is no unique solution.
    """
    import scipy.sparse as sparse
    from scipy.sparse.linalg import splu

    load = -force
    if friction is not None:
        shared = sparse.identity(free.size) + sparse.diags(friction[1:], -1)
        matrix, load = sparse.csr_matrix(shared @ matrix), np.asarray(shared @ load)
    order = find_order(template, free.size > 2 * template.nodes.shape[1])
    kept = order[free[order]]
    inner, load = matrix[kept][:, kept].tocsc(), load[kept]
    options = {"SymmetricMode": True}
    try:
        factors = splu(
            inner, "NATURAL", diag_pivot_thresh=_LEAST_PIVOT, options=options
        )
    except RuntimeError as error:  # how SuperLU tells of a singular matrix
        raise SingularError(str(error)) from None
    unknowns = np.zeros_like(force)
    unknowns[kept] = factors.solve(load)
    unknowns[kept] += factors.solve(load - inner @ unknowns[kept])
    return unknowns


@find_once
def find_order(template: MeshTemplate, is_mixed: bool) -> Ints:
    """Unknowns in SuperLU's order of least degrees, which fills in little.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    is_mixed : bool
        Its element has pressures.

    Returns
    -------
    ndarray of int, shape (n_dofs,)
        Of every unknown its number, the first to be eliminated first.
    """
    from scipy.sparse.linalg import splu

    dofs = list_dofs(template, "mixed" if is_mixed else "velocity")
    # a heavy diagonal: the order is that of the entries, pivots do not change it
    block = np.eye(dofs.shape[1]) * dofs.size + 1.0
    values = np.broadcast_to(block, (*dofs.shape, dofs.shape[1]))
    matrix = sum_blocks(dofs, values, int(dofs.max()) + 1).tocsc()
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    return np.argsort(factors.perm_c)
