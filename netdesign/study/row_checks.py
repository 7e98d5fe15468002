"""All checks of one net row as records: interval, effects, what would change them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

from netdesign.checks import (
    Band,
    CheckResult,
    Declaration,
    RowGeometry,
    Standard,
    check_geometry,
    check_member,
    declare,
    withhold,
)
from netdesign.envelope.extremes import Extreme, find_extreme
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.rows import RowEnvelope, RowGrid
from netdesign.guideline.floor import Floor
from netdesign.outcome import Verdict
from netdesign.site.model import BaseFriction, NetRow, Resistance, Site
from netdesign.snow.creep_law import CREEP_LAWS, CreepLaw
from netdesign.structure.members import Member
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.calibration import find_doubt
from netdesign.study.demand import Demand, tell_governing
from netdesign.study.dependent import Circumstances, settle_resistance
from netdesign.study.effects import RowEffects, check_ends, find_effects
from netdesign.study.flips import (
    CLOSE,
    find_density_change,
    find_friction_change,
    find_height_change,
    find_spacing_change,
)
from netdesign.study.floor import find_row_floor
from netdesign.study.holds import HeldCheck, find_holds
from netdesign.study.member_loads import RowLoads, add_parts
from netdesign.study.probe import Probe
from netdesign.study.pulls import check_directions, find_pull
from netdesign.study.record_cases import record_point
from netdesign.study.records import (
    ChangeRecord,
    CheckRecord,
    DeclarationRecord,
    HoldRecord,
    SpreadRecord,
)
from netdesign.study.sideways import MemberLoad, check_sideways
from netdesign.study.stronger_types import find_type_change
from netdesign.study.target import Target
from netdesign.units import (
    kilonewton_from_newton,
    kilonewton_if_known,
)
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
    law: CreepLaw
    probe: Probe | None
    on_check: Callable[[], None] = lambda: None


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCheck:
    """One member of one support in one mode, judged.

    ``extreme`` and ``demand`` are None where no case was solved; ``gap`` says why the
    demand is not known as a whole, ``doubt`` why the creep law may not hold for the
    governing snow; both are None if all is well.
    """

    given: Resistance
    width: LoadedWidth
    extreme: Extreme | None
    demand: Demand | None
    gap: Message | None
    doubt: Message | None
    result: CheckResult

    @property
    def ratio(self) -> float:
        """Upper end of the utilisation [-]; below 0 without one."""
        used = self.result.utilisation
        return used.high if used else -1.0


def check_row(
    task: RowCheck, extremes: Mapping[str, Extreme], loads: RowLoads
) -> list[CheckRecord]:
    """Every check of a row: the members of both supports, then the geometry.

    ``extremes`` and ``loads`` are those of its solved cases.
    """
    judged = [
        _judge_member(task, given, width, extremes, loads)
        for width, given in list_checked(task.row, loads.effects)
    ]
    checks = []
    for one in judged:
        checks.append(
            _record_member(task, one, loads.effects, is_worst=_is_worst(one, judged))
        )
        task.on_check()
    before = task.probe.faults if task.probe else 0
    holds = _find_holds(task, judged, checks)
    checks = [replace(one, holds=holds.get(one.id, [])) for one in checks]
    if task.probe and task.probe.faults > before:
        told = zip(judged, checks, strict=True)
        checks = [_distrust(task, one, check) for one, check in told]
    return [
        *checks,
        *_check_directions(task, loads, find_open(judged)),
        *record_geometry(task.site, task.row, task.standard),
    ]


def find_open(judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well."""
    points = (one.gap or one.doubt for one in judged)
    return next((one for one in points if one is not None), None)


def _check_directions(
    task: RowCheck, loads: RowLoads, gap: Message | None
) -> list[CheckRecord]:
    """Checks of a row that compare no force: load along it, directions of pulls."""
    lateral = check_sideways(task.row, loads.sideways, gap)
    directions = check_directions(loads.pulls, task.standard, gap)
    return [
        record_result(settle_check(task.site, task.row, lateral)),
        *(
            place_check(record_result(settle_check(task.site, task.row, one)), place)
            for place, one in directions
        ),
    ]


def find_gap(solved: Message | None, floor: Floor | None) -> Message | None:
    """Gap of the cases, else of the floor; None where nothing is missing."""
    return solved or (floor.reason if floor else None)


