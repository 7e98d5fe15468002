"""Limits of each single quantity of a row, beyond which a check turns.

A quantity that ranges is in the envelope; one that is a single value is not certain
either. Each is moved alone, to both sides, within what is plausible: first to the ends
of its search, in cases that carry about the members' largest forces; where a check
turns on the way, by interpolation, until a rounded value on the passing side is
confirmed in the case that governs and in its nearest rival. Between solved values a
force is taken to be monotone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from netdesign.envelope.parameters import ONE_QUANTITY, PARAMETERS
from netdesign.envelope.ranges import Case, Ranges
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow
from netdesign.snow.ground import LARGEST_GLIDE_FACTOR
from netdesign.study.probe import Probe
from netdesign.study.records import HoldRecord
from netdesign.study.rivals import differ_in_friction_alone
from netdesign.study.target import SERVES, TRIED_DENSITIES, Move, Target, list_near
from netdesign.words.message import Message, say

# Ends of a search; half and twice the given value where nothing else is said.
_FACTOR = 2.0
_MORE_SLACK = 0.1
_ANGLE = math.radians(15.0)
_LEAST_GLIDE, _LEAST_LENGTH = 1.01, 0.3  # [-]; length over the snow thickness

# Logarithm by which another case may carry more at an end than the serving one tells:
# for any way, for each of the force's growth, and at most. Of 2,946 followed in the
# governing case and one of other friction two lay above, by 0.03; assumed.
_DOUBT, _DOUBT_OF_GROWTH, _MOST_DOUBT = 0.03, 0.3, 0.2
_AIM, _CLOSE = 0.975, 0.92  # utilisation aimed at, and near enough below 1
_AIM_SHARE, _CLOSE_SHARE = 0.25, 0.6  # or these shares of what a check has left
_LEAST_USED = 1e-3  # of a member that is slack at one end
_MOST_STEPS = 4
_NEAREST = 2  # cases in which a limit is confirmed: the governing one and its rival
_BACK = 0.75
_DIGITS = 3  # of a limit that is told
_FINEST = 1e-3  # of the search's length: no limit is told finer than its decade
_DECIMALS = 9  # of the ends of a search


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """Single value of a quantity and the ends of its search, SI."""

    name: str
    now: float
    low: float
    high: float


def find_holds(
    checks: Mapping[str, Target],
    probe: Probe,
    told: Mapping[str, Mapping[str, float]] | None = None,
) -> dict[str, list[HoldRecord]]:
    """Limits of every single quantity for every check of one row, by the check's id.

    Parameters
    ----------
    checks : mapping of str to Target
        Checks of one row that have a force and a resistance.
    probe : Probe
        Solves what is asked for, each once.
    told : mapping of str to mapping of str to float, optional
        Largest values at which a check passes, by its id and the quantity's name, that
        were found and confirmed before [SI]; they are not looked for again.

    Verified by
    -----------
    tests/study/test_holds.py
    """
    targets = list(checks.values())
    serving = solve_ends(targets, probe)
    return {
        name: _find_limits(check, case, probe, (told or {}).get(name, {}))
        for (name, check), case in zip(checks.items(), serving, strict=True)
    }


def solve_ends(checks: Sequence[Target], probe: Probe) -> list[CaseResult]:
    """Case in which each check of a row is followed to the ends of every search.

    These ends are solved together.
    """
    serving = _choose_cases(checks)
    shared = dict.fromkeys(result.case for result in serving)
    for one in checks[:1]:
        wanted = [
            (case, span.name, value)
            for span in list_spans(one.row, one.ranges)
            for case in shared
            for value in (span.low, span.high)
            if value != span.now
        ]
        probe.solve_moved(one.row, wanted)
    return serving


def _find_limits(
    check: Target, serving: CaseResult, probe: Probe, told: Mapping[str, float]
) -> list[HoldRecord]:
    near = _list_confirming(check)
    return [
        _Line(check, near, span, serving, probe).record(told.get(span.name))
        for span in list_spans(check.row, check.ranges)
    ]


def _list_confirming(check: Target) -> list[Case]:
    """The governing case and its nearest rival, which limits are confirmed in.

    A rival that differs in more than friction, if there is one: others grow alike.
    """
    first, *others = list_near(check)
    unlike = [case for case in others if not differ_in_friction_alone(case, first)]
    return [first, *(unlike or others)[: _NEAREST - 1]]


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


def _choose_cases(checks: Sequence[Target]) -> list[CaseResult]:
    """For each check a case in which its member carries about its largest force.

    As few as do: first the case that serves most checks, of several that one in which
    they carry most.
    """
    results = checks[0].results if checks else ()
    shares = [[check.share(one) for one in results] for check in checks]
    least = [min(SERVES, max(of_check)) for of_check in shares]
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


class _Line:
    """One check along one quantity."""

    def __init__(
        self,
        target: Target,
        near: Sequence[Case],
        span: Span,
        serving: CaseResult,
        probe: Probe,
    ) -> None:
        self._target, self._near = target, near
        self._span, self._probe = span, probe
        self._parameter = PARAMETERS[span.name]
        self._serving = serving.case
        # what the serving case lacks of the largest force
        self._lack = 1.0 / (target.share(serving) or 1.0)
        coupled = target.use(target.largest)
        self._used = max(coupled, self._target.use_least())
        self._passes = self._used <= 1.0
        self._note: Message | None = None

    def record(self, told: float | None = None) -> HoldRecord:
        """Limits to both sides, and how far they were searched.

        ``told`` is the largest value at which the check passes, where that is known.
        """
        span, before, show = self._span, self._probe.count, self._parameter.show
        least, low = self._search(span.low, told)
        most, high = self._search(span.high, told)
        if not self._passes:  # it turns beyond a limit, not before it
            least, most = most, least
        return HoldRecord(
            quantity=self._parameter.key,
            now=show(span.now),
            least=least,
            most=most,
            low=round(show(low), _DECIMALS),
            high=round(show(high), _DECIMALS),
            solves=self._probe.count - before,
            note=self._note,
        )

    def _search(self, end: float, told: float | None) -> tuple[float | None, float]:
        """Limit towards an end, in the unit of its key, and how far was looked."""
        now = self._span.now
        if end == now:
            return None, now
        if told is not None and self._is_between(told, end):
            return self._parameter.show(told), end
        used = self._follow(end)
        if used is None:
            return None, now
        if (used <= 1.0) is self._passes:
            return None, end
        if self._passes:
            return self._refine((now, self._used), (end, used)), end
        return self._refine_back((end, used))

    def _follow(self, end: float) -> float | None:
        """Utilisation at an end, as exactly as needed; None without a result.

        By the case that serves; where that leaves the answer open, by the governing
        one, and by its rival where that one does, too.
        """
        used = self._utilise([self._serving], end, self._lack)
        for count in range(1, _NEAREST + 1):
            if used is None or not self._is_open(used) or used > max(1.0, self._lack):
                return used
            if used <= 1.0 and not self._passes:
                return used  # a limit is looked for, and confirmed
            used = self._utilise(self._near[:count], end)
        return used

    def _is_open(self, used: float) -> bool:
        """In other cases the check may end on the other side of 1."""
        growth = math.log(max(used, _LEAST_USED) / max(self._used, _LEAST_USED))
        doubt = min(_MOST_DOUBT, _DOUBT + _DOUBT_OF_GROWTH * abs(growth))
        return abs(math.log(max(used, _LEAST_USED))) <= doubt

    def _refine_back(self, passing: tuple[float, float]) -> tuple[float | None, float]:
        """Limit on the way back from an end where the check seems to pass."""
        end, now = passing[0], self._span.now
        found = self._refine(passing, (now, self._used))
        if found != self._parameter.show(end):
            return found, end
        used = self._utilise(self._near, end)
        if used is None:
            return None, now
        return (found if used <= 1.0 else None), end

    def _is_between(self, value: float, end: float) -> bool:
        """Value on the way to an end, which itself is no limit."""
        now = self._span.now
        return min(now, end) < value < max(now, end) and (value > now) is self._passes

    def _utilise(
        self, cases: Sequence[Case], value: float, lack: float = 1.0
    ) -> float | None:
        """Largest utilisation in some cases with a value; None without a result.

        Once it exceeds 1 it is that of the cases so far.
        """
        move = Move(name=self._span.name, value=value)
        used = 0.0
        for case in cases:
            (result,) = self._target.solve(self._probe, [case], move)
            found = self._target.utilisation(result, move)
            if found is None:
                self._note = say("hold.no_result", value=self._parameter.show(value))
                return None
            used = max(used, lack * found)
            if used > 1.0:
                break
        return self._target.use_more(used, move)

    def _refine(
        self, passing: tuple[float, float], failing: tuple[float, float]
    ) -> float:
        """Rounded value near the limit, on the passing side and confirmed.

        The passing one that was given where none is found.
        """
        left = 1.0 - passing[1]  # may be little: then less of it is given away
        goal = max(_AIM, 1.0 - _AIM_SHARE * left)
        close = max(_CLOSE, 1.0 - _CLOSE_SHARE * left)
        back = 1.0  # shortens the way after every value that fails
        for _ in range(_MOST_STEPS):
            aim = self._aim(passing, failing, back, goal)
            used = None if aim is None else self._utilise(self._near, aim)
            if aim is None or used is None:
                break
            if used > 1.0:
                failing, back = (aim, used), _BACK * back
                continue
            passing = (aim, used)
            if used >= close:
                break
        return self._parameter.show(passing[0])

    def _aim(
        self,
        passing: tuple[float, float],
        failing: tuple[float, float],
        back: float,
        goal: float,
    ) -> float | None:
        """Rounded value of about a goal of utilisation; None if there is none.

        The utilisation is taken as a power of the value; where that may be zero, as an
        exponential of its root: the sag of a net goes like the root of its slack.
        """
        (good, low), (bad, high) = passing, failing
        low = max(low, _LEAST_USED)
        share = back * math.log(goal / low) / math.log(high / low)
        if min(good, bad) > 0.0:
            value = good * (bad / good) ** share
        else:
            value = (math.sqrt(good) * (1.0 - share) + math.sqrt(bad) * share) ** 2
        shown = self._parameter.show(value)
        rounding = math.ceil if good > bad else math.floor
        step = self._find_step(shown)
        told = self._parameter.read(round(rounding(shown / step) * step, 12))
        return told if min(good, bad) < told < max(good, bad) else None

    def _find_step(self, shown: float) -> float:
        """Power of ten to whose multiples a limit is rounded."""
        show = self._parameter.show
        finest = _FINEST * abs(show(self._span.high) - show(self._span.low))
        of_digits = math.floor(math.log10(abs(shown))) - _DIGITS + 1
        return 10.0 ** max(of_digits, math.floor(math.log10(finest)))
