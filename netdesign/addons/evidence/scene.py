"""A scene as publications give it, in metres and degrees; its net or a wall solved."""

from __future__ import annotations

import math

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution, require_solved
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import (
    GravityMode,
    Layer,
    Snowpack,
    compute_mean_density,
)

FREE = GroundLaw(kind="free")


def build_scene(
    *snow: tuple[float, float],
    slope: float,
    length: float,
    ground: GroundLaw = FREE,
    lean: float = 30.0,
    friction: float = 30.0,
    stiffness: float = 2e7,
    slack: float = 0.0,
    height: float | None = None,
    gravity: GravityMode = "full",
) -> Scene:
    """Scene of a net in uniform or layered snow.

    Parameters
    ----------
    snow : tuple of float
        Thickness [m] and density [kg/m3] of each layer, from the ground up.
    slope, lean, friction : float
        Angle of the slope, inclination of the net, friction angle [degrees].
    length : float
        Upslope length [m].
    ground : GroundLaw
        Law of the base.
    stiffness, slack : float
        Of the net [N/m], [-].
    height : float, optional
        Of the net, normal to the slope [m]; that of the snow unless given.
    gravity : str
        ``full`` or ``parallel``.
    """
    thickness = sum(thickness for thickness, _ in snow)
    layers = tuple(Layer(thickness=high, density=density) for high, density in snow)
    is_layered = len(layers) > 1
    return Scene(
        snowpack=Snowpack(
            slope_angle=math.radians(slope),
            thickness=thickness,
            upslope_length=length,
            density=compute_mean_density(layers) if is_layered else layers[0].density,
            layers=layers if is_layered else (),
            gravity=gravity,
        ),
        ground=ground,
        net=Net(
            height_normal=thickness if height is None else height,
            inclination=math.radians(lean),
            stiffness_per_m=stiffness,
            slack=slack,
            friction_angle=math.radians(friction),
        ),
    )


def solve(scene: Scene, settings: SolverSettings) -> Solution:
    """Steady state of a scene.

    Raises
    ------
    SolveError
        If it has none.
    """
    return require_solved(solve_steady(scene, settings, on_failure="raise"))
