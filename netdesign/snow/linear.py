"""Linear problems of one mesh: element blocks in, unknowns out.

Each problem goes straight into LAPACK's banded storage, its unknowns in the order of
``ordering``: Cholesky where the matrix is symmetric and positive definite, LU where
friction or pressures are in it. Wide meshes go to SuperLU. Theory: snow/THEORY.md,
section 5. SciPy is imported where it is called: with the compiled core it seldom is.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from netdesign.numerics.arrays import Floats, Mask, gather
from netdesign.snow.ordering import Blocks, Ordering, Pattern

if TYPE_CHECKING:
    import scipy.sparse as sparse
    from scipy.sparse.linalg import SuperLU


# Above these half bandwidths SuperLU is faster (measured at 470 to 6800 unknowns).
_WIDEST_CHOLESKY, _WIDEST_LU = 160, 90
# Right sides that SuperLU solves at once: more leave the processor's cache (measured
# at 6,000 to 12,000 unknowns: 130 at once take 1.3 to 1.5 times as long).
_COLUMNS = 32


class SingularError(Exception):
    """The linear problem has no unique solution."""


def solve_blocks(
    ordering: Ordering,
    parts: Sequence[Blocks],
    force: Floats,
    free: Mask,
    friction: Floats | None = None,
    *,
    is_definite: bool,
) -> Floats:
    """Unknowns u with K u = -force, 0 where held.

    Parameters
    ----------
    ordering : Ordering
        Of the template.
    parts : sequence of Blocks
        Whose sum is K.
    force : ndarray, shape (n_dofs,) or (n_dofs, m)
        Out-of-balance forces, or several of them.
    free : ndarray of bool, shape (n_dofs,)
        Unknowns that nothing holds.
    friction : ndarray, shape (n_dofs,), optional
        At each tangential (odd) unknown, what of the row before it is added to its
        own row, eq. (N14); 0 elsewhere.
    is_definite : bool
        K is symmetric and positive definite, friction aside.

    Returns
    -------
    ndarray, of the shape of ``force``
        In the unit of velocities [velocity scale].

    Raises
    ------
    SingularError
        If there is no unique solution.
    """
    held = ~free
    load = -force
    if friction is not None:
        shares = friction[1::2] if load.ndim == 1 else friction[1::2, None]
        load[1::2] += shares * load[: len(load) - 1 : 2]
        parts = [_add_friction(part, friction) for part in parts]
    load[held] = 0.0
    masked = [_mask(part, free) for part in parts]
    is_symmetric = is_definite and friction is None
    if is_symmetric and ordering.band <= _WIDEST_CHOLESKY:
        return _solve_cholesky(ordering, masked, load, held)
    if ordering.band <= _WIDEST_LU:
        return _solve_lu(ordering, masked, load, held)
    return _solve_sparse(ordering, masked, load, held)


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


def _mask(part: Blocks, free: Mask) -> Blocks:
    kept = free[part.dofs].astype(np.float64)
    return part._replace(values=part.values * kept[:, :, None] * kept[:, None, :])


def _scale_of(values: Floats) -> float:
    return float(np.abs(values).max()) or 1.0


def _solve_cholesky(
    ordering: Ordering, parts: Sequence[Blocks], load: Floats, held: Mask
) -> Floats:
    from scipy.linalg import lapack

    matrix = ordering.fill(parts, lower=True)
    matrix[ordering.place[held], 0] = _scale_of(matrix[:, 0])
    _, solution, fault = lapack.dpbsv(
        matrix.T, _in_order(ordering, load), lower=1, overwrite_ab=1, overwrite_b=1
    )
    if fault != 0:
        raise SingularError("not positive definite")
    return np.asarray(solution[ordering.place])


def _in_order(ordering: Ordering, load: Floats) -> Floats:
    rhs = np.empty_like(load, order="F")
    rhs[ordering.place] = load
    return rhs


def _solve_lu(
    ordering: Ordering, parts: Sequence[Blocks], load: Floats, held: Mask
) -> Floats:
    from scipy.linalg import lapack

    band = ordering.band
    matrix = ordering.fill(parts, lower=False)
    matrix[ordering.place[held], 2 * band] = _scale_of(matrix[:, 2 * band])
    _, _, solution, fault = lapack.dgbsv(
        band, band, matrix.T, _in_order(ordering, load), overwrite_ab=1, overwrite_b=1
    )
    if fault != 0:
        raise SingularError("singular")
    return np.asarray(solution[ordering.place])


def _solve_sparse(
    ordering: Ordering, parts: Sequence[Blocks], load: Floats, held: Mask
) -> Floats:
    from scipy.sparse.linalg import splu

    pattern = ordering.find_pattern(parts)
    matrix = _sum_up(pattern, parts, held)
    try:
        factors = splu(
            matrix,
            permc_spec="NATURAL",  # the pattern has it in order
            diag_pivot_thresh=0.01,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:  # how SuperLU tells of a singular matrix
        raise SingularError(str(error)) from None
    rhs = np.empty_like(load, order="F")
    rhs[pattern.place] = load
    if load.ndim == 1:
        return _solve_refined(factors, matrix, rhs)[pattern.place]
    pieces = np.split(rhs, range(_COLUMNS, load.shape[1], _COLUMNS), axis=1)
    if ordering.is_layered:  # only a derivative has several: it needs few digits
        found = [factors.solve(piece) for piece in pieces]
    else:
        found = [_solve_refined(factors, matrix, piece) for piece in pieces]
    return np.asarray(np.hstack(found)[pattern.place])


def _sum_up(pattern: Pattern, parts: Sequence[Blocks], held: Mask) -> sparse.csc_matrix:
    """Sum of the parts in the pattern's order."""
    import scipy.sparse as sparse

    values = np.concatenate([part.values.ravel() for part in parts])
    stored = gather(pattern.slots, values, pattern.rows.size)
    stored[pattern.diagonal[held]] = _scale_of(values)
    matrix = sparse.csc_matrix(
        (stored, pattern.rows, pattern.starts), shape=(held.size, held.size)
    )
    matrix.has_canonical_format = True  # else it is looked through each time
    return matrix


def _solve_refined(factors: SuperLU, matrix: sparse.csc_matrix, load: Floats) -> Floats:
    """Solution of factors whose small pivots were accepted for sparsity.

    One refinement gives the digits back.
    """
    solution = factors.solve(load)
    return np.asarray(solution + factors.solve(load - matrix @ solution))
