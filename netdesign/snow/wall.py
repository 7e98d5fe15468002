"""A rigid wall or rake instead of a net."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import require_positive, require_within


@dataclass(frozen=True, slots=True, kw_only=True)
class Wall:
    """A plane rigid surface from the origin upwards.

    Attributes
    ----------
    height_normal : float
        Normal to the slope [m].
    inclination : float
        From the slope normal, upper edge downslope positive [rad].
    friction_angle : float or None
        Of snow on the wall [rad]; None where the snow adheres (no velocity).
    """

    height_normal: float
    inclination: float = 0.0
    friction_angle: float | None = None

    def __post_init__(self) -> None:
        """Refuse values that no wall has."""
        require_positive("wall height", self.height_normal, "m")
        require_within("wall inclination", self.inclination, 0.0, math.radians(80.0))
        if self.friction_angle is not None:
            limit = math.radians(60.0)
            require_within("friction angle", self.friction_angle, 0.0, limit, "rad")

    @property
    def friction(self) -> float:
        """Tan phi [-]; infinite for adhesion."""
        angle = self.friction_angle
        return math.inf if angle is None else math.tan(angle)
