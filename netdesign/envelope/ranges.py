"""Ranges of the uncertain quantities of a row, and the cases in them.

First: the quantities that may range, and how each enters a scene.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from types import MappingProxyType

from netdesign.coupling.scene import Scene
from netdesign.outcome import ModelError, show_given_units
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack, compute_thickness, scale_layers
from netdesign.units import (
    given_degree_from_radian,
    kilonewton_from_newton,
    newton_from_kilonewton,
    radian_from_degree,
)
from netdesign.words.message import Message, group_reasons, say

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
    power : float
        A range is divided evenly in this power of the value: forces are nearly
        straight lines over it. A range from 0 is divided evenly in the value.
    """

    name: str
    key: str
    put: Callable[[Scene, float], Scene]
    show: Convert = _keep
    read: Convert = _keep
    power: float = 1.0

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


_Angle = partial(Parameter, show=given_degree_from_radian, read=radian_from_degree)
# In the order in which they enter a scene: height needs the slope angle, glide the
# thickness.
_ROWS = (
    Parameter(name="density", key="density_kg_m3", put=_put_snow("density")),
    _Angle(
        name="friction_angle",
        key="friction_deg",
        put=_put_net("friction_angle"),
        power=-4.0,  # the more friction, the more of the net sticks, the less it does
    ),
    _Angle(name="inclination", key="inclination_deg", put=_put_net("inclination")),
    _Angle(name="slope_angle", key="slope_deg", put=_put_snow("slope_angle")),
    Parameter(name="thickness", key="thickness_m", put=_put_thickness),
    Parameter(name="snow_height", key="height_vertical_m", put=_put_height),
    Parameter(
        name="upslope_length",
        key="upslope_length_m",
        put=_put_snow("upslope_length"),
    ),
    Parameter(name="slack", key="slack", put=_put_net("slack"), power=-0.5),
    Parameter(
        name="net_stiffness",
        key="stiffness_kN_per_m",
        put=_put_net("stiffness_per_m"),
        show=kilonewton_from_newton,
        read=newton_from_kilonewton,
        power=-1.0,
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


# What every case has; the other parameters only where they range.
USUAL = ("density", "friction_angle", "inclination")


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """Closed range of an uncertain quantity, in SI units."""

    low: float
    high: float

    def __post_init__(self) -> None:
        """Refuse reversed and endless ranges."""
        if not -math.inf < self.low <= self.high < math.inf:
            raise ModelError(say("envelope.range_ends", low=self.low, high=self.high))


def _list_twins(name: str) -> set[str]:
    """Other names of the same quantity."""
    return {twin for pair in ONE_QUANTITY if name in pair for twin in pair} - {name}


@dataclass(frozen=True, slots=True, kw_only=True)
class Ranges:
    """Ranges of some parameters around a scene; the others stay as the scene has them.

    Attributes
    ----------
    intervals : tuple of (str, Interval)
        Name and range (SI units) of each parameter, in the order of ``PARAMETERS``;
        an interval of one value is no free axis.
    is_even : bool
        All are divided evenly in their values, whatever the power of the parameter.
    """

    intervals: tuple[tuple[str, Interval], ...]
    is_even: bool = False

    def __post_init__(self) -> None:
        """Refuse unknown, repeated and contradicting names, and keep one order."""
        names = [name for name, _ in self.intervals]
        ordered = [name for name in PARAMETERS if name in names]
        if sorted(names) != sorted(ordered):
            raise ModelError(
                say(
                    "envelope.unknown_ranges",
                    names=tuple(names),
                    known=tuple(PARAMETERS),
                )
            )
        for first, second in ONE_QUANTITY:
            if first in names and second in names:
                labels = {
                    "one": PARAMETERS[first].label,
                    "other": PARAMETERS[second].label,
                }
                raise ModelError(say("envelope.one_quantity", **labels))
        order = list(PARAMETERS)
        ranked = sorted(self.intervals, key=lambda interval: order.index(interval[0]))
        object.__setattr__(self, "intervals", tuple(ranked))

    @classmethod
    def of(cls, **intervals: Interval) -> Ranges:
        """Ranges by the names of their parameters."""
        return cls(intervals=tuple(intervals.items()))

    def __getitem__(self, name: str) -> Interval:
        """Range of a parameter by its name."""
        return dict(self.intervals)[name]

    @property
    def further(self) -> tuple[str, ...]:
        """Names of the parameters that not every case has, in their order."""
        return tuple(name for name, _ in self.intervals if name not in USUAL)

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the parameters that do range."""
        return tuple(name for name, span in self.intervals if span.low < span.high)

    def replaced_by(self, others: Ranges) -> Ranges:
        """Ranges with others in the place of those of the same names."""
        every = {**dict(self.intervals), **dict(others.intervals)}
        return Ranges(intervals=tuple(every.items()))

    def with_value(self, name: str, value: float) -> Ranges:
        """Ranges with one quantity at a single value; another name of it goes."""
        gone = {name, *_list_twins(name)}
        kept = [interval for interval in self.intervals if interval[0] not in gone]
        return Ranges(intervals=(*kept, (name, Interval(low=value, high=value))))

    def place(self, point: Sequence[float]) -> dict[str, float]:
        """Value of every parameter at a point of the unit cube over ``axes``."""
        shares = dict(zip(self.axes, point, strict=True))
        return {
            name: self.find_value(name, shares.get(name, 0.0))
            for name, _ in self.intervals
        }

    def find_value(self, name: str, share: float) -> float:
        """Value of a parameter at a share of its range."""
        span, power = self[name], PARAMETERS[name].power
        if self.is_even or power == 1.0 or span.low <= 0.0 or share in (0.0, 1.0):
            return (1.0 - share) * span.low + share * span.high
        mixed = (1.0 - share) * span.low**power + share * span.high**power
        return float(mixed ** (1.0 / power))


NO_RANGES = Ranges(intervals=())


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Case:
    """One point of the ranges. SI units; angles in radians.

    ``others`` names further quantities that range, as in ``PARAMETERS``.
    """

    density: float
    friction_angle: float
    inclination: float
    others: tuple[tuple[str, float], ...] = ()

    @classmethod
    def of(cls, values: Mapping[str, float]) -> Case:
        """Case of values by the names of their parameters."""
        others = dict(values)
        usual = {name: others.pop(name) for name in USUAL}
        return cls(**usual, others=tuple(others.items()))

    @property
    def values(self) -> dict[str, float]:
        """All values by the names of their parameters."""
        return {name: getattr(self, name) for name in USUAL} | dict(self.others)

    def with_value(self, name: str, value: float) -> Case:
        """Case with a value of its own; another name of the same quantity goes."""
        twins = _list_twins(name)
        kept = {key: value for key, value in self.values.items() if key not in twins}
        return Case.of({**kept, name: value})


def build_case(scene: Scene, values: Mapping[str, float]) -> Case:
    """Case of a scene with some values of its own."""
    base = {
        "density": scene.snowpack.density,
        "friction_angle": scene.net.friction_angle,
        "inclination": scene.net.inclination,
    }
    return Case.of({**base, **values})


def require_valid(scene: Scene, ranges: Ranges) -> None:
    """Refuse ranges of which a corner or the centre is outside the model.

    Raises
    ------
    ModelError
        With every kind of reason, its numbers in degrees and kN.
    """
    count = len(ranges.axes)
    reasons: dict[Message, None] = {}
    for point in [*product((0.0, 1.0), repeat=count), (0.5,) * count]:
        if point == (0.5,) * count and reasons:
            continue  # a corner has said why already
        try:
            place_scene(scene, ranges.place(point))
        except ModelError as error:
            reasons.setdefault(show_given_units(error.message))
    if reasons:
        raise ModelError(say("text.lines", lines=group_reasons(reasons)))
