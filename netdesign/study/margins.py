"""Margins: limits of each single quantity, beyond which the check that is shown turns.

A quantity that ranges is in the envelope; one that is a single value is not certain
either. Each is moved alone, to both sides, within what is plausible: first to the ends
of its search; where the check turns on the way, the value is found, both in the
governing case and its nearest neighbour (`check_by_case.py`). Between solved values a
force is taken to be monotone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from netdesign.envelope.parameters import ONE_QUANTITY
from netdesign.envelope.ranges import Case, Ranges
from netdesign.site.model import NetRow
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.study.check_by_case import (
    TRIED_DENSITIES,
    CheckByCase,
    CheckLine,
    NoResultError,
    Point,
    list_near,
)
from netdesign.study.records import HoldRecord
from netdesign.study.row_to_check import CaseSolver
from netdesign.words.message import say

# Ends of a search; half and twice the given value where nothing else is said.
_FACTOR = 2.0
_MORE_SLACK = 0.1
_ANGLE = math.radians(15.0)
_LEAST_GLIDE, _LEAST_LENGTH = 1.01, 0.3  # [-]; length over the snow thickness

_CONFIRMING = 2  # cases in which a margin is confirmed
_CLOSE = 0.08  # a margin leaves so much of the utilisation unused
_DECIMALS = 9  # of the ends of a search


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Single value of a quantity and the ends of its search, SI."""

    name: str
    now: float
    low: float
    high: float


def find_margins(
    check: CheckByCase, solver: CaseSolver, known: Mapping[str, float]
) -> list[HoldRecord]:
    """Margins of a check in every single quantity of its row.

    Parameters
    ----------
    check : CheckByCase
        With a force and a resistance.
    solver : CaseSolver
        Solves what is asked for, each once.
    known : mapping of str to float
        Largest values at which the check passes, by the quantity's name, that were
        found and confirmed before [SI]; they are not looked for again.

    Verified by
    -----------
    tests/study/test_margins.py
    """
    near = _list_confirming(check)
    used = max(check.use(check.largest), check.use_least())
    margins = []
    for span in list_spans(check.row, check.ranges):
        line = CheckLine(
            check=check,
            quantity=span.name,
            cases=near,
            ends=(span.low, span.high),
            solver=solver,
            close=_CLOSE,
        )
        now = Point(value=span.now, used=used)
        margins.append(_find_margin(line, now, known.get(span.name)))
    return margins


def _list_confirming(check: CheckByCase) -> list[Case]:
    """The governing case and its nearest neighbour, which margins are confirmed in.

    One that differs in more than friction, if there is one: others grow alike.
    """
    first, *others = list_near(check)
    unlike = [
        case
        for case in others
        if replace(case, friction_angle=first.friction_angle) != first
    ]
    return [first, *(unlike or others)[: _CONFIRMING - 1]]


def list_spans(row: NetRow, ranges: Ranges) -> list[Span]:
    """Quantities of a row that do not range, with the ends of their search."""
    values = {
        **{name: ranges[name].low for name in ("density", "friction_angle")},
        "inclination": ranges["inclination"].low,
        "thickness": row.snow_thickness,
        "upslope_length": row.upslope_length,
        "slack": row.slack,
        "net_stiffness": row.net_stiffness_per_m,
    }
    if row.glide_factor is not None:
        values["glide_factor"] = row.glide_factor
    elif row.ground.kind == "sliding":
        values["slip_length"] = row.ground.slip_length
    ranged = set(ranges.axes)
    for pair in ONE_QUANTITY:
        if ranged & set(pair):
            ranged |= set(pair)
    spans = []
    for name, now in values.items():
        if name not in ranged:
            low, high = _find_ends(name, now, row)
            spans.append(
                Span(name=name, now=now, low=min(low, now), high=max(high, now))
            )
    return spans


def _find_ends(name: str, now: float, row: NetRow) -> tuple[float, float]:
    """Ends of the search of a quantity, SI."""
    if name == "density":
        return TRIED_DENSITIES
    if name in ("friction_angle", "inclination"):
        return max(0.0, now - _ANGLE), now + _ANGLE
    if name == "slack":
        return 0.0, now + _MORE_SLACK
    if name == "thickness":
        return now / _FACTOR, row.net_height
    if name == "glide_factor":
        return _LEAST_GLIDE, LARGEST_GLIDE_FACTOR
    if name == "upslope_length":
        least = _LEAST_LENGTH * row.snow_thickness
        return max(now / _FACTOR, least), now * _FACTOR
    return now / _FACTOR, now * _FACTOR


def _find_margin(line: CheckLine, now: Point, known: float | None) -> HoldRecord:
    """Limits of a quantity to both sides, and how far they were searched."""
    before, show = line.solver.count, line.parameter.show
    limits: list[float | None] = []
    reached, note = [], None
    for end in line.ends:
        limit = None
        try:
            if end != now.value:
                limit = _find_limit(line, now, end, known)
        except NoResultError as none:
            end, note = now.value, say("hold.no_result", value=show(none.value))
        limits.append(None if limit is None else show(limit))
        reached.append(round(show(end), _DECIMALS))
    least, most = limits if now.passes else reversed(limits)  # see HoldRecord
    return HoldRecord(
        quantity=line.parameter.key,
        now=show(now.value),
        least=least,
        most=most,
        low=reached[0],
        high=reached[1],
        solves=line.solver.count - before,
        note=note,
    )


def _find_limit(
    line: CheckLine, now: Point, end: float, known: float | None
) -> float | None:
    """Value between now and an end at which the check turns [SI]; None if it does not.

    ``known`` is the largest value at which the check passes, where that was found.
    """
    if known is not None and (known > now.value) is now.passes:
        least, most = sorted((now.value, end))
        if least < known < most:
            return known
    at_end = line.find_use(end)
    if at_end.passes is now.passes:
        return None
    passing, failing = (now, at_end) if now.passes else (at_end, now)
    return line.find_turn(passing, failing)
