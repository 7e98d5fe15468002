"""Rounds of flow and net that gain too little alone: Newton's steps on the curve.

Theory: coupling/THEORY.md, eq. (K0).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from netdesign.coupling.steady.hanging import Hanging, SteadyProblem
from netdesign.coupling.steady.round_tangent import linearise_round
from netdesign.numerics.arrays import Floats
from netdesign.snow.flow import FlowResult
from netdesign.snow.kernel import PlacedMesh
from netdesign.snow.linear import SingularError

_MOST_HALVINGS = 3
_PLAIN_STEP = 0.5  # share of what is missed that is made good without a derivative


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Round:
    """Flow along a curve, and the net that hangs under its forces.

    Attributes
    ----------
    curve, image : ndarray, shape (2, n_net)
        The net's nodes as given, and as found [thickness].
    mesh, flow : PlacedMesh, FlowResult
        Snow along the curve.
    hanging : Hanging
        The net.
    """

    curve: Floats
    mesh: PlacedMesh
    flow: FlowResult
    hanging: Hanging
    image: Floats

    @property
    def moved(self) -> float:
        """Largest distance of curve and image along an axis [thickness]."""
        return float(np.abs(self.image - self.curve).max())


class Correction(NamedTuple):
    """A curve, how far its round moved it, and the step that leads on from it.

    Attributes
    ----------
    curve, step : ndarray, shape (2, n_net)
        [thickness].
    moved : float
        [thickness].
    halvings : int
        Of the step so far.
    """

    curve: Floats
    moved: float
    step: Floats
    halvings: int = 0

    @property
    def may_halve(self) -> bool:
        """The step has not become too short to be worth a round."""
        return self.halvings < _MOST_HALVINGS

    def halve(self) -> Correction:
        """The same with half the step."""
        return self._replace(step=self.step / 2.0, halvings=self.halvings + 1)

    @property
    def target(self) -> Floats:
        """Curve of the next round, shape (2, n_net) [thickness]."""
        return self.curve + self.step


def correct_round(
    problem: SteadyProblem, played: Round, last: Correction | None
) -> Correction:
    """Step after a round; half of the ``last`` one if that made things worse.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    played : Round
        The last round.
    last : Correction or None
        What led to it.
    """
    if last is not None and last.may_halve and played.moved > last.moved:
        return last.halve()
    step = _find_step(problem, played)
    return Correction(curve=played.curve, moved=played.moved, step=step)


def _find_step(problem: SteadyProblem, played: Round) -> Floats:
    """Newton's, eq. (K0); a damped plain one where there is none."""
    miss = played.image - played.curve
    hanging, size = played.hanging, miss.size
    try:
        tangent = linearise_round(
            problem.snow,
            played.mesh,
            played.flow.state,
            hanging.cable,
            hanging.forces,
            hanging.lengths,
            problem.stiffness,
        ).reshape(size, size)
        step = np.linalg.solve(np.eye(size) - tangent, miss.ravel())
        return np.asarray(step.reshape(miss.shape))
    except (SingularError, np.linalg.LinAlgError):
        return _PLAIN_STEP * miss
