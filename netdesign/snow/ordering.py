"""Element blocks of a matrix, and the order of its unknowns for a small band.

The sparsity of a template never changes, so its unknowns are ordered once, and the
places of its blocks in banded or sparse storage are found once. Theory: snow/THEORY.md,
section 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, gather
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.shared_mesh import find_once

if TYPE_CHECKING:
    import scipy.sparse as sparse


# Sweeps that narrow an order (no more is gained after 25), and how far they move.
_SWEEPS, _SWEEP = 25, 0.7


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

        return sparse.csr_matrix(
            (self.values.ravel(), list_entries([self.dofs])), shape=(size, size)
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
        return gather(self.dofs, parts, unknowns.size)


def list_entries(groups: Sequence[Ints]) -> tuple[Ints, Ints]:
    """Row and column of each entry of blocks, block by block.

    Parameters
    ----------
    groups : sequence of ndarray of int, shape (n, C)
        Unknowns of the blocks.

    Returns
    -------
    ndarray of int, ndarray of int, shape (n_entries,)
        Rows, columns.
    """
    rows = [np.repeat(dofs, dofs.shape[1], axis=1).ravel() for dofs in groups]
    columns = [np.tile(dofs, (1, dofs.shape[1])).ravel() for dofs in groups]
    return np.concatenate(rows), np.concatenate(columns)


class Pattern(NamedTuple):
    """Places of a sparse matrix that may not be 0, column by column.

    Attributes
    ----------
    place : ndarray of int, shape (n_dofs,)
        Row of each unknown in an order that fills in little.
    slots : ndarray of int, shape (n,)
        Place of each entry of the blocks among the stored ones.
    rows : ndarray of int, shape (n_stored,)
        Row of each stored entry.
    starts : ndarray of int, shape (n_dofs + 1,)
        First stored entry of each column, and the end.
    diagonal : ndarray of int, shape (n_dofs,)
        Stored entry of each unknown on the diagonal.
    """

    place: Ints
    slots: Ints
    rows: Ints
    starts: Ints
    diagonal: Ints


def _build_pattern(groups: Sequence[Ints], size: int) -> Pattern:
    """Pattern of blocks of these unknowns."""
    rows, columns = list_entries(groups)
    place = _find_least_degrees(rows, columns, size)
    stored, slots = np.unique(place[columns] * size + place[rows], return_inverse=True)
    return Pattern(
        place=place,
        slots=slots,
        rows=(stored % size).astype(np.int32),
        starts=np.searchsorted(stored, np.arange(size + 1) * size).astype(np.int32),
        diagonal=np.searchsorted(stored, place * (size + 1)),
    )


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
        return gather(places, values, size + 1)[:size].reshape(-1, height)

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


@find_once
def _build_ordering(
    template: MeshTemplate, has_pressures: bool, couples_net: bool
) -> Ordering:
    import scipy.sparse as sparse

    n_nodes = template.nodes.shape[1]
    groups = [template.triangles.T]
    if couples_net:
        groups.append(template.net[None, ::2])
    rows, columns = list_entries(groups)
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
