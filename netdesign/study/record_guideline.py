"""The guideline's forces beside those of the coupled solve."""

from __future__ import annotations

from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult
from netdesign.guideline.comparison import (
    GuidelineResult,
    NetGeometry,
    compare_with_guideline,
)
from netdesign.guideline.load_model import read_load_model
from netdesign.site.model import NetRow
from netdesign.structure.members import Member
from netdesign.study.effects import find_row_glide_factor, load_guideline
from netdesign.study.record_cases import record_point
from netdesign.study.records import GuidelineCase, GuidelineRecord
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import say

# Why the two differ, by the kind of ground.
_SENTENCES = {
    "free": "guideline.on_free_ground",
    "sliding": "guideline.on_sliding_ground",
    "no-slip": "guideline.without_slip",
}


def record_guideline(row: NetRow, result: CaseResult) -> GuidelineRecord | None:
    """Record the guideline's load cases against one solved case of a row.

    None where the case has no solution to compare with.
    """
    solution = result.solution
    if solution is None or not result.is_converged:
        return None
    load = solution.foot.x + solution.head.x
    foot = result.member_forces[Member.FOOT_ANCHOR].value
    return compare_case(row, result.case, load=load, foot=foot)


def compare_case(
    row: NetRow, case: Case, *, load: float, foot: float
) -> GuidelineRecord:
    """Record the guideline's load cases against the forces of one case.

    Parameters
    ----------
    row : NetRow
        Net row.
    case : Case
        Solved case.
    load : float
        Along the slope on the net [N/m].
    foot : float
        Of the foot anchor [N].
    """
    standard = load_guideline()
    cases = compare_with_guideline(
        read_load_model(standard),
        NetGeometry(
            slope_angle=row.slope_angle,
            snow_thickness=row.snow_thickness,
            net_height=row.net_height,
            inclination=case.inclination,
            stiffness=row.net_stiffness_per_m,
            slack=row.slack,
            layout=row.layout,
        ),
        density=case.density,
        altitude=row.altitude,
        glide_factor=find_row_glide_factor(row),
    )
    return GuidelineRecord(
        profile=standard.id,
        sha256=standard.sha256,
        case=record_point(case),
        solved_load_kN_per_m=kilonewton_from_newton(load),
        solved_foot_anchor_kN=kilonewton_from_newton(foot),
        cases=[_record_case(one, load, foot) for one in cases],
        sentence=say(_SENTENCES[row.ground.kind]),
    )


def _record_case(case: GuidelineResult, load: float, foot: float) -> GuidelineCase:
    snow = case.load
    forces = case.anchors.member_forces if case.anchors else {}
    own_foot = forces.get(Member.FOOT_ANCHOR)
    return GuidelineCase(
        name=case.name,
        density_kg_m3=case.density,
        height_vertical_m=case.height_vertical,
        creep_factor=snow.creep_factor if snow else None,
        glide_factor=snow.glide_factor if snow else None,
        rigid_kN_per_m=kilonewton_if_known(snow.rigid if snow else None),
        load_kN_per_m=kilonewton_if_known(snow.resultant[0] if snow else None),
        foot_anchor_kN=kilonewton_if_known(own_foot),
        uphill_guy_kN=kilonewton_if_known(forces.get(Member.UPHILL_GUY)),
        post_kN=kilonewton_if_known(forces.get(Member.POST)),
        load_difference_percent=_compare(load, snow.resultant[0] if snow else None),
        foot_difference_percent=_compare(foot, own_foot),
        reason=case.reason,
    )


def _compare(solved: float, other: float | None) -> float | None:
    return 100.0 * (solved / other - 1.0) if other else None
