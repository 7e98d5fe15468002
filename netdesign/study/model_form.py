"""Other models of the same snow on one case of a row: the spread of the model form.

Which they are, and how they are derived: snow/THEORY.md, section 7.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import (
    CREEP_LAWS,
    ICE_DENSITY,
    STATED_EXPONENTS,
    CreepLaw,
    StatedExponent,
    derive_exponent,
    require_admissible,
)
from netdesign.snow.ground import (
    GroundLaw,
    build_ground_from_glide_factor,
    load_glide_tables,
    load_glide_tables_of_exponents,
)
from netdesign.snow.law import Sides
from netdesign.structure.members import Member
from netdesign.study.record_envelope import record_point
from netdesign.study.records import CheckRecord, ModelFormRecord, VariantRecord
from netdesign.study.row_to_check import CaseSolver, is_calibrated, list_densities
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say

_NO_TENSION = 1e-6  # share of the ground's reaction: nothing to let go of
_LINEAR = 1.0  # exponent of the other slip law


@dataclass(frozen=True, slots=True, kw_only=True)
class _Variant:
    """One other model; ``reason`` tells why it needs no solve, or cannot have one."""

    kind: str
    law: CreepLaw
    stated: StatedExponent | None = None
    ground: GroundLaw
    ground_contact: Sides = "two-sided"
    reason: Message | None = None
    is_same: bool = False  # its forces are those of the study's model


def record_model_form(
    solver: CaseSolver, row: NetRow, result: CaseResult, member: str, check: CheckRecord
) -> ModelFormRecord | None:
    """Solve the governing case of a row by other models, and record the spread.

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
    check : CheckRecord
        Governing check, with its interval.

    Returns
    -------
    ModelFormRecord or None
        None where the case has no such force.
    """
    own = result.member_forces.get(member)
    if own is None or not own.value > 0.0:
        return None
    before = solver.count
    placed, case = row.at(result.case), replace(result.case, others=())
    variants = list(_list_variants(solver.law, placed, result))
    results = _solve(solver, placed, case, variants, result)
    records = [
        _record(one, found, placed, case, member, own.value)
        for one, found in zip(variants, results, strict=True)
    ]
    band = check.utilisation_band
    record = ModelFormRecord(
        case=record_point(result.case),
        member=member,
        force_kN=kilonewton_from_newton(own.value),
        low_ratio=1.0,
        high_ratio=1.0,
        utilisation=check.utilisation,
        utilisation_low=None,
        utilisation_high=None,
        numerical_low=band[0],
        numerical_high=band[1],
        solves=solver.count - before,
        variants=records,
    )
    return span_variants(record)


def span_variants(record: ModelFormRecord) -> ModelFormRecord:
    """Record with its ends, which follow from its variants."""
    ratios = [1.0, *(one.ratio for one in record.variants if one.ratio is not None)]
    low, high, used = min(ratios), max(ratios), record.utilisation
    return replace(
        record,
        low_ratio=low,
        high_ratio=high,
        utilisation_low=None if used is None else used * low,
        utilisation_high=None if used is None else used * high,
    )


def _list_variants(
    own: CreepLaw, row: NetRow, result: CaseResult
) -> Iterator[_Variant]:
    """Every creep law with every exponent but the study's own; contacts; slip law."""
    for law in CREEP_LAWS.values():
        if law.name != own.name:
            yield _place("creep_law", law, row)
        if not _is_admissible(law, row, result.case.density):
            continue  # the ratio of a and b, which decides, is that of every exponent
        for stated in STATED_EXPONENTS:
            other = derive_exponent(law, stated.exponent)
            yield replace(_place("exponent", other, row), stated=stated)
    balance = result.solution.balance if result.solution else None
    is_idle = balance is not None and balance.ground_tension_share < _NO_TENSION
    yield _Variant(
        kind="ground_contact",
        law=own,
        ground=row.ground,
        ground_contact="one-sided",
        reason=say("model.ground_is_pressed") if is_idle else None,
        is_same=is_idle,
    )
    if row.ground.kind == "sliding":
        linear = _place("slip_law", own, row, f"{own.name}-slip{_LINEAR:g}")
        yield replace(linear, ground=replace(linear.ground, slip_exponent=_LINEAR))


def _is_admissible(law: CreepLaw, row: NetRow, density: float) -> bool:
    """The law takes this snow: (N5)."""
    try:
        for one in list_densities(row, density):
            require_admissible(law, one / ICE_DENSITY)
    except ModelError:
        return False
    return True


def _place(kind: str, law: CreepLaw, row: NetRow, table: str = "") -> _Variant:
    """Variant of a law: where N was typed, with the slip length that means this N.

    ``table`` is the name of the table of N; by default that of the law. A law without
    a table keeps the row's slip length.
    """
    ground, reason, table = row.ground, None, table or law.name
    is_known = table in load_glide_tables() | load_glide_tables_of_exponents()
    if row.glide_factor is not None and is_known:
        try:
            ground = build_ground_from_glide_factor(
                row.glide_factor, row.snow_thickness, table
            )
        except ModelError as error:
            reason = error.message
    return _Variant(kind=kind, law=law, ground=ground, reason=reason)


def _solve(
    solver: CaseSolver,
    row: NetRow,
    case: Case,
    variants: Sequence[_Variant],
    result: CaseResult,
) -> list[CaseResult | None]:
    """Results in their order; None of a variant that is not solved."""
    wanted = [
        (index, one)
        for index, one in enumerate(variants)
        if one.reason is None and _find_denser(one.law, row, case) is None
    ]
    solved = solver.solve_all(
        [
            # on another ground, whatever the row's glide factor says
            (replace(row, ground=one.ground, glide_factor=None), case, one.law)
            for _, one in wanted
        ],
        [one.ground_contact for _, one in wanted],
    )
    found: list[CaseResult | None] = [
        result if one.is_same else None for one in variants
    ]
    for (index, _), one in zip(wanted, solved, strict=True):
        found[index] = one
    return found


def _find_denser(law: CreepLaw, row: NetRow, case: Case) -> Message | None:
    """Reason why an exponent is not derived for this snow; None where it is."""
    densest = max(list_densities(row, case.density))
    if law.name in CREEP_LAWS or law.is_below_branch(densest):
        return None
    return say("snow.no_exponent", law=law.name, branch=law.branch)


def _record(
    one: _Variant,
    found: CaseResult | None,
    row: NetRow,
    case: Case,
    member: str,
    own: float,
) -> VariantRecord:
    forces = found.member_forces if found and found.is_converged else {}
    values = {name: band.value for name, band in forces.items()}
    densities = list_densities(row, case.density)
    reason = one.reason or _find_denser(one.law, row, case)
    if reason is None and found is not None and member not in values:
        reason = found.reason
    return VariantRecord(
        kind=one.kind,
        creep_law=one.law.name,
        exponent=one.law.exponent,
        slip_length_m=one.ground.slip_length or None,
        stated=_describe_stated(one.stated, densities),
        is_calibrated=is_calibrated(one.law, row, case.density),
        foot_anchor_kN=kilonewton_if_known(values.get(Member.FOOT_ANCHOR)),
        uphill_guy_kN=kilonewton_if_known(values.get(Member.UPHILL_GUY)),
        post_kN=kilonewton_if_known(values.get(Member.POST)),
        ratio=values[member] / own if member in values else None,
        reason=reason,
    )


def _describe_stated(stated: StatedExponent | None, densities: Sequence[float]) -> str:
    if stated is None:
        return ""
    return "yes" if all(map(stated.is_stated_for, densities)) else "no"
