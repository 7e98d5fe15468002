"""A finished search, kept beside its cases: a later run need not search again.

It asks for the same cases in the same rounds. Only where every one of them answers as
it did, to the last bit, and as much is asked of the bounds, do the bounds found then
hold; anything else is searched anew.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from typing import Any

import numpy as np

from netdesign.envelope.adaptive import Addition, Maxima, Point, Values, Watched
from netdesign.envelope.surrogate import fit_surrogate

Repetition = Generator[tuple[Point, ...], Sequence[Values | None], Maxima | None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KnownSearch:
    """What a search came to, and what led it there.

    Attributes
    ----------
    maxima : Maxima
        Its end; the cases and their answers are part of it.
    watched : mapping of int to Watched
        What was asked of the bounds at last, by quantity.
    """

    maxima: Maxima
    watched: Mapping[int, Watched]

    def repeat(self, watch: Callable[[], Mapping[int, Watched]]) -> Repetition:
        """Ask for the cases again, as ``search_maxima`` would.

        Returns
        -------
        Maxima or None
            None as soon as an answer, or what is watched at last, is another.

        Verified by
        -----------
        tests/envelope/test_known_search.py
        """
        answers: list[Values | None] = []
        for _, batch in groupby(self.maxima.log, key=lambda one: one.round):
            answers += yield tuple(one.point for one in batch)
            if tuple(answers) != self.maxima.values[: len(answers)]:
                return None
        is_same = len(answers) == len(self.maxima.points) and watch() == self.watched
        return self.maxima if is_same else None


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
        values=tuple(None if one is None else tuple(one) for one in maxima["values"]),
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
        )
        found = replace(found, surrogate=model)
    watched = {int(k): Watched(**one) for k, one in given["watched"].items()}
    return KnownSearch(maxima=found, watched=watched)