def list_checked(
    row: NetRow, effects: RowEffects
) -> list[tuple[LoadedWidth, Resistance]]:
    """Members that are checked of a row, on each support and in each mode."""
    return [
        (width, given)
        for width in effects.supports
        for given in row.resistances_at(width.position)
    ]


def _is_worst(one: MemberCheck, judged: Sequence[MemberCheck]) -> bool:
    """No other support uses the member more."""
    rivals = [other for other in judged if _name_of(other) == _name_of(one)]
    return one is max(rivals, key=lambda other: other.ratio)


def _find_holds(
    task: RowCheck, judged: Sequence[MemberCheck], checks: Sequence[CheckRecord]
) -> dict[str, list[HoldRecord]]:
    """Limits of single values for the checks that follow from forces, by their ids.

    At the support that uses a member most: where that holds, the other one does.
    """
    if task.probe is None or task.solved.gap or task.row.is_overtopped:
        return {}
    find = cache(partial(_find_floor, task))  # the same for all members
    held = {
        check.id: HeldCheck(target=_build_target(task, one, find))
        for one, check in zip(judged, checks, strict=True)
        if one.ratio > 0.0 and _has_target(one) and _is_worst(one, judged)
    }
    return find_holds(held, task.probe)


def _find_floor(task: RowCheck, ranges: Ranges) -> Floor | None:
    """Floor of the row over ranges in which something was moved."""
    return find_row_floor(task.row, ranges, task.standard)


def _find_width(standard: Standard, one: MemberCheck, row: NetRow) -> float:
    """Width that loads a support of a row that was changed [m]."""
    supports = find_effects(row, standard).supports
    widths = [w.width for w in supports if w.position == one.width.position]
    return max(widths, default=one.width.width)


def _name_of(one: MemberCheck) -> tuple[str, str]:
    return one.given.member, one.given.mode


def record_geometry(site: Site, row: NetRow, standard: Standard) -> list[CheckRecord]:
    """Checks of a row that no force enters."""
    geometry = [*check_geometry(read_geometry(row, site.ranges), standard)]
    ends = check_ends(find_effects(row, standard))
    results = [*geometry, *([ends] if ends else [])]
    return [record_result(settle_check(site, row, one)) for one in results]


def settle_check(site: Site, row: NetRow, result: CheckResult) -> CheckResult:
    """Check with what the workbook says beside its numbers.

    Forces of a net below its snow are those of snow up to its head: information.
    A check may be declared as proven elsewhere.
    """
    if row.is_overtopped and result.member != Member.NET:
        result = withhold(result, say("check.overtopped"))
    declaration = site.find_declaration(row.id, result.member, result.mode)
    return declare(result, declaration)


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


def _judge_member(
    task: RowCheck,
    given: Resistance,
    width: LoadedWidth,
    extremes: Mapping[str, Extreme],
    loads: RowLoads,
) -> MemberCheck:
    extreme, demand, doubt = extremes.get(given.member), None, None
    if extreme is not None:
        demand = loads.demand(given, extreme, width)
        known = Circumstances(
            row=task.row,
            ranges=task.site.ranges,
            standard=task.standard,
            pull=find_pull(loads.pulls, given.member, width.position),
            pressing=loads.press(extreme, width),
        )
        given = settle_resistance(given, known)
        brings = [extreme]
        if demand.load.added.high > 0.0:  # by the net's pull, as the post's force is
            brings.append(extremes[Member.POST])
        doubts = (_find_doubt(task, one) for one in brings)
        doubt = next((one for one in doubts if one), None)
    gap = find_gap(task.solved.gap, loads.floor)
    action = demand.action if demand else None
    return MemberCheck(
        given=given,
        width=width,
        extreme=extreme,
        demand=demand,
        gap=gap,
        doubt=doubt,
        result=judge_forces(action, given, task.standard, gap=gap, doubt=doubt),
    )


def _find_doubt(task: RowCheck, extreme: Extreme) -> Message | None:
    """Doubt that the creep law holds for the snow of a largest force."""
    density, largest = extreme.governing.case.density, extreme.widened.high
    return find_doubt(task.site, task.row, task.law, density=density, largest=largest)


