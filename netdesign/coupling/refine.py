"""Solves on finer and finer meshes until vectors are accurate enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from netdesign.snow.mesh import MeshSize

Floats = NDArray[np.float64]
State = TypeVar("State")


class Estimate(NamedTuple):
    """A vector with its estimated discretisation error."""

    vector: Floats
    error: float


class ErrorModel(NamedTuple):
    """What two meshes in turn say of the error of the finer one.

    Attributes
    ----------
    share : float
        Error over the difference of the two [-].
    floor : float
        Relative error that is added for what neither mesh sees [-].
    floor_ratio : float
        The floor of each further mesh over that before [-].
    """

    share: float
    floor: float
    floor_ratio: float = 1.0

    def estimate(self, coarse: Floats, fine: Floats, place: int = 0) -> Estimate:
        """The finer vector with its error; ``place`` counts meshes from the second."""
        floor = self.floor * self.floor_ratio**place
        error = self.share * np.hypot(*(fine - coarse)) + floor * np.hypot(*fine)
        return Estimate(vector=fine, error=float(error))


# Of nets and walls at rest; measured on random scenes (netdesign bench --errors).
STEADY_ERROR = ErrorModel(share=0.9, floor=2.5e-3, floor_ratio=0.8)


def refine(
    levels: Sequence[MeshSize],
    solve: Callable[[MeshSize, State | None], State],
    measure: Callable[[State], Sequence[Floats]],
    accuracy: float,
    model: ErrorModel,
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
    model : ErrorModel
        Turns the difference of two meshes into an error.

    Returns
    -------
    list, list of Estimate
        All states, coarse to fine, and the vectors of the last. If the finest level
        does not reach the accuracy, the error says so.
    """
    states = [solve(levels[0], None)]
    for place, level in enumerate(levels[1:]):
        states.append(solve(level, states[-1]))
        pairs = zip(measure(states[-2]), measure(states[-1]), strict=True)
        estimates = [model.estimate(*pair, place) for pair in pairs]
        if all(e.error <= accuracy * np.hypot(*e.vector) for e in estimates):
            break
    return states, estimates
