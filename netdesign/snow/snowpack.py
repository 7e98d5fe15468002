"""The snowpack that hangs on a net: geometry, density, gravity."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from netdesign.errors import ModelError
from netdesign.guards import require_one_of, require_positive, require_within
from netdesign.snow.creep_law import ICE_DENSITY

GRAVITY = 9.81  # [m/s2]
STEEPEST_SLOPE = math.radians(80.0)  # beyond it no snowpack of this shape stands

GravityMode = Literal["full", "parallel"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Snowpack:
    """Uniform snowpack on a plane slope.

    Attributes
    ----------
    slope_angle : float
        psi [rad].
    thickness : float
        d, normal to the slope [m].
    upslope_length : float
        L, snowpack carried by the net, measured on the ground [m].
    density : float
        rho [kg/m3].
    gravity : str
        ``full``, or ``parallel``: only the component along the slope.
    """

    slope_angle: float
    thickness: float
    upslope_length: float
    density: float
    gravity: GravityMode = "full"

    def __post_init__(self) -> None:
        """Refuse values that no snowpack has."""
        require_within("slope angle", self.slope_angle, 0.0, STEEPEST_SLOPE, "rad")
        require_positive("snow thickness", self.thickness, "m")
        require_positive("upslope length", self.upslope_length, "m")
        require_one_of("gravity mode", self.gravity, ("full", "parallel"))
        if not 0 < self.density < ICE_DENSITY:
            raise ModelError(
                f"snow density = {self.density!r}: must lie above 0 and below "
                f"{ICE_DENSITY:g} kg/m3 (ice)"
            )

    @property
    def relative_density(self) -> float:
        """D, density against ice [-]."""
        return self.density / ICE_DENSITY

    @property
    def gravity_direction(self) -> tuple[float, float]:
        """Gravity over g in the slope's axes [-]."""
        normal = -math.cos(self.slope_angle) if self.gravity == "full" else 0.0
        return math.sin(self.slope_angle), normal

    @property
    def stress_scale(self) -> float:
        """Rho g d [Pa], the scale of every stress in the snowpack."""
        return self.density * GRAVITY * self.thickness


def compute_thickness(vertical_height: float, slope_angle: float) -> float:
    """Thickness normal to the slope [m] of snow of a vertical height [m]."""
    require_positive("vertical snow height", vertical_height, "m")
    require_within("slope angle", slope_angle, 0.0, STEEPEST_SLOPE, "rad")
    return vertical_height * math.cos(slope_angle)
