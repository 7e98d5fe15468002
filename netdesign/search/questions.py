"""Points at which a search asks for values next.

Theory: search/THEORY.md, "First design" and "Questions".
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from netdesign.search.surrogate import Point
from netdesign.search.upper_bound import GRAIN, Bounds

# All lengths as shares of a range.
_BESIDE = 1.0 / 16.0  # from a maximum to the cases that test it
_TEST_APART = 0.125  # least distance of a test from every known case
_APART = 0.2  # least distance between the cases of one batch


class Question(NamedTuple):
    """One point, and the quantity that asks for it."""

    point: Point
    quantity: int


def list_first_design(dimension: int) -> tuple[Point, ...]:
    """Cases of the first round: corners and centre, and what lies between.

    Up to three parameters it has all of low, middle and high; beyond, the corners, the
    centre and the centres of the faces. Both have the centres of the 2^n parts, too.
    """
    corners = set(product((0.0, 1.0), repeat=dimension))
    if dimension <= 3:
        points = set(product((0.0, 0.5, 1.0), repeat=dimension))
    else:
        centre = (0.5,) * dimension
        faces = {
            (*centre[:axis], side, *centre[axis + 1 :])
            for axis in range(dimension)
            for side in (0.0, 1.0)
        }
        points = corners | faces | {centre}
    return tuple(sorted(points | set(product((0.25, 0.75), repeat=dimension))))


def choose_questions(
    bounds: Bounds, points: Sequence[Point], batch: int, room: int
) -> list[Question]:
    """Next cases: where a quantity could exceed its maximum; then tests of the bounds.

    Parameters
    ----------
    bounds : Bounds
        Of the cases known so far.
    points : sequence of Point
        These cases.
    batch : int
        Most cases of a round; the neighbours of the maxima are asked for together.
    room : int
        Cases that may still be asked for.
    """
    most = min(batch, room)
    if not bounds.is_closed:
        # the places that could exceed may all be known cases: then the best others
        return _pick(bounds, bounds.deciding, points, most, 0.0, GRAIN) or _pick(
            bounds, bounds.open, points, most, -math.inf, _BESIDE
        )
    known = set(points)
    beside = [one for one in _list_neighbours(bounds) if one.point not in known]
    if beside:
        return beside[:room]
    return _pick(bounds, bounds.deciding, points, most, -math.inf, _TEST_APART)


def _pick(
    bounds: Bounds,
    quantities: Sequence[int],
    points: Sequence[Point],
    most: int,
    least: float,
    apart: float,
) -> list[Question]:
    """Wanted cases above an excess, well apart from each other and from known ones."""
    chosen: list[Question] = []
    for excess, point, quantity in bounds.wanted:
        if quantity not in quantities:
            continue
        if excess <= least or len(chosen) >= most:
            break
        is_apart = all(math.dist(point, other) > _APART for other, _ in chosen)
        if is_apart and all(math.dist(point, other) >= apart for other in points):
            chosen.append(Question(point, quantity))
    return chosen


def _list_neighbours(bounds: Bounds) -> list[Question]:
    """Points just beside every maximum, along each axis: they tell if it is one."""
    found: dict[Point, int] = {}
    for place, quantity in bounds.summits:
        for axis, side in product(range(len(place)), (-_BESIDE, _BESIDE)):
            value = place[axis] + side
            if 0.0 <= value <= 1.0:
                found.setdefault((*place[:axis], value, *place[axis + 1 :]), quantity)
    return [Question(point, quantity) for point, quantity in found.items()]
