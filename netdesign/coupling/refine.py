"""Solves on finer and finer meshes until vectors are accurate enough."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeVar

from netdesign.numerics.arrays import Floats
from netdesign.snow.mesh import MeshSize

State = TypeVar("State")


class Estimate(NamedTuple):
    """A vector with its estimated discretisation error.

    Attributes
    ----------
    vector : ndarray, shape (2,)
        In the unit of the solve.
    error : float
        In the same unit.
    """

    vector: Floats
    error: float


class Looseness(NamedTuple):
    """Looseness of the snow on its supports.

    Attributes
    ----------
    slip : float
        Share of the net along which the snow slips [-].
    lifts : bool
        The snow lifts off ground or net: where it does so moves with the mesh.
    """

    slip: float = 0.0
    lifts: bool = False


_FIRM = Looseness()


class ErrorModel(NamedTuple):
    """Error of the last mesh, as the meshes so far tell it, eq. (K5).

    Attributes
    ----------
    share : float
        Error over the difference of the last two [-].
    floor : float
        Relative error that is added for what no mesh sees [-].
    floor_ratio : float
        The floor of each further mesh over that before [-].
    slip_share, lift_share : float
        What is added to ``share`` where the snow slips along the whole net, and where
        it lifts off ground or net [-].
    lift_floor : float
        What is added to ``floor`` where it lifts [-].
    loose_ratio : float
        What is added to ``floor_ratio`` where it slips along the whole net or lifts
        [-].
    memory : float
        What a further mesh leaves at least of a difference: two meshes in turn may
        agree by accident [-].
    kinship : float
        Least relative error of a vector over that of the others [-].
    """

    share: float
    floor: float
    floor_ratio: float = 1.0
    slip_share: float = 0.0
    lift_share: float = 0.0
    lift_floor: float = 0.0
    loose_ratio: float = 0.0
    memory: float = 0.0
    kinship: float = 0.0

    def estimate(
        self, meshes: Sequence[Sequence[Floats]], held: Looseness = _FIRM
    ) -> list[Estimate]:
        """The last mesh's vectors with their errors.

        Parameters
        ----------
        meshes : sequence of sequence of ndarray
            The vectors, shape (2,) each, on two meshes or more from coarse to fine.
        held : Looseness
            Of the last mesh.
        """
        share = self.share + self.slip_share * held.slip + self.lift_share * held.lifts
        floor = self.floor + self.lift_floor * held.lifts
        ratio = self.floor_ratio + self.loose_ratio * max(held.slip, held.lifts)
        floor *= ratio ** (len(meshes) - 2)
        sizes = [math.hypot(*vector) for vector in meshes[-1]]
        steps = [self._remember(one) for one in zip(*meshes, strict=True)]
        pairs = list(zip(steps, sizes, strict=True))
        errors = [share * step + floor * size for step, size in pairs]
        own = zip(errors, sizes, strict=True)
        shared = self.kinship * max(
            error / size if size else 0.0 for error, size in own
        )
        return [
            Estimate(vector=vector, error=max(error, shared * size))
            for vector, error, size in zip(meshes[-1], errors, sizes, strict=True)
        ]

    def _remember(self, meshes: Sequence[Floats]) -> float:
        """Difference of the last two meshes, or the remembered part of earlier ones."""
        step = 0.0
        for coarse, fine in pairwise(meshes):
            step = max(math.hypot(*(fine - coarse)), self.memory * step)
        return step


# Of nets and walls at rest; measured on random scenes and along lines of scenes
# (netdesign bench --errors, --lines).
STEADY_ERROR = ErrorModel(
    share=0.9,
    floor=2.5e-3,
    floor_ratio=0.5,
    slip_share=0.3,
    lift_share=0.5,
    lift_floor=3e-3,
    loose_ratio=0.3,
    memory=0.45,
    kinship=0.5,
)


def refine(
    levels: Sequence[MeshSize],
    solve: Callable[[MeshSize, State | None], State],
    measure: Callable[[State], Sequence[Floats]],
    accuracy: float,
    model: ErrorModel,
    loosen: Callable[[State], Looseness] = lambda _: _FIRM,
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
        Turns the differences of meshes into an error.
    loosen : callable, optional
        State to how loosely its snow is held.

    Returns
    -------
    list, list of Estimate
        All states, coarse to fine, and the vectors of the last. If the finest level
        does not reach the accuracy, the error says so.
    """
    states = [solve(levels[0], None)]
    meshes = [measure(states[0])]
    for level in levels[1:]:
        states.append(solve(level, states[-1]))
        meshes.append(measure(states[-1]))
        estimates = model.estimate(meshes, loosen(states[-1]))
        if all(one.error <= accuracy * math.hypot(*one.vector) for one in estimates):
            break
    return states, estimates
