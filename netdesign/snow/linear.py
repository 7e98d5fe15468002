"""Linear problems of one mesh: element blocks in, unknowns out.

The sparsity of a template never changes, so its unknowns are ordered once for a small
bandwidth and each problem goes straight into LAPACK's banded storage: Cholesky where
the matrix is symmetric and positive definite, LU where friction or pressures are in it.
Wide meshes go to SuperLU. Theory: snow/THEORY.md, section 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.linalg import lapack

from netdesign.numerics.arrays import Floats, Ints, Mask
from netdesign.snow.mesh import MeshTemplate

if TYPE_CHECKING:
    import scipy.sparse as sparse
    from scipy.sparse.linalg import SuperLU


# Above these half bandwidths SuperLU is faster (measured at 470 to 4100 unknowns).
_WIDEST_CHOLESKY, _WIDEST_LU = 220, 120
# Slipping nodes, over the half bandwidth, whose friction is cheaper beside a Cholesky
# factor than in an LU one.
_MOST_SLIPPING = 0.15
# Sweeps that narrow an order (no more is gained after 25), and how far they move.
_SWEEPS, _SWEEP = 25, 0.7
# Right sides that SuperLU solves at once: more leave the processor's cache (measured
# at 6,000 to 12,000 unknowns: 130 at once take 1.3 to 1.5 times as long).
_COLUMNS = 32


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

        count = self.dofs.shape[1]
        rows = np.repeat(self.dofs, count, axis=1).ravel()
        columns = np.tile(self.dofs, (1, count)).ravel()
        return sparse.csr_matrix(
            (self.values.ravel(), (rows, columns)), shape=(size, size)
        )

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
        sums = np.bincount(self.dofs.ravel(), parts.ravel(), minlength=unknowns.size)
        return np.asarray(sums)


class Pattern(NamedTuple):
    """Places of a sparse matrix that may not be 0, column by column.

    Attributes
    ----------
    slots : ndarray of int, shape (n,)
        Place of each entry of the blocks among the stored ones.
    rows : ndarray of int, shape (n_stored,)
        Row of each stored entry.
    starts : ndarray of int, shape (n_dofs + 1,)
        First stored entry of each column, and the end.
    diagonal : ndarray of int, shape (n_dofs,)
        Stored entries on the diagonal.
    """

    slots: Ints
    rows: Ints
    starts: Ints
    diagonal: Ints


def _build_pattern(groups: Sequence[Ints], size: int) -> Pattern:
    """Pattern of blocks of these unknowns."""
    keys = np.concatenate(
        [(dofs[:, None] * size + dofs[..., None]).ravel() for dofs in groups]
    )
    stored, slots = np.unique(keys, return_inverse=True)
    each = np.arange(size + 1)
    return Pattern(
        slots=slots,
        rows=(stored % size).astype(np.int32),
        starts=np.searchsorted(stored, each * size).astype(np.int32),
        diagonal=np.searchsorted(stored, each[:-1] * (size + 1)),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Ordering:
    """Order of the unknowns of a template.

    Attributes
    ----------
    place : ndarray of int, shape (n_dofs,)
        Row of each unknown.
    band : int
        Half bandwidth.
    is_layered : bool
        Of a template with layers.
    known : dict
        Places found before, shape (n,), by the arrays of unknowns they are of.
    patterns : dict
        Sparse patterns found before, of shape (n,), in the same way.
    """

    place: Ints
    band: int
    is_layered: bool
    known: dict[tuple[int | bool, ...], tuple[list[Ints], Ints]] = field(
        default_factory=dict
    )

    patterns: dict[tuple[int, ...], tuple[list[Ints], Pattern]] = field(
        default_factory=dict
    )

    def find_pattern(self, parts: Sequence[Blocks]) -> Pattern:
        """Pattern of the sum of the parts.

        Parameters
        ----------
        parts : sequence of Blocks
            Of the matrix.
        """
        groups = [part.dofs for part in parts]
        key = tuple(id(dofs) for dofs in groups)  # as in _find
        if key in self.patterns:
            return self.patterns[key][1]
        pattern = _build_pattern(groups, self.place.size)
        if not any(dofs.flags.writeable for dofs in groups):
            self.patterns[key] = groups, pattern
        return pattern

    def fill(self, parts: Sequence[Blocks], *, lower: bool) -> Floats:
        """Sum of the parts in LAPACK's banded storage.

        All parts go in one sum: the storage is larger than what they hold, and each
        pass over it costs.

        Parameters
        ----------
        parts : sequence of Blocks
            Of the matrix.
        lower : bool
            The lower half band alone; else the whole, with room for pivots.

        Returns
        -------
        ndarray, shape (n_dofs, height)
            Height is band + 1 or 3 band + 1.
        """
        height = self.band + 1 if lower else 3 * self.band + 1
        size = self.place.size * height
        places = self._find([part.dofs for part in parts], lower=lower)
        values = np.concatenate([part.values.ravel() for part in parts])
        # what lies above the diagonal has gone to one place behind the end
        sums = np.bincount(places, values, minlength=size + 1)[:size]
        return np.asarray(sums.reshape(-1, height))

    def _find(self, groups: list[Ints], *, lower: bool) -> Ints:
        # the same arrays come again with each solve: they are their own key while
        # they live
        key = (lower, *(id(dofs) for dofs in groups))
        if key in self.known:
            return self.known[key][1]
        find = self._find_below if lower else self._find_all
        places = np.concatenate([find(self.place[dofs]).ravel() for dofs in groups])
        if not any(dofs.flags.writeable for dofs in groups):
            self.known[key] = groups, places
        return places

    def _find_below(self, row: Ints) -> Ints:
        height = self.band + 1
        below = row[:, :, None] - row[:, None, :]
        end = self.place.size * height
        return np.where(below >= 0, row[:, None, :] * height + below, end)

    def _find_all(self, row: Ints) -> Ints:
        return row[:, None, :] * 3 * self.band + 2 * self.band + row[:, :, None]


def build_ordering(
    template: MeshTemplate, *, has_pressures: bool, couples_net: bool
) -> Ordering:
    """Order of small bandwidth, (N23).

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    has_pressures : bool
        Every vertex has a pressure, too.
    couples_net : bool
        All net vertices are neighbours.
    """
    return _build_ordering(template, has_pressures, couples_net)


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
    load[held] = 0.0
    if is_definite and ordering.band <= _WIDEST_CHOLESKY:
        if friction is None:
            rhs = _in_order(ordering, load)
            masked = [_mask(part, free) for part in parts]
            return _solve_cholesky(ordering, masked, rhs, held)[ordering.place]
        if np.count_nonzero(friction) <= _MOST_SLIPPING * ordering.band:
            return _solve_slipping(ordering, parts, friction, load, free)
    if friction is not None:
        parts = [_add_friction(part, friction) for part in parts]
    masked = [_mask(part, free) for part in parts]
    if ordering.band <= _WIDEST_LU:
        return _solve_lu(ordering, masked, load, held)
    return _solve_sparse(ordering, masked, load, held)


@lru_cache(maxsize=256)
def _build_ordering(
    template: MeshTemplate, has_pressures: bool, couples_net: bool
) -> Ordering:
    import scipy.sparse as sparse

    n_nodes = template.nodes.shape[1]
    groups = [template.triangles.T]
    if couples_net:
        groups.append(template.net[None, ::2])
    rows = np.concatenate([np.repeat(g, g.shape[1], axis=1).ravel() for g in groups])
    columns = np.concatenate([np.tile(g, (1, g.shape[1])).ravel() for g in groups])
    graph = sparse.csr_matrix((np.ones(rows.size), (rows, columns)), (n_nodes, n_nodes))
    size = np.full(n_nodes, 2)
    if has_pressures:
        size[: template.n_vertices] = 3
    graph.sum_duplicates()
    rows = np.repeat(np.arange(n_nodes), np.diff(graph.indptr))
    columns = graph.indices.astype(np.int64)
    orders = _list_orders(graph, template)
    narrowest = min(orders, key=lambda order: _find_bandwidth(order, rows, columns))
    start = _place_in(_narrow(narrowest, rows, columns), size)
    bandwidth = int(np.abs(start[rows] - start[columns]).max())
    place = np.empty(int(size.sum()), dtype=np.int64)
    place[: 2 * n_nodes : 2] = start
    place[1 : 2 * n_nodes : 2] = start + 1
    if has_pressures:
        place[2 * n_nodes :] = start[: template.n_vertices] + 2
    return Ordering(
        place=place,
        band=bandwidth + int(size.max()) - 1,
        is_layered=bool(template.interfaces),
    )


def _list_orders(graph: sparse.csr_matrix, template: MeshTemplate) -> list[Ints]:
    """Orders of the nodes that may give a small bandwidth.

    Fronts that start at an end of the net, where the triangles are smallest, are
    narrower than those of Cuthill and McKee on most templates.
    """
    from scipy.sparse.csgraph import breadth_first_order, reverse_cuthill_mckee

    fronts = [
        breadth_first_order(graph, end, directed=False, return_predecessors=False)
        for end in template.net[[0, -1]]
    ]
    narrow = reverse_cuthill_mckee(graph, symmetric_mode=True)
    return [order.astype(np.int64) for order in (narrow, *fronts)]


def _narrow(order: Ints, rows: Ints, columns: Ints) -> Ints:
    """The narrowest of the orders found by moving nodes between their neighbours.

    In each sweep every node goes most of the way to the middle between its first and
    its last neighbour. That takes a quarter of the bandwidth away, half of the work.
    ``rows`` and ``columns`` are the entries of the graph, sorted by row.
    """
    begins = np.searchsorted(rows, np.arange(order.size))
    best, narrowest = order, order.size
    for _ in range(_SWEEPS + 1):
        place = np.empty(order.size)
        place[order] = np.arange(order.size)
        bandwidth = _find_bandwidth(order, rows, columns)
        if bandwidth < narrowest:
            best, narrowest = order, bandwidth
        first = np.minimum.reduceat(place[columns], begins)
        last = np.maximum.reduceat(place[columns], begins)
        moved = (1.0 - _SWEEP) * place + _SWEEP * (first + last) / 2.0
        order = np.argsort(moved, kind="stable")
    return best


def _find_bandwidth(order: Ints, rows: Ints, columns: Ints) -> int:
    """Largest distance of neighbours in an order."""
    place = np.argsort(order)
    return int(np.abs(place[rows] - place[columns]).max())


def _place_in(order: Ints, size: Ints) -> Ints:
    """First unknown of each node if the nodes come in this order."""
    start = np.empty(order.size, dtype=np.int64)
    start[order] = np.cumsum(size[order]) - size[order]
    return start


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
    ordering: Ordering, parts: Sequence[Blocks], rhs: Floats, held: Mask
) -> Floats:
    """Solutions of right sides that are in order already; they stay so."""
    matrix = ordering.fill(parts, lower=True)
    matrix[ordering.place[held], 0] = _scale_of(matrix[:, 0])
    _, solution, fault = lapack.dpbsv(
        matrix.T, rhs, lower=1, overwrite_ab=1, overwrite_b=1
    )
    if fault != 0:
        raise SingularError("not positive definite")
    return np.asarray(solution)


def _solve_slipping(
    ordering: Ordering,
    parts: Sequence[Blocks],
    friction: Floats,
    load: Floats,
    free: Mask,
) -> Floats:
    """Solution with a few rows added to the symmetric matrix: Woodbury's (N24)."""
    slipping = np.flatnonzero(friction)
    columns = load.size // len(load)
    rhs = np.zeros((len(load), columns + slipping.size), order="F")
    rhs[ordering.place, :columns] = load.reshape(-1, columns)
    rhs[ordering.place[slipping], columns + np.arange(slipping.size)] = 1.0
    masked = [_mask(part, free) for part in parts]
    solutions = _solve_cholesky(ordering, masked, rhs, ~free)
    plain, inverse = solutions[:, :columns], solutions[:, columns:]
    rows = _collect_friction(ordering, parts, friction, free)
    small = rows @ inverse
    small.flat[:: slipping.size + 1] += 1.0
    _, _, shared, fault = lapack.dgesv(small, rows @ plain)
    if fault != 0:
        raise SingularError("singular")
    both = plain - inverse @ shared
    return np.asarray(both[ordering.place].reshape(load.shape))


