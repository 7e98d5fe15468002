"""All checks of one net row as records: interval, effects, what would change them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

from netdesign.checks import (
    Band,
    CheckResult,
    RowGeometry,
    Standard,
    check_geometry,
    check_member,
)
from netdesign.envelope.extremes import Extreme, find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.outcome import Verdict
from netdesign.site.model import BaseFriction, NetRow, Resistance, Site
from netdesign.snow.creep_law import CREEP_LAWS
from netdesign.study.dependent import (
    Circumstances,
    settle_resistance,
)
from netdesign.study.effects import check_ends, find_effects
from netdesign.study.flips import (
    CLOSE,
    Target,
    find_density_change,
    find_friction_change,
    find_height_change,
    find_spacing_change,
)
from netdesign.study.member_loads import RowLoads
from netdesign.study.probe import Probe
from netdesign.study.pulls import check_directions
from netdesign.study.record_cases import record_point
from netdesign.study.records import ChangeRecord, CheckRecord, SpreadRecord
from netdesign.study.sideways import check_sideways
from netdesign.study.stronger_types import find_type_change
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say
from netdesign.words.names import name

# A program that fails beside the cases of a check is not trusted in them.
_FAULT_BESIDE = say("check.fault_beside")


@dataclass(frozen=True, slots=True, kw_only=True)
class RowCheck:
    """One net row under one profile.

    ``probe`` is None where nothing beyond the solved cases is to be solved;
    ``on_check`` is called after each check of a force.
    """

    site: Site
    row: NetRow
    solved: RowGrid | RowEnvelope
    standard: Standard
    probe: Probe | None
    on_check: Callable[[], None] = lambda: None


def check_row(
    task: RowCheck, extremes: Mapping[str, Extreme], loads: RowLoads
) -> list[CheckRecord]:
    """Every check of a row: each member in each mode, then the geometry.

    ``extremes`` and ``loads`` are those of its solved cases.
    """
    checks = []
    for given in task.row.resistances:
        checks.append(_check_one(task, given, extremes, loads))
        task.on_check()
    return [
        *checks,
        *(record_result(one) for one in _check_directions(task, loads)),
        *record_geometry(task.row, task.site.ranges, task.standard),
    ]


def _check_directions(task: RowCheck, loads: RowLoads) -> list[CheckResult]:
    """Checks of a support that compare no force: load along the row, directions."""
    gap = task.solved.gap
    return [
        check_sideways(task.row, loads.sideways, gap),
        *check_directions(loads.pulls, task.standard, gap),
    ]


def record_geometry(
    row: NetRow, ranges: Ranges, standard: Standard
) -> list[CheckRecord]:
    """Checks of a row that no force enters."""
    geometry = [*check_geometry(read_geometry(row, ranges), standard)]
    ends = check_ends(find_effects(row, standard))
    return [record_result(one) for one in [*geometry, *([ends] if ends else [])]]


def read_geometry(row: NetRow, ranges: Ranges) -> RowGeometry:
    """Input of a row's checks of geometry."""
    return RowGeometry(
        inclination_low=ranges["inclination"].low,
        inclination_high=ranges["inclination"].high,
        slope_angle=row.slope_angle,
        snow_thickness=row.snow_thickness,
        net_height=row.net_height,
        upslope_length=row.upslope_length,
        gap=row.gap,
    )


def _check_one(
    task: RowCheck,
    given: Resistance,
    extremes: Mapping[str, Extreme],
    loads: RowLoads,
) -> CheckRecord:
    extreme = extremes.get(given.member)
    gap = task.solved.gap
    if extreme is None:
        return record_result(check_member(None, given, task.standard, gap=gap), given)
    action = loads.act(given, extreme.widened)
    given = _settle(task, given, extreme, loads)
    result = judge_forces(action, given, task.standard, gap)
    before = task.probe.faults if task.probe else 0
    at_cases = loads.act(given, extreme.force)
    spreads = _list_spreads(task, extreme, result, at_cases)
    changes = _list_changes(task, given, extreme, loads, result)
    if task.probe and task.probe.faults > before and not gap:
        result = judge_forces(action, given, task.standard, _FAULT_BESIDE)
    return replace(
        record_result(result, given),
        case=record_point(extreme.governing.case),
        action=loads.record(given, extreme),
        spreads=spreads,
        changes=changes,
    )


def _settle(
    task: RowCheck, given: Resistance, extreme: Extreme, loads: RowLoads
) -> Resistance:
    """The resistance with the value that follows from the demand, where it does."""
    known = Circumstances(
        row=task.row,
        ranges=task.site.ranges,
        standard=task.standard,
        pull=loads.pulls.get(given.member),
        pressing=loads.press(extreme.widened).value,
    )
    return settle_resistance(given, known)


def judge_forces(
    action: Band | None, given: Resistance, standard: Standard, gap: Message | None
) -> CheckResult:
    """Check of forces; it fails where a moment alone is too much for a post."""
    result = check_member(action, given, standard, gap=gap)
    lack = given.lack
    if lack is None or lack.key != "post_bending.too_much":
        return result
    return replace(result, verdict=Verdict.FAIL, reason=lack)


