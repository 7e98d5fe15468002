"""Changes that would make a check pass, or fail: solved, never guessed.

Proportions (resistance, post spacing) are exact. Density, snow height and friction
angle are roots of the coupled solve: found for the case that governs, then confirmed
for every case whose force came near to governing, unless cases before it leave no doubt
(`rivals.py`); a case that still fails takes over, and so on. A floor by the guideline's
load knows neither density nor friction of the ranges; it limits the snow height by its
closed form.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import count, product

from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.snow.snowpack import compute_thickness
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.probe import Probe
from netdesign.study.records import ChangeRecord
from netdesign.study.rivals import bound_rival, put_outer_first
from netdesign.study.root import LEAST_POWER, Root, refuse, round_down
from netdesign.study.target import TRIED_DENSITIES, Move, Target, list_near
from netdesign.units import degree_from_radian, radian_from_degree
from netdesign.words.message import Message, say

CLOSE = 0.9  # utilisation from which a passing check is told where it flips
_LEAST_SHARE = 0.5  # of the snow height, down to which a search goes
_STEPS = {"density": 1.0, "thickness": 0.01, "friction": 0.1}  # told to this
_LEAST_FLOOR = 1e-3  # utilisation by a floor, that a secant is taken with
_MOST_ROUNDS = 4


def find_spacing_change(
    post_spacing: float, width: LoadedWidth, utilisation: float
) -> ChangeRecord:
    """Largest post spacing at which a check passes: every force is in proportion."""
    allowed = width.width / utilisation
    ends = width.end_factor * width.end_length
    widest = 2.0 * (allowed - ends) if width.position == "edge" else allowed
    bound = math.floor(100.0 * widest + 1e-9) / 100.0
    return ChangeRecord(
        quantity=say("change.post_spacing"),
        unit="m",
        now=post_spacing,
        bound=bound if bound > 0.0 else None,
        sense="at most",
        solves=0,
        note=None if bound > 0.0 else say("change.end_effect_too_much"),
    )


def _refuse_by_floor(quantity: str, unit: str, now: float) -> ChangeRecord:
    """No value of a quantity that the guideline's load does not know mends a check."""
    return ChangeRecord(
        quantity=say(f"change.{quantity}"),
        unit=unit,
        now=now,
        bound=None,
        sense="at most",
        solves=0,
        note=say("change.floor_stays"),
    )


def find_density_change(target: Target, probe: Probe) -> ChangeRecord:
    """Largest snow density at which a check passes.

    The guideline's load has densities of its own and stays.
    """
    if target.use_least() > 1.0:
        return _refuse_by_floor("snow_density", "kg/m3", target.ranges["density"].high)
    bound, solves, note = _search(
        target,
        probe,
        "density",
        start=target.ranges["density"].high,
        limits=TRIED_DENSITIES,
        step=_STEPS["density"],
        power=1.5,
    )
    if bound is not None and not _less_passes(target, "density", bound):
        bound, note = None, say("change.lighter_snow_fails")
    if bound is not None and bound < target.ranges["density"].low:
        note = say("change.below_range")
    return ChangeRecord(
        quantity=say("change.snow_density"),
        unit="kg/m3",
        now=target.ranges["density"].high,
        bound=bound,
        sense="at most",
        solves=solves,
        note=note,
    )


def find_height_change(target: Target, probe: Probe) -> ChangeRecord:
    """Largest snow thickness, normal to the slope, at which a check passes.

    Where the thickness ranges, all of it has to stay below, and thinner snow that was
    solved has to pass: the force of a guy may fall while the snow grows. The floor
    rises with it; the lower of the two limits counts.
    """
    thickness = target.row.snow_thickness
    least, most = _LEAST_SHARE * thickness, target.row.net_height
    highest = _find_floor_height(target, least, most)
    if highest is None:
        bound, solves, note = None, 0, refuse("change.not_even", "thickness", least)
    elif target.is_slack:  # the floor alone decides
        bound, solves, note = round_down(highest, _STEPS["thickness"]), 0, None
    else:
        bound, solves, note = _search(
            target,
            probe,
            "thickness",
            start=min(thickness, highest),
            limits=(least, highest),
            step=_STEPS["thickness"],
            power=2.0,
        )
    limit = most if highest is None else highest
    if bound is not None and limit < most and bound > limit - _STEPS["thickness"]:
        note = say("change.floor_limits")
    if bound is not None and not _less_passes(target, "thickness", bound):
        bound, note = None, say("change.thinner_snow_fails")
    if bound is not None and bound < _find_thinnest(target):
        note = say("change.below_range")
    return ChangeRecord(
        quantity=say("change.snow_thickness"),
        unit="m",
        now=thickness,
        bound=bound,
        sense="at most",
        solves=solves,
        note=note,
    )


