"""Scenes of snow and net in an engineer's units."""

import math

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene
from netdesign.snow.creep_law import BOUTILLIER_2004, CreepLaw
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snow.snowpack import (
    GravityMode,
    Layer,
    Snowpack,
    build_layered_snowpack,
)

ICE = 917.0  # [kg/m3]


def build_scene(
    *,
    slope_deg: float = 40.0,
    thickness_m: float = 4.0,
    length_m: float = 20.0,
    relative_density: float = 0.4,
    density_kg_m3: float | None = None,
    layers: tuple[Layer, ...] = (),
    gravity: GravityMode = "full",
    ground: GroundKind | GroundLaw = "free",
    slip_length_m: float = 0.0,
    inclination_deg: float = 0.0,
    height_m: float | None = None,
    stiffness_kN_per_m: float = 2e4,
    slack: float = 0.0,
    friction_deg: float = 30.0,
    creep_law: CreepLaw = BOUTILLIER_2004,
    **more: object,
) -> Scene:
    """Scene in an engineer's units; by default the paper's reference scene.

    Layers have their own thickness and density.
    """
    along = {
        "slope_angle": math.radians(slope_deg),
        "upslope_length": length_m,
        "gravity": gravity,
    }
    snowpack = (
        build_layered_snowpack(layers, **along)  # type: ignore[arg-type]
        if layers
        else Snowpack(
            thickness=thickness_m,
            density=density_kg_m3 or ICE * relative_density,
            **along,  # type: ignore[arg-type]
        )
    )
    if not isinstance(ground, GroundLaw):
        ground = GroundLaw(kind=ground, slip_length=slip_length_m)
    return Scene(
        snowpack=snowpack,
        ground=ground,
        net=Net(
            height_normal=snowpack.thickness if height_m is None else height_m,
            inclination=math.radians(inclination_deg),
            stiffness_per_m=1e3 * stiffness_kN_per_m,
            slack=slack,
            friction_angle=math.radians(friction_deg),
        ),
        creep_law=creep_law,
        **more,  # type: ignore[arg-type]
    )