def record_result(result: CheckResult, given: Resistance | None = None) -> CheckRecord:
    """Check in engineer's units, without what stands behind its action."""
    demand, utilisation = result.demand, result.utilisation
    return CheckRecord(
        id=result.id,
        clause=result.clause,
        member=result.member,
        mode=result.mode,
        demand_kN=kilonewton_if_known(demand.value if demand else None),
        demand_low_kN=kilonewton_if_known(demand.low if demand else None),
        demand_high_kN=kilonewton_if_known(demand.high if demand else None),
        resistance_kN=kilonewton_if_known(result.design_resistance),
        utilisation=utilisation.value if utilisation else None,
        verdict=result.verdict,
        case=None,
        reason=result.reason,
        action_kN=kilonewton_if_known(result.action.value if result.action else None),
        action_factor=result.action_factor,
        resistance_characteristic_kN=kilonewton_if_known(result.resistance),
        resistance_factor=result.resistance_factor,
        resistance_basis=given.basis if given else "",
        resistance_type=given.type_id if given else "",
        resistance_cell=given.source if given else "",
        resistance_derivation=_describe_derivation(given, result),
    )


def _describe_derivation(
    given: Resistance | None, result: CheckResult
) -> Message | None:
    if given is None or given.tests is None or result.resistance is None:
        return given.derivation if given else None
    tests = given.tests
    return say(
        "check.from_tests",
        mean=kilonewton_from_newton(tests.mean),
        least=kilonewton_from_newton(tests.least),
        count=tests.count,
    )


def _list_spreads(
    task: RowCheck, extreme: Extreme, result: CheckResult, at_cases: Band
) -> list[SpreadRecord]:
    """Parts of the interval of a utilisation, the creep law's for comparison.

    ``at_cases`` is the action without what may hide between the cases.
    """
    used = result.utilisation
    if used is None or at_cases.value == 0.0:
        return []
    scale = used.value / at_cases.value
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    spreads = [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=at_cases.low * scale,
            high=at_cases.high * scale,
            in_verdict=True,
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.high - at_cases.high * scale + used.value,
            in_verdict=True,
            note=say("spread.unknown_along", axes=unknown) if unknown else None,
        ),
    ]
    if task.probe is not None and extreme.force.value > 0.0:
        on_force = used.value / extreme.force.value
        spreads += _list_creep_laws(task.probe, task.row, extreme, on_force)
    return spreads


def _list_creep_laws(
    probe: Probe, row: NetRow, extreme: Extreme, scale: float
) -> Iterable[SpreadRecord]:
    laws = {k: law for k, law in CREEP_LAWS.items() if k != probe.law.name}
    results = probe.solve_all(
        [(row, extreme.governing.case, law) for law in laws.values()]
    )
    for law, result in zip(laws, results, strict=True):
        force = result.member_forces.get(extreme.member)
        yield SpreadRecord(
            source=say("spread.creep_law", law=law),
            low=force.low * scale if force else None,
            high=force.high * scale if force else None,
            in_verdict=False,
            note=say("spread.in_governing_case") if force else result.reason,
        )


def _list_changes(
    task: RowCheck,
    given: Resistance,
    extreme: Extreme,
    loads: RowLoads,
    result: CheckResult,
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check."""
    if result.demand is None or result.demand.high == 0.0:
        return []
    used = result.utilisation
    is_close = used is not None and used.high >= CLOSE
    gap = task.solved.gap
    if not is_close and (result.verdict is Verdict.PASS or (used and gap)):
        return []  # a case without result is not mended by any change
    if isinstance(given.dimensions, BaseFriction):
        return []  # in proportion to what presses the base
    changes = _list_resistance_changes(task, given, result)
    if used is None or result.design_resistance is None:
        return changes
    changes.append(find_spacing_change(loads.effects, used.high))
    if gap:
        note = say("change.as_far_as_solved")
        return [replace(change, note=note) for change in changes]
    if task.probe is None or given.dimensions or extreme.force.value == 0.0:
        return changes  # what follows the snow is no fixed resistance
    at_cases = find_extreme(given.member, task.solved.results).force.high
    margin = extreme.widened.high / at_cases
    action = loads.act(given, extreme.widened).high / extreme.widened.high
    on_force = action * (result.action_factor or math.nan)
    target = Target(
        row=task.row,
        ranges=task.site.ranges,
        member=given.member,
        scale=on_force * margin / result.design_resistance,
        governing=extreme.governing.case,
        results=task.solved.results,
    )
    found = (
        find_density_change(target, task.probe),
        find_height_change(target, task.probe),
        find_friction_change(target, task.probe),
    )
    return [*changes, *(change for change in found if change is not None)]


def _list_resistance_changes(
    task: RowCheck, given: Resistance, result: CheckResult
) -> list[ChangeRecord]:
    """Characteristic resistance that is needed, and the type that has it."""
    factor: float | None = result.resistance_factor
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        found = task.standard.find_resistance_factor(given.mode, "tested")
        factor = found.value_si if found else None
        note = say("change.on_basis_of_tests")
    if factor is None or result.demand is None:
        return []
    needed = result.demand.high * factor
    shown = math.ceil(kilonewton_from_newton(needed) * 10.0 - 1e-9) / 10.0
    change = ChangeRecord(
        quantity=say("change.characteristic_resistance"),
        unit="kN",
        now=kilonewton_if_known(result.resistance),
        bound=shown,
        sense="at least",
        solves=0,
        note=note,
    )
    kind = find_type_change(task.site, given, result.demand.high, task.standard)
    return [change, kind] if kind else [change]
