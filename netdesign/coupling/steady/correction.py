"""Rounds of flow and net that gain too little alone: Newton's steps on the curve.

Theory: coupling/THEORY.md, eq. (K0).
"""

from __future__ import annotations

from contextlib import suppress
from typing import NamedTuple

import numpy as np

from netdesign.cable.funicular import linearise_curve
from netdesign.coupling.steady.net import SteadyProblem
from netdesign.coupling.steady.round import RoundResult
from netdesign.numerics.arrays import Floats
from netdesign.snow.contact import net_components
from netdesign.snow.flow_step import linearise_reaction
from netdesign.snow.linear import SingularError
from netdesign.snow.placed_mesh import turn_normals

_MOST_HALVINGS = 3
_PLAIN_STEP = 0.5  # share of what is missed that is made good without a derivative


class Correction(NamedTuple):
    """A curve, how far its round moved it, and the step that leads on from it.

    Attributes
    ----------
    curve, step : ndarray, shape (2, n_net)
        [thickness].
    moved : float
        [thickness].
    tangent : ndarray, shape (2, n_net, 2, n_net), or None
        That the step was found with; None if there is none.
    halvings : int
        Of the step so far.
    """

    curve: Floats
    moved: float
    step: Floats
    tangent: Floats | None
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
    problem: SteadyProblem,
    taken: RoundResult,
    last: Correction | None,
    carried: Floats | None = None,
) -> Correction:
    """Step after a round; half of the ``last`` one if that made things worse.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    taken : RoundResult
        The last round.
    last : Correction or None
        What led to it.
    carried : ndarray, shape (2, n_net, 2, n_net), optional
        Derivative on another mesh, where it will do.
    """
    if last is not None and last.may_halve and taken.moved > last.moved:
        return last.halve()
    tangent = carried
    if tangent is None:
        with suppress(SingularError):
            tangent = linearise_round(problem, taken)
    return Correction(
        curve=taken.curve,
        moved=taken.moved,
        step=_find_step(tangent, taken.image - taken.curve),
        tangent=tangent,
    )


def carry_tangent(tangent: Floats, known: Floats, wanted: Floats) -> Floats:
    """Derivative of a round between the nodes of another mesh.

    Parameters
    ----------
    tangent : ndarray, shape (2, n, 2, n)
        Component and node of the curve found; of the curve given.
    known, wanted : ndarray, shape (n,), (m,)
        Places of its nodes and of the other mesh's along the net.

    Returns
    -------
    ndarray, shape (2, m, 2, m)
        Of curves that are straight between nodes.
    """
    to_known, to_wanted = _interpolate(wanted, known), _interpolate(known, wanted)
    rows = np.einsum("fi,aibj->afbj", to_wanted, tangent)
    return np.asarray(rows @ to_known)


def _interpolate(known: Floats, wanted: Floats) -> Floats:
    """Values at wanted places of hats about the known ones, (wanted, known)."""
    return np.array([np.interp(wanted, known, hat) for hat in np.eye(known.size)]).T


def _find_step(tangent: Floats | None, miss: Floats) -> Floats:
    """Newton's, eq. (K0); a damped plain one where there is none."""
    if tangent is not None:
        with suppress(np.linalg.LinAlgError):
            matrix = np.eye(miss.size) - tangent.reshape(miss.size, miss.size)
            step = np.linalg.solve(matrix, miss.ravel())
            return np.asarray(step.reshape(miss.shape))
    return _PLAIN_STEP * miss


def linearise_round(problem: SteadyProblem, taken: RoundResult) -> Floats:
    """Derivative of a round, of which only the turning of the net is taken.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    taken : RoundResult
        The round.

    Returns
    -------
    ndarray, shape (2, n_net, 2, n_net)
        Component and node of the curve found; of the curve given.
    """
    mesh, state, net = taken.mesh, taken.state, taken.net
    count = mesh.template.net.size
    _, tangential = net_components(mesh)
    speed = state.unknowns[tangential]
    # velocity along the net turns into one out of the snow: v.n = 0 in a turned n
    across = -speed[:, None, None] * turn_normals(mesh)[1:]
    response = linearise_reaction(problem.snow, mesh, state.contact, taken.condense())
    loads = np.tensordot(response, across, 1)
    curve = linearise_curve(net.cable, net.forces, net.lengths, problem.stiffness)
    return np.tensordot(curve[:, :count, :, :count], loads, 2)
