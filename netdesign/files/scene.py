"""The scene file (TOML): one scene, its support, and how it is to be solved.

The fields of ``[support]`` and ``[panel]`` are those of the input workbook
(site/columns); none of sag and cut has a default.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from netdesign import addon_table
from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Method
from netdesign.edge.input_files import explain, explain_shape, list_faults, read_toml
from netdesign.outcome import ModelError, SceneFileError
from netdesign.panel.inputs import LARGEST_GUY_ANGLE, LARGEST_SAG, Cut, Panel, Rope
from netdesign.snow.creep_law import (
    CREEP_LAWS,
    DENSEST_SNOW,
    FLUIDITY_EXPONENT,
    ICE_DENSITY,
    LARGEST_EXPONENT,
    CreepLaw,
    compute_fluidity,
)
from netdesign.snow.ground import GroundKind, GroundLaw, build_ground_from_glide_factor
from netdesign.snow.law import Sides
from netdesign.snow.snowpack import (
    GravityMode,
    Layer,
    Snowpack,
    compute_mean_density,
    compute_thickness,
)
from netdesign.solving.solve import Settings
from netdesign.structure.layout import (
    DEFAULT_DOWNHILL_RATIO,
    DEFAULT_POST_TILT,
    DEFAULT_UPHILL_RATIO,
    SupportLayout,
)
from netdesign.units import (
    fluidity_from_mpa_year,
    kelvin_from_celsius,
    newton_from_kilonewton,
    second_from_day,
)
from netdesign.words.message import Message, say

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
_Distance = Annotated[float, Field(ge=0, le=100)]
_Sag = Annotated[float, Field(ge=0, le=LARGEST_SAG)]


class Table(BaseModel):
    """Table of a scene file: no key that it does not have."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class SupportTable(Table):
    """``[support]``; distances along the slope."""

    post_spacing_m: Positive
    post_tilt_deg: Annotated[float, Field(ge=-30, le=45)] | None = None
    post_base_distance_m: Annotated[float, Field(ge=-50, le=50)] | None = None
    uphill_anchor_distance_m: _Distance | None = None
    downhill_anchor_distance_m: _Distance | None = None


class PanelTable(Table):
    """``[panel]``; of stiffness and sag one value for both ropes, or one for each."""

    rope_stiffness_kN: Positive | None = None
    lower_rope_stiffness_kN: Positive | None = None
    upper_rope_stiffness_kN: Positive | None = None
    rope_sag: _Sag | None = None
    lower_rope_sag: _Sag | None = None
    upper_rope_sag: _Sag | None = None
    cut: Cut
    mid_span_anchors: bool = False
    end_guy_deg: (
        Annotated[float, Field(ge=0, le=round(math.degrees(LARGEST_GUY_ANGLE)))] | None
    ) = None


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneSupport:
    """Support of a scene's net, and the row in which it stands.

    Attributes
    ----------
    layout : SupportLayout
        Geometry.
    panel : Panel or None
        Between two posts.
    end_guy_angle : float or None
        Of the guy that holds the row's end, to the row [rad].
    """

    layout: SupportLayout
    panel: Panel | None = None
    end_guy_angle: float | None = None


def build_support(
    support: SupportTable | None, panel: PanelTable | None, net_height: float
) -> SceneSupport | None:
    """Support of a scene in SI units; None without one.

    Parameters
    ----------
    support, panel : SupportTable, PanelTable or None
        The two tables.
    net_height : float
        Normal to the slope [m].

    Raises
    ------
    ModelError
        With every fault of the two together.
    """
    if support is None and panel is None:
        return None
    faults = [] if panel is None else _list_faults(panel)
    if support is None:
        faults.append(say("scene_file.panel_without_support"))
    if support is None or faults:
        raise ModelError(say("text.lines", lines=tuple(faults)))
    layout = _build_layout(support, net_height)
    if panel is None:
        return SceneSupport(layout=layout)
    angle = panel.end_guy_deg
    return SceneSupport(
        layout=layout,
        panel=_build_panel(panel, support.post_spacing_m),
        end_guy_angle=None if angle is None else math.radians(angle),
    )


