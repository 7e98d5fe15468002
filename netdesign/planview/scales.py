"""Lengths over which a wall holds snow back, from the creep law and the base's drag.

Theory: planview/THEORY.md, section 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.guards import require_positive, require_within
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    ICE_DENSITY,
    CreepLaw,
    compute_bulk_factor,
    compute_shear_factor,
    require_admissible,
)

# The drag on snow that sticks to the ground acts like a slip over this share of d.
_PROFILE_SHARE = 1.0 / 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Slab:
    """Snow of linear creep on a slope.

    Attributes
    ----------
    thickness : float
        d, normal to the slope [m].
    slope_angle : float
        psi [rad].
    density : float
        [kg/m3]; it decides the ratio a/b of the creep law.
    creep_law : CreepLaw
        Its a and b are taken, not its exponent.
    """

    thickness: float
    slope_angle: float
    density: float
    creep_law: CreepLaw = BOUTILLIER_2004

    def __post_init__(self) -> None:
        """Refuse what is no snow on a slope."""
        require_positive("snow thickness", self.thickness, "m")
        require_within("slope angle", self.slope_angle, 0.05, 1.5, "rad")
        require_positive("density", self.density, "kg/m3")
        require_admissible(self.creep_law, self.density / ICE_DENSITY)

    @property
    def poisson(self) -> float:
        """Viscous Poisson's ratio nu [-]; (W2)."""
        relative = self.density / ICE_DENSITY
        a = compute_shear_factor(self.creep_law, relative)
        b = compute_bulk_factor(self.creep_law, relative)
        return (3.0 * a - 2.0 * b) / (6.0 * a + 2.0 * b)

    @property
    def side_length(self) -> float:
        """Length of slope as heavy as the pressure at rest is large [m]; (W4)."""
        side = self.poisson / (1.0 - self.poisson)
        return side * self.thickness / (2.0 * math.tan(self.slope_angle))


@dataclass(frozen=True, slots=True, kw_only=True)
class Scales:
    """Lengths of the plan view.

    Attributes
    ----------
    longitudinal, lateral : float
        l_x, l_z: the wall's influence fades like exp(-x / l_x) upslope of it and
        exp(-z / l_z) beside its end [m].
    retarded_share : float
        Part of the pressure on an endless wall that holds snow back; the rest is the
        pressure at rest, which the end does not change [-].
    """

    longitudinal: float
    lateral: float
    retarded_share: float


def compute_scales(slab: Slab, slip_length: float) -> Scales:
    """Lengths of a slab on a ground with linear slip; (W3) and (W5).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep; 0 without slip [m].

    Raises
    ------
    ModelError
        If the slip length is negative or not finite.

    Verified by
    -----------
    tests/verification/test_plan_view.py
    """
    require_within("slip length", slip_length, 0.0, 1e6, "m")
    drag = slab.thickness * (slip_length + _PROFILE_SHARE * slab.thickness)
    longitudinal = math.sqrt(2.0 / (1.0 - slab.poisson) * drag)
    return Scales(
        longitudinal=longitudinal,
        lateral=math.sqrt(drag),
        retarded_share=longitudinal / (longitudinal + slab.side_length),
    )


def find_linear_slip(slab: Slab, glide_factor: float) -> float:
    """Slip length at which an endless wall carries N times what it does without; (W6).

    Parameters
    ----------
    slab : Slab
        Snow.
    glide_factor : float
        N, at least 1 [-].

    Returns
    -------
    float
        D* of linear creep [m]: shorter than that of snow with n = 3 for the same N.

    Raises
    ------
    ModelError
        If N is out of its range.
    """
    require_within("glide factor", glide_factor, 1.0, 20.0)
    rough = compute_scales(slab, 0.0).longitudinal
    wanted = glide_factor * rough + (glide_factor - 1.0) * slab.side_length
    grown = (wanted / rough) ** 2 - 1.0
    return _PROFILE_SHARE * slab.thickness * grown
