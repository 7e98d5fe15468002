"""Creep and glide pressure in closed form, beside the forces of the coupled solve."""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.guideline.comparison import NetGeometry, place_head
from netdesign.guideline.net_pull import compute_net_pull
from netdesign.haefeli.pressure import SlabForce, compute_slab_force
from netdesign.haefeli.slab import Slab, find_linear_slip
from netdesign.outcome import ModelError
from netdesign.site.model import NetRow
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.ground import DEFAULT_CREEP_LAW, load_glide_tables
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import place_support
from netdesign.structure.members import Member
from netdesign.study.floor import build_geometry
from netdesign.study.opinion_records import SlabCase, SlabRecord
from netdesign.study.record_cases import record_point
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message


def record_slab(row: NetRow, result: CaseResult, law: CreepLaw) -> SlabRecord | None:
    """Record the closed form against one solved case of a row.

    None where the case has no solution to compare with, or its snow no closed form.
    """
    solution = result.solution
    if solution is None or not result.is_converged:
        return None
    load = solution.foot.x + solution.head.x
    foot = result.member_forces[Member.FOOT_ANCHOR].value
    return compare_slab(row, result.case, law, load=load, foot=foot)


def compare_slab(
    row: NetRow, case: Case, law: CreepLaw, *, load: float, foot: float
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
    foot = forces.get(Member.FOOT_ANCHOR)
    return SlabCase(
        name=name,
        slip_length_m=slip if math.isfinite(slip) else None,
        influence_length_m=(
            force.influence_length if math.isfinite(force.influence_length) else None
        ),
        dynamic_kN_per_m=kilonewton_from_newton(force.dynamic),
        at_rest_kN_per_m=kilonewton_from_newton(force.at_rest),
        wedge_kN_per_m=kilonewton_from_newton(force.wedge),
        load_kN_per_m=kilonewton_from_newton(force.total),
        foot_anchor_kN=kilonewton_if_known(foot),
        uphill_guy_kN=kilonewton_if_known(forces.get(Member.UPHILL_GUY)),
        post_kN=kilonewton_if_known(forces.get(Member.POST)),
        load_difference_percent=_compare(solved[0], force.total),
        foot_difference_percent=_compare(solved[1], foot),
        reason=reason,
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
    anchors = compute_anchor_forces(
        place_support(net.layout, place_head(net)),
        foot_pull_per_m=pull.foot,
        head_pull_per_m=pull.head,
        post_spacing=net.layout.post_spacing,
    )
    if isinstance(anchors, FailedSupport):
        return {}, anchors.reason
    return dict(anchors.member_forces), None


def _compare(solved: float, other: float | None) -> float | None:
    return 100.0 * (solved / other - 1.0) if other else None
