"""Distance of straight anchors in the ground."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product

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
    return min((measure_distance(one, other) for one, other in pairs), default=math.inf)


def find_distance_to_row_above(
    bores: Sequence[Bore], alike: Sequence[Bore], upslope: float
) -> float:
    """Least distance to anchors of a row above that is built alike [m].

    Nobody knows how the two rows stand along each other: seen along the row, where
    distances are least. Theory: structure/THEORY.md, eq. (S21).

    Parameters
    ----------
    bores, alike : sequence of Bore
        Anchors of the row; and those that the row above has as well.
    upslope : float
        Distance of the row above, along the slope [m].

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    here, above = ({_flatten(one) for one in found} for found in (bores, alike))
    moved = [
        replace(one, start=(one.start[0] - upslope, *one.start[1:])) for one in above
    ]
    pairs = product(here, moved)
    return min((measure_distance(*pair) for pair in pairs), default=math.inf)


def _flatten(bore: Bore) -> Bore:
    """Anchor as it is seen along the row."""
    (x, y, _), (along, out, _) = bore.start, bore.direction
    seen = math.hypot(along, out)
    direction = (along / seen, out / seen, 0.0) if seen else (0.0, -1.0, 0.0)
    length = None if bore.length is None else bore.length * seen
    return Bore(start=(x, y, 0.0), direction=direction, length=length)


def measure_distance(one: Bore, other: Bore) -> float:
    """Least distance of two anchors, each a straight line of its length [m].

    It lies between two points inside both, or at an end of one of them.

    Verified by
    -----------
    tests/verification/test_anchor_distance.py
    """
    ways = (one.direction, other.direction)
    lengths = [_LONG if bore.length is None else bore.length for bore in (one, other)]
    x, y, z = (a - b for a, b in zip(one.start, other.start, strict=True))
    gap = (x, y, z)
    cosine = _dot(*ways)
    along = (_dot(ways[0], gap), _dot(ways[1], gap))
    sine = 1.0 - cosine**2
    tried = [(end, along[1] + end * cosine) for end in (0.0, lengths[0])]
    tried += [(end * cosine - along[0], end) for end in (0.0, lengths[1])]
    if sine > 1e-12:
        first = (cosine * along[1] - along[0]) / sine
        tried.append((first, along[1] + first * cosine))
    return min(
        math.dist(_go(one, s, lengths[0]), _go(other, t, lengths[1])) for s, t in tried
    )


def _dot(one: Place, other: Place) -> float:
    return sum(a * b for a, b in zip(one, other, strict=True))


def _go(bore: Bore, way: float, length: float) -> Place:
    """Place on an anchor, so far along it, or at the nearer end."""
    x, y, z = (
        start + min(max(way, 0.0), length) * slope
        for start, slope in zip(bore.start, bore.direction, strict=True)
    )
    return x, y, z