def _find_thinnest(target: Target) -> float:
    """Least thickness that the ranges have; 0 where it does not range [m]."""
    ranges = target.ranges
    if "thickness" in ranges.further:
        return ranges["thickness"].low
    if "snow_height" in ranges.further:
        return compute_thickness(ranges["snow_height"].low, target.row.slope_angle)
    return 0.0


def _find_floor_height(target: Target, least: float, most: float) -> float | None:
    """Largest snow thickness at which the floor is met [m]; None if not at the least.

    The floor rises with the height.
    """

    def use(thickness: float) -> float:
        return target.use_about(Move(name="thickness", value=thickness))

    if (fails := use(most)) <= 1.0:
        return most
    if (passes := use(least)) > 1.0:
        return None
    step = 0.1 * _STEPS["thickness"]
    for number in count():
        if most - least <= step:
            break
        low, high = max(passes, _LEAST_FLOOR), min(fails, 1.0 / _LEAST_FLOOR)
        share = math.log(low) / math.log(low / high)
        share = 0.5 if number % 3 == 2 else share  # a kink misleads a secant
        value = least * (most / least) ** share
        value = min(max(value, least + 0.45 * step), most - 0.45 * step)
        if (found := use(value)) <= 1.0:
            least, passes = value, found
        else:
            most, fails = value, found
    return least


def find_friction_change(target: Target, probe: Probe) -> ChangeRecord | None:
    """Friction angle from or up to which a failing check passes.

    Within the range that was given; None where the check passes all over it. The
    force is not monotonic in the friction angle: the end of the range beside the
    governing case is told on which every sample passes, from the nearest of them.
    """
    now = degree_from_radian(target.governing.friction_angle)
    if target.use_least() > 1.0:
        return _refuse_by_floor("friction_angle", "deg", now)
    samples = _list_friction_angles(target)
    worst = [_worst_at(target, angle) for angle in samples]
    if all(one is not None and one <= 1.0 for one in worst):
        return None
    place = samples.index(target.governing.friction_angle)
    passes = [one is not None and one <= 1.0 for one in worst]
    passing = _list_passing_ends(passes, place)
    if not passing or passes[place]:
        note = say("change.no_friction_angle")
        if any(passes) and not passes[place]:
            note = say("change.friction_between")
        return ChangeRecord(
            quantity=say("change.friction_angle"),
            unit="deg",
            now=now,
            bound=None,
            sense="at most",
            solves=0,
            note=note,
        )
    nearest = min(passing, key=lambda k: abs(k - place))
    beside = nearest + (1 if place > nearest else -1)
    before = probe.count
    bound = _bisect_friction(target, probe, samples[nearest], samples[beside])
    degrees = degree_from_radian(bound)
    step = _STEPS["friction"]
    is_upper = place > nearest
    rounding = math.floor if is_upper else math.ceil
    return ChangeRecord(
        quantity=say("change.friction_angle"),
        unit="deg",
        now=now,
        bound=round(rounding(degrees / step) * step, 6),
        sense="at most" if is_upper else "at least",
        solves=probe.count - before,
    )


def _list_passing_ends(passes: Sequence[bool], place: int) -> list[int]:
    """Places from which on all pass, away from that of the governing case."""
    ends = range(len(passes))
    return [k for k in ends if all(passes[k:] if k > place else passes[: k + 1])]


def _list_friction_angles(target: Target) -> list[float]:
    """Angles that stand for the whole of the other ranges, and the governing one.

    A search solves some angles at a few cases only; an angle counts where the corners
    of the other ranges were solved.
    """
    others = [one for one in target.ranges.intervals if one[0] != "friction_angle"]
    corners = set(product(*((span.low, span.high) for _, span in others)))
    solved: dict[float, set[tuple[float, ...]]] = {}
    for result in target.results:
        values = result.case.values
        at = solved.setdefault(values["friction_angle"], set())
        at.add(tuple(values[name] for name, _ in others))
    whole = {angle for angle, cases in solved.items() if cases >= corners}
    return sorted(whole | {target.governing.friction_angle})


