"""The net: an elastic cable per metre of width."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_positive, require_within

LARGEST_INCLINATION = math.radians(80.0)
LARGEST_SLACK = 0.5
# Far beyond what is built; a number of kN/m falls below [N/m].
STIFFNESSES = (1e5, 1e15)
LARGEST_FRICTION_ANGLE = math.radians(60.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Net:
    """A net hung between a foot at the origin and a post head.

    Attributes
    ----------
    height_normal : float
        D_k, height of the head above the ground, normal to the slope [m].
    inclination : float
        theta, from the slope normal to the chord, head downslope positive [rad].
    stiffness_per_m : float
        ES, force per width at unit strain [N/m].
    slack : float
        Unstressed length over chord, less 1 [-].
    friction_angle : float
        phi of snow on net [rad].
    """

    height_normal: float
    inclination: float
    stiffness_per_m: float
    slack: float
    friction_angle: float

    def __post_init__(self) -> None:
        """Refuse values that no net has."""
        require_positive("net height", self.height_normal, "m")
        require_within(
            "net inclination", self.inclination, 0.0, LARGEST_INCLINATION, "rad"
        )
        require_within("net stiffness", self.stiffness_per_m, *STIFFNESSES, "N/m")
        require_within("slack", self.slack, 0.0, LARGEST_SLACK)
        require_within(
            "friction angle", self.friction_angle, 0.0, LARGEST_FRICTION_ANGLE, "rad"
        )

    @property
    def chord(self) -> float:
        """Distance of foot and head [m]."""
        return self.height_normal / math.cos(self.inclination)

    @property
    def head(self) -> Floats:
        """Position of the head, shape (2,) [m]."""
        x = self.height_normal * math.tan(self.inclination)
        return np.array([x, self.height_normal])

    @property
    def unstressed_length(self) -> float:
        """Length without load [m]."""
        return (1.0 + self.slack) * self.chord

    @property
    def friction(self) -> float:
        """Tan phi [-]; the one place where it is formed."""
        return math.tan(self.friction_angle)
