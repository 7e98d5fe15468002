"""How the audit compares two numbers that must be one."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from netdesign.study.records import Study

SAME = 1e-9  # relative; stored numbers that follow from each other differ by rounding
_ZERO = 1e-12  # kN; what is left of a sum that must vanish
_STEADY = "steady"

Pair = tuple[str, float | None, float | None]


def is_same(one: float | None, other: float | None) -> bool:
    """Whether both are the same number, or both are missing."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=SAME, abs_tol=_ZERO)


def is_of_steady_states(study: Study) -> bool:
    """Whether no history had a part in its forces."""
    return study.provenance.settings.get("method") == _STEADY


def tell_unequal(place: str, pairs: Iterable[Pair]) -> Iterator[str]:
    """A sentence for each name whose stored value is not what follows.

    ``pairs`` are name, stored value, value that follows from others.
    """
    for name, stored, expected in pairs:
        if not is_same(stored, expected):
            yield f"{place}: {name} is {stored!r}, but {expected!r} follows"
