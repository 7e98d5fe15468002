"""Solves on finer and finer meshes until vectors are accurate enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from netdesign.snow.mesh import MeshSize

Floats = NDArray[np.float64]
State = TypeVar("State")

# Smallest relative error that is claimed of two coarse meshes: what both cannot see
# (far upslope both are coarse; 0.3 % was measured, 0.4 % on snow that does not slide).
ERROR_FLOOR, NO_SLIP_FLOOR = 2.5e-3, 4e-3
# Error of a mesh over its difference from the one before. Scenes that need a third mesh
# converge slowly: half of an error may be left (measured: netdesign bench --errors).
ERROR_SHARE, SLOW_SHARE = 1.0, 2.0


class Estimate(NamedTuple):
    """A vector with its estimated discretisation error."""

    vector: Floats
    error: float


def refine(
    levels: Sequence[MeshSize],
    solve: Callable[[MeshSize, State | None], State],
    measure: Callable[[State], Sequence[Floats]],
    accuracy: float,
    floor: float = ERROR_FLOOR,
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
    floor : float
        Smallest relative error that is claimed of the second level [-].

    Returns
    -------
    list, list of Estimate
        All states, coarse to fine, and the vectors of the last. The error is the
        difference from the level before, from the third level on twice that, plus a
        floor of the vector's size, halved on each level from the fourth on. If the
        finest level does not reach the accuracy, the error says so.
    """
    states = [solve(levels[0], None)]
    for place, level in enumerate(levels[1:]):
        states.append(solve(level, states[-1]))
        pairs = zip(measure(states[-1]), measure(states[-2]), strict=True)
        share = SLOW_SHARE if place else ERROR_SHARE
        least = floor / 2 ** max(0, place - 1)
        estimates = [estimate_error(*pair, least, share) for pair in pairs]
        if all(e.error <= accuracy * np.hypot(*e.vector) for e in estimates):
            break
    return states, estimates


def estimate_error(
    fine: Floats, coarse: Floats, floor: float, share: float = ERROR_SHARE
) -> Estimate:
    """The fine vector; its error is a multiple of their difference, and of its size."""
    error = share * np.hypot(*(fine - coarse)) + floor * np.hypot(*fine)
    return Estimate(vector=fine, error=float(error))
