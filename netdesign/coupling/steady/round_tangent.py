"""Derivative of the curve that a round gives by the curve that it was given.

Theory: coupling/THEORY.md, eq. (K0).
"""

from __future__ import annotations

import numpy as np

from netdesign.cable.funicular import Funicular, linearise_curve
from netdesign.numerics.arrays import Floats
from netdesign.snow.contact import net_components
from netdesign.snow.flow_state import FlowState
from netdesign.snow.flow_step import linearise_reaction
from netdesign.snow.law import FlowProblem
from netdesign.snow.placed_mesh import PlacedMesh, turn_normals


def linearise_round(
    problem: FlowProblem,
    mesh: PlacedMesh,
    state: FlowState,
    cable: Funicular,
    forces: Floats,
    lengths: Floats,
    stiffness: float,
) -> Floats:
    """Derivative of a round, of which only the turning of the net is taken.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh, state : PlacedMesh, FlowState
        Snow against the curve that was given.
    cable : Funicular
        The net under the forces found.
    forces : ndarray, shape (2, 2 n + 1)
        As given to ``solve_funicular``; those of a freeboard are the last [rho g d^2].
    lengths : ndarray, shape (n,)
        Unstressed lengths of the elements [thickness].
    stiffness : float
        ES [rho g d^2].

    Returns
    -------
    ndarray, shape (2, n_net, 2, n_net)
        Component and node of the curve found; of the curve given.
    """
    count = mesh.template.net.size
    _, tangential = net_components(mesh)
    speed = state.unknowns[tangential]
    # velocity along the net turns into one out of the snow: v.n = 0 in a turned n
    across = -speed[:, None, None] * turn_normals(mesh)[1:]
    loads = np.tensordot(linearise_reaction(problem, mesh, state), across, 1)
    curve = linearise_curve(cable, forces, lengths, stiffness)
    return np.tensordot(curve[:, :count, :, :count], loads, 2)