def _list_faults(panel: PanelTable) -> list[Message]:
    """Stiffness and sag: one for both ropes or one for each, never both ways."""
    faults = []
    for name in ("stiffness_kN", "sag"):
        keys = [f"{which}rope_{name}" for which in ("", "lower_", "upper_")]
        are_given = tuple(getattr(panel, key) is not None for key in keys)
        if are_given not in ((True, False, False), (False, True, True)):
            faults.append(say("scene_file.both_ropes_or_each", name=name))
    return faults


def _build_layout(table: SupportTable, net_height: float) -> SupportLayout:
    tilt, uphill = table.post_tilt_deg, table.uphill_anchor_distance_m
    downhill = table.downhill_anchor_distance_m
    return SupportLayout(
        post_spacing=table.post_spacing_m,
        post_tilt=DEFAULT_POST_TILT if tilt is None else math.radians(tilt),
        uphill_anchor_distance=(
            DEFAULT_UPHILL_RATIO * net_height if uphill is None else uphill
        ),
        downhill_anchor_distance=(
            DEFAULT_DOWNHILL_RATIO * net_height if downhill is None else downhill
        ),
        post_base_distance=table.post_base_distance_m,
    )


def _build_panel(table: PanelTable, spacing: float) -> Panel:
    lower, upper = (_build_rope(table, rope) for rope in ("lower", "upper"))
    return Panel(
        post_spacing=spacing,
        lower=lower,
        upper=upper,
        cut=table.cut,
        has_mid_anchors=table.mid_span_anchors,
    )


def _build_rope(table: PanelTable, rope: str) -> Rope:
    """Rope ``lower`` or ``upper``: what is given for both, or its own."""
    stiffness, sag = (
        next(
            float(value)
            for which in ("", f"{rope}_")
            if (value := getattr(table, f"{which}rope_{name}")) is not None
        )
        for name in ("stiffness_kN", "sag")
    )
    return Rope(stiffness=newton_from_kilonewton(stiffness), sag=sag)


Finite = Annotated[float, Field(allow_inf_nan=False)]
Pair = Annotated[list[Finite], Field(min_length=2, max_length=2), AfterValidator(tuple)]
Density = Annotated[float, Field(gt=0, le=DENSEST_SNOW * ICE_DENSITY)]
Temperature = Annotated[float, Field(ge=-60, le=0)]


class SlopeTable(Table):
    """``[slope]``."""

    angle_deg: Annotated[float, Field(ge=0, le=80)]


class LayerTable(Table):
    """One entry of ``snow.layers``, from the ground up."""

    thickness_m: Positive
    density_kg_m3: Density
    temperature_C: Temperature | None = None


class CreepLawTable(Table):
    """A set of the user's own for ``snow.creep_law``."""

    name: str
    source: str
    shear_fit: Pair
    bulk_fit: Pair
    branch: Positive
    clamp: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    calibrated: Pair


class SnowTable(Table):
    """``[snow]``; one of thickness and vertical height, one of density and layers."""

    thickness_m: Positive | None = None
    height_vertical_m: Positive | None = None
    upslope_length_m: Positive
    density_kg_m3: Density | None = None
    layers: Annotated[list[LayerTable], Field(min_length=1)] | None = None
    creep_law: str | CreepLawTable = "boutillier-2004"
    creep_exponent: Annotated[float, Field(ge=1, le=LARGEST_EXPONENT)] = 3.0
    fluidity_per_MPa3_a: Positive | None = None
    temperature_C: Temperature | None = None


class GroundTable(Table):
    """``[ground]``."""

    law: GroundKind = "free"
    slip_length_m: Positive | None = None
    glide_factor: Annotated[float, Field(ge=1, allow_inf_nan=False)] | None = None
    contact: Sides = "two-sided"


