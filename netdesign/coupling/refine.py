"""Solves on finer and finer meshes until vectors are accurate enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from netdesign.snow.mesh import MeshSize

Floats = NDArray[np.float64]
State = TypeVar("State")

# Error of a mesh over its difference from the one before (of MESH_LEVELS: two steps or
# other meshes may differ by less than they err), and the least relative error
# that is claimed, of the second mesh and of each further one over that before: what two
# meshes do not see (measured: netdesign bench --errors).
ERROR_SHARE = 0.9
ERROR_FLOOR, FLOOR_RATIO = 2.5e-3, 0.8


class Estimate(NamedTuple):
    """A vector with its estimated discretisation error."""

    vector: Floats
    error: float


def refine(
    levels: Sequence[MeshSize],
    solve: Callable[[MeshSize, State | None], State],
    measure: Callable[[State], Sequence[Floats]],
    accuracy: float,
) -> tuple[list[State], list[Estimate]]:
    """Solve level after level until two in turn agree.

    Parameters
    ----------
    levels : sequence of MeshSize
        From coarse to fine, at least two.
    solve : callable
        Level and the state on the level before to a state.
    measure : callable
        State to the vectors that matter, each shape (2,).
    accuracy : float
        Relative error allowed in each vector [-].

    Returns
    -------
    list, list of Estimate
        All states, coarse to fine, and the vectors of the last. The error is a share
        of the difference from the level before, and a share of the vector's size. If
        the finest level does not reach the accuracy, the error says so.
    """
    states = [solve(levels[0], None)]
    for place, level in enumerate(levels[1:]):
        states.append(solve(level, states[-1]))
        pairs = zip(measure(states[-1]), measure(states[-2]), strict=True)
        floor = ERROR_FLOOR * FLOOR_RATIO**place
        estimates = [estimate_error(*pair, floor, ERROR_SHARE) for pair in pairs]
        if all(e.error <= accuracy * np.hypot(*e.vector) for e in estimates):
            break
    return states, estimates


def estimate_error(
    fine: Floats, coarse: Floats, floor: float, share: float = 1.0
) -> Estimate:
    """The fine vector; its error is a multiple of their difference, and of its size."""
    error = share * np.hypot(*(fine - coarse)) + floor * np.hypot(*fine)
    return Estimate(vector=fine, error=float(error))
