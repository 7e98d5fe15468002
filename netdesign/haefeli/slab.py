"""Snow of linear creep on a slope, and the length of slope that a wall holds back.

Theory: haefeli/THEORY.md, section 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import ModelError, require_positive, require_within
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    ICE_DENSITY,
    CreepLaw,
    compute_bulk_factor,
    compute_shear_factor,
    require_admissible,
)
from netdesign.words.message import say

# The drag on snow that sticks to the ground acts like a slip over this share of d.
PROFILE_SHARE = 1.0 / 3.0
_LONGEST_SLIP = 1e6  # [m]
_LARGEST_RATIO = 20.0  # of forces, for which a slip length is looked for


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
        """Viscous Poisson's ratio nu [-]; (H3)."""
        relative = self.density / ICE_DENSITY
        a = compute_shear_factor(self.creep_law, relative)
        b = compute_bulk_factor(self.creep_law, relative)
        return (3.0 * a - 2.0 * b) / (6.0 * a + 2.0 * b)

    @property
    def side_length(self) -> float:
        """Length of slope as heavy as the pressure at rest is large [m]; (H8)."""
        side = self.poisson / (1.0 - self.poisson)
        return side * self.thickness / (2.0 * math.tan(self.slope_angle))


def compute_influence_length(slab: Slab, slip_length: float) -> float:
    """Length over which a wall's influence fades upslope; (H4).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep, the stagnation depth; 0 without slip [m].

    Returns
    -------
    float
        l [m].

    Raises
    ------
    ModelError
        If the slip length is negative or not finite.

    Verified by
    -----------
    tests/haefeli/test_pressure.py
    """
    require_within("slip length", slip_length, 0.0, _LONGEST_SLIP, "m")
    drag = slab.thickness * (slip_length + PROFILE_SHARE * slab.thickness)
    return math.sqrt(2.0 / (1.0 - slab.poisson) * drag)


def scale_slip_length(slab: Slab, slip_length: float, ratio: float) -> float:
    """Slip length at which an endless slab presses with a multiple of its force; (H9).

    Parameters
    ----------
    slab : Slab
        Snow.
    slip_length : float
        D* of linear creep that belongs to the force [m].
    ratio : float
        Wanted force over this one [-].

    Returns
    -------
    float
        D* of linear creep [m].

    Raises
    ------
    ModelError
        If the slab presses more than that even without slip, or a number is out of its
        range.
    """
    require_within("force ratio", ratio, 0.0, _LARGEST_RATIO)
    now = compute_influence_length(slab, slip_length)
    wanted = ratio * now + (ratio - 1.0) * slab.side_length
    rough = compute_influence_length(slab, 0.0)
    if wanted < rough:
        raise ModelError(say("haefeli.presses_more", ratio=ratio))
    return PROFILE_SHARE * slab.thickness * ((wanted / rough) ** 2 - 1.0)


def find_linear_slip(slab: Slab, glide_factor: float) -> float:
    """Slip length at which an endless wall carries N times what it does without; (H9).

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
    require_within("glide factor", glide_factor, 1.0, _LARGEST_RATIO)
    return scale_slip_length(slab, 0.0, glide_factor)
