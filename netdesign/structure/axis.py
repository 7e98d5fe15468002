"""Direction of a pull on an anchor, and its angle to the axis."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from netdesign.numerics.arrays import Number
from netdesign.numerics.either import measure_turn
from netdesign.outcome import require_within
from netdesign.structure.members import Member

LEAST_AXIS, MOST_AXIS = math.radians(-30.0), math.radians(90.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class PullRange:
    """Directions of the pulls on one anchor.

    Attributes
    ----------
    least, largest : float
        As `measure_pull` counts them [rad].
    """

    least: float
    largest: float

    @property
    def mean(self) -> float:
        """Middle of the two, the axis of an anchor that has none given [rad]."""
        return 0.5 * (self.least + self.largest)

    def find_largest_angle(self, axis: float) -> float:
        """Largest angle between a pull of the range and an axis.

        Parameters
        ----------
        axis : float
            Inclination of the anchor [rad].

        Returns
        -------
        float
            [rad].
        """
        return max(abs(self.least - axis), abs(self.largest - axis))


def measure_pull(x: Number, y: Number, anchor: str) -> Number:
    """Inclination of a pull on an anchor; structure/THEORY.md, eq. (S12).

    Parameters
    ----------
    x, y : float or ndarray
        Force on the ground, X downslope and Y out of it [N].
    anchor : str
        Which of the three it is; it says which way along the slope counts as 0.

    Returns
    -------
    float or ndarray
        Against the slope surface, pi/2 straight out of the ground [rad].
    """
    facing = -1.0 if anchor == Member.DOWNHILL_ANCHOR else 1.0
    return measure_turn(facing * x, y)


def find_dip(axis: float, slope: float, anchor: str) -> float:
    """Dip of an anchor below the horizontal; structure/THEORY.md, eq. (S14a).

    Parameters
    ----------
    axis : float
        As `measure_pull` counts it [rad].
    slope : float
        Slope angle [rad].
    anchor : str
        Which of the three it is.

    Returns
    -------
    float
        Negative of a borehole that rises from its mouth [rad].

    Verified by
    -----------
    tests/verification/test_anchor_dip.py
    """
    return axis + slope if anchor == Member.DOWNHILL_ANCHOR else axis - slope


def turn_by_splay(inclination: float, splay: float) -> float:
    """Inclination of a guy that leaves the section; structure/THEORY.md, eq. (S12).

    Parameters
    ----------
    inclination : float
        Of the guy's line in the section, 0 to pi [rad].
    splay : float
        beta, between the guy and the section [rad].

    Returns
    -------
    float
        Of the guy in space, against the slope surface [rad].
    """
    rises = math.cos(splay) * math.sin(inclination)
    found = math.asin(rises)
    return found if inclination <= 0.5 * math.pi else math.pi - found


def find_pull_range(directions: Iterable[float]) -> PullRange | None:
    """Least and largest of some directions.

    Parameters
    ----------
    directions : iterable of float
        As `measure_pull` counts them [rad].

    Returns
    -------
    PullRange or None
        None of none.
    """
    found = sorted(directions)
    return PullRange(least=found[0], largest=found[-1]) if found else None


def turn_sideways(angle: float, share: float) -> float:
    """Angle between a force and an axis in the section, with a part along the row.

    Theory: structure/THEORY.md, eq. (S14).

    Parameters
    ----------
    angle : float
        Of the part in the section, 0 to pi [rad].
    share : float
        Part along the row over that in the section [-].

    Returns
    -------
    float
        [rad].

    Raises
    ------
    ModelError
        If the share is out of its range.
    """
    require_within("lateral share", share, 0.0, 10.0)
    return math.acos(math.cos(angle) / math.hypot(1.0, share))
