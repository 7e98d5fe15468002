"""A net under a guideline's load: end pulls of a shallow elastic cable.

The guideline says how large the load is, not how hard a slack or tight net pulls on
its ends; here the net's own stiffness and slack say it, in closed form.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.guards import require_positive, require_within

Point = tuple[float, float]
_ROUNDS = 80  # of a bisection; more than the digits of a float


@dataclass(frozen=True, slots=True, kw_only=True)
class NetPull:
    """Pulls of the net on its ends for each metre of width.

    Attributes
    ----------
    foot, head : tuple of float, shape (2,)
        On the foot anchor and on the post head [N/m].
    chord_tension : float
        Part of the tension along the chord, the same at both ends [N/m].
    """

    foot: Point
    head: Point
    chord_tension: float


def compute_net_pull(
    resultant: Point,
    *,
    inclination: float,
    chord: float,
    loaded_share: float,
    stiffness: float,
    slack: float,
) -> NetPull:
    """End pulls of a shallow cable under a load spread evenly from the foot.

    Theory: guideline/THEORY.md, eqs. (G7) to (G9).

    Parameters
    ----------
    resultant : tuple of float, shape (2,)
        Load on the net [N/m].
    inclination : float
        Of the chord from the slope normal [rad].
    chord : float
        Foot to head [m].
    loaded_share : float
        Part of the chord that carries the load, from the foot [-].
    stiffness : float
        ES [N/m].
    slack : float
        Unstressed length over chord, less 1 [-].

    Returns
    -------
    NetPull
        Their sum is the load [N/m].

    Raises
    ------
    ModelError
        If the load does not press the net, or a number is out of its range.
    """
    require_positive("chord", chord, "m")
    require_within("loaded share", loaded_share, 0.05, 1.0)
    require_positive("stiffness", stiffness, "N/m")
    require_within("slack", slack, 0.0, 0.5)
    along = (math.sin(inclination), math.cos(inclination))
    across = resultant[0] * along[1] - resultant[1] * along[0]
    require_positive("load across the net", across, "N/m")
    head_share = 0.5 * loaded_share
    tension = _find_chord_tension(across, loaded_share, stiffness, slack)
    return NetPull(
        foot=_combine(resultant, 1.0 - head_share, along, tension),
        head=_combine(resultant, head_share, along, -tension),
        chord_tension=tension,
    )


def _find_chord_tension(
    across: float, loaded: float, stiffness: float, slack: float
) -> float:
    """Root of (G8): the length that the sag needs is slack and stretch."""
    head, foot = 0.5 * loaded, 1.0 - 0.5 * loaded
    # mean square of the shear force over the chord, in units of the load
    square = loaded * (foot**2 - foot * head + head**2) / 3.0 + (1 - loaded) * head**2

    def excess(tension: float) -> float:
        needed = 0.5 * square * (across / tension) ** 2
        return needed - slack - (1.0 + slack) * tension / stiffness

    low = across * 1e-6
    high = max(stiffness, across) * 10.0
    for _ in range(_ROUNDS):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if excess(middle) > 0.0 else (low, middle)
    return math.sqrt(low * high)


def _combine(load: Point, share: float, along: Point, tension: float) -> Point:
    return (load[0] * share + tension * along[0], load[1] * share + tension * along[1])
