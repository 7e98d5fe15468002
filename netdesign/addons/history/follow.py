"""After a step: the net's nodes and the snow's mesh in their places again."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from netdesign.addons.history.body import move_body
from netdesign.addons.history.instant import Instant
from netdesign.addons.history.response import measure_arcs
from netdesign.addons.history.state import (
    HEAD_GAP,
    Top,
    TransientProblem,
    TransientState,
)
from netdesign.numerics.arrays import Floats
from netdesign.numerics.curve import interpolate_curve
from netdesign.outcome import Outcome, SolveError
from netdesign.words.message import say


class _Net(NamedTuple):
    """Net vertices (2, n) from the foot on, lengths of all segments."""

    vertices: Floats
    lengths: Floats
    top: Top


def follow(
    problem: TransientProblem, state: TransientState, instant: Instant, step: float
) -> tuple[TransientState, float]:
    """State at the end of a step.

    Parameters
    ----------
    problem : TransientProblem
        What stays the same.
    state : TransientState
        At the step's start.
    instant : Instant
        Equilibrium at its end.
    step : float
        Duration [time scale].

    Returns
    -------
    TransientState, float
        And the mass of snow that fell over the head [mean density times d^2].

    Raises
    ------
    SolveError
        If the net touches the ground or the mesh cannot follow the snow.
    """
    net = _spread_nodes(problem, state, _move_top(problem, state, instant))
    if not net.vertices[1, 1:].min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("net.touches_ground"))
    # the upper corner may have become a node of the net, or none any more
    signs = np.append(instant.response.sliding.slide_signs, np.zeros(1, dtype=np.int8))
    body, fallen = move_body(state.body, instant.displaced, net.vertices, problem.head)
    following = TransientState(
        time=state.time + step,
        body=body,
        lengths=net.lengths,
        top=net.top,
        velocity=instant.velocity,
        moved=instant.displaced - state.body.vertices,
        step=step,
        stress=instant.stress,
        base_shear=instant.base_shear,
        slide_signs=signs[: net.lengths.size - 1],
    )
    return following, fallen


def _move_top(
    problem: TransientProblem, state: TransientState, instant: Instant
) -> _Net:
    """Decide what the snow's upper corner does in the next step."""
    vertices = instant.displaced[:, state.body.topology.net].copy()
    lengths = instant.response.sliding.lengths
    head, chord = problem.head, float(np.hypot(*problem.head))
    last = head - vertices[:, -2]
    distance = float(np.hypot(*last))
    if instant.top == "on-net":
        below = float((head - vertices[:, -1]) @ last) / distance
        if below > HEAD_GAP * chord / 4.0:
            return _Net(vertices, lengths, "on-net")
        vertices[:, -1] = head
        return _Net(vertices, np.append(lengths[:-2], lengths[-2:].sum()), "held")
    vertices[:, -1] = head
    upward = last / distance
    if instant.top == "slipping":
        return _Net(vertices, lengths, "slipping")
    normal = np.array([upward[1], -upward[0]])
    shear = float(instant.on_net[:, -1] @ upward)
    limit = problem.snow.friction * max(float(instant.on_net[:, -1] @ normal), 0.0)
    if shear >= -limit:
        return _Net(vertices, lengths, "held")
    if not instant.response.sliding.tensions[-1] > 0.0:
        return _Net(vertices, lengths, "held")
    share = HEAD_GAP * chord / distance
    vertices[:, -1] = head - last * share
    parts = lengths[-1] * np.array([1.0 - share, share])
    return _Net(vertices, np.append(lengths[:-1], parts), "on-net")


def _spread_nodes(problem: TransientProblem, state: TransientState, net: _Net) -> _Net:
    """Vertices spaced along the net as in the template; each keeps what net it has."""
    points = net.vertices
    if net.top == "on-net":
        points = np.column_stack([points, problem.head])
    places = np.append(0.0, np.cumsum(measure_arcs(points)))
    in_snow = places[: net.vertices.shape[1]]
    wanted = state.body.topology.template.net_fractions[::2] * in_snow[-1]
    vertices = interpolate_curve(in_snow, net.vertices, wanted)
    vertices[:, 0], vertices[:, -1] = net.vertices[:, 0], net.vertices[:, -1]
    material = np.append(0.0, np.cumsum(net.lengths))
    shifted = np.interp(wanted, places, material)
    shifted[-1] = material[wanted.size - 1]
    lengths = np.append(np.diff(shifted), net.lengths[wanted.size - 1 :])
    return _Net(vertices, lengths, net.top)
