"""Remedies: changes that make a check pass, or limits of one that just passes.

Proportions (resistance, post spacing) are exact. Density, snow height and friction
angle are found by solves (`check_by_case.py`), and confirmed in every case whose force
comes near to governing. A floor by the guideline's load knows neither density nor
friction of the ranges; it limits the snow height.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import Literal

from netdesign.outcome import Verdict
from netdesign.snow.snowpack import compute_thickness
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.check_by_case import (
    TRIED_DENSITIES,
    CheckByCase,
    CheckLine,
    NoResultError,
    Point,
    Setting,
    list_near,
)
from netdesign.study.judgement import MemberCheck
from netdesign.study.records import ChangeRecord
from netdesign.study.row_to_check import CaseSolver, RowToCheck, find_doubt
from netdesign.study.stronger_types import find_type_change
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say

CLOSE = 0.9  # utilisation from which a passing check gets its limits
_LEAST_SHARE = 0.5  # of the snow height, down to which a search goes
_KEYS = {  # of a quantity's name in words, and its unit
    "density": ("change.snow_density", "kg/m3"),
    "thickness": ("change.snow_thickness", "m"),
    "friction_angle": ("change.friction_angle", "deg"),
}


def list_remedies(
    task: RowToCheck, one: MemberCheck, check: CheckByCase | None
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check.

    What needs a solve is looked for where there is a ``check``.
    """
    is_of_ground = one.given.mode in ("sliding", "wedge") and one.given.dimensions
    if is_of_ground or not _is_worth_telling(task, one):
        return []  # sliding goes with what presses the base; a ground is as it is
    changes = _list_resistance_remedies(task, one)
    used = one.result.find("μ")
    if used is None or used.high is None:
        return _complete(task, one, changes, None)
    if not task.row.panels:  # its forces are in no proportion to the spacing
        spacing = task.row.layout.post_spacing
        changes.append(find_spacing_remedy(spacing, one.width, used.high))
    return _complete(task, one, changes, check)


def _complete(
    task: RowToCheck,
    one: MemberCheck,
    changes: list[ChangeRecord],
    check: CheckByCase | None,
) -> list[ChangeRecord]:
    """Changes with those found by solves; with a note where they alone do not do.

    Another type has the condition of its own resistance.
    """
    if one.gap or one.doubt:
        key = "change.as_far_as_solved" if one.gap else "change.if_law_accepted"
        return [replace(change, note=say(key)) for change in changes]
    if one.unsure:
        note = say("change.if_rest_proven")
        return [x if x.sense == "has" else replace(x, note=note) for x in changes]
    return changes + (_list_solved_remedies(task, check) if check else [])


def _is_worth_telling(task: RowToCheck, one: MemberCheck) -> bool:
    """It has a force, and does not pass with much to spare."""
    demand, used = one.result.find("E_d"), one.result.find("μ")
    if demand is None or demand.high == 0.0 or task.row.is_overtopped:
        return False
    if used is None:
        return one.result.verdict is not Verdict.PASS
    return (used.high or 0.0) >= CLOSE


def _list_solved_remedies(task: RowToCheck, check: CheckByCase) -> list[ChangeRecord]:
    """Changes of snow and friction, each found by solves."""
    if task.solver is None:
        return []
    found = (
        _doubt_density(task, find_density_remedy(check, task.solver)),
        find_height_remedy(check, task.solver),
        find_friction_remedy(check, task.solver),
    )
    return [change for change in found if change is not None]


def _doubt_density(task: RowToCheck, change: ChangeRecord) -> ChangeRecord:
    """Change of density that says where the creep law is not given for its snow."""
    bound = change.bound
    if bound is None or not find_doubt(task, density=bound, largest=math.inf):
        return change
    return replace(change, note=say("change.if_law_accepted"))


