"""Force of a creeping and gliding slab on what holds it, in closed form.

Theory: haefeli/THEORY.md, section 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.haefeli.slab import Slab, compute_influence_length
from netdesign.outcome import require_positive, require_within
from netdesign.snow.snowpack import GRAVITY

_MOST_DECAY = 700.0  # of exp(), which has an end


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
    wedge : float
        Weight along the slope of the snow between slope normal and net [N/m].
    wedge_normal : float
        Its weight towards the ground, negative [N/m].
    """

    influence_length: float
    dynamic: float
    at_rest: float
    wedge: float = 0.0
    wedge_normal: float = 0.0

    @property
    def total(self) -> float:
        """Sum along the slope [N/m]."""
        return self.dynamic + self.at_rest + self.wedge


def compute_slab_force(
    slab: Slab,
    *,
    slip_length: float,
    upslope_length: float = math.inf,
    inclination: float = 0.0,
) -> SlabForce:
    """Force of a slab on a smooth face; (H6), (H7) and (H10).

    Parameters
    ----------
    slab : Slab
        Snow, as high as the face.
    slip_length : float
        D* of linear creep; 0 without slip, infinite where nothing holds the snow [m].
    upslope_length : float
        L, from the face to the free upslope end [m].
    inclination : float
        theta of the face from the slope normal, upper edge downslope positive [rad].

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
    tests/haefeli/test_pressure.py, ``netdesign verify``, cases haefeli-*
    """
    require_within("net inclination", inclination, 0.0, 1.5, "rad")
    if upslope_length != math.inf:
        require_positive("upslope length", upslope_length, "m")
    sine, cosine = math.sin(slab.slope_angle), math.cos(slab.slope_angle)
    weight = slab.density * GRAVITY * slab.thickness  # of a metre of slope [N/m2]
    wedge = weight * slab.thickness * math.tan(inclination) / 2.0
    length, reach, end = _find_reach(slab, slip_length, upslope_length)
    side = slab.poisson / (1.0 - slab.poisson) / 2.0
    return SlabForce(
        influence_length=length,
        dynamic=weight * reach * sine,
        at_rest=(1.0 - end) * side * weight * slab.thickness * cosine,
        wedge=wedge * sine,
        wedge_normal=-wedge * cosine,
    )


def _find_reach(
    slab: Slab, slip_length: float, upslope_length: float
) -> tuple[float, float, float]:
    """Influence length, length of slope held [m], and what is felt of the end [-]."""
    if slip_length == math.inf:  # the limit of (H6): the whole snowpack
        require_positive("upslope length", upslope_length, "m")
        return math.inf, upslope_length, 1.0
    length = compute_influence_length(slab, slip_length)
    lengths = min(upslope_length / length, _MOST_DECAY)
    return length, length * math.tanh(lengths), 1.0 / math.cosh(lengths)
