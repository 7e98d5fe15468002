"""Parts of a cable between given heights, under given nodal forces.

Theory: cable/THEORY.md, eqs (C5a) and (C5b).
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from netdesign.cable.funicular import tension_offsets
from netdesign.core.arguments import locate_all, to_array, to_floats
from netdesign.core.library import find_core, require_sound
from netdesign.numerics.arrays import Floats, Ints

_MOST_STEPS, _MOST_HALVINGS = 30, 20


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartedCable:
    """A cable whose parts begin and end at given heights.

    Attributes
    ----------
    shares : ndarray, shape (n,)
        Unstressed length of each element over that of its part.
    firsts : ndarray of int, shape (n_parts,)
        First element of each part.
    rises : ndarray, shape (n_parts,)
        Height that each part has to gain; their sum is the head's.
    head_x : float
        X of the upper end from the lower one [any unit of length].
    length : float
        Unstressed, of all parts [unit of ``head_x``].
    stiffness : float
        ES, in the unit of the forces.
    """

    shares: Floats
    firsts: Ints
    rises: Floats
    head_x: float
    length: float
    stiffness: float


class _Parts(NamedTuple):
    """Lengths of the parts under a pull, what is missing, and its derivative."""

    lengths: Floats
    gap: Floats
    slope: Floats

    @property
    def miss(self) -> float:
        """Size of what is missing; not finite where a part does not rise."""
        is_risen = bool((self.lengths > 0.0).all())
        return float(np.hypot(*self.gap)) if is_risen else np.inf


def part_cable(cable: PartedCable, forces: Floats, start: Floats) -> Floats | None:
    """Unstressed lengths of the parts, shape (n_parts,), in equilibrium.

    Parameters
    ----------
    cable : PartedCable
        What is given of it.
    forces : ndarray, shape (2, 2 n + 1)
        Nodal forces as ``solve_funicular`` takes them.
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
    core = find_core()
    if core is not None:
        return _part_compiled(core, cable, forces, start)
    offsets = tension_offsets(forces, -0.75 * forces[:, 1::2])
    pull, now = start, _evaluate(cable, offsets, start)
    for _ in range(_MOST_STEPS):
        if now.miss <= 1e-12 * cable.length:
            return now.lengths
        if not np.isfinite(now.miss):
            return None
        try:
            step = -np.linalg.solve(now.slope, now.gap)
        except np.linalg.LinAlgError:
            return None
        for _ in range(_MOST_HALVINGS):
            then = _evaluate(cable, offsets, pull + step)
            if then.miss < now.miss:
                break
            step = step / 2.0
        pull, now = pull + step, then
    return None


def _part_compiled(
    core: ctypes.PyDLL, cable: PartedCable, forces: Floats, start: Floats
) -> Floats | None:
    """The same by the compiled core."""
    count, parts = cable.shares.size, cable.rises.size
    arrays = (
        to_floats(forces, (2, 2 * count + 1)),
        to_floats(cable.shares, (count,)),
        to_array(cable.firsts, np.int64, (parts,)),
        to_floats(cable.rises, (parts,)),
    )
    pull, lengths = to_floats(start, (2,)).copy(), np.empty(parts)
    numbers = (cable.head_x, cable.length, cable.stiffness)
    code = core.nd_part(
        *(count, parts, *(ctypes.c_void_p(one) for one in locate_all(*arrays))),
        *map(ctypes.c_double, numbers),
        *(ctypes.c_void_p(one) for one in locate_all(pull, lengths)),
    )
    return lengths if require_sound(code) == 0 else None


def _evaluate(cable: PartedCable, offsets: Floats, pull: Floats) -> _Parts:
    """Parts as long as their rises ask under a pull (C5a), the gaps of (C5b)."""
    vector = pull[:, None, None] + offsets
    size = np.hypot(*vector)
    give = cable.shares / 2.0 * (1.0 / size + 1.0 / cable.stiffness)
    along = cable.shares / 2.0 * vector / size**3
    mean_x, mean_y = (_sum_parts(cable, give * axis) for axis in vector)
    lengths = cable.rises / mean_y
    # derivatives of the mean slopes, shape (2, n_parts), per component of the pull
    turn_y = -_sum_parts(cable, along * vector[1])
    turn_x = -_sum_parts(cable, along * vector[0])
    turn_x[0] += _sum_parts(cable, give)
    turn_y[1] += _sum_parts(cable, give)
    longer = -lengths / mean_y * turn_y
    return _Parts(
        lengths=lengths,
        gap=np.array([lengths @ mean_x - cable.head_x, lengths.sum() - cable.length]),
        slope=np.array([longer @ mean_x + turn_x @ lengths, longer.sum(axis=1)]),
    )


def _sum_parts(cable: PartedCable, values: Floats) -> Floats:
    """Sums (.., n_parts) of values (.., 2, n) at the Gauss points."""
    return np.asarray(np.add.reduceat(values.sum(axis=-2), cable.firsts, axis=-1))
