"""A round: snow that flows along a given curve, and the net that hangs under it.

The compiled core takes it in one call (``compiled.py``); here it is taken step by step.
Rounds that gain too little alone are corrected by Newton's steps on the curve.
Theory: coupling/THEORY.md, section 2, eq. (K0). Dimensionless: lengths in snow
thicknesses d, forces per metre of width in rho g d^2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from netdesign.cable.funicular import linearise_curve
from netdesign.coupling.interface import SupportForces, share_net_forces
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.net import (
    NetEquilibrium,
    SteadyProblem,
    find_contact_curve,
    hang_net,
)
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.contact import FlowState, net_components
from netdesign.snow.flow import solve_flow
from netdesign.snow.flow_step import condense_to_net, linearise_reaction
from netdesign.snow.kernel import SingularError
from netdesign.snow.mesh import place_nodes
from netdesign.snow.placed_mesh import PlacedMesh, build_placed_mesh, turn_normals
from netdesign.words.message import Message, say

_HALVINGS = 4
# Layers whose creep rates differ by more may have no steady state that rounds find.
_LAYER_CONTRAST = 300.0
# So may nets of more slack (over the chord): they hang close to the ground.
_MUCH_SLACK = 0.1
# And nets that leave their foot at less, whatever their slack [rad].
_LOW = math.radians(5.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RoundResult:
    """Snow along a curve, and the net that hangs under its forces.

    Attributes
    ----------
    curve, image : ndarray, shape (2, n_net)
        The net's nodes as given, and as found [thickness].
    mesh, state : PlacedMesh, FlowState
        The snow.
    net : NetEquilibrium
        Under the reactions of the flow.
    linear_solves : int
        Taken by the flow.
    change : float
        Relative error that its last step left [-].
    from_stresses : tuple or None
        Forces from the stresses of the snow alone, and the net under them; where the
        core found them for a net that hardly moved.
    condense : callable
        Gives the forces on the net per velocity of its nodes, as ``condense_to_net``.
    """

    curve: Floats
    image: Floats
    mesh: PlacedMesh
    state: FlowState
    net: NetEquilibrium
    linear_solves: int
    change: float
    condense: Callable[[], Floats]
    from_stresses: tuple[SupportForces, NetEquilibrium] | None = None

    @property
    def moved(self) -> float:
        """Largest distance of curve and image along an axis [thickness]."""
        return float(np.abs(self.image - self.curve).max())


# A round, as ``take_round``: curve, state, net, tolerance.
Take = Callable[[Floats, FlowState | None, NetEquilibrium, float], RoundResult]


class OffMeshError(SolveError):
    """The snow has no mesh along a curve."""

    def __init__(self, curve: Floats) -> None:
        above = float(np.degrees(np.arctan2(curve[1, 1], curve[0, 1])))
        touches = curve[1, 1:].min() <= 0.0
        super().__init__(
            Outcome.OUT_OF_VALIDITY,
            say("net.would_touch_ground")
            if touches
            else say("net.bulges", angle=above),
        )


def take_near(
    take: Take,
    taken: Sequence[RoundResult],
    wanted: Floats,
    state: FlowState | None,
    net: NetEquilibrium,
    tolerance: float,
) -> RoundResult:
    """Round along the wanted curve, or as near to it from the last one as it can be.

    Parameters
    ----------
    take : callable
        Takes the round.
    taken : sequence of RoundResult
        Rounds on this mesh so far.
    wanted : ndarray, shape (2, n_net)
        Curve of this one [thickness].
    state, net : FlowState or None, NetEquilibrium
        As in ``take_round``.
    tolerance : float
        Relative error that the last step of the flow may leave [-].

    Raises
    ------
    SolveError
        If no curve near enough has a mesh, a flow and a net in equilibrium.
    """
    for _ in range(_HALVINGS):
        try:
            return take(wanted, state, net, tolerance)
        except OffMeshError:
            if not taken:
                raise
            wanted = (wanted + taken[-1].curve) / 2
    return take(wanted, state, net, tolerance)


def take_round(
    problem: SteadyProblem,
    settings: SolverSettings,
    curve: Floats,
    state: FlowState | None,
    net: NetEquilibrium,
    tolerance: float,
) -> RoundResult:
    """Flow along a curve, and the net under its forces.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    settings : SolverSettings
        Newton steps allowed.
    curve : ndarray, shape (2, n_net)
        Of the net [thickness].
    state : FlowState or None
        Where the flow starts; None if nothing is known of it.
    net : NetEquilibrium
        As it hung last.
    tolerance : float
        Relative error that the last step of the flow may leave [-].

    Raises
    ------
    SolveError
        If there is no mesh, no flow or no equilibrium of the net.
    """
    snow, mesh = problem.snow, place_along(problem, curve)
    flow = solve_flow(
        snow,
        mesh,
        state,
        tolerance=tolerance,
        max_iterations=settings.max_iterations,
    )
    if flow.outcome is not Outcome.CONVERGED:
        raise explain_flow(problem, flow.outcome)
    on_net = share_net_forces(snow, mesh, flow.state.reaction)
    hung = hang_net(problem, on_net, net.cable.pull, net.parts)
    return RoundResult(
        curve=curve,
        image=find_contact_curve(problem, hung),
        mesh=mesh,
        state=flow.state,
        net=hung,
        linear_solves=flow.linear_solves,
        change=flow.change,
        condense=partial(condense_to_net, snow, mesh, flow.state),
    )


def place_along(problem: SteadyProblem, curve: Floats) -> PlacedMesh:
    """Mesh of the snow along a curve.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    curve : ndarray, shape (2, n_net)
        Of the net [thickness].

    Raises
    ------
    OffMeshError
        If the curve touches the ground, or bulges so that the mesh folds over.
    """
    if curve[1, 1:].min() <= 0.0:
        raise OffMeshError(curve)
    nodes = place_nodes(problem.template, curve)
    mesh = build_placed_mesh(problem.template, nodes, problem.snow.element)
    if not mesh.is_valid:
        raise OffMeshError(curve)
    return mesh


def explain_flow(problem: SteadyProblem, outcome: Outcome) -> SolveError:
    """Failure of a flow that ended so.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    outcome : Outcome
        Not converged.
    """
    what = say("snow.flow_failed", outcome=outcome.message)
    return explain_failure(problem, outcome, what)


def explain_failure(
    problem: SteadyProblem,
    outcome: Outcome,
    what: Message,
    curve: Floats | None = None,
) -> SolveError:
    """Failure with what in the scene is known to leave no steady state.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    outcome : Outcome
        As the iteration ended.
    what : Message
        Found of it.
    curve : ndarray, shape (2, n_net), optional
        Of the last round, if the net could hang along it [thickness].
    """
    snow, causes = problem.snow, []
    if "one-sided" in (snow.ground_contact, snow.net_contact):
        causes.append(say("steady.lifts_off"))
    rates = [layer.fluidity_ratio for layer in snow.layers]
    if max(rates) > _LAYER_CONTRAST * min(rates):
        contrast = max(rates) / min(rates)
        causes.append(say("steady.layers_contrast", contrast=contrast))
    is_low = curve is not None and math.atan2(curve[1, 1], curve[0, 1]) < _LOW
    if is_low or problem.slack > _MUCH_SLACK:
        causes.append(say("steady.much_slack", slack=float(problem.slack)))
    if outcome is not Outcome.MAX_ITERATIONS or not causes:
        return SolveError(outcome, what)
    return SolveError(
        Outcome.NO_EQUILIBRIUM,
        say("steady.not_found", what=what, causes=tuple(causes)),
    )


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


def carry_tangent(tangent: Floats, places: Floats, wanted: Floats) -> Floats:
    """Derivative of a round between the nodes of another mesh.

    Parameters
    ----------
    tangent : ndarray, shape (2, n, 2, n)
        Component and node of the curve found; of the curve given.
    places, wanted : ndarray, shape (n,), (m,)
        Places of its nodes and of the other mesh's along the net.

    Returns
    -------
    ndarray, shape (2, m, 2, m)
        Of curves that are straight between nodes.
    """
    to_places, to_wanted = _interpolate(wanted, places), _interpolate(places, wanted)
    rows = np.einsum("fi,aibj->afbj", to_wanted, tangent)
    return np.asarray(rows @ to_places)


def _interpolate(places: Floats, wanted: Floats) -> Floats:
    """Values at the wanted places of hats about the places, shape (wanted, places)."""
    return np.array([np.interp(wanted, places, hat) for hat in np.eye(places.size)]).T


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
