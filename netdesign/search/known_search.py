"""A finished search, kept beside its cases: a later run need not search again.

The later run asks for the same cases in the same rounds. The old bounds hold only if
every case gives the same values, to the last bit, and the same is asked of the bounds.
Anything else is searched anew.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from netdesign.search.maxima import Addition, Maxima, Values, Watched, fill_doubts
from netdesign.search.surrogate import Point, fit_surrogate


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KnownSearch:
    """Result of a search, and the demands that led to it.

    Attributes
    ----------
    maxima : Maxima
        Its end; the cases and their answers are part of it.
    watched : mapping of int to Watched
        Last demands on the bounds, by quantity.
    """

    maxima: Maxima
    watched: Mapping[int, Watched]


class Repetition:
    """A known search, asked for again as ``MaximaSearch`` would ask.

    Attributes
    ----------
    known : KnownSearch
        The search that is repeated.
    gap : float
        Infinite: no bound stands before the last value has turned out the same.
    result : Maxima or None
        The old one, once everything has turned out the same; None before, and if a
        value or the last demands differ.

    Verified by
    -----------
    tests/search/test_known_search.py
    """

    gap = math.inf

    def __init__(self, known: KnownSearch) -> None:
        """Begin with the first round."""
        self.known = known
        self.result: Maxima | None = None
        self._values: tuple[Values | None, ...] = ()
        self._doubts: tuple[Values | None, ...] = ()
        self._rounds = [
            tuple(one.point for one in batch)
            for _, batch in groupby(known.maxima.log, key=lambda one: one.round)
        ]

    def ask(self) -> tuple[Point, ...]:
        """Points whose values are wanted next; () at the end."""
        return self._rounds[0] if self._rounds else ()

    def tell(
        self,
        values: Sequence[Values | None],
        watched: Mapping[int, Watched],
        doubts: Sequence[Values | None] | None = None,
    ) -> None:
        """Compare the values at the points asked for; one that differs ends it."""
        maxima = self.known.maxima
        self._values += tuple(values)
        self._doubts += tuple(doubts or (None,) * len(values))
        is_same = (
            self._values == maxima.values[: len(self._values)]
            and self._doubts == maxima.doubts[: len(self._doubts)]
        )
        self._rounds = self._rounds[1:] if is_same else []
        is_whole = is_same and len(self._values) == len(maxima.points)
        if is_whole and watched == self.known.watched:
            self.result = maxima


def encode_search(known: KnownSearch) -> str:
    """Text from which ``decode_search`` makes the very same value.

    The model is not written: it follows from the cases and the noise allowed for.
    """
    model = known.maxima.surrogate
    return json.dumps(
        {
            "maxima": asdict(replace(known.maxima, surrogate=None)),
            "noise": None if model is None else model.noise.tolist(),
            "watched": {place: asdict(one) for place, one in known.watched.items()},
        }
    )


def decode_search(text: str) -> KnownSearch:
    """The value that was encoded.

    Raises
    ------
    ValueError, KeyError, TypeError
        If the text is not what ``encode_search`` wrote.
    """
    given: dict[str, Any] = json.loads(text)
    maxima = given["maxima"]
    found = Maxima(
        points=tuple(map(tuple, maxima["points"])),
        values=_read_values(maxima["values"]),
        doubts=_read_values(maxima["doubts"]),
        maximum=tuple(maxima["maximum"]),
        upper_bound=tuple(maxima["upper_bound"]),
        governing=tuple(maxima["governing"]),
        is_closed=maxima["is_closed"],
        log=tuple(
            Addition(**{**one, "point": tuple(one["point"])}) for one in maxima["log"]
        ),
        surrogate=None,
    )
    if given["noise"] is not None:
        solved = [k for k, value in enumerate(found.values) if value is not None]
        model = fit_surrogate(
            np.array([found.points[k] for k in solved]),
            np.array([found.values[k] for k in solved]),
            np.array(given["noise"]),
            fill_doubts([found.doubts[k] for k in solved], len(found.maximum)),
        )
        found = replace(found, surrogate=model)
    watched = {int(k): Watched(**one) for k, one in given["watched"].items()}
    return KnownSearch(maxima=found, watched=watched)


def _read_values(given: Sequence[Sequence[float] | None]) -> tuple[Values | None, ...]:
    return tuple(None if one is None else tuple(one) for one in given)
