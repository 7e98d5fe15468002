"""Margins: limits of each single quantity of a row, beyond which a check turns.

A quantity that ranges is in the envelope; one that is a single value is not certain
either. Each is moved alone, to both sides, within what is plausible: first to the ends
of its search, in a case that carries about the members' largest forces; where a check
turns on the way, the value is found in the governing case and its nearest neighbour
(`check_by_case.py`). Between solved values a force is taken to be monotone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.envelope.parameters import ONE_QUANTITY
from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
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

_SERVES = 0.85  # share of its largest force that a member carries in a case it shares
# Utilisation, in logarithms, within which the case that serves leaves an end open;
# assumed, after 2,946 ends that were followed in other cases, too.
_DOUBT = 0.2
_CONFIRMING = 2  # cases in which a margin is confirmed
_LEAST_USED = 1e-3  # of a member that is slack at an end
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
    checks: Mapping[str, CheckByCase],
    solver: CaseSolver,
    known: Mapping[str, Mapping[str, float]] | None = None,
) -> dict[str, list[HoldRecord]]:
    """Margins of every single quantity for every check of one row, by the check's id.

    Parameters
    ----------
    checks : mapping of str to CheckByCase
        Checks of one row that have a force and a resistance.
    solver : CaseSolver
        Solves what is asked for, each once.
    known : mapping of str to mapping of str to float, optional
        Largest values at which a check passes, by its id and the quantity's name, that
        were found and confirmed before [SI]; they are not looked for again.

    Verified by
    -----------
    tests/study/test_margins.py
    """
    serving = solve_ends(list(checks.values()), solver)
    return {
        name: _list_margins(check, case, solver, (known or {}).get(name, {}))
        for (name, check), case in zip(checks.items(), serving, strict=True)
    }


def solve_ends(checks: Sequence[CheckByCase], solver: CaseSolver) -> list[CaseResult]:
    """Case in which each check of a row is followed to the ends of every search.

    These ends are solved together.
    """
    serving = _choose_cases(checks)
    shared = dict.fromkeys(result.case for result in serving)
    for one in checks[:1]:
        wanted = [
            (one.row, case.with_value(span.name, value), solver.law)
            for span in list_spans(one.row, one.ranges)
            for case in shared
            for value in (span.low, span.high)
            if value != span.now
        ]
        solver.solve_all(wanted)
    return serving


def _list_margins(
    check: CheckByCase,
    serving: CaseResult,
    solver: CaseSolver,
    known: Mapping[str, float],
) -> list[HoldRecord]:
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
        margins.append(_find_margin(line, now, serving, known.get(span.name)))
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


def _choose_cases(checks: Sequence[CheckByCase]) -> list[CaseResult]:
    """For each check a case in which its member carries about its largest force.

    As few as do: first the case that serves most checks, of several that one in which
    they carry most.
    """
    results = checks[0].results if checks else ()
    shares = [[check.share(one) for one in results] for check in checks]
    least = [min(_SERVES, max(of_check)) for of_check in shares]
    open_, chosen = set(range(len(checks))), [0] * len(checks)
    while open_:
        served = [
            [number for number in open_ if shares[number][place] >= least[number]]
            for place in range(len(results))
        ]
        weights = [
            (len(some), sum(shares[number][place] for number in some))
            for place, some in enumerate(served)
        ]
        best = weights.index(max(weights))
        for number in served[best]:
            chosen[number] = best
        open_ -= set(served[best])
    return [results[place] for place in chosen]


def _find_margin(
    line: CheckLine, now: Point, serving: CaseResult, known: float | None
) -> HoldRecord:
    """Limits of a quantity to both sides, and how far they were searched."""
    before, show = line.solver.count, line.parameter.show
    limits: list[float | None] = []
    reached, note = [], None
    for end in line.ends:
        limit = None
        try:
            if end != now.value:
                limit = _find_limit(line, now, end, serving, known)
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
    line: CheckLine, now: Point, end: float, serving: CaseResult, known: float | None
) -> float | None:
    """Value between now and an end at which the check turns [SI]; None if it does not.

    ``known`` is the largest value at which the check passes, where that was found.
    """
    if known is not None and (known > now.value) is now.passes:
        least, most = sorted((now.value, end))
        if least < known < most:
            return known
    at_end = _find_end_use(line, end, serving)
    if at_end.passes is now.passes:
        return None
    passing, failing = (now, at_end) if now.passes else (at_end, now)
    return line.find_turn(passing, failing)


def _find_end_use(line: CheckLine, end: float, serving: CaseResult) -> Point:
    """Utilisation at an end of a search, as exactly as needed.

    By the case that serves all members, in the proportion of their largest forces;
    where that leaves the answer open, by the cases near to governing.
    """
    lack = 1.0 / (line.check.share(serving) or 1.0)
    used = lack * line.find_case_use(end, serving.case)
    if abs(math.log(max(used, _LEAST_USED))) <= _DOUBT:
        return line.find_use(end)
    return Point(value=end, used=used)
