"""Upper bounds of the quantities over the box, and the points to solve next.

The bound is the model's mean plus some standard errors, more of them around cases that
exceeded it. It is evaluated on a lattice and around the best cases, then followed
uphill. Theory: search/THEORY.md, "First design", "Questions", eq. (M6) and (M7).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.numerics.optimise import find_distinct
from netdesign.search.surrogate import REACH, Point, Surrogate, measure_distances

# Coordinates are multiples of this share of a range: equal cases have equal keys.
GRAIN = 1.0 / 64.0
# Points per axis at which the bound is looked at before it is followed uphill.
_LATTICE = {0: 1, 1: 65, 2: 17, 3: 9, 4: 5, 5: 4, 6: 4, 7: 3, 8: 3}
CERTAINTY = 3.0  # standard errors between the model's mean and the upper bound
NOISE = 0.25  # of a tolerance: what cases may jump by from mesh to mesh
_WANTED = 100  # highest lattice points per quantity that may be asked for
_STARTS = 3  # highest lattice points per quantity that are followed uphill
_FINEST_STEP = 1.0 / 128.0
_MARGIN = 0.02  # of a tolerance: what following the bound uphill may fall short by


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inflation:
    """A wider standard error around a case that the bound did not hold for."""

    place: Floats
    ratio: Floats  # error over what was allowed, shape (quantities,)


class Wanted(NamedTuple):
    """Points that may be asked for, n of them, those of the largest excess first."""

    excess: Floats  # of the bound over the least that matters, over the tolerance
    points: Floats  # shape (n, dimension)
    quantities: Ints  # whose bound it is


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Bounds:
    """Values that the model allows, and their places."""

    best: Floats
    tolerance: Floats  # shape (quantities,)
    upper: Floats
    watched: tuple[int, ...]
    deciding: tuple[int, ...]  # those of them that have to be close
    summits: tuple[Point, ...]  # best values of the deciding quantities
    wanted: Wanted

    @property
    def open(self) -> tuple[int, ...]:
        """Deciding quantities whose gap is larger than its tolerance."""
        gaps = (self.upper - self.best) / self.tolerance
        return tuple(q for q in self.deciding if not gaps[q] <= 1.0 + 1e-9)

    @property
    def is_closed(self) -> bool:
        """No gap is larger than its tolerance."""
        return not self.open


class Lattice:
    """Places at which a bound is looked at first, and what is known of them.

    Attributes
    ----------
    places : ndarray, shape (n, dimension)
        Even shares of each range [-].
    step : float
        Between two of them along an axis [-].
    """

    def __init__(self, dimension: int) -> None:
        """Lay the places out."""
        count = _LATTICE[dimension]
        self.places = _list_products(np.linspace(0.0, 1.0, count), dimension)
        self.step = 1.0 / max(1, count - 1)
        self._near: Floats = np.empty((len(self.places), 0))

    def correlate(self, model: Surrogate) -> Floats:
        """Correlation with a model's cases: those of the last model, and new ones."""
        new = model.correlate(self.places, self._near.shape[1])
        self._near = np.concatenate([self._near, new], axis=1)
        return self._near


