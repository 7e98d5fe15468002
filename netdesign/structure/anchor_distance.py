"""Distance of straight anchors in the ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

Place = tuple[float, float, float]

_LONG = 60.0  # of an anchor whose length is not given [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Bore:
    """Drilled anchor: where it starts, which way it goes, and how far.

    Attributes
    ----------
    start : tuple of float, shape (3,)
        On the ground, (x, y, z): downslope, normal to the slope, along the row [m].
    direction : tuple of float, shape (3,)
        Into the ground, of length 1 [-].
    length : float or None
        Drilled [m]; None where it is not given: then it goes on.
    """

    start: Place
    direction: Place
    length: float | None


def find_least_distance(bores: Sequence[Bore]) -> float:
    """Least distance between any two anchors [m]; infinite of a single one.

    Theory: structure/THEORY.md, eq. (S21).

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    pairs = combinations(bores, 2)
    return min((measure_distance(one, other) for one, other in pairs), default=np.inf)


def measure_distance(one: Bore, other: Bore) -> float:
    """Least distance of two anchors, each a straight line of its length [m].

    It lies between two points inside both, or at an end of one of them.

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    ways = [np.array(bore.direction) for bore in (one, other)]
    lengths = [_LONG if bore.length is None else bore.length for bore in (one, other)]
    gap = np.subtract(one.start, other.start)
    cosine = float(ways[0] @ ways[1])
    along = (float(ways[0] @ gap), float(ways[1] @ gap))
    sine = 1.0 - cosine**2
    tried = [(end, along[1] + end * cosine) for end in (0.0, lengths[0])]
    tried += [(end * cosine - along[0], end) for end in (0.0, lengths[1])]
    if sine > 1e-12:
        first = (cosine * along[1] - along[0]) / sine
        tried.append((first, along[1] + first * cosine))
    return min(
        float(np.linalg.norm(gap + s * ways[0] - t * ways[1]))
        for s, t in (np.clip(point, 0.0, lengths) for point in tried)
    )
