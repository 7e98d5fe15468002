"""Load on the ends of two long rows beside a gap, from what slips through it.

Theory: planview/THEORY.md, section 2. Lengths along the row are in l_z, loads in
that of an endless wall, velocities in that far from any wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import iti0k0, k1

from netdesign.numerics.arrays import Floats


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GapFlow:
    """Flow through a gap.

    Attributes
    ----------
    half : float
        h, half the gap [-].
    places : ndarray, shape (m,)
        Points in the gap over h, from -1 to 1 [-].
    velocities, weights : ndarray, shape (m,)
        Velocity v there, and the weights of an integral over the gap [-].
    excess : float
        What one end takes beyond as much of an endless wall [-].
    error : float
        Of ``excess``: its change with fewer functions [-].
    """

    half: float
    places: Floats
    velocities: Floats
    weights: Floats
    excess: float
    error: float


def find_load(gap: GapFlow, distances: Floats) -> Floats:
    """Load on the wall beside the gap, (W8).

    Parameters
    ----------
    gap : GapFlow
        Solved gap.
    distances : ndarray
        From the gap [-]; at 0 the load is infinite.
    """
    reach = distances[..., None] + gap.half * (1.0 - gap.places)
    slipped = gap.weights * gap.velocities
    return np.asarray(1.0 + (k1(reach) / reach) @ slipped / math.pi)


def find_excess_within(gap: GapFlow, distance: float) -> float:
    """Excess on the wall from the gap to a distance, (W9).

    Parameters
    ----------
    gap : GapFlow
        Solved gap.
    distance : float
        From the gap [-].
    """
    reach = distance + gap.half * (1.0 - gap.places)
    beyond = k1(reach) - (0.5 * math.pi - iti0k0(reach)[1])
    return gap.excess - float(beyond @ (gap.weights * gap.velocities)) / math.pi
