"""Where a history begins: the net's shape, and the snow that lies against it."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from netdesign.cable.response import measure_arcs
from netdesign.coupling.moving import TransientProblem, TransientState
from netdesign.coupling.start import guess_pressure
from netdesign.errors import SolveError
from netdesign.outcome import Outcome
from netdesign.snow.body import build_body
from netdesign.snow.mesh import MeshTemplate

Floats = NDArray[np.float64]
Start = Literal["straight", "sagged"]

# Length of net that comes free above the snow's upper corner, over the chord, when
# the corner begins to slip down.
HEAD_GAP = 2e-3
TOUCHES_GROUND = "the net touches the ground: less slack or less inclination is needed"
_BISECTIONS = 60
_LARGEST_SAG = 0.6  # over the chord


def build_start(
    problem: TransientProblem, template: MeshTemplate, start: Start
) -> TransientState:
    """Snow and net at time 0.

    Parameters
    ----------
    problem : TransientProblem
        Scene.
    template : MeshTemplate
        Reference mesh.
    start : str
        ``straight``: the net has no tension, a straight line or, if it has slack, the
        parabola that takes up the slack. ``sagged``: it hangs under the snow's mean
        pressure. The snow, undeformed, lies against it.

    Returns
    -------
    TransientState
        At rest.

    Raises
    ------
    SolveError
        If the sagged net would lie on the ground.
    """
    head = problem.head
    fractions = template.net_fractions / head[1]
    has_freeboard = bool(head[1] > 1.0 + HEAD_GAP)
    if not has_freeboard:
        fractions = fractions / fractions[-1]
    pressure = 0.0
    if start == "sagged":
        pressure = guess_pressure(problem.law, template.aspect)
    sag = _find_sag(problem, pressure)
    curve = _parabola(head, sag, fractions)
    if not curve[1, 1:].min() > 0.0:
        raise SolveError(Outcome.OUT_OF_VALIDITY, TOUCHES_GROUND)
    body = build_body(problem.law, template, curve)
    points = curve[:, ::2]
    if has_freeboard:
        points = np.column_stack([points, head])
    arcs = measure_arcs(points)
    return TransientState(
        time=0.0,
        body=body,
        lengths=arcs * (problem.length / arcs.sum()),
        glide=np.zeros(arcs.size - 1, dtype=np.int8),
        top="on-net" if has_freeboard else "held",
        velocity=np.zeros((2, template.nodes.shape[1])),
        moved=np.zeros_like(body.vertices),
    )


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
