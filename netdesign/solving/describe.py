"""A scene in one line, as whoever looks for a fault wants it."""

from __future__ import annotations

from netdesign.coupling.scene import Scene
from netdesign.solving.solve import Settings, method_of
from netdesign.units import degree_from_radian


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
