"""Slack and sag of a net that hangs without snow."""

from __future__ import annotations

import math


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
