"""Equilibrium curve of an elastic cable under given nodal forces.

The cable consists of quadratic elements, the very edges of the snow mesh, so that
nodal forces pass from snow to net without interpolation. With two Gauss points in
an element the tensions there follow from statics alone but for one vector, the
pull at the foot, and that minimises a strictly convex function of two unknowns.
Cables under the same forces, of different lengths and ends, go through arrays all at
once. Last: the parts of a cable between given heights, under the same forces.
Theory: cable/THEORY.md, eqs (C1) to (C5b).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints, freeze
from netdesign.numerics.optimise import minimise_convex
from netdesign.outcome import Outcome

# Gap at the head, over the length, that counts as closed.
CLOSED = 1e-12
_GAUSS = 1.0 / np.sqrt(3.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Funicular:
    """Equilibrium of the cable; usable only if converged.

    Attributes
    ----------
    outcome : Outcome
        Converged, or why there is no equilibrium.
    curve : ndarray, shape (2, 2 n + 1)
        Positions of the nodes, foot to head.
    pull : ndarray, shape (2,)
        Tension vector of the first element at its middle: start of a next solve.
    tension : ndarray, shape (2, n)
        Tension at the two Gauss points of each element.
    foot_pull, head_pull : ndarray, shape (2,)
        What the cable pulls with on foot and head.
    """

    outcome: Outcome
    curve: Floats
    pull: Floats
    tension: Floats
    foot_pull: Floats
    head_pull: Floats


def solve_funicular(
    forces: Floats,
    lengths: Floats,
    stiffness: float,
    head: Floats,
    start: Floats,
) -> Funicular:
    """Curve and tensions of a cable hung from the origin to ``head``.

    Parameters
    ----------
    forces : ndarray, shape (2, 2 n + 1)
        Nodal forces on the cable, foot to head, consistent with quadratic shape
        functions. Those at the two ends go straight into the end pulls.
    lengths : ndarray, shape (n,)
        Unstressed lengths of the elements.
    stiffness : float
        ES, in the unit of the forces.
    head : ndarray, shape (2,)
        Upper end, in the unit of the lengths.
    start : ndarray, shape (2,)
        Guess of the tension vector near the foot.

    Returns
    -------
    Funicular
        Outcome ``no_equilibrium`` if no pull at the foot closes the gap. Tensions
        are sizes of vectors: no cable of this form can push.

    Verified by
    -----------
    tests/verification/test_elastic_cable.py
    """
    total = float(lengths.sum())
    cable = build_alike(forces, lengths / total, stiffness)

    def gap_at_head(pull: Floats) -> tuple[Floats, Floats]:
        """Gradient of the complementary energy (C4), and its Hessian."""
        ends, slopes = reach_ends(cable, pull[:, None])
        return ends[:, 0] - head / total, slopes[..., 0]

    minimum = minimise_convex(gap_at_head, start, tolerance=CLOSED)
    converged = minimum.outcome is Outcome.CONVERGED
    pull = minimum.point
    return Funicular(
        outcome=Outcome.CONVERGED if converged else Outcome.NO_EQUILIBRIUM,
        curve=draw_curves(cable, np.array([total]), pull[:, None])[0],
        pull=pull,
        tension=np.hypot(*(pull[:, None] + cable.offsets)).reshape(2, -1),
        foot_pull=pull + cable.to_foot,
        head_pull=cable.load - pull - cable.to_foot,
    )


def linearise_curve(
    cable: Funicular, forces: Floats, lengths: Floats, stiffness: float
) -> Floats:
    """Change of the curve per nodal force, about an equilibrium.

    Parameters
    ----------
    cable : Funicular
        The equilibrium.
    forces : ndarray, shape (2, 2 n + 1)
        As given to ``solve_funicular``.
    lengths : ndarray, shape (n,)
        As given to ``solve_funicular``.
    stiffness : float
        ES, in the unit of the forces.

    Returns
    -------
    ndarray, shape (2, 2 n + 1, 2, 2 n + 1)
        Moved component and node, loaded component and node.
    """
    count = forces.shape[1]
    vector = cable.pull[:, None, None] + tension_offsets(forces)
    size = np.hypot(*vector)
    direction = vector / size
    unit = np.eye(2)[:, :, None, None]
    across = unit - np.einsum("iqe,jqe->ijqe", direction, direction)
    give = across / size + unit / stiffness  # slope dx/dS per tension vector
    offsets = _offset_units(count)
    slopes = np.einsum("ijqe,kjqe->kiqe", give, offsets)
    closing = np.linalg.solve(
        np.einsum("ijqe,e->ij", give, lengths),
        np.einsum("kiqe,e->ik", slopes, lengths),
    )
    slopes -= np.einsum("ijqe,jk->kiqe", give, closing)
    moved = integrate_curve(slopes, lengths).reshape(2, count, 2, count)
    return np.asarray(moved.transpose(2, 3, 0, 1))


@lru_cache(maxsize=8)
def _offset_units(count: int) -> Floats:
    """Offsets of a unit force at each node, shape (2 n_nodes, 2, 2, n_elements)."""
    loads = np.eye(2 * count).reshape(2 * count, 2, count)
    return freeze(tension_offsets(loads))


def find_bends(forces: Floats) -> Floats:
    """Half the change of tension over each of n elements, b_e of (C3), (.., 2, n).

    In the unit of the nodal forces, (.., 2, 2 n + 1).
    """
    bends: Floats = -0.75 * forces[..., 1::2]
    return bends


def tension_offsets(forces: Floats) -> Floats:
    """Tension vectors at the Gauss points less the pull, (C3).

    Parameters
    ----------
    forces : ndarray, shape (.., 2, 2 n + 1)
        Nodal forces, any unit.

    Returns
    -------
    ndarray, shape (.., 2, 2, n)
        Component, Gauss point, element; in that unit.
    """
    bend = find_bends(forces)
    steps = 2.0 / 3.0 * (bend[..., :-1] + bend[..., 1:]) - forces[..., 2:-1:2]
    middle = _sum_from_zero(steps)
    turn = bend * _GAUSS
    offsets = np.empty((*bend.shape[:-1], 2, bend.shape[-1]))
    np.subtract(middle, turn, out=offsets[..., 0, :])
    np.add(middle, turn, out=offsets[..., 1, :])
    return offsets


def integrate_curve(slope: Floats, lengths: Floats) -> Floats:
    """Node positions of cables from their slopes at the Gauss points.

    Parameters
    ----------
    slope : ndarray, shape (.., 2, 2, n)
        dx/dS: component, Gauss point, element [-].
    lengths : ndarray, shape (n,) or (.., 1, n)
        Unstressed lengths of the elements, any unit.

    Returns
    -------
    ndarray, shape (.., 2, 2 n + 1)
        From the first node on, in the unit of the lengths.
    """
    mean = (slope[..., 0, :] + slope[..., 1, :]) / 2.0
    change = (slope[..., 1, :] - slope[..., 0, :]) / (2.0 * _GAUSS)
    ends = _sum_from_zero(lengths * mean)
    curve = np.empty((*mean.shape[:-1], 2 * mean.shape[-1] + 1))
    curve[..., ::2] = ends
    curve[..., 1::2] = ends[..., :-1] + lengths / 2.0 * (mean - change / 2.0)
    return curve


def _sum_from_zero(steps: Floats) -> Floats:
    """Cumulative sums along the last axis, the first of them 0."""
    sums = np.zeros((*steps.shape[:-1], steps.shape[-1] + 1))
    np.cumsum(steps, axis=-1, out=sums[..., 1:])
    return sums


def share_uniform_load(lengths: Floats) -> Floats:
    """Nodal forces of a uniform load of 1 on quadratic elements.

    Parameters
    ----------
    lengths : ndarray, shape (n,)
        Of the elements, along which the load is uniform.

    Returns
    -------
    ndarray, shape (2 n + 1,)
        Consistent with the shape functions, in the unit of the lengths.
    """
    shares = np.zeros(2 * lengths.size + 1)
    shares[1::2] = 4.0 / 6.0 * lengths
    shares[:-1:2] += lengths / 6.0
    shares[2::2] += lengths / 6.0
    return shares


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AlikeCables:
    """Common part of cables that differ in length and ends.

    Attributes
    ----------
    offsets : ndarray, shape (2, 2 n)
        Tension vectors at the Gauss points less the pull, (C3).
    weights : ndarray, shape (2 n,)
        Of the Gauss points, over the whole length [-].
    stiffness : float
        ES, in the unit of the forces.
    to_foot : ndarray, shape (2,)
        Pull at the foot less the pull of the first element, (C5).
    load : ndarray, shape (2,)
        Sum of the forces.
    """

    offsets: Floats
    weights: Floats
    stiffness: float
    to_foot: Floats
    load: Floats


def build_alike(forces: Floats, shares: Floats, stiffness: float) -> AlikeCables:
    """Common part of cables under these forces.

    Parameters
    ----------
    forces : ndarray, shape (2, 2 n + 1)
        Nodal forces, foot to head, as ``solve_funicular`` takes them.
    shares : ndarray, shape (n,)
        Unstressed lengths of the elements over that of the whole [-].
    stiffness : float
        ES, in the unit of the forces.
    """
    return AlikeCables(
        offsets=tension_offsets(forces).reshape(2, -1),
        weights=np.concatenate([shares, shares]) / 2.0,
        stiffness=stiffness,
        to_foot=forces[:, 0] - 2.0 / 3.0 * find_bends(forces)[:, 0],
        load=forces.sum(axis=1),
    )


def reach_ends(cables: AlikeCables, pulls: Floats) -> tuple[Floats, Floats]:
    """Ends that cables reach under pulls, and how they answer to them, (C4).

    Parameters
    ----------
    cables : AlikeCables
        What they have in common.
    pulls : ndarray, shape (2, K)
        Tension vector of the first element of each at the middle, in the unit of the
        forces.

    Returns
    -------
    ndarray, shape (2, K)
        Head less foot of each, over its unstressed length [-].
    ndarray, shape (2, 2, K)
        Derivative of that by the pull, symmetric and positive, per unit of the forces.

    Verified by
    -----------
    tests/cable/test_alike.py
    """
    x = pulls[0, :, None] + cables.offsets[0]
    y = pulls[1, :, None] + cables.offsets[1]
    square = x * x + y * y
    share = cables.weights / np.sqrt(square)
    give = share + cables.weights / cables.stiffness
    ends = np.array([np.einsum("kg,kg->k", x, give), np.einsum("kg,kg->k", y, give)])
    bent = share / square
    whole = give.sum(axis=1)
    xx = whole - np.einsum("kg,kg,kg->k", x, x, bent)
    yy = whole - np.einsum("kg,kg,kg->k", y, y, bent)
    xy = -np.einsum("kg,kg,kg->k", x, y, bent)
    return ends, np.array([[xx, xy], [xy, yy]])


def draw_curves(cables: AlikeCables, lengths: Floats, pulls: Floats) -> Floats:
    """Curves of some cables from their pulls, each from its foot on.

    Parameters
    ----------
    cables : AlikeCables
        What they have in common.
    lengths : ndarray, shape (K,)
        Unstressed.
    pulls : ndarray, shape (2, K)
        As ``reach_ends`` takes them.

    Returns
    -------
    ndarray, shape (K, 2, 2 n + 1)
        Nodes, foot to head, in the unit of the lengths.

    Verified by
    -----------
    tests/panel/test_strips.py
    """
    count = cables.weights.size // 2
    vector = pulls.T[:, :, None] + cables.offsets
    give = 1.0 / np.hypot(vector[:, 0], vector[:, 1]) + 1.0 / cables.stiffness
    slope = vector * give[:, None]
    own = 2.0 * cables.weights[:count] * lengths[:, None]
    return integrate_curve(slope.reshape(lengths.size, 2, 2, count), own[:, None])


_MOST_STEPS, _MOST_HALVINGS = 30, 20


class CableParts(NamedTuple):
    """Parts of a cable, which begin and end at given heights.

    Attributes
    ----------
    shares : ndarray, shape (n,)
        Unstressed length of each element over that of its part [-].
    part : ndarray of int, shape (n,)
        Of each element.
    firsts : ndarray of int, shape (n_parts,)
        First element of each part.
    rises : ndarray, shape (n_parts,)
        Height that each part has to gain; their sum is the head's [unit of length].
    """

    shares: Floats
    part: Ints
    firsts: Ints
    rises: Floats


class _Lengths(NamedTuple):
    """Lengths of the parts under a pull, what is missing, and its derivative."""

    lengths: Floats
    gap: Floats
    slope: Floats

    @property
    def miss(self) -> float:
        """Size of what is missing; not finite where a part does not rise."""
        is_risen = bool((self.lengths > 0.0).all())
        return float(np.hypot(*self.gap)) if is_risen else np.inf


def find_part_lengths(
    parts: CableParts,
    forces: Floats,
    head_x: float,
    length: float,
    stiffness: float,
    start: Floats,
) -> Floats | None:
    """Unstressed lengths of the parts, shape (n_parts,), in equilibrium.

    Parameters
    ----------
    parts : CableParts
        With their rises.
    forces : ndarray, shape (2, 2 n + 1)
        Nodal forces as ``solve_funicular`` takes them.
    head_x : float
        X of the upper end from the lower one [unit of the rises].
    length : float
        Unstressed, of all parts [unit of the rises].
    stiffness : float
        ES, in the unit of the forces.
    start : ndarray, shape (2,)
        Guess of the tension vector near the foot.

    Returns
    -------
    ndarray or None
        None if no equilibrium is found in which every part rises.

    Verified by
    -----------
    tests/cable/test_parted.py
    """
    offsets = tension_offsets(forces)

    def evaluate(pull: Floats) -> _Lengths:
        return _evaluate(
            parts, pull[:, None, None] + offsets, stiffness, head_x, length
        )

    pull, now = start, evaluate(start)
    for _ in range(_MOST_STEPS):
        if now.miss <= 1e-12 * length:
            return now.lengths
        if not np.isfinite(now.miss):
            return None
        try:
            step = -np.linalg.solve(now.slope, now.gap)
        except np.linalg.LinAlgError:
            return None
        for _ in range(_MOST_HALVINGS):
            then = evaluate(pull + step)
            if then.miss < now.miss:
                break
            step = step / 2.0
        pull, now = pull + step, then
    return None


def _evaluate(
    parts: CableParts, vector: Floats, stiffness: float, head_x: float, length: float
) -> _Lengths:
    """Parts as long as their rises ask under tensions (C5a), the gaps of (C5b)."""
    size = np.hypot(*vector)
    give = parts.shares / 2.0 * (1.0 / size + 1.0 / stiffness)
    along = parts.shares / 2.0 * vector / size**3
    mean_x, mean_y = (_sum_parts(parts, give * axis) for axis in vector)
    lengths = parts.rises / mean_y
    # derivatives of the mean slopes, shape (2, n_parts), per component of the pull
    turn_y = -_sum_parts(parts, along * vector[1])
    turn_x = -_sum_parts(parts, along * vector[0])
    turn_x[0] += _sum_parts(parts, give)
    turn_y[1] += _sum_parts(parts, give)
    longer = -lengths / mean_y * turn_y
    return _Lengths(
        lengths=lengths,
        gap=np.array([lengths @ mean_x - head_x, lengths.sum() - length]),
        slope=np.array([longer @ mean_x + turn_x @ lengths, longer.sum(axis=1)]),
    )


def _sum_parts(parts: CableParts, values: Floats) -> Floats:
    """Sums (.., n_parts) of values (.., 2, n) at the Gauss points."""
    return np.asarray(np.add.reduceat(values.sum(axis=-2), parts.firsts, axis=-1))
