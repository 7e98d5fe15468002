"""The net: an elastic cable per metre of width, and its friction at given nodes.

Closed forms are starts for the solver and references for its tests. Snow prescribes the
nodes, foot to head; n nodes lie between the two ends, and n + 1 segments join them.
Theory: cable/THEORY.md, eqs (C6) and (C8).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import (
    require_positive,
    require_within,
)

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


def compute_parabola_sag(
    load: float, chord: float, stiffness: float, slack: float
) -> float:
    """Sag of a shallow elastic cable under a uniform load normal to its chord.

    Solves (8/3) (f/c)^2 = slack + q c^2 / (8 f ES), eq. (C6); for slack 0 this is
    f^3 = 3 q c^4 / (64 ES).

    Parameters
    ----------
    load : float
        q, per length of chord [N/m2 or any unit].
    chord : float
        c [m].
    stiffness : float
        ES, unit of q c.
    slack : float
        Unstressed length over chord, less 1 [-].

    Returns
    -------
    float
        f [m].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_positive("load", load)
    require_positive("chord", chord)
    require_positive("stiffness", stiffness)
    require_within("slack", slack, 0.0, 1.0)
    # increasing and convex in f above the taut sag: Newton from above is monotone
    taut = math.cbrt(3.0 * load * chord**4 / (64.0 * stiffness))
    sag: float = taut + chord * math.sqrt(3.0 * slack / 8.0)
    for _ in range(60):
        value = 8.0 / 3.0 * (sag / chord) ** 2 - slack
        value -= load * chord**2 / (8.0 * sag * stiffness)
        slope = 16.0 / 3.0 * sag / chord**2
        slope += load * chord**2 / (8.0 * sag**2 * stiffness)
        lower = sag - value / slope
        if lower >= sag:
            break
        sag = lower
    return sag


def compute_capstan_ratio(wrap_angle: float, friction_angle: float) -> float:
    """Largest ratio of tensions over a smooth contact, Euler-Eytelwein (C8).

    Parameters
    ----------
    wrap_angle : float
        Turning of the cable over the contact [rad].
    friction_angle : float
        phi [rad].

    Returns
    -------
    float
        exp(tan(phi) * angle) [-].
    """
    return math.exp(math.tan(friction_angle) * wrap_angle)


def compute_turning_angles(points: Floats) -> Floats:
    """Angles by which the net turns around the snow at its nodes.

    Parameters
    ----------
    points : ndarray, shape (2, n + 2)
        Foot, nodes and head; X downslope, snow on the side of negative X [m].

    Returns
    -------
    ndarray, shape (n,)
        beta_i, from -pi to pi, positive where the net is convex to the valley [rad].

    Examples
    --------
    >>> bulge = np.array([[0.0, 1.0, 0.0], [0.0, 1.0, 2.0]])
    >>> np.degrees(compute_turning_angles(bulge))
    array([90.])
    """
    x, y = np.diff(points)
    cross = x[:-1] * y[1:] - y[:-1] * x[1:]
    dot = x[:-1] * x[1:] + y[:-1] * y[1:]
    angles: Floats = np.arctan2(cross, dot)
    return angles


def find_slack(sag: float) -> float:
    """Slack of a hanging net by its sag over its chord [-].

    It hangs in a parabola y = 4 f x (1 - x), its weight spread evenly over the chord:
    arc = integral of sqrt(1 + y'^2) = sqrt(1 + (4 f)^2) / 2 + asinh(4 f) / (8 f). A
    chain of the same sag is longer, by 0.0015 at f = 0.2: less slack pulls harder.

    Parameters
    ----------
    sag : float
        Largest distance of the net from its chord, over the chord [-].

    Returns
    -------
    float
        Length of the arc over the chord, minus 1; grows with the sag [-].

    Verified by
    -----------
    tests/cable/test_sag.py
    """
    slope = 4.0 * sag  # of the ends
    if slope < 1e-4:
        return slope * slope / 6.0
    return 0.5 * math.hypot(1.0, slope) + 0.5 * math.asinh(slope) / slope - 1.0


def find_sag(slack: float) -> float:
    """Sag over its chord of a net of some slack [-]: the inverse of `find_slack`."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        is_low = find_slack(middle) < slack
        low, high = (middle, high) if is_low else (low, middle)
    return low
