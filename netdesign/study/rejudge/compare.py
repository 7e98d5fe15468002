"""Comparison of two numbers, or parts of a study, that must be one."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from netdesign.outcome import NetDesignError, Verdict
from netdesign.study.records import Study
from netdesign.study.values import compare_values, show_value
from netdesign.words.message import Message, say

SAME = 1e-9  # relative; stored numbers that follow from each other differ by rounding
_ZERO = 1e-12  # kN; what is left of a sum that must vanish
_STEADY = "steady"
_MOST = 5  # places of one part that are named

Pair = tuple[str, float | None, float | None]


def is_same(one: float | None, other: float | None) -> bool:
    """Both are the same number, or both are missing."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=SAME, abs_tol=_ZERO)


def is_of_steady_states(study: Study) -> bool:
    """No history had a part in its forces."""
    return study.provenance.settings.get("method") == _STEADY


def report_unequal(place: Message, pairs: Iterable[Pair]) -> Iterator[Message]:
    """A sentence for each name whose stored value is not what follows.

    ``pairs`` are the name in the document, stored value, value that follows from
    others.
    """
    for name, stored, expected in pairs:
        if not is_same(stored, expected):
            yield report_value(place, name, stored, expected)


def guard(place: Message, sentences: Iterator[Message]) -> Iterator[Message]:
    """Sentences; where numbers are such as no solve gives, one that says so."""
    try:
        yield from sentences
    except (NetDesignError, LookupError, ValueError, TypeError, ArithmeticError):
        yield say("audit.no_calculation", place=place)


def report_differences(
    key: str, stored: object, again: object, *, is_exact: bool = False, **given: Message
) -> Iterator[Message]:
    """Sentences on the first places at which a stored part is not what follows."""
    for found in compare_values(stored, again, is_exact=is_exact)[:_MOST]:
        yield say(key, **given, value=found.message)


def report_value(place: Message, name: str, stored: object, follows: object) -> Message:
    """A sentence on a value, by its name in the document, that is not what follows."""
    one, other = show_value(stored), show_value(follows)
    return say("audit.unequal", place=place, name=name, stored=one, follows=other)


def report_verdict(place: Message, stored: Verdict, follows: Verdict) -> Message:
    """A sentence on a verdict that is not that of its parts."""
    verdict, merged = say(f"verdict.{stored}"), say(f"verdict.{follows}")
    return say("audit.verdict", place=place, verdict=verdict, merged=merged)