class NetTable(Table):
    """``[net]``."""

    kind: Literal["cable"] = "cable"
    inclination_deg: Annotated[float, Field(ge=0, lt=90)] = 30.0
    height_m: Positive | None = None
    stiffness_kN_per_m: Positive | None = None
    slack: Annotated[float, Field(ge=0, le=0.5)] | None = None
    friction_deg: Annotated[float, Field(ge=0, le=60)] | None = None
    contact: Sides = "two-sided"


class GravityTable(Table):
    """``[gravity]``."""

    mode: GravityMode = "full"


class SolveTable(Table):
    """``[solve]``; start and horizon matter for histories only."""

    method: Method = "steady"
    accuracy: Annotated[float, Field(ge=1e-4, le=0.1)] = 0.005
    start: Literal["steady", "straight", "sagged"] | None = None
    horizon_days: Positive = 30.0
    densification: bool = True


class SceneFile(Table):
    """A whole scene file."""

    slope: SlopeTable
    snow: SnowTable
    ground: GroundTable = GroundTable()
    net: NetTable
    gravity: GravityTable = GravityTable()
    solve: SolveTable = SolveTable()
    support: SupportTable | None = None
    panel: PanelTable | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneToSolve:
    """All that a scene file gives; ``support`` is None without such a table."""

    scene: Scene
    settings: Settings
    support: SceneSupport | None


def read_scene(
    path: str | Path, method: Method | None = None
) -> tuple[Scene, Settings]:
    """Scene and settings of a scene file, as ``read_scene_file`` gives them."""
    file = read_scene_file(Path(path), method)
    return file.scene, file.settings


def read_scene_file(path: Path, method: Method | None = None) -> SceneToSolve:
    """Content of a scene file (TOML); ``method`` overrules the file's.

    Raises
    ------
    SceneFileError
        With every fault of the file: key, value, what is accepted.
    """
    try:
        tables = read_toml(path)
    except (OSError, ValueError) as error:
        raise SceneFileError(
            say("file.no_toml", file=str(path), cause=explain(error))
        ) from None
    try:
        return build_scene_of_file(SceneFile.model_validate(tables), method)
    except ValidationError as error:
        faults: Sequence[Message | str] = [_describe(fault) for fault in error.errors()]
    except ModelError as error:
        message = error.message
        lists = message.arguments.get("lines") if message.key == "text.lines" else None
        faults = lists if isinstance(lists, tuple) else (message,)
    lines = [say("text.at_place", place=str(path), text=fault) for fault in faults]
    raise SceneFileError(list_faults(lines))


def build_scene_of_file(file: SceneFile, method: Method | None = None) -> SceneToSolve:
    """Scene, settings and support in SI units; ``method`` overrules the file's."""
    snowpack = _snowpack(file)
    creep_law, net = _creep_law(file.snow), _net(file.net, snowpack.thickness)
    scene = Scene(
        snowpack=snowpack,
        ground=_ground(file.ground, snowpack.thickness, creep_law),
        net=net,
        creep_law=creep_law,
        fluidity=_fluidity(file.snow),
        ground_contact=file.ground.contact,
        net_contact=file.net.contact,
    )
    return SceneToSolve(
        scene=scene,
        settings=_settings(file.solve, method or file.solve.method, scene),
        support=build_support(file.support, file.panel, net.height_normal),
    )


def _settings(table: SolveTable, method: Method, scene: Scene) -> Settings:
    if method == "steady":
        return SolverSettings(accuracy=table.accuracy)
    build = addon_table.load(f"method {method}", addon_table.METHODS[method])
    horizon = second_from_day(table.horizon_days)
    settings: Settings = build(
        scene, table.accuracy, table.start, horizon, table.densification
    )
    return settings


