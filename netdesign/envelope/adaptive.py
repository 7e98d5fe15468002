"""The largest values of several quantities over a box, with what may still hide.

Knows no solver: it asks for values at points of the unit cube. Coarse to fine: a
first design, then cases where a quantity could still exceed its maximum under the
model of ``surrogate.py``; once none can, cases that put that very claim to the test.
Theory: envelope/THEORY.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from netdesign.envelope.surrogate import (
    Surrogate,
    count_trend_terms,
    fit_surrogate,
)
from netdesign.envelope.upper_bound import (
    GRAIN,
    NOISE,
    Bounds,
    Surprise,
    bound_quantities,
    build_lattice,
)
from netdesign.errors import ModelError
from netdesign.guards import require_count, require_within
from netdesign.words.message import say

Floats = NDArray[np.float64]
Point = tuple[float, ...]
Values = tuple[float, ...]
Search = Generator[tuple[Point, ...], Sequence[Values | None], "Maxima"]

MOST_PARAMETERS = 6
# The first design sees features at least as wide at half their height, as a share of
# a range; narrower ones may hide, and every result says so.
RESOLVED_SHARE = 0.6
_BESIDE = 1.0 / 16.0  # from a maximum to the cases that test it
_MOST_SURPRISE = 2.0  # more would widen what is dense with cases by now
_TEST_APART = 0.125  # least distance of a test from every known case
_APART = 0.2  # least distance between the cases of one batch


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """How closely the maxima are bounded; pure numbers, printed in every result.

    Attributes
    ----------
    gap : float
        Most that the upper bound may lie above the maximum found, as a share of it.
    certainty : float
        Standard errors between the model's mean and the upper bound.
    tests : int
        Batches of held-out cases in turn that the model must predict well, at the
        places where it could be wrong most dearly, before the search ends.
    small_share : float
        Quantities below this share of the largest one are bounded to the same
        absolute gap as at that share. A small guy force is a difference of large
        ones: its numerical error is a share of those, and so may be its gap.
    batch : int
        Cases per round; not the number of workers, so that results do not depend
        on that.
    max_cases : int
        The search ends there with whatever gap is left, and says so.
    """

    gap: float = 0.005
    certainty: float = 3.0
    tests: int = 2
    small_share: float = 0.2
    batch: int = 6
    max_cases: int = 250

    def __post_init__(self) -> None:
        """Refuse settings that would certify anything."""
        require_within("gap", self.gap, 1e-4, 0.5)
        require_within("certainty", self.certainty, 1.0, 10.0)
        require_within("small share", self.small_share, 0.0, 1.0)
        for name in ("tests", "batch", "max_cases"):
            require_count(name.replace("_", " "), getattr(self, name))


@dataclass(frozen=True, slots=True, kw_only=True)
class Watched:
    """What is asked of the bound of one quantity, in its unit.

    ``worth`` is the closest gap that is worth a case: nobody bounds a force closer
    than its cases are accurate. Below ``floor`` the quantity does not matter, since
    another one of the same member is as large already.
    """

    worth: float = 0.0
    floor: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Addition:
    """One line of the densification log: a case, why, and what the model expected.

    ``predicted``, ``claimed`` (one standard error) and ``found`` are of the quantity
    that asked for the case; NaN predictions belong to the first design, a NaN
    ``found`` to a case that failed.
    """

    point: Point
    round: int
    reason: str  # "first design", "could exceed", "test"
    quantity: int
    predicted: float
    claimed: float
    found: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Maxima:
    """End of a search.

    Attributes
    ----------
    points : tuple of Point
        All cases asked for, in order; shares of the ranges.
    values : tuple of Values or None
        Their answers; None for a failed case.
    maximum, upper_bound : tuple of float
        Of each quantity: largest value found, and largest value that the model
        allows anywhere in the box, 0 where all are negative; infinite for a
        quantity that was not watched. Empty if no case succeeded.
    governing : tuple of int
        Place of each maximum in ``points``; of equals the least point.
    is_closed : bool
        Every gap is within the settings and the claim passed its tests.
    log : tuple of Addition
        Why each case was solved.
    surrogate : Surrogate or None
        Last model; None where there were too few cases for one.
    """

    points: tuple[Point, ...]
    values: tuple[Values | None, ...]
    maximum: tuple[float, ...]
    upper_bound: tuple[float, ...]
    governing: tuple[int, ...]
    is_closed: bool
    log: tuple[Addition, ...]
    surrogate: Surrogate | None


def search_maxima(
    dimension: int,
    settings: SearchSettings,
    on_round: Callable[[float], None] = lambda _: None,
    watch: Callable[[], Mapping[int, Watched]] | None = None,
) -> Search:
    """Ask for values until every maximum is bounded; ``send`` answers each question.

    Parameters
    ----------
    dimension : int
        Number of parameters, 1 to 6.
    settings : SearchSettings
        When to stop.
    on_round : callable, optional
        Takes the largest gap left after each round, over its quantity [-].
    watch : callable, optional
        Which quantities have to be bounded, by their place, and how closely. Asked
        once answers are there; other quantities are modelled along. All of them
        unless told otherwise.

    Yields
    ------
    tuple of Point
        Cases to solve, each coordinate a share of its range, 0 to 1. The answer is
        one tuple of values for each, or None where a case failed.

    Returns
    -------
    Maxima
        The same for the same answers, whoever computed them in whatever order.

    Raises
    ------
    ModelError
        For a number of parameters that is not within 1 to 6.

    Verified by
    -----------
    tests/envelope/test_adaptive.py
    """
    if not 1 <= dimension <= MOST_PARAMETERS:
        raise ModelError(
            say("envelope.parameters", count=dimension, most=MOST_PARAMETERS)
        )
    points = list_first_design(dimension)
    values = list((yield points))
    log = [_note_first(*one) for one in zip(points, values, strict=True)]
    lattice = build_lattice(dimension)
    passed = 0
    surprises: list[Surprise] = []
    while True:
        solved = [k for k, value in enumerate(values) if value is not None]
        if len(solved) <= count_trend_terms(dimension):
            return _finish(points, values, log, None, None, is_closed=False)
        places = np.array([points[k] for k in solved])
        known = np.array([values[k] for k in solved])
        everything = dict.fromkeys(range(known.shape[1]), Watched())
        watched = everything if watch is None else watch()
        model, bounds = _bound(places, known, settings, watched, lattice, surprises)
        on_round(bounds.gap * settings.gap)
        batch = _choose(bounds, points, settings)
        is_done = bounds.is_closed and passed >= settings.tests
        has_room = len(points) < settings.max_cases
        if is_done or not batch or not has_room:
            # without a batch nothing is left to test, or there was no room for it
            is_closed = bounds.is_closed and (is_done or (not batch and has_room))
            return _finish(points, values, log, model, bounds, is_closed=is_closed)
        answers = yield tuple(point for point, _ in batch)
        held, claimed = _hold_out(model, batch, answers, log, bounds)
        held[:, [q for q in range(held.shape[1]) if q not in watched]] = 0.0
        # the bound must have held for every case that was not yet known
        covered = np.maximum(settings.certainty * claimed, bounds.tolerance / 2.0)
        passed = passed + 1 if bounds.is_closed and np.all(held <= covered) else 0
        surprises += [
            Surprise(place=np.array(point), ratio=np.minimum(ratio, _MOST_SURPRISE))
            for (point, _), ratio in zip(batch, held / covered, strict=True)
            if np.any(ratio > 1.0)
        ]
        points = (*points, *(point for point, _ in batch))
        values = [*values, *answers]


def list_first_design(dimension: int) -> tuple[Point, ...]:
    """Cases of the first round: corners and centre, and what lies between.

    Up to three parameters all of low, middle and high; beyond, the corners, the
    centre and the centres of the faces. To both the centres of the 2^n parts.
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


