"""The scene of a history, dimensionless."""

from __future__ import annotations

from netdesign.cable.net import Net
from netdesign.coupling.history.state import TransientProblem
from netdesign.coupling.scene import Scene
from netdesign.errors import ModelError
from netdesign.snow.settling import Settling
from netdesign.words.message import say


def build_problem(
    scene: Scene, *, densifies: bool, base_drag: float = 0.0
) -> TransientProblem:
    """The scene's snow and net, dimensionless."""
    net = scene.net
    if not isinstance(net, Net):
        raise ModelError(say("history.needs_net"))
    if "one-sided" in (scene.ground_contact, scene.net_contact):
        raise ModelError(say("history.two_sided_only"))
    thickness = scene.snowpack.thickness
    return TransientProblem(
        law=scene.flow_law,
        settling=Settling(
            creep_law=scene.creep_law,
            mean_density=scene.snowpack.relative_density,
            densifies=densifies,
            least_density=min(layer.density for layer in scene.flow_law.layers),
        ),
        head=net.head / thickness,
        length=net.unstressed_length / thickness,
        stiffness=net.stiffness_per_m / scene.force_scale,
        base_drag=base_drag,
    )