def bound_quantities(
    model: Surrogate,
    values: Floats,
    *,
    best: Floats,
    tolerance: Floats,
    watched: Sequence[int],
    deciding: Sequence[int],
    lattice: Lattice,
    inflations: Sequence[Inflation],
) -> Bounds:
    """Largest mean plus ``CERTAINTY`` standard errors, and the places near it.

    Parameters
    ----------
    model : Surrogate
        Fitted to the values.
    values : ndarray, shape (n, quantities)
        Of the solved cases.
    best, tolerance : ndarray, shape (quantities,)
        What each quantity has to exceed to matter, and the gap that it may keep.
    watched : sequence of int
        Quantities that are bounded; the others have no bound.
    deciding : sequence of int
        Those of them whose bounds have to be close.
    lattice : Lattice
        Of the same dimension, for models of the same cases and more.
    inflations : sequence of Inflation
        Around the cases for which the bound did not hold.

    Returns
    -------
    Bounds
        Of a quantity that is negative everywhere 0, of one not watched infinity.
    """
    asked = list(watched)
    around = np.array([model.places[np.argmax(column)] for column in values.T])
    # at the walls of the box many places around the best cases are one
    distinct, every = find_distinct(_surround(np.unique(around, axis=0)))
    looked_at = np.concatenate([lattice.places, distinct[every]])

    reach = _build_reach(model, asked, tolerance, inflations)
    of_lattice = reach(lattice.places, lattice.correlate(model))
    allowed = np.concatenate([of_lattice, reach(distinct)[every]])
    upper = allowed.max(axis=0)
    order = {q: _list_highest(allowed[:, q]) for q in asked}
    starts = {q: looked_at[places[:_STARTS]] for q, places in order.items()}
    climbed = _climb(starts, reach, lattice.step)
    wanted = []
    for quantity, (tops, heights) in climbed.items():
        upper[quantity] = max(upper[quantity], heights.max())
        places = np.concatenate([tops, looked_at[order[quantity]]])
        reached = np.concatenate([heights, allowed[order[quantity], quantity]])
        excess = (reached - best[quantity]) / tolerance[quantity] - 1.0
        if quantity in deciding:
            wanted.append((excess, _settle(places), np.full(len(places), quantity)))
    summits = [tuple(place) for place in _settle(around).tolist()]
    return Bounds(
        best=best,
        tolerance=tolerance,
        upper=_close_above(upper, best, _MARGIN * tolerance),
        watched=tuple(asked),
        deciding=tuple(deciding),
        summits=tuple(summits[q] for q in deciding if values[:, q].max() >= best[q]),
        wanted=_sort(wanted, lattice.places.shape[1]),
    )


def _sort(wanted: Sequence[tuple[Floats, Floats, Ints]], dimension: int) -> Wanted:
    """All points that may be asked for; of equal excess the least point first."""
    none = (np.empty(0), np.empty((0, dimension)), np.empty(0, dtype=np.intp))
    excess, points, quantities = map(np.concatenate, zip(none, *wanted, strict=True))
    order = np.lexsort((quantities, *points.T[::-1], -excess))
    return Wanted(excess[order], points[order], quantities[order])


def _list_highest(values: Floats) -> Ints:
    """Places of the highest of some values, in their order."""
    count = min(_WANTED, len(values))
    least = np.partition(values, len(values) - count)[len(values) - count]
    places = np.flatnonzero(values >= least)
    return places[np.argsort(-values[places], kind="stable")[:count]]


def _build_reach(
    model: Surrogate,
    asked: list[int],
    tolerance: Floats,
    inflations: Sequence[Inflation],
) -> Callable[..., Floats]:
    """Places to what each quantity may reach there; infinity of one not asked for."""
    of_asked = model.select(asked)
    around = np.array([one.place for one in inflations])
    wider = np.array([one.ratio[asked] - 1.0 for one in inflations])

    def reach(at: Floats, near: Floats | None = None) -> Floats:
        mean, standard_error, sway = of_asked.predict(at, near)
        factor = _inflate(at, around, wider) if inflations else 1.0
        result: Floats = np.full((len(at), len(tolerance)), np.inf)
        likely = mean + CERTAINTY * factor * standard_error
        result[:, asked] = likely + sway + NOISE * tolerance[asked]
        return result

    return reach


def _close_above(upper: Floats, best: Floats, margin: Floats) -> Floats:
    """Bound above the largest value found, and above what the model reaches.

    What is negative everywhere is no force at all: a guy that stays slack.
    """
    is_force = (upper > 0.0) | (best > 0.0)
    return np.where(is_force, np.maximum(upper, best) + margin, 0.0)


def _settle(places: Floats) -> Floats:
    """Nearest points whose coordinates are multiples of the grain."""
    return np.asarray(np.round(places / GRAIN) * GRAIN)


