"""Snow of linear creep on a slope, and its force on a wall, in closed form.

Theory: verification/THEORY.md.
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
from netdesign.snow.snowpack import GRAVITY
from netdesign.words.message import say

# The drag on snow that sticks to the ground acts like a slip over this share of d.
PROFILE_SHARE = 1.0 / 3.0
_LONGEST_SLIP = 1e6  # [m]
_LARGEST_RATIO = 20.0  # of forces, for which a slip length is looked for
_MOST_DECAY = 700.0  # of exp(), which has an end


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
        """Refuse dimensions and densities out of range."""
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
    tests/verification/test_slab_force.py
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


@dataclass(frozen=True, slots=True, kw_only=True)
class SlabForce:
    """Force along the slope on a net or wall, per metre of width.

    Attributes
    ----------
    influence_length : float
        l; infinite on a ground without drag [m].
    dynamic : float
        Of the creep and glide that is held back [N/m].
    at_rest : float
        Of the snow's settling, which cannot spread [N/m].
    """

    influence_length: float
    dynamic: float
    at_rest: float

    @property
    def total(self) -> float:
        """Sum along the slope [N/m]."""
        return self.dynamic + self.at_rest


def compute_slab_force(
    slab: Slab, *, slip_length: float, upslope_length: float = math.inf
) -> SlabForce:
    """Force of a slab on a smooth face normal to the slope; (H6), (H7).

    Parameters
    ----------
    slab : Slab
        Snow, as high as the face.
    slip_length : float
        D* of linear creep; 0 without slip, infinite where nothing holds the snow [m].
    upslope_length : float
        L, from the face to the free upslope end [m].

    Returns
    -------
    SlabForce
        [N/m].

    Raises
    ------
    ModelError
        If a number is out of its range, or nothing holds an endless slab.

    Verified by
    -----------
    tests/verification/test_slab_force.py, ``netdesign verify``, cases haefeli-*
    """
    if upslope_length != math.inf:
        require_positive("upslope length", upslope_length, "m")
    sine, cosine = math.sin(slab.slope_angle), math.cos(slab.slope_angle)
    weight = slab.density * GRAVITY * slab.thickness  # of a metre of slope [N/m2]
    length, reach, end = _find_reach(slab, slip_length, upslope_length)
    side = slab.poisson / (1.0 - slab.poisson) / 2.0
    return SlabForce(
        influence_length=length,
        dynamic=weight * reach * sine,
        at_rest=(1.0 - end) * side * weight * slab.thickness * cosine,
    )


def _find_reach(
    slab: Slab, slip_length: float, upslope_length: float
) -> tuple[float, float, float]:
    """Influence length and held length of slope [m]; effect of the upslope end [-]."""
    if slip_length == math.inf:  # the limit of (H6): the whole snowpack
        require_positive("upslope length", upslope_length, "m")
        return math.inf, upslope_length, 1.0
    length = compute_influence_length(slab, slip_length)
    lengths = min(upslope_length / length, _MOST_DECAY)
    return length, length * math.tanh(lengths), 1.0 / math.cosh(lengths)