def _record_member(
    task: RowCheck, one: MemberCheck, effects: RowEffects, *, is_worst: bool
) -> CheckRecord:
    given, result = one.given, one.result
    if one.extreme is None or one.demand is None:
        settled = settle_check(task.site, task.row, result)
        return place_check(record_result(settled, given), one.width.position)
    before = task.probe.faults if task.probe else 0
    spreads = _list_spreads(task, one, one.extreme)
    changes = _list_changes(task, one, effects, is_worst=is_worst)
    if task.probe and task.probe.faults > before and not one.gap:
        result = judge_forces(
            one.demand.action,
            given,
            task.standard,
            gap=_FAULT_BESIDE,
            doubt=one.doubt,
        )
    settled = settle_check(task.site, task.row, result)
    plain = one.demand.record(effects, given.member)
    action = add_parts(plain, one.extreme.governing, given.member)
    return replace(
        place_check(record_result(settled, given), one.width.position),
        case=record_point(one.extreme.governing.case),
        action=action,
        reason=tell_governing(settled.reason, action),
        spreads=spreads,
        changes=changes,
    )


def _distrust(task: RowCheck, one: MemberCheck, check: CheckRecord) -> CheckRecord:
    """Check of a row beside whose cases the program failed."""
    if one.demand is None or one.gap or check.action is None:
        return check
    result = judge_forces(
        one.demand.action, one.given, task.standard, gap=_FAULT_BESIDE, doubt=one.doubt
    )
    settled = settle_check(task.site, task.row, result)
    reason = tell_governing(settled.reason, check.action)
    return replace(check, verdict=settled.verdict, reason=reason)


def judge_forces(
    action: Band | None,
    given: Resistance,
    standard: Standard,
    *,
    gap: Message | None,
    doubt: Message | None,
) -> CheckResult:
    """Check of forces; it fails where a moment alone is too much for a post."""
    result = check_member(action, given, standard, gap=gap, doubt=doubt)
    lack = given.lack
    if lack is None or lack.key != "post_bending.too_much":
        return result
    return replace(result, verdict=Verdict.FAIL, reason=lack)


def place_check(check: CheckRecord, position: Position) -> CheckRecord:
    """Check of a member, named by its support."""
    name_of_end = ".end" if position == "edge" else ""
    return replace(check, id=f"{check.id}{name_of_end}", position=position)


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
        declared=_record_declaration(result.declaration),
    )


def _record_declaration(given: Declaration | None) -> DeclarationRecord | None:
    if given is None:
        return None
    return DeclarationRecord(
        document=given.document,
        author=given.author,
        date=given.date,
        cell=given.source,
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
    task: RowCheck, one: MemberCheck, extreme: Extreme
) -> list[SpreadRecord]:
    """Parts of the interval of a utilisation, the creep law's for comparison.

    A floor cuts off what lies below it.
    """
    used, scale = one.result.utilisation, _find_scale(one)
    if used is None or scale is None or used.value == 0.0:
        return []
    unknown = tuple(name("axis", axis) for axis in extreme.unknown)
    numerical = max(used.value, _use_at_cases(one, extreme))
    spreads = [
        SpreadRecord(
            source=say("spread.numerical_error"),
            low=used.low,
            high=numerical,
            in_verdict=True,
            note=_note_floor(one),
        ),
        SpreadRecord(
            source=say("spread.between_cases"),
            low=used.value,
            high=used.value + used.high - numerical,
            in_verdict=True,
            note=say("spread.unknown_along", axes=unknown) if unknown else None,
        ),
    ]
    if task.probe is not None and extreme.force.value > 0.0:
        spreads += _list_creep_laws(task.probe, task.row, extreme, scale)
    return spreads


def _use_at_cases(one: MemberCheck, extreme: Extreme) -> float:
    """Utilisation by the coupled force without what may hide between the cases [-]."""
    result, demand = one.result, one.demand
    if demand is None or not (result.action_factor and result.design_resistance):
        return 0.0
    force = demand.load.apply(extreme.force).high * demand.on_support
    return force * result.action_factor / result.design_resistance


def _find_use(one: MemberCheck) -> float | None:
    """Utilisation for each N on a member inside the row; None without resistance."""
    result, demand = one.result, one.demand
    if demand is None or not (result.action_factor and result.design_resistance):
        return None
    return demand.on_support * result.action_factor / result.design_resistance