def _note_first(point: Point, value: Values | None) -> Addition:
    return Addition(
        point=point,
        round=0,
        reason="first design",
        quantity=0,
        predicted=math.nan,
        claimed=math.nan,
        found=math.nan if value is None else value[0],
    )


def _bound(
    places: Floats,
    values: Floats,
    settings: SearchSettings,
    watched: Mapping[int, Watched],
    lattice: Floats,
    surprises: Sequence[Surprise],
) -> tuple[Surrogate, Bounds]:
    """Model of the cases solved so far, and what it allows."""
    tolerance = _set_tolerance(values, settings, watched)
    model = fit_surrogate(places, values, NOISE * tolerance)
    return model, bound_quantities(
        model,
        values,
        best=_find_best(values, watched),
        tolerance=tolerance,
        watched=list(watched),
        lattice=lattice,
        certainty=settings.certainty,
        surprises=surprises,
    )


def _find_best(values: Floats, watched: Mapping[int, Watched]) -> Floats:
    """What a quantity has to exceed to matter; a negative force is none."""
    floors = [watched.get(q, Watched()).floor for q in range(values.shape[1])]
    result: Floats = np.maximum(values.max(axis=0), np.maximum(floors, 0.0))
    return result


def _set_tolerance(
    values: Floats, settings: SearchSettings, watched: Mapping[int, Watched]
) -> Floats:
    """Gap that each quantity may keep, in its unit."""
    best = _find_best(values, watched)
    scale = np.maximum(best, settings.small_share * best.max())
    worth = [watched.get(q, Watched()).worth for q in range(values.shape[1])]
    tolerance = np.maximum(settings.gap * scale, worth)
    result: Floats = np.maximum(tolerance, np.finfo(float).tiny)
    return result


