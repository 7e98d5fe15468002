"""Knowledge that solved cases give the checks of a row, in engineer's units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from netdesign.envelope.extremes import Extreme
from netdesign.envelope.run import CaseResult
from netdesign.guideline.floor import Floor
from netdesign.panel.solution import FailedPanel
from netdesign.site.model import NetRow
from netdesign.study.case_records import ForceRecord
from netdesign.study.effects import find_effects
from netdesign.study.judgement import Known
from netdesign.study.pulls import list_pulls
from netdesign.study.record_envelope import record_point
from netdesign.study.record_guideline import record_floor
from netdesign.study.row_to_check import Basis
from netdesign.study.sideways import find_held_sideways, find_tilt
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say


def know_row(
    basis: Basis,
    results: Sequence[CaseResult],
    extremes: Mapping[str, Extreme],
    gap: Message | None,
    floor: Floor | None,
) -> Known:
    """Knowledge of a row by its cases and the guideline's load.

    ``gap`` says why the cases are not complete.
    """
    row, standard = basis.row, basis.standard
    effects = find_effects(row, standard, basis.site.ranges)
    head, record = floor.head if floor else None, record_floor(floor, row)
    held = find_held_sideways(row, results, extremes, standard, head)
    return Known(
        row=row,
        standard=standard,
        effects=effects,
        largest={name: _record_force(one) for name, one in extremes.items()},
        floor={one.member: one for one in record.forces} if record else None,
        held=held,
        tilt=find_tilt(
            row, (one.case.inclination for one in results if one.is_converged)
        ),
        pulls=tuple(list_pulls(row, results, effects.lateral_share, head)),
        gap=gap,
        floor_gap=floor.reason if floor else None,
        panel_gap=_find_failed_panel(row, results),
    )


def _record_force(extreme: Extreme) -> ForceRecord:
    force = extreme.widened
    return ForceRecord(
        quantity=extreme.member,
        low_kN=kilonewton_from_newton(force.low),
        value_kN=kilonewton_from_newton(force.value),
        high_kN=kilonewton_from_newton(force.high),
        case=record_point(extreme.governing.case),
        unknown=list(extreme.unknown),
    )


def _find_failed_panel(row: NetRow, results: Sequence[CaseResult]) -> Message | None:
    """Reason why an assumed panel fails, so that nothing is known of the row."""
    failed = [one for one in results if isinstance(one.panel, FailedPanel)]
    if not failed or row.panel is None or not row.panel.assumed:
        return None
    return say("panel.assumed_fails", reason=failed[0].lack or "")
