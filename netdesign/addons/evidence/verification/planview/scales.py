"""Lengths over which a wall holds snow back, from the creep law and the base's drag.

Theory: planview/THEORY.md, section 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.addons.evidence.verification.slab import (
    PROFILE_SHARE,
    Slab,
    compute_influence_length,
)


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
    longitudinal = compute_influence_length(slab, slip_length)
    drag = slab.thickness * (slip_length + PROFILE_SHARE * slab.thickness)
    return Scales(
        longitudinal=longitudinal,
        lateral=math.sqrt(drag),
        retarded_share=longitudinal / (longitudinal + slab.side_length),
    )
