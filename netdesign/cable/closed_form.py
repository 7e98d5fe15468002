"""Closed forms of cables: starts for the solver, references for its tests.

Theory: cable/THEORY.md, eqs (C6) to (C9).
"""

from __future__ import annotations

import math

from netdesign.outcome import require_positive, require_within


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
