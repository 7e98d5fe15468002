"""Linear problems of one mesh: element blocks in, unknowns out.

Blocks are summed into one sparse matrix, which SuperLU factorises. Where its entries
lie never changes on a template, so their places and the order of elimination are found
once. Theory: snow/THEORY.md, section 5. SciPy is imported where it is called: with the
compiled core it seldom is.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, Mask, gather
from netdesign.snow.element import list_dofs
from netdesign.snow.mesh import MeshTemplate, edge_triples
from netdesign.snow.shared_mesh import find_once

if TYPE_CHECKING:
    import scipy.sparse as sparse

# Pivots on the diagonal are kept while they are so large, over the largest of their
# column: they fill in little, and one refinement gives the digits back.
_LEAST_PIVOT = 0.01


class SingularError(Exception):
    """The linear problem has no unique solution."""


class Blocks(NamedTuple):
    """Dense blocks of a matrix.

    Attributes
    ----------
    dofs : ndarray of int, shape (n, C)
        Unknowns of each block.
    values : ndarray, shape (n, C, C)
        Its entries.
    n_paired : int
        So many of the first columns are velocities in pairs, two per node.
    """

    dofs: Ints
    values: Floats
    n_paired: int

    def to_matrix(self, size: int) -> sparse.csr_matrix:
        """The matrix itself.

        Parameters
        ----------
        size : int
            Number of unknowns.

        Returns
        -------
        sparse matrix, shape (size, size)
            Sum of the blocks.
        """
        import scipy.sparse as sparse

        entries = _list_entries([self.dofs])
        return sparse.csr_matrix((self.values.ravel(), entries), shape=(size, size))

    def multiply(self, unknowns: Floats) -> Floats:
        """Product of the matrix with a vector.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            Any unit.

        Returns
        -------
        ndarray, shape (n_dofs,)
            Product.
        """
        parts = self.values @ unknowns[self.dofs][..., None]
        return gather(self.dofs, parts, unknowns.size)


class _Pattern(NamedTuple):
    """Places of a sparse matrix that may not be 0, column by column."""

    place: Ints  # row of each unknown in the order of elimination
    slots: Ints  # of each entry of the blocks among the stored ones
    rows: Ints  # of each stored entry
    starts: Ints  # first stored entry of each column, and the end
    diagonal: Ints  # stored entry of each unknown on the diagonal


def solve_blocks(
    template: MeshTemplate,
    parts: Sequence[Blocks],
    force: Floats,
    free: Mask,
    friction: Floats | None = None,
) -> Floats:
    """Unknowns u with K u = -force, 0 where held.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    parts : sequence of Blocks
        Whose sum is K: those of the triangles and, where there are any, those of the
        edges on the ground.
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
    from scipy.sparse.linalg import splu

    load = -force
    if friction is not None:
        shares = friction[1::2] if load.ndim == 1 else friction[1::2, None]
        load[1::2] += shares * load[: len(load) - 1 : 2]
        parts = [_add_friction(part, friction) for part in parts]
    load[~free] = 0.0
    is_mixed = parts[0].dofs.shape[1] > 12
    pattern = _find_pattern(template, is_mixed, len(parts) > 1)
    matrix = _sum_up(pattern, parts, free)
    options = {"SymmetricMode": True}
    try:
        factors = splu(
            matrix, "NATURAL", diag_pivot_thresh=_LEAST_PIVOT, options=options
        )
    except RuntimeError as error:  # how SuperLU tells of a singular matrix
        raise SingularError(str(error)) from None
    rhs = np.empty_like(load, order="F")
    rhs[pattern.place] = load
    solution = factors.solve(rhs)
    solution += factors.solve(rhs - matrix @ solution)
    return np.asarray(solution[pattern.place])


def _add_friction(part: Blocks, friction: Floats) -> Blocks:
    """Add a share of each normal row to the tangential row of the same node."""
    pairs = part.dofs[:, 1 : part.n_paired : 2]
    shares = friction[pairs]
    if not shares.any():
        return part
    values = part.values.copy()
    normal = part.values[:, 0 : part.n_paired : 2]
    values[:, 1 : part.n_paired : 2] += shares[..., None] * normal
    return part._replace(values=values)


def _sum_up(
    pattern: _Pattern, parts: Sequence[Blocks], free: Mask
) -> sparse.csc_matrix:
    """Sum of the parts in the pattern's order; rows and columns that are held empty."""
    import scipy.sparse as sparse

    kept = [free[part.dofs].astype(np.float64) for part in parts]
    values = np.concatenate(
        [
            (part.values * one[:, :, None] * one[:, None, :]).ravel()
            for part, one in zip(parts, kept, strict=True)
        ]
    )
    stored = gather(pattern.slots, values, pattern.rows.size)
    stored[pattern.diagonal[~free]] = float(np.abs(values).max()) or 1.0
    matrix = sparse.csc_matrix(
        (stored, pattern.rows, pattern.starts), shape=(free.size, free.size)
    )
    matrix.has_canonical_format = True  # else it is looked through each time
    return matrix


@find_once
def _find_pattern(template: MeshTemplate, is_mixed: bool, has_edges: bool) -> _Pattern:
    """Pattern of the blocks of triangles and, if asked, of the ground's edges."""
    groups = [list_dofs(template, "mixed" if is_mixed else "velocity")]
    if has_edges:
        groups.append(2 * np.column_stack(edge_triples(template.ground)))
    rows, columns = _list_entries(groups)
    size = int(groups[0].max()) + 1
    place = _find_least_degrees(rows, columns, size)
    stored, slots = np.unique(place[columns] * size + place[rows], return_inverse=True)
    return _Pattern(
        place=place,
        slots=slots,
        rows=(stored % size).astype(np.int32),
        starts=np.searchsorted(stored, np.arange(size + 1) * size).astype(np.int32),
        diagonal=np.searchsorted(stored, place * (size + 1)),
    )


def _list_entries(groups: Sequence[Ints]) -> tuple[Ints, Ints]:
    """Row and column of each entry of blocks, block by block."""
    rows = [np.repeat(dofs, dofs.shape[1], axis=1).ravel() for dofs in groups]
    columns = [np.tile(dofs, (1, dofs.shape[1])).ravel() for dofs in groups]
    return np.concatenate(rows), np.concatenate(columns)


def _find_least_degrees(rows: Ints, columns: Ints, size: int) -> Ints:
    """Places of the unknowns in SuperLU's order of least degrees."""
    import scipy.sparse as sparse
    from scipy.sparse.linalg import splu

    each = np.arange(size)
    # a heavy diagonal: the order is that of the entries, pivots do not change it
    values = np.append(np.ones(rows.size), np.full(size, float(rows.size)))
    entries = np.append(rows, each), np.append(columns, each)
    matrix = sparse.csc_matrix((values, entries), shape=(size, size))
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    return np.asarray(factors.perm_c, dtype=np.int64)