def _list_resistance_remedies(task: RowToCheck, one: MemberCheck) -> list[ChangeRecord]:
    """Characteristic resistance that is needed, and the type that has it."""
    standard, result = task.standard, one.result
    demand, factor = result.find("E_d"), result.find_value("γ_R")
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        found = standard.find_resistance_factor(one.given.mode, "tested")
        factor = found.value_si if found else None
        note = say("change.on_basis_of_tests")
    if factor is None or demand is None or demand.high is None:
        return []
    change = ChangeRecord(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=result.find_value("R_k"),
        bound=math.ceil(demand.high * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        solves=0,
        note=note,
    )
    kind = find_type_change(task, one.given, demand.high, one.pull)
    return [change, kind] if kind else [change]


def find_spacing_remedy(
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


def find_density_remedy(check: CheckByCase, solver: CaseSolver) -> ChangeRecord:
    """Largest snow density at which a check passes.

    The guideline's load has densities of its own and stays.
    """
    highest = check.ranges["density"].high
    if check.use_least() > 1.0:
        return _record("density", highest, None, note=say("change.floor_stays"))
    if check.is_slack:
        return _record("density", highest, None, note=say("change.member_slack"))
    line = CheckLine(
        check=check,
        quantity="density",
        cases=list_near(check),
        ends=TRIED_DENSITIES,
        solver=solver,
    )
    least = check.ranges["density"].low
    return _find_largest(line, highest, least, "change.lighter_snow_fails")


def find_height_remedy(check: CheckByCase, solver: CaseSolver) -> ChangeRecord:
    """Largest snow thickness, normal to the slope, at which a check passes.

    Where the thickness ranges, all of it has to stay below, and thinner snow that was
    solved has to pass: the force of a guy may fall while the snow grows. The floor
    rises with it, and may set the limit.
    """
    thickness = check.row.snow_thickness
    line = CheckLine(
        check=check,
        quantity="thickness",
        cases=list_near(check),
        ends=(_LEAST_SHARE * thickness, check.row.net_height),
        solver=solver,
    )
    least = _find_thinnest(check)
    return _find_largest(line, thickness, least, "change.thinner_snow_fails")


def _find_largest(
    line: CheckLine, start: float, least: float, fails: str
) -> ChangeRecord:
    """Largest value of a quantity at which a check passes, and so does all with less.

    ``least`` is the low end of its range, ``fails`` the key of what is said where some
    case with less does not pass.
    """
    before = line.solver.count
    bound, note = _search(line, start)
    if bound is not None and note is None and _is_floor_next(line, bound):
        note = say("change.floor_limits")
    if bound is not None and not _less_passes(line.check, line.quantity, bound):
        bound, note = None, say(fails)
    if bound is not None and bound < least:
        note = say("change.below_range")
    return _record(line.quantity, start, bound, line.solver.count - before, note)


def _search(line: CheckLine, start: float) -> tuple[float | None, Message | None]:
    """Largest value at which a check passes, from a start in the search's ends."""
    least, most = line.ends
    try:
        now = line.find_use(min(max(start, least), most))
        if now.passes:
            end = line.find_use(most)
            if end.passes:
                return most, say("change.passes_to_end")
            return line.find_turn(now, end), None
        governing = line.find_case_use(least, line.cases[0])
        if governing <= 1.0:
            found = line.find_turn(Point(value=least, used=governing), now)
            if found is not None:
                return found, None
        return None, _remark("change.not_even", line, least)
    except NoResultError as none:
        return None, _remark("change.case_without_result", line, none.value)


def _remark(key: str, line: CheckLine, value: float) -> Message:
    unit = _KEYS[line.quantity][1].replace("m3", "m³")
    return say(key, value=line.parameter.show(value), unit=unit)


def _is_floor_next(line: CheckLine, bound: float) -> bool:
    """One step above a bound the guideline's load alone is too much."""
    above = Setting(name=line.quantity, value=bound + 2.0 * line.find_step(bound))
    return line.check.use_about(above) > 1.0


def _find_thinnest(check: CheckByCase) -> float:
    """Least thickness that the ranges have; 0 where it does not range [m]."""
    ranges = check.ranges
    if "thickness" in ranges.further:
        return ranges["thickness"].low
    if "snow_height" in ranges.further:
        return compute_thickness(ranges["snow_height"].low, check.row.slope_angle)
    return 0.0


def find_friction_remedy(check: CheckByCase, solver: CaseSolver) -> ChangeRecord | None:
    """Friction angle from or up to which a failing check passes.

    Within the range that was given; None where the check passes all over it. The
    force is not monotonic in the friction angle: the end of the range beside the
    governing case is stated on which every sample passes, from the nearest of them.
    """
    governing = check.governing.friction_angle
    now = degree_from_radian(governing)
    if check.use_least() > 1.0:
        return _record("friction_angle", now, None, note=say("change.floor_stays"))
    samples = _list_friction_angles(check)
    used = [_find_worst_use(check, angle) for angle in samples]
    passes = [one <= 1.0 for one in used]
    if all(passes):
        return None
    place = samples.index(governing)
    passing = _list_passing_ends(passes, place)
    if not passing or passes[place]:
        is_between = any(passes) and not passes[place]
        key = "change.friction_between" if is_between else "change.no_friction_angle"
        return _record("friction_angle", now, None, note=say(key))
    nearest = min(passing, key=lambda k: abs(k - place))
    is_upper = place > nearest
    beside = nearest + (1 if is_upper else -1)
    line = CheckLine(
        check=check,
        quantity="friction_angle",
        cases=list_near(check),
        ends=(samples[0], samples[-1]),
        solver=solver,
    )
    before = solver.count
    try:
        points = [Point(value=samples[k], used=used[k]) for k in (nearest, beside)]
        turn = line.find_turn(*points)
        bound = None if turn is None else line.parameter.show(turn)
        note = say("change.no_friction_angle") if bound is None else None
    except NoResultError as none:
        bound, note = None, _remark("change.case_without_result", line, none.value)
    sense: Literal["at most", "at least"] = "at most" if is_upper else "at least"
    return _record(
        "friction_angle", now, bound, solver.count - before, note, sense=sense
    )


def _list_passing_ends(passes: Sequence[bool], place: int) -> list[int]:
    """Places from which on all pass, away from that of the governing case."""
    ends = range(len(passes))
    return [k for k in ends if all(passes[k:] if k > place else passes[: k + 1])]


def _list_friction_angles(check: CheckByCase) -> list[float]:
    """Angles that stand for the whole of the other ranges, and the governing one.

    A search solves some angles at a few cases only; an angle counts where the corners
    of the other ranges were solved.
    """
    others = [one for one in check.ranges.intervals if one[0] != "friction_angle"]
    corners = set(product(*((span.low, span.high) for _, span in others)))
    solved: dict[float, set[tuple[float, ...]]] = {}
    for result in check.results:
        values = result.case.values
        at = solved.setdefault(values["friction_angle"], set())
        at.add(tuple(values[name] for name, _ in others))
    whole = {angle for angle, cases in solved.items() if cases >= corners}
    return sorted(whole | {check.governing.friction_angle})


def _find_worst_use(check: CheckByCase, angle: float) -> float:
    """Largest utilisation at a friction angle [-]; infinite if a case there failed."""
    known = [
        check.utilisation(result)
        for result in check.results
        if result.case.friction_angle == angle
    ]
    return max((math.inf if one is None else one for one in known), default=math.inf)


def _less_passes(check: CheckByCase, name: str, bound: float) -> bool:
    """Every solved case passes that has no more of a quantity than a bound."""
    used = (
        check.utilisation(result)
        for result in check.results
        if (check.find_value(result.case, name) or 0.0) <= bound
    )
    return all(one is not None and one <= 1.0 for one in used)


def _record(
    name: str,
    now: float,
    bound: float | None,
    solves: int = 0,
    note: Message | None = None,
    *,
    sense: Literal["at most", "at least"] = "at most",
) -> ChangeRecord:
    """Record of a remedy that was solved for."""
    key, unit = _KEYS[name]
    return ChangeRecord(
        quantity=say(key),
        unit=unit,
        now=now,
        bound=bound,
        sense=sense,
        solves=solves,
        note=note,
    )
