"""The quantities an envelope can range over, and how each enters a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.errors import ModelError
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """One quantity that may range.

    Attributes
    ----------
    name : str
        Attribute of a ``Case``.
    key : str
        Name in documents, unit included.
    put : callable
        Scene and value (SI) to the scene with that value.
    """

    name: str
    key: str
    put: Callable[[Scene, float], Scene]


def _put_snow(name: str) -> Callable[[Scene, float], Scene]:
    def put(scene: Scene, value: float) -> Scene:
        if name == "density" and scene.snowpack.layers:
            raise ModelError(say("envelope.layered_density"))
        if name == "thickness" and scene.snowpack.layers:
            raise ModelError(say("envelope.layered_thickness"))
        pack: Snowpack = replace(scene.snowpack, **{name: value})  # type: ignore[arg-type]
        return replace(scene, snowpack=pack)

    return put


def _put_net(name: str) -> Callable[[Scene, float], Scene]:
    def put(scene: Scene, value: float) -> Scene:
        if not isinstance(scene.net, Net):
            raise ModelError(say("envelope.wall_parameter", name=name))
        return replace(scene, net=replace(scene.net, **{name: value}))

    return put


def _put_glide(scene: Scene, value: float) -> Scene:
    ground = build_ground_from_glide_factor(
        value, scene.snowpack.thickness, scene.creep_law.name
    )
    return replace(scene, ground=ground)


# In the order in which they enter a scene: glide needs the thickness.
_ROWS = (
    Parameter(name="density", key="density_kg_m3", put=_put_snow("density")),
    Parameter(
        name="friction_angle", key="friction_deg", put=_put_net("friction_angle")
    ),
    Parameter(name="inclination", key="inclination_deg", put=_put_net("inclination")),
    Parameter(name="slope_angle", key="slope_deg", put=_put_snow("slope_angle")),
    Parameter(name="thickness", key="thickness_m", put=_put_snow("thickness")),
    Parameter(name="slack", key="slack", put=_put_net("slack")),
    Parameter(name="glide_factor", key="glide_factor", put=_put_glide),
)
PARAMETERS: Mapping[str, Parameter] = MappingProxyType({p.name: p for p in _ROWS})


def place_scene(scene: Scene, values: Mapping[str, float]) -> Scene:
    """Scene with some values changed.

    Raises
    ------
    ModelError
        If the model cannot represent it; names the value and what is accepted.
    """
    for name, parameter in PARAMETERS.items():
        if name in values:
            scene = parameter.put(scene, values[name])
    return scene
