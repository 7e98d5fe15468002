"""Snow and net that move: the scene, their state at one time, and the start.

Dimensionless as in ``steady``; times in d over the velocity scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from netdesign.addons.history.body import Settling, SnowBody, build_body
from netdesign.addons.history.net_pulls import measure_arcs
from netdesign.addons.history.settings import Start
from netdesign.cable.net import find_slack
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.steady.net import guess_pressure, locate_nodes
from netdesign.coupling.steady.solve import find_net_equilibrium
from netdesign.numerics.arrays import Floats, Ints, Signs
from netdesign.numerics.curve import interpolate_curve
from netdesign.outcome import ModelError, Outcome, SolveError
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshSize, MeshTemplate, build_template
from netdesign.words.message import say

# The snow's upper corner: held at the net's head, slipping over it, or a node of the
# net below it.
Top = Literal["held", "slipping", "on-net"]

# Length of net that comes free above the snow's upper corner, over the chord, when
# the corner begins to slip down.
HEAD_GAP = 2e-3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransientProblem:
    """Data that stay the same while the snow moves, dimensionless.

    Attributes
    ----------
    snow : FlowProblem
        Creep, ground and friction.
    settling : Settling
        How the creep law follows the density.
    head : ndarray, shape (2,)
        Position of the net's head [thickness].
    length : float
        Unstressed, of the whole net [thickness].
    stiffness : float
        ES, the force of a strain of 1 [rho g d^2].
    base_drag : float
        Shear stress on the ground over its velocity [rho g d / velocity scale].
    """

    snow: FlowProblem
    settling: Settling
    head: Floats
    length: float
    stiffness: float
    base_drag: float = 0.0

    @property
    def has_freeboard(self) -> bool:
        """The head stands above the snow by more than the gap of a corner."""
        return bool(self.head[1] > 1.0 + HEAD_GAP)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TransientState:
    """Snow and net at one time.

    Attributes
    ----------
    time : float
        Creep time since the start [time scale].
    body : SnowBody
        The snow.
    lengths : ndarray, shape (n_segments,)
        Unstressed lengths of the net between its nodes [thickness].
    slide_signs : ndarray of int, shape (n_segments - 1,)
        How the net slid through its nodes in the last step, as in ``NetGuess``.
    top : str
        What the snow's upper corner does.
    velocity : ndarray, shape (2, n_nodes)
        Of the last step [velocity scale].
    moved : ndarray, shape (2, n_vertices)
        Displacement in the last step [thickness].
    step : float
        Its duration [time scale]; 0 before the first.
    stress : ndarray, shape (n_triangles, n_points, R), or None
        Of the last step [rho g d]; None before the first.
    base_shear : ndarray, shape (n_edges, n_points), or None
        Of a ground with a shear [rho g d].
    """

    time: float
    body: SnowBody
    lengths: Floats
    slide_signs: Signs
    top: Top
    velocity: Floats
    moved: Floats
    step: float = 0.0
    stress: Floats | None = None
    base_shear: Floats | None = None

    @property
    def carried(self) -> Ints:
        """Vertices (n,) that are nodes of the net, foot and a held top left out."""
        net = self.body.topology.net
        return net[1:] if self.top == "on-net" else net[1:-1]

    @property
    def net_nodes(self) -> Floats:
        """Positions (2, n) of the vertices that are nodes of the net [thickness]."""
        return self.body.vertices[:, self.carried]


def build_problem(
    scene: Scene, *, densifies: bool, base_drag: float = 0.0
) -> TransientProblem:
    """The scene's snow and net, dimensionless.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net.
    densifies : bool
        The creep law follows the density.
    base_drag : float
        Shear stress on the ground over its velocity [rho g d / velocity scale].

    Raises
    ------
    ModelError
        If the scene has a one-sided contact.
    """
    net = scene.net
    if "one-sided" in (scene.ground_contact, scene.net_contact):
        raise ModelError(say("history.two_sided_only"))
    thickness = scene.snowpack.thickness
    return TransientProblem(
        snow=scene.flow_problem,
        settling=Settling(
            creep_law=scene.creep_law,
            mean_density=scene.snowpack.relative_density,
            densifies=densifies,
            least_density=min(layer.density for layer in scene.flow_problem.layers),
        ),
        head=net.head / thickness,
        length=net.unstressed_length / thickness,
        stiffness=net.stiffness_per_m / scene.force_scale,
        base_drag=base_drag,
    )


_BISECTIONS = 60
_LARGEST_SAG = 0.6  # over the chord

_ROUNDS = 5  # for the sag of a polygon; each gains some two digits


def build_start(
    scene: Scene, problem: TransientProblem, size: MeshSize, start: Start
) -> TransientState:
    """Snow and net at time 0.

    Parameters
    ----------
    scene, problem : Scene, TransientProblem
        Snow, ground and net; the same, dimensionless.
    size : MeshSize
        Of the history's mesh.
    start : str
        ``straight``: the net has no tension, a straight line or, if it has slack, the
        parabola that takes up the slack. ``sagged``: it hangs under the snow's mean
        pressure. ``steady``: it hangs as at rest. The snow, undeformed, lies against
        it.

    Returns
    -------
    TransientState
        At rest.

    Raises
    ------
    SolveError
        If there is no steady state to start from, or the net would lie on the ground.
    """
    template = build_template(scene.snowpack.aspect, size, scene.layer_tops)
    if start == "steady":
        rest = find_net_at_rest(scene, size)
        curve, lengths = hang_polygon(rest, problem, template.net_fractions)
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
    outward = np.array([problem.head[1], -problem.head[0]])
    depths = 4.0 * _find_sag(problem, pressure) * fractions * (1.0 - fractions)
    return np.outer(problem.head, fractions) + np.outer(outward, depths)


def _spread_length(problem: TransientProblem, curve: Floats) -> Floats:
    """Unstressed lengths of the segments on a curve, all under one strain."""
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
        if 1.0 + find_slack(sag) < (1.0 + slack) * (1.0 + strain):
            low = sag
        else:
            high = sag
    return low


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
    try:
        problem, net = find_net_equilibrium(scene, size, SolverSettings())
    except SolveError as failure:
        reason = say("history.no_start", reason=failure.reason)
        raise SolveError(failure.outcome, reason) from None
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
    middles_at_rest = (rest.places[:-2:2] + rest.places[2::2]) / 2.0
    stretch = 1.0 + np.interp(middles, middles_at_rest, rest.strain)
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
