"""The other creep laws on one case of a row: the spread of the model form."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.checks.check import Check
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CREEP_LAWS, CreepLaw
from netdesign.snow.ground import (
    GroundLaw,
    build_ground_from_glide_factor,
    load_glide_tables,
)
from netdesign.study.record_envelope import record_point
from netdesign.study.records import ModelFormRecord, VariantRecord
from netdesign.study.row_to_check import CaseSolver
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True)
class _Variant:
    """One other creep law; ``reason`` tells why it cannot have a force."""

    law: CreepLaw
    ground: GroundLaw
    reason: Message | None


def record_model_form(
    solver: CaseSolver, row: NetRow, result: CaseResult, member: str, check: Check
) -> ModelFormRecord | None:
    """Solve the governing case of a row by the other creep laws; record the spread.

    Parameters
    ----------
    solver : CaseSolver
        Solves; it has the study's creep law.
    row : NetRow
        Net row.
    result : CaseResult
        Governing case, solved.
    member : str
        Key of the governing force.
    check : Check
        Governing check, with its interval.

    Returns
    -------
    ModelFormRecord or None
        None where the case has no such force.
    """
    own = result.member_forces.get(member)
    if own is None or not own.value > 0.0:
        return None
    placed, case = row.at(result.case), replace(result.case, others=())
    others = [law for law in CREEP_LAWS.values() if law.name != solver.law.name]
    variants = [_place(law, placed) for law in others]
    results = _solve(solver, placed, case, variants)
    records = [
        _record(one, found, member, own.value)
        for one, found in zip(variants, results, strict=True)
    ]
    return ModelFormRecord(
        case=record_point(result.case),
        member=member,
        force_kN=kilonewton_from_newton(own.value),
        utilisation=check.utilisation,
        variants=records,
    )


def _place(law: CreepLaw, row: NetRow) -> _Variant:
    """Variant of a law: where N was typed, with the slip length that means this N.

    A law without a table of N keeps the row's slip length.
    """
    ground, reason = row.ground, None
    if row.glide_factor is not None and law.name in load_glide_tables():
        try:
            ground = build_ground_from_glide_factor(
                row.glide_factor, row.snow_thickness, law.name
            )
        except ModelError as error:
            reason = error.message
    return _Variant(law=law, ground=ground, reason=reason)


def _solve(
    solver: CaseSolver, row: NetRow, case: Case, variants: Sequence[_Variant]
) -> list[CaseResult | None]:
    """Results in their order; None of a variant that is not solved."""
    solved = iter(
        solver.solve_all(
            [
                # on another ground, whatever the row's glide factor says
                (replace(row, ground=one.ground, glide_factor=None), case, one.law)
                for one in variants
                if one.reason is None
            ]
        )
    )
    return [next(solved) if one.reason is None else None for one in variants]


def _record(
    one: _Variant,
    found: CaseResult | None,
    member: str,
    own: float,
) -> VariantRecord:
    forces = found.member_forces if found and found.is_converged else {}
    values = {name: band.value for name, band in forces.items()}
    reason = one.reason
    if found is not None and member not in values:
        reason = found.reason
    return VariantRecord(
        creep_law=one.law.name,
        ratio=values[member] / own if member in values else None,
        reason=reason,
    )