def _inflate(at: Floats, around: Floats, wider: Floats) -> Floats:
    """Factor of the standard errors at places, by what is added around others [-]."""
    shares = np.exp(-((measure_distances(around, at) / REACH) ** 2))
    added = np.zeros((wider.shape[1], len(at)))
    for share, ratio in zip(shares, wider, strict=True):
        np.maximum(added, ratio[:, None] * share, out=added)
    return 1.0 + added.T


def _list_products(axis: Floats, dimension: int) -> Floats:
    """All points with these coordinates, (n, dimension): the last one varies first."""
    places = np.indices((axis.size,) * dimension).reshape(
        dimension, axis.size**dimension
    )
    return np.asarray(axis[places.T])


def _surround(places: Floats) -> Floats:
    """Finer lattice around each of the best cases found."""
    offsets = _list_products(np.array([-0.0625, 0.0, 0.0625]), places.shape[1])
    around = np.clip(places[:, None] + offsets, 0.0, 1.0)
    return np.asarray(around.reshape(-1, places.shape[1]))


def _climb(
    starts: Mapping[int, Floats], reach: Callable[[Floats], Floats], step: float
) -> dict[int, tuple[Floats, Floats]]:
    """Follow each quantity's bound uphill, by halving steps along the axes.

    All quantities go together, since one large question costs less than many small.
    """
    places = np.concatenate(list(starts.values()))
    owners = np.repeat(list(starts), [len(own) for own in starts.values()])
    count, dimension = places.shape
    heights = np.full(count, -np.inf)
    moves = np.concatenate(
        [np.zeros((1, dimension)), np.eye(dimension), -np.eye(dimension)]
    )
    while True:
        step /= 2.0
        moving = np.arange(count)
        for _ in range(dimension):  # one move an axis
            tried = np.clip(places[moving] + step * moves[:, None], 0.0, 1.0)
            # quantities climb the same way, and steps end at the walls of the box
            distinct, place = find_distinct(tried.reshape(-1, dimension))
            reached = reach(distinct)[place].reshape(len(moves), len(moving), -1)
            here = np.arange(len(moving))
            own = reached[:, here, owners[moving]]
            best = own.argmax(axis=0)
            places[moving], heights[moving] = tried[best, here], own[best, here]
            moving = moving[best > 0]  # the others are on top for this step
            if not len(moving):
                break
        if step <= _FINEST_STEP:
            return {q: (places[owners == q], heights[owners == q]) for q in starts}


# All lengths as shares of a range.
_BESIDE = 1.0 / 16.0  # from a maximum to the cases that test it
_TEST_APART = 0.125  # least distance of a test from every known case
_APART = 0.2  # least distance between the cases of one batch


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
) -> list[Point]:
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
    sampled = set(points)
    beside = [x for x in _list_neighbours(bounds) if x not in sampled]
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
) -> list[Point]:
    """Wanted cases above an excess, well apart from each other and from known ones."""
    wanted = bounds.wanted
    is_asked = np.isin(wanted.quantities, quantities) & (wanted.excess > least)
    if not is_asked.any():
        return []
    at = wanted.points[is_asked]
    is_free = measure_distances(at, np.array(points)).min(axis=1) >= apart * (1 - 1e-9)
    chosen: list[Point] = []
    for point in map(tuple, at[is_free].tolist()):
        if len(chosen) >= most:
            break
        if all(math.dist(point, other) > _APART for other in chosen):
            chosen.append(point)
    return chosen


def _list_neighbours(bounds: Bounds) -> list[Point]:
    """Points just beside every maximum, along each axis: they tell if it is one."""
    asked: dict[Point, None] = {}
    for place in bounds.summits:
        for axis, side in product(range(len(place)), (-_BESIDE, _BESIDE)):
            value = place[axis] + side
            if 0.0 <= value <= 1.0:
                asked[(*place[:axis], value, *place[axis + 1 :])] = None
    return list(asked)
