"""The quantities an envelope can range over, and how each enters a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from types import MappingProxyType

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.envelope.grid import Case, Interval
from netdesign.errors import ModelError
from netdesign.snow.ground import build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack
from netdesign.words.message import Message, say


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Ranges of some parameters around a scene; the others stay as the scene has them.

    Attributes
    ----------
    intervals : tuple of (str, Interval)
        Name and range (SI units) of each parameter, in the order of ``PARAMETERS``;
        an interval of one value is no free axis.
    """

    intervals: tuple[tuple[str, Interval], ...]

    def __post_init__(self) -> None:
        """Refuse unknown and repeated names, and keep one order."""
        names = [name for name, _ in self.intervals]
        known = [name for name in PARAMETERS if name in names]
        if sorted(names) != sorted(known):
            raise ModelError(
                say(
                    "envelope.unknown_ranges",
                    names=tuple(names),
                    known=tuple(PARAMETERS),
                )
            )
        order = list(PARAMETERS)
        ranked = sorted(self.intervals, key=lambda one: order.index(one[0]))
        object.__setattr__(self, "intervals", tuple(ranked))

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the parameters that do range."""
        return tuple(name for name, span in self.intervals if span.low < span.high)

    def place(self, point: Sequence[float]) -> dict[str, float]:
        """Value of every parameter at a point of the unit cube over ``axes``."""
        shares = dict(zip(self.axes, point, strict=True))
        return {
            name: (1.0 - shares.get(name, 0.0)) * span.low
            + shares.get(name, 0.0) * span.high
            for name, span in self.intervals
        }


def build_case(scene: Scene, values: Mapping[str, float]) -> Case:
    """Case of a scene with some values of its own."""
    net = scene.net
    if not isinstance(net, Net):
        raise ModelError(say("envelope.wall"))
    base = {
        "density": scene.snowpack.density,
        "friction_angle": net.friction_angle,
        "inclination": net.inclination,
    }
    given = {key: values.get(key, value) for key, value in base.items()}
    others = tuple((key, value) for key, value in values.items() if key not in base)
    return Case(**given, others=others)


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


def require_valid(scene: Scene, box: Box) -> None:
    """Refuse a box of which a corner or the centre is outside the model.

    Raises
    ------
    ModelError
        With every distinct reason.
    """
    count = len(box.axes)
    reasons: dict[Message, None] = {}
    for point in [*product((0.0, 1.0), repeat=count), (0.5,) * count]:
        if point == (0.5,) * count and reasons:
            continue  # a corner has said why already
        try:
            place_scene(scene, box.place(point))
        except ModelError as error:
            reasons.setdefault(error.message)
    if reasons:
        raise ModelError(say("text.lines", lines=tuple(reasons)))