def _bisect_friction(
    target: Target, probe: Probe, passes: float, fails: float
) -> float:
    """Friction angle up to which every case passes, between two samples [rad]."""
    now = target.governing.friction_angle
    cases = _list_rivals(target, Move(name="friction_angle", value=now))
    tolerance = radian_from_degree(_STEPS["friction"])
    while abs(fails - passes) > tolerance:
        middle = 0.5 * (passes + fails)
        move = Move(name="friction_angle", value=middle)
        is_met = all(
            _is_met(target, *target.solve(probe, [case], move)) for case in cases
        )
        passes, fails = (middle, fails) if is_met else (passes, middle)
    return passes


def _is_met(target: Target, result: CaseResult) -> bool:
    utilisation = target.utilisation(result)
    return utilisation is not None and utilisation <= 1.0


def _worst_at(target: Target, angle: float) -> float | None:
    """Largest utilisation at a friction angle; None if a case there failed."""
    known = [
        target.utilisation(result)
        for result in target.results
        if result.case.friction_angle == angle
    ]
    numbers = [one for one in known if one is not None]
    return max(numbers) if len(numbers) == len(known) and numbers else None


def _less_passes(target: Target, name: str, bound: float) -> bool:
    """Every solved case passes that has no more of a quantity than a bound."""
    return all(
        _is_met(target, result)
        for result in target.results
        if (target.find_value(result.case, name) or 0.0) <= bound
    )


def _search(
    target: Target,
    probe: Probe,
    quantity: str,
    *,
    start: float,
    limits: tuple[float, float],
    step: float,
    power: float,
) -> tuple[float | None, int, Message | None]:
    """Largest value at which every case passes, solves, and a remark."""
    before = probe.count
    active = target.governing
    value, power = start, _find_power(target, quantity, power)
    for _ in range(_MOST_ROUNDS):
        root = Root(target, probe, quantity, active, limits, power, step)
        found = root.find(value)
        if isinstance(found, Message):
            return None, probe.count - before, found
        value = round_down(found, step)
        worst = _find_violator(target, probe, Move(name=quantity, value=value))
        if worst is None:
            at_end = found == limits[1]
            note = say("change.passes_to_end") if at_end else None
            return value, probe.count - before, note
        if isinstance(worst, Message):
            return None, probe.count - before, worst
        active = worst
    return None, probe.count - before, say("change.not_settled")


def _find_power(target: Target, quantity: str, usual: float) -> float:
    """Power by which the governing force grows, from a solved case beside it.

    One that differs in the quantity alone, the nearest; without one the usual power.
    """
    at = target.governing.values
    if quantity not in at:
        return usual
    beside = {
        one.case.values[quantity]: target.utilisation(one) or 0.0
        for one in target.results
        if {**one.case.values, quantity: at[quantity]} == at
    }
    used = beside.pop(at[quantity], 0.0)
    for value in sorted(beside, key=lambda one: abs(one - at[quantity])):
        if used > 0.0 and beside[value] > 0.0:
            slope = math.log(used / beside[value]) / math.log(at[quantity] / value)
            return slope if slope > LEAST_POWER else usual
    return usual


def _find_violator(target: Target, probe: Probe, move: Move) -> Case | Message | None:
    """Rival case that still fails most at a value; a reason if one is unsolved.

    One after the other, unless those before leave no doubt that it passes.
    """
    used: dict[Case, float] = {}
    for case in put_outer_first(_list_rivals(target, move)):
        if bound_rival(target, case, move, used) < 1.0:
            continue
        (result,) = target.solve(probe, [case], move)
        utilisation = target.utilisation(result, move)
        if utilisation is None:
            reason = result.reason or result.outcome.message
            return refuse(
                "change.rival_without_result", move.name, move.value, reason=reason
            )
        used[case] = utilisation
    worst = max(used, key=lambda one: used[one])
    return worst if used[worst] > 1.0 else None


def _list_rivals(target: Target, move: Move) -> list[Case]:
    """Cases near to governing, those that the move makes equal only once."""
    near = list_near(target)
    moved = {case.with_value(move.name, move.value): case for case in reversed(near)}
    return list(reversed(moved.values()))
