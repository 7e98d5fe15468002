"""A stored net row again: every value of it that follows from others of the study.

What only a solve can tell is not here. Of checks this is the arithmetic of their steps:
that each is by the right rule and of the right resistance is what judging again from
site and profile shows, ``study.py``. What holds a support: ``support_again.py``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from netdesign.calculation.quantity import Kind, Quantity
from netdesign.calculation.steps import Step, evaluate, list_steps
from netdesign.checks.check import judge_utilisation
from netdesign.checks.forces import calculate_force, calculate_resistance, rate
from netdesign.outcome import Verdict
from netdesign.structure.members import REPORTED_MEMBERS, Member
from netdesign.study.case_records import (
    AxisRecord,
    BoundRecord,
    CaseRecord,
    ConfirmationRecord,
    EnvelopeRecord,
    ExtremeRecord,
    ForceRecord,
)
from netdesign.study.check_to_record import UNBOUNDED
from netdesign.study.governing import find_shown
from netdesign.study.member_force import leave_out_governing
from netdesign.study.model_form import span_variants
from netdesign.study.notes import list_reasons
from netdesign.study.records import (
    CheckRecord,
    RowStudy,
    SpreadRecord,
    Study,
)
from netdesign.study.rejudge.stored import (
    ALONE,
    GUY_OF,
    RULES,
    Fields,
    find_largest,
    list_extremes,
    list_solved,
    read_force,
    read_spans,
)
from netdesign.words.message import Message

Ends = tuple[float | None, float | None, float | None]


def follow_reasons(row: RowStudy, _: Study) -> Fields:
    """Reasons from checks and independent checks."""
    return {"reasons": list_reasons(row.checks, row.independent)}


def follow_extremes(row: RowStudy, _: Study) -> Fields:
    """Largest forces from the cases; their bands stay."""
    stored = {one.quantity: one for one in row.extremes}
    wanted = REPORTED_MEMBERS if list_solved(row) else ()
    return {
        "extremes": [
            _follow_extreme(stored[name], find_largest(row, name)) for name in wanted
        ]
    }


def _follow_extreme(extreme: ExtremeRecord, largest: CaseRecord) -> ExtremeRecord:
    forces = {str(one): read_force(largest, one) or 0.0 for one in REPORTED_MEMBERS}
    return replace(
        extreme,
        max_kN=forces.pop(extreme.quantity),
        case=largest.case,
        coincident_kN=forces,
    )


def follow_forces(row: RowStudy, _: Study) -> Fields:
    """Forces that the checks rest on, from the largest ones of the cases."""
    extremes, drawing = list_extremes(row), row.drawing
    is_at_foot = drawing is not None and drawing.uphill_anchor_m == (0.0, 0.0)
    bringing = dict(GUY_OF)
    if is_at_foot:  # one anchor carries both, (S7)
        bringing[Member.UPHILL_ANCHOR] = Member.FOOT_ANCHOR
    return {
        "forces": [
            one
            if one.quantity in ALONE
            else _follow_force(one, extremes[bringing.get(one.quantity, one.quantity)])
            for one in row.forces
        ]
    }


def _follow_force(force: ForceRecord, largest: ExtremeRecord) -> ForceRecord:
    """Force with the bound of a search; with that of a grid or what may hide more."""
    high = largest.high_kN
    if largest.upper_bound_kN is None:
        high = max(force.high_kN, high)
    return replace(
        force,
        low_kN=largest.low_kN,
        value_kN=largest.max_kN,
        high_kN=high,
        case=largest.case,
    )


def follow_envelope(row: RowStudy, study: Study) -> Fields:
    """Search of the cases: their numbers, its ranges and bounds."""
    record = row.envelope
    return {} if record is None else {"envelope": _follow_search(row, record, study)}


def _follow_search(
    row: RowStudy, record: EnvelopeRecord, study: Study
) -> EnvelopeRecord:
    axes = {axis.key: axis for axis in record.axes}
    for key, (low, high) in read_spans(study).items():
        axes[key] = AxisRecord(key=key, low=low, high=high)
    bounds = {one.quantity: one for one in record.bounds}
    return replace(
        record,
        cases=len(row.cases),
        failed=len(row.cases) - len(list_solved(row)),
        axes=list(axes.values()),
        bounds=[_follow_bound(bounds[one.quantity], one) for one in row.extremes],
    )


def _follow_bound(bound: BoundRecord, extreme: ExtremeRecord) -> BoundRecord:
    upper, again = extreme.upper_bound_kN, bound.confirmation
    return replace(
        bound,
        max_kN=extreme.max_kN,
        upper_bound_kN=math.nan if upper is None else upper,
        case=extreme.case.values,
        coincident_kN=extreme.coincident_kN,
        confirmation=again and _follow_confirmation(again),
    )


def _follow_confirmation(again: ConfirmationRecord) -> ConfirmationRecord:
    if again.confirmed_kN is None or not again.screened_kN:
        return again
    change = 100.0 * (again.confirmed_kN / again.screened_kN - 1.0)
    return replace(again, difference_percent=change)


def follow_opinions(row: RowStudy, _: Study) -> Fields:
    """Second opinions: of the largest force of the foot, the spread of the models."""
    found: dict[str, object] = {}
    if row.guideline is not None:
        largest = find_largest(row, Member.FOOT_ANCHOR)
        found["guideline"] = replace(
            row.guideline,
            case=largest.case,
            solved_foot_anchor_kN=largest.foot_anchor_kN or 0.0,
        )
    if row.model_form is not None:
        found["model_form"] = span_variants(row.model_form)
    return found


def follow_checks(row: RowStudy, study: Study) -> Fields:
    """Checks of forces by their own numbers, from the forces that the row states."""
    known = _list_known(row)
    values = {value.id: value.value for value in study.profile.values}
    return {
        "checks": [
            _follow_check(one, row, known, values) if one.steps else one
            for one in row.checks
        ]
    }


def _list_known(row: RowStudy) -> dict[str, Ends]:
    """Solved quantities that a row states, by their sources: low end, value, high."""
    known: dict[str, Ends] = {
        one.quantity: (one.low_kN, one.value_kN, one.high_kN) for one in row.forces
    }
    for least in row.floor.forces if row.floor else ():
        known[f"floor.{least.member}"] = (least.force_kN,) * 3
    known["tilt"] = (row.tilt,) * 3
    held = row.held_sideways
    if held is not None:
        known["head_pull"] = (held.pull_low_kN, held.pull_kN, held.pull_high_kN)
        known["least_tension"] = (held.least_tension_kN,) * 3
        for part in ("uphill_part", "downhill_part", "post_part"):
            known[part] = (getattr(held, part),) * 3
    return known


def _follow_check(
    check: CheckRecord,
    row: RowStudy,
    known: Mapping[str, Ends],
    values: Mapping[str, float],
) -> CheckRecord:
    """Every step from the leaves, and these from forces and profile."""
    leaves = [
        _follow_leaf(one, known, values) for one in check.steps if not one.formula
    ]
    again = replace(check, steps=list_steps(_calculate(evaluate(leaves))))
    return replace(
        again,
        demand_kN=again.read("E_d"),
        resistance_kN=again.read("R_d"),
        utilisation=again.read("μ"),
        verdict=_follow_verdict(check, row),
        spreads=_follow_spreads(check, is_wanted=check is _find_detailed(row)),
    )


def _follow_leaf(
    step: Step, known: Mapping[str, Ends], values: Mapping[str, float]
) -> Step:
    """A solved or profile's value as its source has it."""
    if step.kind is Kind.SOLVED and step.value is not None:
        low, value, high = known.get(step.source, (None, None, None))
    elif step.kind is Kind.PROFILE and step.source in values and step.source != RULES:
        low = value = high = values[step.source]
    else:
        return step
    return replace(
        step,
        value=value,
        low=None if low == value else low,
        high=None if high == value else high,
    )