def _find_scale(one: MemberCheck) -> float | None:
    """Utilisation for each N of the solved force [1/N]; None without a resistance.

    What the load along the row adds counts in proportion.
    """
    use, demand = _find_use(one), one.demand
    if demand is None or use is None:
        return None
    solved = demand.solved.high
    if solved == 0.0:
        return use * demand.load.share
    return use * demand.load.apply(demand.solved).high / solved


def _note_floor(one: MemberCheck) -> Message | None:
    is_floor = one.demand is not None and one.demand.governs == "guideline"
    return say("spread.floor_governs") if is_floor else None


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
    task: RowCheck, one: MemberCheck, effects: RowEffects, *, is_worst: bool
) -> list[ChangeRecord]:
    """Changes that flip a failing, unproven or close check.

    What needs a solve is looked for at the support that uses its member most: where
    that passes, the other one does.
    """
    result, used = one.result, one.result.utilisation
    if result.demand is None or result.demand.high == 0.0 or task.row.is_overtopped:
        return []
    is_close = used is not None and used.high >= CLOSE
    gap = one.gap
    if not is_close and (
        result.verdict is Verdict.PASS or (used and (gap or one.doubt))
    ):
        return []  # neither a missing result nor a doubt is mended by any change
    if isinstance(one.given.dimensions, BaseFriction):
        return []  # in proportion to what presses the base
    changes = _list_resistance_changes(task, one.given, result)
    if used is None or result.design_resistance is None:
        return changes
    changes.append(find_spacing_change(effects.post_spacing, one.width, used.high))
    if gap or one.doubt:
        note = say("change.as_far_as_solved" if gap else "change.if_law_accepted")
        return [replace(change, note=note) for change in changes]
    if task.probe is None or not is_worst or not _has_target(one):
        return changes
    target = _build_target(task, one, partial(_find_floor, task))
    found = (
        _doubt_density(task, find_density_change(target, task.probe)),
        find_height_change(target, task.probe),
        find_friction_change(target, task.probe),
    )
    return [*changes, *(change for change in found if change is not None)]


def _has_target(one: MemberCheck) -> bool:
    """The check follows from the member's force by numbers that stay as they are.

    A resistance that follows the snow does not, nor what is added to no force at all.
    """
    demand = one.demand
    if demand is None or one.given.dimensions or _find_use(one) is None:
        return False
    return demand.solved.high > 0.0 or demand.load.added.high == 0.0


def _build_target(
    task: RowCheck, one: MemberCheck, find: Callable[[Ranges], Floor | None]
) -> Target:
    """The check as a function of a solved case and of the row."""
    extreme, demand, use = one.extreme, one.demand, _find_use(one)
    if extreme is None or demand is None or use is None:
        raise ValueError("a check without a demand has no target")
    member, load = one.given.member, demand.load

    def use_floor(ranges: Ranges) -> float:
        floor = find(ranges)
        least = floor.find(member) if floor else None
        if floor is not None and least is None:
            return math.inf
        if floor is None or least is None:
            return 0.0
        return use * (load.share * least.force + _add_by_floor(load, floor))

    at_cases = find_extreme(member, task.solved.results).force.high
    widened = extreme.widened.high / at_cases if at_cases else 1.0
    return Target(
        row=task.row,
        ranges=task.site.ranges,
        member=member,
        scale=use * load.share * widened,
        added=use * load.added.high,
        rise=use * load.rise,
        largest=at_cases,
        governing=extreme.governing.case,
        results=task.solved.results,
        use_floor=use_floor,
        widen=partial(_find_width, task.standard, one),
    )


def _add_by_floor(load: MemberLoad, floor: Floor) -> float:
    """Force added to a member where the guideline's pull on the head may be larger [N].

    It grows with that pull, and never falls.
    """
    pull = floor.head.pull if floor.head else 0.0
    growth = max(0.0, pull / load.pull - 1.0) if load.pull else 0.0
    return load.added.value + growth * load.rise


def _doubt_density(task: RowCheck, change: ChangeRecord) -> ChangeRecord:
    """Change of density that says where the creep law is not given for its snow."""
    if change.bound is None or not find_doubt(
        task.site, task.row, task.law, density=change.bound, largest=math.inf
    ):
        return change
    return replace(change, note=say("change.if_law_accepted"))


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
