"""Made-up responses with an interior peak: is one ever missed, and how narrow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from statistics import median
from typing import Any

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.search.maxima import Maxima, MaximaSearch, SearchSettings

Response = Callable[[Floats], Floats]

_SAMPLES = 21  # of each axis, for the true maximum
_SIGMA = 2.3548  # widths at half height of a Gaussian bell, in its sigmas
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class PeakEnd:
    """Result of the search of one response.

    ``excess`` is the true maximum over the upper bound, less 1: negative where the
    bound holds.
    """

    excess: float
    cases: int
    is_closed: bool


def build_peak(seed: int, width: float) -> Response:
    """Tilted plane with a peak as high as a tenth of it to itself; three parameters.

    Parameters
    ----------
    seed : int
        Equal seeds give equal responses.
    width : float
        Of the peak at half its height, as a share of a range.

    Returns
    -------
    callable
        Places of shape (n, 3) to values of shape (n,).
    """
    rng = np.random.default_rng(seed)
    top, height = rng.uniform(0.0, 1.0, 3), rng.uniform(1.0, 10.0)
    slope, sigma = 1.5 * rng.normal(size=3), width / _SIGMA

    def respond(at: Floats) -> Floats:
        square = np.sum((at - top) ** 2, axis=1)
        bell: Floats = np.exp(-square / (2.0 * sigma**2))
        return 10.0 + at @ slope + height * bell

    return respond


def search_peak(response: Response) -> PeakEnd:
    """Search one response and compare with its values on a dense grid."""
    found = _drive(response)
    axis = np.linspace(0.0, 1.0, _SAMPLES)
    truth = float(response(np.array(list(product(axis, repeat=3)))).max())
    return PeakEnd(
        excess=truth / found.upper_bound[0] - 1.0,
        cases=len(found.points),
        is_closed=found.is_closed,
    )


def measure_peaks(count: int, widths: tuple[float, ...]) -> list[dict[str, Any]]:
    """Missed peaks by width; a search that did not close states no bound."""
    points = []
    for width in widths:
        ends = [search_peak(build_peak(seed, width)) for seed in range(count)]
        points.append(
            {
                "width": width,
                "searches": count,
                "not_closed": sum(not end.is_closed for end in ends),
                "missed": sum(end.is_closed and end.excess > _ROUNDING for end in ends),
                "median_cases": median(end.cases for end in ends),
            }
        )
    return points


def _drive(response: Response) -> Maxima:
    search = MaximaSearch(3, SearchSettings())
    while points := search.ask():
        values = response(np.array(points)).tolist()
        search.tell([(value,) for value in values])
    if search.result is None:
        raise AssertionError("a search that asks no more has ended")
    return search.result
