"""The quantities an envelope can range over, and how each enters a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.outcome import ModelError
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack, compute_thickness, scale_layers
from netdesign.units import (
    given_degree_from_radian,
    kilonewton_from_newton,
    newton_from_kilonewton,
    radian_from_degree,
)
from netdesign.words.message import Message, say

Convert = Callable[[float], float]


def _keep(value: float) -> float:
    return value


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
    show, read : callable
        Value in SI units to that in the unit of the key, and back.
    """

    name: str
    key: str
    put: Callable[[Scene, float], Scene]
    show: Convert = _keep
    read: Convert = _keep

    @property
    def label(self) -> Message:
        """Name of the quantity in words."""
        return say(f"label.{self.key}")


def _put_snow(name: str) -> Callable[[Scene, float], Scene]:
    def put(scene: Scene, value: float) -> Scene:
        if name == "density" and scene.snowpack.layers:
            raise ModelError(say("envelope.layered_density"))
        pack: Snowpack = replace(scene.snowpack, **{name: value})  # type: ignore[arg-type]
        return replace(scene, snowpack=pack)

    return put


def _put_net(name: str) -> Callable[[Scene, float], Scene]:
    def put(scene: Scene, value: float) -> Scene:
        if not isinstance(scene.net, Net):
            raise ModelError(say("envelope.wall"))
        return replace(scene, net=replace(scene.net, **{name: value}))

    return put


def _put_thickness(scene: Scene, value: float) -> Scene:
    """Scene with snow of another thickness; layers keep their proportions."""
    pack = scene.snowpack
    layers = scale_layers(pack.layers, value, pack.density) if pack.layers else ()
    return replace(scene, snowpack=replace(pack, thickness=value, layers=layers))


def _put_height(scene: Scene, value: float) -> Scene:
    return _put_thickness(scene, compute_thickness(value, scene.snowpack.slope_angle))


def _put_slip(scene: Scene, value: float) -> Scene:
    _require_sliding(scene, "slip_length")
    return replace(scene, ground=GroundLaw(kind="sliding", slip_length=value))


def _put_glide(scene: Scene, value: float) -> Scene:
    _require_sliding(scene, "glide_factor")
    ground = build_ground_from_glide_factor(
        value, scene.snowpack.thickness, scene.creep_law.name
    )
    return replace(scene, ground=ground)


def _require_sliding(scene: Scene, name: str) -> None:
    """Refuse to range over the glide of a ground that does not slide."""
    if scene.ground.kind == "sliding":
        return
    label = say("finding.in_quotes", text=PARAMETERS[name].label)
    rule = say("range.not_sliding", place=say("envelope.itself"), name=label)
    kind = say(f"ground_kind.{scene.ground.kind}")
    raise ModelError(say("envelope.not_sliding", kind=kind, rule=rule))


# In the order in which they enter a scene: height needs the slope angle, glide the
# thickness.
_ROWS = (
    Parameter(name="density", key="density_kg_m3", put=_put_snow("density")),
    Parameter(
        name="friction_angle",
        key="friction_deg",
        put=_put_net("friction_angle"),
        show=given_degree_from_radian,
        read=radian_from_degree,
    ),
    Parameter(
        name="inclination",
        key="inclination_deg",
        put=_put_net("inclination"),
        show=given_degree_from_radian,
        read=radian_from_degree,
    ),
    Parameter(
        name="slope_angle",
        key="slope_deg",
        put=_put_snow("slope_angle"),
        show=given_degree_from_radian,
        read=radian_from_degree,
    ),
    Parameter(name="thickness", key="thickness_m", put=_put_thickness),
    Parameter(name="snow_height", key="height_vertical_m", put=_put_height),
    Parameter(
        name="upslope_length",
        key="upslope_length_m",
        put=_put_snow("upslope_length"),
    ),
    Parameter(name="slack", key="slack", put=_put_net("slack")),
    Parameter(
        name="net_stiffness",
        key="stiffness_kN_per_m",
        put=_put_net("stiffness_per_m"),
        show=kilonewton_from_newton,
        read=newton_from_kilonewton,
    ),
    Parameter(name="slip_length", key="slip_length_m", put=_put_slip),
    Parameter(name="glide_factor", key="glide_factor", put=_put_glide),
)
PARAMETERS: Mapping[str, Parameter] = MappingProxyType({p.name: p for p in _ROWS})
# Two names of one quantity: of each pair at most one ranges.
ONE_QUANTITY = (("thickness", "snow_height"), ("slip_length", "glide_factor"))


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
