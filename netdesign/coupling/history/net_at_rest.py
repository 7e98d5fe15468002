"""The net of the steady state, as a history takes it over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from netdesign.cable.response import measure_arcs
from netdesign.coupling.history.state import TransientProblem
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.steady.net import locate_nodes
from netdesign.coupling.steady.solve import find_net_equilibrium
from netdesign.numerics.arrays import Floats
from netdesign.numerics.curve import interpolate_curve
from netdesign.snow.mesh import MeshSize

_ROUNDS = 5  # for the sag of a polygon; each gains some two digits


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetAtRest:
    """The net of a steady state, dimensionless.

    Attributes
    ----------
    places : ndarray, shape (2 n + 1,)
        Shares of the net's length in the snow at its nodes, 0 to 1.
    curve : ndarray, shape (2, 2 n + 1)
        Their positions.
    strain : ndarray, shape (n,)
        Of the elements in the snow [-].
    free_strain : float
        Of the segment above the snow, if there is one [-].
    """

    places: Floats
    curve: Floats
    strain: Floats
    free_strain: float


def find_net_at_rest(scene: Scene, size: MeshSize) -> NetAtRest:
    """The net of the steady state on one mesh.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    size : MeshSize
        Of the one mesh.

    Raises
    ------
    SolveError
        If there is no steady state.
    """
    problem, net = find_net_equilibrium(scene, size, SolverSettings())
    places = locate_nodes(problem.template, net)
    strain = net.cable.tension.mean(axis=0) / problem.stiffness
    return NetAtRest(
        places=places,
        curve=net.cable.curve[:, : places.size],
        strain=strain[: places.size // 2],
        free_strain=float(strain[-1]),
    )


def hang_polygon(
    rest: NetAtRest, problem: TransientProblem, fractions: Floats
) -> tuple[Floats, Floats]:
    """The net at rest as the polygon that a history has for it.

    Its segments have the tensions of the net at rest; it sags by a trifle more, so
    that chords instead of arcs take up the net's unstressed length.

    Parameters
    ----------
    rest : NetAtRest
        With the tensions.
    problem : TransientProblem
        With the net's unstressed length.
    fractions : ndarray, shape (2 m + 1,)
        Shares of the net's length in the snow at the history's nodes.

    Returns
    -------
    ndarray, ndarray
        Positions (2, 2 m + 1) of the nodes; unstressed lengths (m,) of the segments
        in the snow and, where the net stands above it, of the one there.
    """
    middles = (fractions[:-2:2] + fractions[2::2]) / 2.0
    known = (rest.places[:-2:2] + rest.places[2::2]) / 2.0
    stretch = 1.0 + np.interp(middles, known, rest.strain)
    curve = interpolate_curve(rest.places, rest.curve, fractions)
    end = problem.head[:, None]
    if problem.has_freeboard:
        stretch = np.append(stretch, 1.0 + rest.free_strain)
    else:  # a head that hardly stands above the snow counts as level with it
        curve = curve + np.outer(problem.head - curve[:, -1], fractions)
        end = end[:, :0]
    # from foot to head: where the net stands above thin snow it is the fold at the
    # surface that takes up the slack, and the top moves with the sag
    chord = np.outer(problem.head, problem.head @ curve / (problem.head**2).sum())

    def unstress(sag: float) -> Floats:
        points = (chord + sag * (curve - chord))[:, ::2]
        return measure_arcs(np.column_stack([points, end])) / stretch

    sag, taut = 1.0, float(unstress(0.0).sum())
    for _ in range(_ROUNDS):  # what exceeds the chord goes with the square of the sag
        sag *= ((problem.length - taut) / (float(unstress(sag).sum()) - taut)) ** 0.5
    lengths = unstress(sag)
    return chord + sag * (curve - chord), lengths * (problem.length / lengths.sum())
