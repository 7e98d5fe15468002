"""Snow and net that move: the scene that stays the same, and their state at one time.

Dimensionless as in ``steady``; times in d over the velocity scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from netdesign.addons.history.body import Settling, SnowBody
from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.numerics.arrays import Floats, Ints, Signs
from netdesign.outcome import ModelError
from netdesign.snow.law import FlowProblem
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
        If the scene has a wall or a one-sided contact.
    """
    net = scene.net
    if not isinstance(net, Net):
        raise ModelError(say("history.needs_net"))
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