def _snowpack(file: SceneFile) -> Snowpack:
    snow, slope = file.snow, math.radians(file.slope.angle_deg)
    thickness = _thickness(snow, slope)
    if (snow.density_kg_m3 is None) == (snow.layers is None):
        raise ModelError(say("scene_file.density_or_layers"))
    layers = tuple(
        Layer(
            thickness=layer.thickness_m,
            density=layer.density_kg_m3,
            temperature=(
                None
                if layer.temperature_C is None
                else kelvin_from_celsius(layer.temperature_C)
            ),
        )
        for layer in snow.layers or ()
    )
    density = snow.density_kg_m3 or compute_mean_density(layers)
    return Snowpack(
        slope_angle=slope,
        thickness=thickness,
        upslope_length=snow.upslope_length_m,
        density=density,
        layers=layers,
        gravity=file.gravity.mode,
    )


def _thickness(snow: SnowTable, slope: float) -> float:
    if (snow.thickness_m is None) == (snow.height_vertical_m is None):
        if snow.layers is not None:
            raise ModelError(say("scene_file.layers_replace_no_thickness"))
        raise ModelError(say("scene_file.thickness_or_height"))
    if snow.thickness_m is not None:
        return snow.thickness_m
    return compute_thickness(snow.height_vertical_m or 0.0, slope)


def _creep_law(snow: SnowTable) -> CreepLaw:
    if isinstance(snow.creep_law, CreepLawTable):
        table = snow.creep_law
        if table.name in CREEP_LAWS:
            raise ModelError(say("scene_file.shipped_law", name=table.name))
        own = snow.creep_exponent
        return CreepLaw(exponent=own, own_exponent=own, **dict(table))
    if snow.creep_law not in CREEP_LAWS:
        names = tuple(CREEP_LAWS)
        raise ModelError(
            say("scene_file.unknown_law", name=snow.creep_law, known=names)
        )
    return replace(CREEP_LAWS[snow.creep_law], exponent=snow.creep_exponent)


def _fluidity(snow: SnowTable) -> float | None:
    fluidity, temperature = snow.fluidity_per_MPa3_a, snow.temperature_C
    if temperature is None:
        exponent = snow.creep_exponent
        return None if fluidity is None else fluidity_from_mpa_year(fluidity, exponent)
    if fluidity is not None:
        raise ModelError(say("scene_file.fluidity_or_temperature"))
    if snow.creep_exponent != FLUIDITY_EXPONENT:
        raise ModelError(
            say("scene_file.temperature_exponent", known=FLUIDITY_EXPONENT)
        )
    return compute_fluidity(kelvin_from_celsius(temperature))


def _ground(ground: GroundTable, thickness: float, creep_law: CreepLaw) -> GroundLaw:
    slip, glide = ground.slip_length_m, ground.glide_factor
    if ground.law != "sliding":
        if slip is not None or glide is not None:
            raise ModelError(say("scene_file.not_sliding", law=ground.law))
        return GroundLaw(kind=ground.law)
    if (slip is None) == (glide is None):
        raise ModelError(say("scene_file.slip_or_glide"))
    if slip is not None:
        return GroundLaw(kind="sliding", slip_length=slip)
    if creep_law.exponent != FLUIDITY_EXPONENT:
        raise ModelError(say("scene_file.glide_exponent"))
    return build_ground_from_glide_factor(glide or 1.0, thickness, creep_law.name)


def _net(net: NetTable, thickness: float) -> Net:
    height = net.height_m or thickness
    inclination = math.radians(net.inclination_deg)
    if net.stiffness_kN_per_m is None:
        raise ModelError(say("scene_file.cable_stiffness"))
    if net.friction_deg is None:
        raise ModelError(say("scene_file.cable_friction"))
    return Net(
        height_normal=height,
        inclination=inclination,
        stiffness_per_m=newton_from_kilonewton(net.stiffness_kN_per_m),
        slack=net.slack or 0.0,
        friction_angle=math.radians(net.friction_deg),
    )


def _describe(fault: Any) -> Message:
    place = ".".join(map(str, fault["loc"])) or say("scene_file.whole")
    value = fault.get("input")
    shown = f" = {value!r:.100}" if isinstance(value, (str, int, float)) else ""
    return say("scene_file.fault", place=place, value=shown, fault=explain_shape(fault))