def _collect_friction(
    ordering: Ordering, parts: Sequence[Blocks], friction: Floats, free: Mask
) -> Floats:
    """Rows A of (N24), which friction adds at slipping nodes, (n_slipping, n_dofs).

    The columns are in order.
    """
    slipping = np.flatnonzero(friction)
    number = np.full(friction.size, -1)
    number[slipping] = np.arange(slipping.size)
    sums = np.zeros(slipping.size * friction.size)
    for part in parts:
        wanted = number[part.dofs[:, 1 : part.n_paired : 2]]
        block, pair = np.nonzero(wanted >= 0)
        row, dofs = wanted[block, pair, None], part.dofs[block]
        share = friction[slipping[row]] * free[dofs]
        at = row * friction.size + ordering.place[dofs]
        normal = share * part.values[block, 2 * pair]
        sums += np.bincount(at.ravel(), normal.ravel(), minlength=sums.size)
    return np.asarray(sums.reshape(slipping.size, friction.size))


def _in_order(ordering: Ordering, load: Floats) -> Floats:
    rhs = np.empty_like(load, order="F")
    rhs[ordering.place] = load
    return rhs


def _solve_lu(
    ordering: Ordering, parts: Sequence[Blocks], load: Floats, held: Mask
) -> Floats:
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

    sum_up = _sum_by_pattern if ordering.is_layered else _sum_anew
    matrix = sum_up(ordering, parts, held)
    try:
        factors = splu(
            matrix,
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.01,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:  # how SuperLU tells of a singular matrix
        raise SingularError(str(error)) from None
    if load.ndim == 1:
        return _solve_refined(factors, matrix, load)
    pieces = np.split(load, range(_COLUMNS, load.shape[1], _COLUMNS), axis=1)
    if ordering.is_layered:  # only a derivative has several: it needs few digits
        return np.hstack([factors.solve(piece) for piece in pieces])
    return np.hstack([_solve_refined(factors, matrix, piece) for piece in pieces])


def _sum_by_pattern(
    ordering: Ordering, parts: Sequence[Blocks], held: Mask
) -> sparse.csc_matrix:
    """Sum of the parts where it was stored before."""
    import scipy.sparse as sparse

    pattern = ordering.find_pattern(parts)
    values = np.concatenate([part.values.ravel() for part in parts])
    stored = np.bincount(pattern.slots, values, minlength=pattern.rows.size)
    stored[pattern.diagonal[held]] = _scale_of(values)
    matrix = sparse.csc_matrix(
        (stored, pattern.rows, pattern.starts), shape=(held.size, held.size)
    )
    matrix.has_canonical_format = True  # else it is looked through each time
    return matrix


def _sum_anew(_: Ordering, parts: Sequence[Blocks], held: Mask) -> sparse.csc_matrix:
    """The same in scipy's order, on which last digits of uniform snow hang."""
    import scipy.sparse as sparse

    rows, columns, values = [], [], []
    for part in parts:
        count = part.dofs.shape[1]
        rows.append(np.repeat(part.dofs, count, axis=1).ravel())
        columns.append(np.tile(part.dofs, (1, count)).ravel())
        values.append(part.values.ravel())
    fixed = np.flatnonzero(held)
    diagonal = np.full(fixed.size, _scale_of(np.concatenate(values)))
    entries = (
        np.concatenate([*values, diagonal]),
        (np.concatenate([*rows, fixed]), np.concatenate([*columns, fixed])),
    )
    return sparse.csc_matrix(entries, shape=(held.size, held.size))


def _solve_refined(factors: SuperLU, matrix: sparse.csc_matrix, load: Floats) -> Floats:
    """Solution of factors whose small pivots were accepted for sparsity.

    One refinement gives the digits back.
    """
    solution = factors.solve(load)
    return np.asarray(solution + factors.solve(load - matrix @ solution))
