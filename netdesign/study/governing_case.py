"""The governing case of a row: its drawing, laws that it obeys, other creep laws."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from netdesign.cable.net import (
    compute_end_directions,
    compute_ratio_bounds,
    compute_turning_angles,
)
from netdesign.checks.check import Check
from netdesign.coupling.solution import SolvedState
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
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.layout import Point, place_support
from netdesign.study.case_records import Drawing
from netdesign.study.record_envelope import record_point
from netdesign.study.records import IndependentRecord, ModelFormRecord, VariantRecord
from netdesign.study.row_to_check import CaseSolver
from netdesign.units import degree_from_radian, kilonewton_from_newton
from netdesign.words.message import Message

_DECIMALS = 4  # of positions in drawings: a tenth of a millimetre


def record_drawing(row: NetRow, result: CaseResult | None) -> Drawing | None:
    """Record the section of a case; None where it has no solution."""
    if result is None or result.solution is None or result.anchors is None:
        return None
    points = place_support(row.layout, result.solution.head_point)
    curve = result.solution.net_curve.T.round(_DECIMALS).tolist()
    return Drawing(
        case=record_point(result.case),
        slope_deg=degree_from_radian(row.slope_angle),
        snow_thickness_m=row.at(result.case).held_thickness,
        net_m=[(x, y) for x, y in curve],
        head_m=points.head,
        post_base_m=points.post_base,
        uphill_anchor_m=points.uphill_anchor,
        downhill_anchor_m=points.downhill_anchor,
    )


def record_independent(
    row: NetRow, result: CaseResult | None
) -> list[IndependentRecord]:
    """Laws that a converged case has to obey; none where it has no solution."""
    if result is None or result.solution is None:
        return []
    state, width = result.solution, row.layout.post_spacing
    checks = [
        _judge("global_balance", state.balance.relative_residual),
        _judge("friction_excess", state.balance.friction_excess),
        _check_ends(state),
        _check_capstan(state, result.case.friction_angle),
    ]
    share = (state.balance.smallest_tension or 0.0) / state.tension_max
    checks.append(_judge("tension_share", share))  # a net does not push
    if result.anchors is not None:
        pull = (state.head.x * width, state.head.y * width)
        missing = _measure_open_head(pull, result.anchors)
        if missing is not None:
            checks.append(_judge("head_balance", missing))
    return checks


def _check_ends(state: SolvedState) -> IndependentRecord:
    """Sine of the larger angle between an end's pull and the net's end there [-]."""
    leaving = compute_end_directions(state.net_curve)
    ends = zip((state.foot, state.head), leaving, strict=True)
    sines = [abs(pull.x * y - pull.y * x) / pull.size for pull, (x, y) in ends]
    errors = [
        DIRECTION_ERRORS * pull.error / pull.size for pull in (state.foot, state.head)
    ]
    return _judge("end_direction", max(sines), max(DIRECTION, *errors))


def _check_capstan(state: SolvedState, friction_angle: float) -> IndependentRecord:
    """Largest over smallest tension against what friction can hold, (C12)."""
    turns = compute_turning_angles(state.net_curve)
    bound = float(compute_ratio_bounds(turns, math.tan(friction_angle)).sum())
    limit = math.exp(bound) if bound < 100.0 else None
    smallest = state.balance.smallest_tension or 0.0
    ratio = float(state.tension_max / smallest) if smallest > 0.0 else None
    return _judge("capstan_ratio", ratio, limit)


def _measure_open_head(pull: Point, anchors: AnchorForces) -> float | None:
    """Forces on a post head that are left over, as a share of the largest one [-].

    The net's pull is that of the solve, the others are the reverse of what each member
    does to the ground: an error in the support leaves the polygon open. None where no
    member has a force.
    """
    members = (anchors.post_base, anchors.uphill_anchor, anchors.downhill_anchor)
    forces = [(-force.x, -force.y) for force in members if force.size > 0.0]
    if not forces:
        return None
    missing = math.hypot(*(sum(part) for part in zip(pull, *forces, strict=True)))
    return missing / max(math.hypot(*force) for force in (pull, *forces))


def _judge(
    name: str, value: float | None, limit: float | None = None
) -> IndependentRecord:
    value = None if value is None else float(value)
    limit = LIMITS.get(name, limit)
    return IndependentRecord(
        name=name, value=value, limit=limit, is_met=is_law_met(name, value, limit)
    )


BALANCE = 1e-3  # of a largest force or of the weight: tight enough for print
DIRECTION = 2e-2  # pulls are those of two meshes, the shape that of the finer one
DIRECTION_ERRORS = 3.0  # or so many times the relative error of the end's pull
RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces

# Largest value of each law whose limit does not depend on the case [-].
LIMITS = {
    "global_balance": BALANCE,
    "friction_excess": BALANCE,
    "head_balance": BALANCE,
    "tension_share": 0.0,  # that one lies above it
}


def is_law_met(name: str, value: float | None, limit: float | None) -> bool:
    """Whether a law is met.

    Parameters
    ----------
    name : str
        As in an ``IndependentRecord``.
    value : float or None
        Share or ratio [-]; None where there is none, which never meets a law.
    limit : float or None
        Its limit [-]; None where nothing bounds a ratio of tensions.
    """
    if value is None or (limit is None and name != "capstan_ratio"):
        return False
    if name == "tension_share":  # a net does not push
        return value > 0.0
    if name == "capstan_ratio":
        return limit is None or value <= limit * (1.0 + RATIO)
    return limit is not None and abs(value) <= limit


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
        _record(variant, result, member, own.value)
        for variant, result in zip(variants, results, strict=True)
    ]
    return ModelFormRecord(
        case=record_point(result.case),
        member=member,
        force_kN=kilonewton_from_newton(own.value),
        utilisation=check.utilisation,
        variants=records,
    )


def _place(law: CreepLaw, row: NetRow) -> _Variant:
    """Build the variant of a law, with the slip length that means the typed N.

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
    solved = iter(
        solver.solve_all(
            [
                # on another ground, whatever the row's glide factor says
                (
                    replace(row, ground=variant.ground, glide_factor=None),
                    case,
                    variant.law,
                )
                for variant in variants
                if variant.reason is None
            ]
        )
    )
    return [next(solved) if variant.reason is None else None for variant in variants]


def _record(
    variant: _Variant,
    result: CaseResult | None,
    member: str,
    own: float,
) -> VariantRecord:
    forces = result.member_forces if result and result.is_converged else {}
    values = {name: band.value for name, band in forces.items()}
    reason = variant.reason
    if result is not None and member not in values:
        reason = result.reason
    return VariantRecord(
        creep_law=variant.law.name,
        ratio=values[member] / own if member in values else None,
        reason=reason,
    )
