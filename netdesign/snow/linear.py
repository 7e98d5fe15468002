"""Linear problems of one mesh: element blocks to a sparse matrix, unknowns out of it.

The order of elimination depends on the template alone and is found once. Theory:
snow/THEORY.md, section 5. SciPy is imported where it is called: with the compiled core
it seldom is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.snow.element import list_dofs
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.shared_mesh import find_once

if TYPE_CHECKING:
    import scipy.sparse as sparse

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
