"""One entry for every kind of scene and every method."""

from __future__ import annotations

from netdesign.coupling.scene import Scene, SolverSettings, Wall
from netdesign.coupling.solution import (
    FailedSolution,
    Method,
    MethodSettings,
    Solution,
    WallSolution,
)
from netdesign.coupling.steady.solve import solve_steady
from netdesign.units import degree_from_radian

Settings = SolverSettings | MethodSettings


def solve_scene(
    scene: Scene, settings: Settings | None = None
) -> Solution | WallSolution | FailedSolution:
    """Snow against the scene's net or wall; the settings choose the method.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net or wall.
    settings : SolverSettings or MethodSettings, optional
        Of the steady state (default), or of a method that an add-on brings.
    """
    if settings is not None and not isinstance(settings, SolverSettings):
        return settings.solve(scene)
    if isinstance(scene.net, Wall):
        # few runs push a wall: they alone wait for the import
        from netdesign.coupling.steady.rigid import solve_rigid

        return solve_rigid(scene, settings)
    return solve_steady(scene, settings)


def method_of(settings: Settings) -> Method:
    """Name of the method that the settings choose."""
    return "steady" if isinstance(settings, SolverSettings) else settings.method


def describe_case(scene: Scene, settings: Settings) -> str:
    """``density 400 kg/m3, friction 30 deg, inclination 25 deg, ..., steady``."""
    snow, net = scene.snowpack, scene.net
    adheres = net.friction_angle is None  # a wall's snow may
    friction = degree_from_radian(net.friction_angle or 0.0)
    parts = (
        f"density {snow.density:.6g} kg/m3",
        "snow adheres" if adheres else f"friction {friction:.6g} deg",
        f"inclination {degree_from_radian(net.inclination):.6g} deg",
        f"slope {degree_from_radian(snow.slope_angle):.6g} deg",
        f"snow {snow.thickness:.6g} m by {snow.upslope_length:.6g} m",
        method_of(settings),
    )
    return ", ".join(parts)