def _calculate(leaves: Mapping[str, Quantity]) -> Quantity:
    """Utilisation from the leaves of a stored calculation, as it was made."""
    force = None if "E_k" in leaves else calculate_force(leaves)
    resistance = calculate_resistance(leaves, force)
    action = force.action if force else leaves["E_k"]
    return rate(action, leaves["γ_E"], resistance, leaves["γ_R"])


def _follow_verdict(check: CheckRecord, row: RowStudy) -> Verdict:
    """Verdict from the band, as ``checks.check`` gives it; that held back stays."""
    low, high = check.utilisation_band
    verdict = judge_utilisation(low, high, is_complete=is_complete(row))
    if check.is_unbounded:
        verdict = Verdict.FAIL
    is_declared = check.verdict is Verdict.DECLARED and check.declared is not None
    if is_declared and verdict is not Verdict.FAIL:
        return check.verdict
    is_open = is_held_back(check) or _is_information(check, row)
    return check.verdict if is_open else verdict


def is_complete(row: RowStudy) -> bool:
    """Completeness: every case solved, nothing left open, the floor known."""
    record = row.envelope
    if row.unsaid:
        return False
    if row.floor is not None and row.floor.reason is not None:
        return False
    if not row.cases or len(list_solved(row)) < len(row.cases):
        return False
    if row.panel is not None and row.panel.failed:
        return False
    if record is None:
        return True
    again = [bound.confirmation for bound in record.bounds]
    return record.is_closed and all(
        one is None or one.confirmed_kN is not None for one in again
    )


def is_held_back(check: CheckRecord) -> bool:
    """A check that would pass is not proven for a reason beside its numbers.

    Such as a fault of the program in a solve that the check does not rest on.
    """
    _, high = check.utilisation_band
    is_met = high is not None and high <= 1.0
    is_told = leave_out_governing(check.reason).key == "check.not_proven"
    return check.verdict is Verdict.NOT_PROVEN and is_met and is_told


def _is_information(check: CheckRecord, row: RowStudy) -> bool:
    """The check is left open since the net stands below its snow."""
    too_low = any(
        one.id == "geometry.height" and one.verdict is Verdict.FAIL
        for one in row.checks
    )
    return too_low and check.verdict is Verdict.NOT_PROVEN


def is_used_up(check: CheckRecord) -> bool:
    """Nothing is left of a post or its foot for the force along it, by its reason."""
    has_numbers = check.utilisation is not None or check.resistance_kN is not None
    reason = leave_out_governing(check.reason)
    alone = reason.arguments.get("reason")
    if reason.key == "check.fails_though_declared" and isinstance(alone, Message):
        reason = alone
    return reason.key in UNBOUNDED and not has_numbers


def _find_detailed(row: RowStudy) -> CheckRecord | None:
    """Check of which the parts of the interval are stored: that shown, of a force."""
    stored = next((one for one in row.checks if one.spreads), None)
    shown = find_shown(row.checks)
    return stored or (shown if shown and shown.is_of_force else None)


def _follow_spreads(check: CheckRecord, *, is_wanted: bool) -> list[SpreadRecord]:
    """Parts of the interval; those that count in the verdict make up its band."""
    (low, high), used = check.utilisation_band, check.utilisation
    if not used or high is None or not is_wanted:
        return []
    numerical, between, *others = check.spreads
    hidden = high - (math.nan if numerical.high is None else numerical.high)
    return [
        replace(numerical, low=low),
        replace(between, low=used, high=used + hidden),
        *others,
    ]