def _choose(
    bounds: Bounds, points: Sequence[Point], settings: SearchSettings
) -> list[tuple[Point, int]]:
    """Next cases: where a quantity could exceed; once none can, tests of that."""
    room = settings.max_cases - len(points)
    known = set(points)
    if bounds.is_closed:
        beside = [one for one in _list_neighbours(bounds) if one[0] not in known]
        if beside:
            return beside[:room]
    most = min(settings.batch, room)
    if bounds.is_closed:
        return _pick(bounds, bounds.watched, points, most, -math.inf, _TEST_APART)
    # all that could exceed may lie on known cases: then the like of them elsewhere
    return _pick(bounds, bounds.watched, points, most, 0.0, GRAIN) or _pick(
        bounds, bounds.open, points, most, -math.inf, _BESIDE
    )


def _pick(
    bounds: Bounds,
    quantities: Sequence[int],
    points: Sequence[Point],
    most: int,
    least: float,
    apart: float,
) -> list[tuple[Point, int]]:
    """Wanted cases above an excess, well apart from each other and from known ones."""
    chosen: list[tuple[Point, int]] = []
    for excess, point, quantity in bounds.wanted:
        if quantity not in quantities:
            continue
        if excess <= least or len(chosen) >= most:
            break
        is_apart = all(math.dist(point, other) > _APART for other, _ in chosen)
        if is_apart and all(math.dist(point, other) >= apart for other in points):
            chosen.append((point, quantity))
    return chosen


def _list_neighbours(bounds: Bounds) -> list[tuple[Point, int]]:
    """Points just beside every maximum, along each axis: they tell if it is one."""
    found: dict[Point, int] = {}
    for place, quantity in bounds.summits:
        for axis, side in product(range(len(place)), (-_BESIDE, _BESIDE)):
            value = place[axis] + side
            if 0.0 <= value <= 1.0:
                found.setdefault((*place[:axis], value, *place[axis + 1 :]), quantity)
    return list(found.items())


def _hold_out(
    model: Surrogate,
    batch: Sequence[tuple[Point, int]],
    answers: Sequence[Values | None],
    log: list[Addition],
    bounds: Bounds,
) -> tuple[Floats, Floats]:
    """Log a batch against what the model expected of it.

    Returns the errors of the predictions and their claims, shape (batch, quantities);
    a failed case has no error.
    """
    mean, claim = model.predict(np.array([point for point, _ in batch]))
    number = log[-1].round + 1
    errors = np.zeros_like(mean)
    for k, ((point, quantity), answer) in enumerate(zip(batch, answers, strict=True)):
        log.append(
            Addition(
                point=point,
                round=number,
                reason="test" if bounds.is_closed else "could exceed",
                quantity=quantity,
                predicted=float(mean[k, quantity]),
                claimed=float(claim[k, quantity]),
                found=math.nan if answer is None else answer[quantity],
            )
        )
        if answer is not None:
            errors[k] = np.abs(np.array(answer) - mean[k])
    return errors, claim


def _finish(
    points: Sequence[Point],
    values: Sequence[Values | None],
    log: Sequence[Addition],
    model: Surrogate | None,
    bounds: Bounds | None,
    *,
    is_closed: bool,
) -> Maxima:
    solved = [k for k, value in enumerate(values) if value is not None]
    answers = [values[k] or () for k in solved]
    governing = tuple(
        min(solved, key=lambda k: (-(values[k] or ())[quantity], points[k]))
        for quantity in range(len(answers[0]) if answers else 0)
    )
    maximum = tuple((values[k] or ())[q] for q, k in enumerate(governing))
    upper = maximum if bounds is None else tuple(float(u) for u in bounds.upper)
    return Maxima(
        points=tuple(points),
        values=tuple(values),
        maximum=maximum,
        upper_bound=upper,
        governing=governing,
        is_closed=is_closed,
        log=tuple(log),
        surrogate=model,
    )
