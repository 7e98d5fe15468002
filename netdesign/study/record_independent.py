"""Checks of one solved case against laws that hold whatever the mesh.

Forces sum up to zero, a net pulls along itself and does not push, friction bounds the
ratio of its tensions.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.cable.tension import (
    compute_end_directions,
    compute_ratio_bounds,
    compute_turning_angles,
)
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.guideline.comparison import NetGeometry, hold_net
from netdesign.guideline.net_pull import compute_net_pull
from netdesign.haefeli.pressure import SlabForce, compute_slab_force
from netdesign.haefeli.slab import Slab, find_linear_slip
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.ground import DEFAULT_CREEP_LAW, load_glide_tables
from netdesign.solving.state import SolvedState
from netdesign.structure.head import FailedSupport
from netdesign.study.record_envelope import record_point
from netdesign.study.record_guideline import build_geometry, compare_forces, find_solved
from netdesign.study.records import IndependentRecord, SlabCase, SlabRecord
from netdesign.study.support_records import HeadForce
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message


def record_slab(row: NetRow, result: CaseResult, law: CreepLaw) -> SlabRecord | None:
    """Record the closed form against one solved case of a row.

    None where the case has no solution to compare with, or its snow no closed form.
    """
    solved = find_solved(result)
    return None if solved is None else compare_slab(row, result.case, law, *solved)


def compare_slab(
    row: NetRow, case: Case, law: CreepLaw, load: float, foot: float
) -> SlabRecord | None:
    """Record the closed form against the forces of one case.

    Parameters
    ----------
    row : NetRow
        Net row.
    case : Case
        Solved case.
    law : CreepLaw
        Whose a and b are taken.
    load : float
        Along the slope on the net [N/m].
    foot : float
        Of the foot anchor [N].
    """
    row = row.at(case)
    try:
        slab = Slab(
            thickness=row.held_thickness,
            slope_angle=row.slope_angle,
            density=case.density,
            creep_law=law,
        )
        cases = [
            _record_case(row, case, slab, name, slip, (load, foot))
            for name, slip in _list_grounds(row, slab)
        ]
    except ModelError:  # snow that the law does not take: its cases say so
        return None
    return SlabRecord(
        case=record_point(case),
        poisson=slab.poisson,
        solved_load_kN_per_m=kilonewton_from_newton(load),
        solved_foot_anchor_kN=kilonewton_from_newton(foot),
        cases=cases,
    )


def _list_grounds(row: NetRow, slab: Slab) -> Iterator[tuple[str, float]]:
    """Slip lengths that stand for a row's ground in linear creep [m]."""
    ground = row.ground
    if ground.kind != "sliding":
        yield ("free", math.inf) if ground.kind == "free" else ("no_slip", 0.0)
        return
    glide = row.glide_factor
    if glide is None:
        table = load_glide_tables()[DEFAULT_CREEP_LAW]
        glide = table.find_glide_factor(ground.slip_length / row.held_thickness)
    yield "glide_factor", find_linear_slip(slab, glide)
    yield "slip_length", ground.slip_length


def _record_case(
    row: NetRow,
    case: Case,
    slab: Slab,
    name: str,
    slip: float,
    solved: tuple[float, float],
) -> SlabCase:
    force = compute_slab_force(
        slab,
        slip_length=slip,
        upslope_length=row.upslope_length,
        inclination=case.inclination,
    )
    net = build_geometry(row, case.inclination)
    forces, reason = _find_forces(net, force)
    return SlabCase(
        name=name,
        slip_length_m=slip if math.isfinite(slip) else None,
        influence_length_m=(
            force.influence_length if math.isfinite(force.influence_length) else None
        ),
        dynamic_kN_per_m=kilonewton_from_newton(force.dynamic),
        at_rest_kN_per_m=kilonewton_from_newton(force.at_rest),
        wedge_kN_per_m=kilonewton_from_newton(force.wedge),
        reason=reason,
        **compare_forces(force.total, forces, solved),
    )


def _find_forces(
    net: NetGeometry[float], force: SlabForce
) -> tuple[dict[str, float], Message | None]:
    """Forces of the members by the guideline's closed form of a net, or why none."""
    try:
        pull = compute_net_pull(
            (force.total, force.wedge_normal),
            inclination=net.inclination,
            chord=net.net_height / math.cos(net.inclination),
            loaded_share=min(net.snow_thickness / net.net_height, 1.0),
            stiffness=net.stiffness,
            slack=net.slack,
        )
    except ModelError as error:
        return {}, error.message
    anchors = hold_net(net, pull)
    if isinstance(anchors, FailedSupport):
        return {}, anchors.reason
    return dict(anchors.member_forces), None


def record_independent(
    result: CaseResult | None, head: list[HeadForce]
) -> list[IndependentRecord]:
    """Independent checks of a converged case; none where it has no solution.

    Parameters
    ----------
    result : CaseResult or None
        The drawn case; None where there is none.
    head : list of HeadForce
        As ``record_head`` gives them [kN].
    """
    if result is None or result.solution is None:
        return []
    state = result.solution
    checks = [
        _judge("global_balance", state.balance.relative_residual),
        _judge("friction_excess", state.balance.friction_excess),
        _check_ends(state),
    ]
    if state.method == "steady":  # forces of a history are its largest, not its last
        checks.append(_check_capstan(state, result.case.friction_angle))
    share = (state.balance.smallest_tension or 0.0) / state.tension_max
    checks.append(_judge("tension_share", share))  # a net does not push
    if len(head) > 1:
        checks.append(_judge("head_balance", measure_open_head(head)))
    return checks


def _check_ends(state: SolvedState) -> IndependentRecord:
    """Sine of the larger angle between an end's pull and the net's end there [-]."""
    is_curved = state.method == "steady"  # a history's net is straight between nodes
    leaving = compute_end_directions(state.net_curve, is_curved=is_curved)
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


def measure_open_head(head: list[HeadForce]) -> float:
    """Forces on a post head that are left over, as a share of the largest one [-]."""
    missing = math.hypot(
        sum(force.x_kN for force in head), sum(force.y_kN for force in head)
    )
    return missing / max(math.hypot(force.x_kN, force.y_kN) for force in head)


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
    """A law is met.

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
