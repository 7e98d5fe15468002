"""Parts of a cable between given heights, under given nodal forces.

Theory: cable/THEORY.md, eqs (C5a) and (C5b).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from netdesign.cable.funicular import tension_offsets
from netdesign.numerics.arrays import Floats, Ints

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
    offsets = tension_offsets(forces, -0.75 * forces[:, 1::2])

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
