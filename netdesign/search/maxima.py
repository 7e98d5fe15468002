"""The largest values of several quantities over a box, with a bound between the cases.

The search knows no solver: it asks for values at points of the unit cube. First a
coarse design; then cases where the model of ``surrogate.py`` lets a quantity exceed its
maximum; at last cases that test this bound. Theory: search/THEORY.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats, Mask
from netdesign.outcome import ModelError
from netdesign.search.surrogate import (
    DENSE_DIMENSIONS,
    Point,
    Prediction,
    Surrogate,
    fit_surrogate,
    supports_model,
    weigh_axes,
)
from netdesign.search.upper_bound import (
    CERTAINTY,
    NOISE,
    Bounds,
    Inflation,
    Lattice,
    bound_quantities,
    choose_questions,
    list_first_design,
)
from netdesign.words.message import say

MOST_PARAMETERS = 8
# The first design sees features at least as wide at half their height, as a share of
# a range; narrower ones may hide, and every result says so.
RESOLVED_SHARE = 0.6
# Batches of held-out cases in turn that the model must predict well, at the places
# where it could be wrong most dearly, before the search ends.
_TESTS = 2
# Quantities below this share of the largest one are bounded to the same absolute gap as
# at that share. A small guy force is a difference of large ones: its numerical error is
# a share of those, and so may be its gap.
_SMALL_SHARE = 0.2
# Cases per round; not the number of workers, so that results do not depend on that.
_BATCH = 6
_MOST_INFLATION = 2.0  # more would widen what is dense with cases by now


@dataclass(frozen=True, slots=True, kw_only=True)
class SearchSettings:
    """Demands on the bounds of the maxima.

    Attributes
    ----------
    gap : float
        Most that the upper bound may lie above the maximum found, as a share of it.
    max_cases : int
        The search ends there with whatever gap is left, and says so.
    """

    gap: float = 0.005
    max_cases: int = 250


@dataclass(frozen=True, slots=True, kw_only=True)
class Watched:
    """Demands on the bound of one quantity, in its unit.

    Attributes
    ----------
    resolution : float
        Smallest gap that is worth a case: the numerical accuracy of the cases.
    floor : float
        Below it the quantity does not matter, since another one is as large already.
    is_deciding : bool
        Its bound has to be close. That of another one follows from the same cases,
        close or not: it asks for none, and no test of it counts.
    """

    resolution: float = 0.0
    floor: float = 0.0
    is_deciding: bool = True


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Maxima:
    """End of a search.

    Attributes
    ----------
    points : tuple of Point
        All cases asked for, in order; shares of the ranges.
    values : ndarray, shape (points, quantities)
        Their answers; no numbers of a failed case.
    doubts : ndarray, shape (points, quantities)
        Errors of the answers that are known roughly only; 0 of the others.
    maximum, upper_bound : tuple of float
        Of each quantity: largest value found, and largest value that the model
        allows anywhere in the box, 0 where all are negative; infinite for a
        quantity that was not watched. Empty if no case succeeded.
    governing : tuple of int
        Place of each maximum in ``points``; of equals the least point.
    is_closed : bool
        Every gap is within the settings and the bound passed its tests.
    surrogate : Surrogate or None
        Last model; None where there were too few cases for one.
    """

    points: tuple[Point, ...]
    values: Floats
    doubts: Floats
    maximum: tuple[float, ...]
    upper_bound: tuple[float, ...]
    governing: tuple[int, ...]
    is_closed: bool
    surrogate: Surrogate | None


class MaximaSearch:
    """Search of several quantities until each maximum is bounded.

    It asks, and is told: ``while points := search.ask(): search.tell(values)``. The
    same for the same values, whoever computed them in whatever order.

    Attributes
    ----------
    settings : SearchSettings
        When it ends.
    points : tuple of Point
        All cases told so far, in the order in which they were asked for.
    values, doubts : list of ndarray
        Their answers and the errors of these, an array for each round.
    result : Maxima or None
        End of the search; None while it goes on.

    Verified by
    -----------
    tests/search/test_maxima.py
    """

    def __init__(self, dimension: int, settings: SearchSettings) -> None:
        """Begin with the first design.

        Parameters
        ----------
        dimension : int
            Number of parameters, 0 to 8.
        settings : SearchSettings
            When to end.

        Raises
        ------
        ModelError
            For more than 8 parameters.
        """
        if dimension > MOST_PARAMETERS:
            raise ModelError(
                say("envelope.parameters", count=dimension, most=MOST_PARAMETERS)
            )
        self.settings = settings
        self.points: tuple[Point, ...] = ()
        self.values: list[Floats] = []
        self.doubts: list[Floats] = []
        self.result: Maxima | None = None
        self._lattice = Lattice(dimension)
        self._asked = [*list_first_design(dimension)]
        self._axis_weights: Floats | None = None  # by the first design
        self._model: Surrogate | None = None
        self._bounds: Bounds | None = None  # these led to the questions
        self._passed = 0  # tests in turn
        self._inflations: list[Inflation] = []

    def ask(self) -> tuple[Point, ...]:
        """Points whose values are wanted next; () once the search has ended.

        Each coordinate is a share of its range, 0 to 1. Asked again before the values
        are told, the points are the same.
        """
        return tuple(self._asked)

    def tell(
        self,
        values: Floats,
        watched: Mapping[int, Watched] | None = None,
        doubts: Floats | None = None,
    ) -> None:
        """Take the values at the points asked for, and decide what to ask next.

        Parameters
        ----------
        values : ndarray, shape (points, quantities)
            In their order, each in the quantity's unit; no numbers where a case failed.
        watched : mapping of int to Watched, optional
            Quantities that have to be bounded, by their place, and how closely; the
            others are modelled along. All of them unless told otherwise.
        doubts : ndarray, shape (points, quantities), optional
            Errors of values that are known roughly only, 0 of the others; none by
            default.
        """
        if self._model is not None and self._bounds is not None:
            expected = self._model.predict(np.array(self.ask()))
            self._test(values, expected, self._bounds)
        self.points += self.ask()
        self.values.append(values)
        self.doubts.append(np.zeros_like(values) if doubts is None else doubts)
        self._asked = self._choose(watched)
        if not self._asked:
            self.result = self._finish()

    def _test(self, values: Floats, expected: Prediction, bounds: Bounds) -> None:
        """Test the bounds by cases that they did not know: they must have held."""
        errors = _measure_errors(values, expected.mean, bounds.watched)
        allowed = np.maximum(
            CERTAINTY * expected.standard_error, bounds.tolerance / 2.0
        )
        is_held = (errors <= allowed)[:, list(bounds.deciding)]
        has_passed = bounds.is_closed and bool(np.all(is_held))
        self._passed = self._passed + 1 if has_passed else 0
        self._inflations += [
            Inflation(place=np.array(point), ratio=np.minimum(ratio, _MOST_INFLATION))
            for point, ratio in zip(self.ask(), errors / allowed, strict=True)
            if np.any(ratio > 1.0)
        ]

    def _choose(self, watched: Mapping[int, Watched] | None) -> list[Point]:
        """Next cases; none at the end of the search."""
        values, doubts = np.concatenate(self.values), np.concatenate(self.doubts)
        is_solved = _find_solved(values)
        places, values = np.array(self.points)[is_solved], values[is_solved]
        if not is_solved.any() or not supports_model(places):
            return []
        if watched is None:
            watched = dict.fromkeys(range(values.shape[1]), Watched())
        self._model, self._bounds = self._bound(
            places, values, doubts[is_solved], watched
        )
        return [] if self._is_tested else self._list_questions(self._bounds)

    def _bound(
        self,
        places: Floats,
        values: Floats,
        doubts: Floats,
        watched: Mapping[int, Watched],
    ) -> tuple[Surrogate, Bounds]:
        """Model of the cases solved so far, and what it allows."""
        tolerance = _set_tolerance(values, self.settings.gap, watched)
        deciding = [q for q, bound in watched.items() if bound.is_deciding]
        if self._axis_weights is None and places.shape[1] > DENSE_DIMENSIONS:
            self._axis_weights = weigh_axes(
                places, values[:, deciding], tolerance[deciding]
            )
        model = fit_surrogate(
            *(places, values, NOISE * tolerance, doubts), self._axis_weights
        )
        return model, bound_quantities(
            model,
            values,
            best=_find_best(values, watched),
            tolerance=tolerance,
            watched=list(watched),
            deciding=deciding,
            lattice=self._lattice,
            inflations=self._inflations,
        )

    def _list_questions(self, bounds: Bounds) -> list[Point]:
        room = max(0, self.settings.max_cases - len(self.points))
        return choose_questions(bounds, self.points, _BATCH, room)

    @property
    def _is_tested(self) -> bool:
        """The bounds are close enough, and have held for all tests in turn."""
        is_closed = self._bounds is not None and self._bounds.is_closed
        return is_closed and self._passed >= _TESTS

    @property
    def _is_closed(self) -> bool:
        """The maxima count as bounded, at the end of the search.

        They do so too where no case is left that could test them, unless cases ran out.
        """
        if not self._lattice.places.shape[1]:  # nothing hides beside a single case
            return True
        is_closed = self._bounds is not None and self._bounds.is_closed
        has_room = len(self.points) < self.settings.max_cases
        return is_closed and (self._is_tested or has_room)

    def _finish(self) -> Maxima:
        values = np.concatenate(self.values)
        governing = _find_governing(self.points, values)
        maximum = tuple(float(values[k, q]) for q, k in enumerate(governing))
        bounds = self._bounds
        return Maxima(
            points=self.points,
            values=values,
            doubts=np.concatenate(self.doubts),
            maximum=maximum,
            upper_bound=maximum if bounds is None else tuple(bounds.upper.tolist()),
            governing=governing,
            is_closed=self._is_closed,
            surrogate=self._model,
        )


def _find_solved(values: Floats) -> Mask:
    """Cases with a number for every quantity, shape (cases,)."""
    is_solved: Mask = np.isfinite(values).all(axis=1) & (values.shape[1] > 0)
    return is_solved


def _measure_errors(values: Floats, mean: Floats, watched: Sequence[int]) -> Floats:
    """Errors of predictions, shape (batch, quantities).

    A failed case has none, and neither has a quantity that is not watched.
    """
    errors = np.where(_find_solved(values)[:, None], np.abs(values - mean), 0.0)
    errors[:, [q for q in range(mean.shape[1]) if q not in watched]] = 0.0
    return errors


def _find_best(values: Floats, watched: Mapping[int, Watched]) -> Floats:
    """Least value by which a quantity matters; a negative force is none."""
    floors = [watched.get(q, Watched()).floor for q in range(values.shape[1])]
    return np.asarray(np.maximum(values.max(axis=0), np.maximum(floors, 0.0)))


def _set_tolerance(
    values: Floats, gap: float, watched: Mapping[int, Watched]
) -> Floats:
    """Gap that each quantity may keep, in its unit: search/THEORY.md, eq. (M8)."""
    best = _find_best(values, watched)
    scale = np.maximum(best, _SMALL_SHARE * best.max())
    closest = [watched.get(q, Watched()).resolution for q in range(values.shape[1])]
    tolerance = np.maximum(gap * scale, closest)
    return np.asarray(np.maximum(tolerance, np.finfo(float).tiny))


def _find_governing(points: Sequence[Point], values: Floats) -> tuple[int, ...]:
    """Place of each quantity's largest value; of equals the least point."""
    solved = np.flatnonzero(_find_solved(values)).tolist()
    columns = values.T.tolist() if solved else []
    return tuple(min(solved, key=lambda k: (-own[k], points[k])) for own in columns)
