"""Cables under the same forces, of different lengths and ends, all at once.

One pass through arrays takes hardly longer for many cables than for one.
Theory: cable/THEORY.md, eqs (C3) to (C5).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.cable.funicular import integrate_curve, tension_offsets
from netdesign.numerics.arrays import Floats


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
    bend = -0.75 * forces[:, 1::2]
    return AlikeCables(
        offsets=tension_offsets(forces, bend).reshape(2, -1),
        weights=np.concatenate([shares, shares]) / 2.0,
        stiffness=stiffness,
        to_foot=forces[:, 0] - 2.0 / 3.0 * bend[:, 0],
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
