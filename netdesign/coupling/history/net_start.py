"""Begin of a history: the net's shape, and the snow that lies against it."""

from __future__ import annotations

import numpy as np

from netdesign.cable.response import measure_arcs
from netdesign.coupling.history.net_at_rest import (
    NetAtRest,
    find_net_at_rest,
    hang_polygon,
)
from netdesign.coupling.history.settings import Start
from netdesign.coupling.history.state import TransientProblem, TransientState
from netdesign.coupling.scene import Scene
from netdesign.coupling.steady.net import guess_pressure
from netdesign.errors import SolveError
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.snow.body import build_body
from netdesign.snow.mesh import MeshSize, MeshTemplate
from netdesign.words.message import say

_BISECTIONS = 60
_LARGEST_SAG = 0.6  # over the chord


def find_start(scene: Scene, size: MeshSize, start: Start) -> Start | NetAtRest:
    """Start in the form that ``build_start`` takes.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    size : MeshSize
        Of the history's mesh.
    start : str
        ``steady``, ``straight`` or ``sagged``.

    Returns
    -------
    str or NetAtRest
        Of a steady start the net as it hangs at rest.

    Raises
    ------
    SolveError
        If there is no steady state.
    """
    if start != "steady":
        return start
    try:
        return find_net_at_rest(scene, size)
    except SolveError as failure:
        raise SolveError(
            failure.outcome,
            say("history.no_start", reason=failure.reason),
        ) from None


def build_start(
    problem: TransientProblem, template: MeshTemplate, start: Start | NetAtRest
) -> TransientState:
    """Snow and net at time 0.

    Parameters
    ----------
    problem : TransientProblem
        Scene.
    template : MeshTemplate
        Reference mesh.
    start : str or NetAtRest
        ``straight``: the net has no tension, a straight line or, if it has slack, the
        parabola that takes up the slack. ``sagged``: it hangs under the snow's mean
        pressure. The net of a steady state: it hangs as it does there. The snow,
        undeformed, lies against it.

    Returns
    -------
    TransientState
        At rest.

    Raises
    ------
    SolveError
        If the net would lie on the ground.
    """
    fractions = template.net_fractions
    if isinstance(start, NetAtRest):
        curve, lengths = hang_polygon(start, problem, fractions)
    else:
        curve = _hang_parabola(problem, template, start)
        lengths = _spread_length(problem, curve)
    if not curve[1, 1:].min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("net.touches_ground"))
    body = build_body(problem.snow, template, curve)
    return TransientState(
        time=0.0,
        body=body,
        lengths=lengths,
        slide_signs=np.zeros(lengths.size - 1, dtype=np.int8),
        top="on-net" if problem.has_freeboard else "held",
        velocity=np.zeros((2, template.nodes.shape[1])),
        moved=np.zeros_like(body.vertices),
    )


def _hang_parabola(
    problem: TransientProblem, template: MeshTemplate, start: Start
) -> Floats:
    """Nodes (2, n) of a net whose shape is guessed."""
    fractions = template.net_fractions / problem.head[1]
    if not problem.has_freeboard:
        fractions = fractions / fractions[-1]
    pressure = 0.0
    if start == "sagged":
        pressure = guess_pressure(problem.snow, template.aspect)
    return _parabola(problem.head, _find_sag(problem, pressure), fractions)


def _spread_length(problem: TransientProblem, curve: Floats) -> Floats:
    """Unstressed lengths of the segments on a curve: the same strain in all."""
    points = curve[:, ::2]
    if problem.has_freeboard:
        points = np.column_stack([points, problem.head])
    arcs = measure_arcs(points)
    return np.asarray(arcs * (problem.length / arcs.sum()))


def _find_sag(problem: TransientProblem, pressure: float) -> float:
    """Sag over the chord of a parabola as long as the net is under the pressure."""
    chord = float(np.hypot(*problem.head))
    slack = problem.length / chord - 1.0
    low, high = 0.0, _LARGEST_SAG
    for _ in range(_BISECTIONS):
        sag = (low + high) / 2.0
        strain = 0.0
        if pressure > 0.0:
            tension = pressure * chord * np.hypot(1.0 / (8.0 * sag), 0.25)
            strain = tension / problem.stiffness
        if _parabola_length(sag) < (1.0 + slack) * (1.0 + strain):
            low = sag
        else:
            high = sag
    return low


def _parabola_length(sag: float) -> float:
    """Length over the chord."""
    slope = 4.0 * sag
    if slope < 1e-4:
        return 1.0 + slope**2 / 6.0
    return float((np.hypot(1.0, slope) + np.arcsinh(slope) / slope) / 2.0)


def _parabola(head: Floats, sag: float, fractions: Floats) -> Floats:
    """Curve (2, n) at fractions of the chord; the sag is downslope, over the chord."""
    outward = np.array([head[1], -head[0]])
    return np.outer(head, fractions) + np.outer(
        outward, 4.0 * sag * fractions * (1.0 - fractions)
    )
