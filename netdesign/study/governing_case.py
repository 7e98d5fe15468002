"""The governing case of a row: its drawing, laws that it obeys, other creep laws."""

from __future__ import annotations

import math
from dataclasses import replace

from netdesign.cable.net import (
    compute_end_directions,
    compute_ratio_bounds,
    compute_turning_angles,
)
from netdesign.checks.check import Check
from netdesign.coupling.solution import SolvedState
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


BALANCE = 1e-3  # of a largest force or of the weight: tight enough for print
DIRECTION = 2e-2  # pulls are those of two meshes, the shape that of the finer one
DIRECTION_ERRORS = 3.0  # or so many times the relative error of the end's pull
RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces


def record_independent(
    row: NetRow, result: CaseResult | None
) -> list[IndependentRecord]:
    """Laws that a converged case has to obey; none where it has no solution.

    A law without a value is not met. Friction without a bound holds any ratio of
    tensions.
    """
    if result is None or result.solution is None:
        return []
    state, width = result.solution, row.layout.post_spacing
    balance = state.balance
    smallest = balance.smallest_tension or 0.0
    share = float(smallest / state.tension_max)
    sine, largest_sine = _measure_ends(state)
    held = _limit_ratio(state, result.case.friction_angle)
    ratio = float(state.tension_max / smallest) if smallest > 0.0 else None
    is_held = ratio is not None and (held is None or ratio <= held * (1.0 + RATIO))
    laws = [
        _limit("global_balance", balance.relative_residual, BALANCE),
        _limit("friction_excess", balance.friction_excess, BALANCE),
        _limit("end_direction", sine, largest_sine),
        IndependentRecord(
            name="capstan_ratio", value=ratio, limit=held, is_met=is_held
        ),
        IndependentRecord(
            name="tension_share", value=share, limit=0.0, is_met=share > 0.0
        ),  # a net does not push
    ]
    if result.anchors is not None:
        pull = (state.head.x * width, state.head.y * width)
        missing = _measure_open_head(pull, result.anchors)
        if missing is not None:
            laws.append(_limit("head_balance", missing, BALANCE))
    return laws


def _limit(name: str, value: float | None, limit: float) -> IndependentRecord:
    """Law of a value that lies within a limit."""
    value = None if value is None else float(value)
    is_met = value is not None and abs(value) <= limit
    return IndependentRecord(name=name, value=value, limit=limit, is_met=is_met)


def _measure_ends(state: SolvedState) -> tuple[float, float]:
    """Sine of the larger angle between an end's pull and the net's end, and its limit.

    Both without a unit.
    """
    leaving = compute_end_directions(state.net_curve)
    ends = zip((state.foot, state.head), leaving, strict=True)
    sines = [abs(pull.x * y - pull.y * x) / pull.size for pull, (x, y) in ends]
    errors = [
        DIRECTION_ERRORS * pull.error / pull.size for pull in (state.foot, state.head)
    ]
    return max(sines), max(DIRECTION, *errors)


def _limit_ratio(state: SolvedState, friction_angle: float) -> float | None:
    """Ratio of the largest tension to the smallest that friction can hold, (C12)."""
    turns = compute_turning_angles(state.net_curve)
    bound = float(compute_ratio_bounds(turns, math.tan(friction_angle)).sum())
    return math.exp(bound) if bound < 100.0 else None


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
    laws = [law for law in CREEP_LAWS.values() if law.name != solver.law.name]
    grounds = [(law, _find_ground(law, placed)) for law in laws]
    solved = iter(
        solver.solve_all(
            [
                # on another ground, whatever the row's glide factor says
                (replace(placed, ground=ground, glide_factor=None), case, law)
                for law, ground in grounds
                if isinstance(ground, GroundLaw)
            ]
        )
    )
    return ModelFormRecord(
        case=record_point(result.case),
        member=member,
        force_kN=kilonewton_from_newton(own.value),
        utilisation=check.utilisation,
        variants=[
            _record_refused(law, ground)
            if isinstance(ground, Message)
            else _record(law, next(solved), member, own.value)
            for law, ground in grounds
        ],
    )


def _find_ground(law: CreepLaw, row: NetRow) -> GroundLaw | Message:
    """Ground with the slip length by which a law means the typed N, or why it has none.

    A law without a table of N keeps the row's slip length.
    """
    if row.glide_factor is None or law.name not in load_glide_tables():
        return row.ground
    try:
        return build_ground_from_glide_factor(
            row.glide_factor, row.snow_thickness, law.name
        )
    except ModelError as error:
        return error.message


def _record_refused(law: CreepLaw, reason: Message | None) -> VariantRecord:
    return VariantRecord(creep_law=law.name, ratio=None, reason=reason)


def _record(
    law: CreepLaw, result: CaseResult, member: str, own: float
) -> VariantRecord:
    force = result.member_forces.get(member) if result.is_converged else None
    if force is None:
        return _record_refused(law, result.reason)
    return VariantRecord(creep_law=law.name, ratio=force.value / own)
