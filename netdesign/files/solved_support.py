"""Forces of a scene's support: by the section, by the panel, and at the row's end.

The same functions that a site's cases go through make them, bands included.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.coupling.solution import Solution
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.ranges import build_case
from netdesign.envelope.run import CaseResult, CaseTask, resolve_case
from netdesign.files.support_tables import GivenSupport
from netdesign.panel.row_forces import EndForces, compute_end_forces
from netdesign.panel.solution import RopeForces
from netdesign.solving.solve import Settings
from netdesign.solving.state import keep_state
from netdesign.solving.workers import Job
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.layout import Point, place_support
from netdesign.structure.members import SOLVED_MEMBERS, name_in_panel
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import Language, render


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SolvedSupport:
    """A scene's support under the net's pulls.

    Attributes
    ----------
    given : GivenSupport
        What it is.
    result : CaseResult
        Its forces by the section and by the panel, or why there are none.
    end : EndForces or None
        Of the row's end; None without a panel.
    """

    given: GivenSupport
    result: CaseResult
    end: EndForces | None


def resolve_support(
    solution: Solution, settings: Settings, given: GivenSupport
) -> SolvedSupport:
    """Forces of a support of the net that was solved."""
    task = CaseTask(
        case=build_case(solution.scene, {}),
        job=Job(scene=solution.scene, settings=settings),
        refusal=None,
        layout=given.layout,
        panels=(given.panel,) if given.panel else (),
    )
    result = resolve_case(task, keep_state(solution))
    return SolvedSupport(given=given, result=result, end=_find_end(given, result))


def _find_end(given: GivenSupport, result: CaseResult) -> EndForces | None:
    if result.solution is None or not isinstance(result.panel, PanelForces):
        return None
    points = place_support(given.layout, result.solution.head_point)
    end = compute_end_forces(result.panel.solution, points, given.end_guy_angle or 0.0)
    return end if isinstance(end, EndForces) else None


def write_support(solved: SolvedSupport, language: Language = "en") -> dict[str, Any]:
    """Part ``support`` of the solution document: kN on one support."""
    result = solved.result
    written: dict[str, Any] = {"plain": None, "panel": None, "row_end": None}
    if lack := result.lack:
        written["reason"] = render(lack, language)
    if result.anchors is None:
        return written
    written["plain"] = _write_forces(result, result.anchors, SOLVED_MEMBERS)
    if isinstance(result.panel, PanelForces):
        written["panel"] = _write_panel(result, result.panel)
    if solved.end is not None:
        has_guy = solved.given.end_guy_angle is not None
        written["row_end"] = _write_end(solved.end, has_guy=has_guy)
    return written


def _write_forces(
    result: CaseResult, anchors: AnchorForces, members: Sequence[str]
) -> dict[str, Any]:
    """Forces with the numerical error of each; ``members`` are keys of the bands.

    An anchor that net and uphill guy share takes both, (S7): ``foot_anchor_kN``.
    """
    foot = (anchors.foot_anchor.x, anchors.foot_anchor.y)
    bands = [result.member_forces[member] for member in members]
    head = anchors.head
    return {
        "foot_kN": _write_force(foot),
        "head_kN": _write_force(anchors.head_pull),
        "foot_anchor_kN": kilonewton_from_newton(bands[0].value),
        "post_kN": kilonewton_from_newton(head.post_compression),
        "post_foot_kN": kilonewton_from_newton(head.post_tension),
        "uphill_guy_kN": kilonewton_from_newton(head.guy_demands[0]),
        "downhill_guy_kN": kilonewton_from_newton(head.guy_demands[1]),
        "error_kN": {
            member.value: kilonewton_from_newton(band.high - band.value)
            for member, band in zip(SOLVED_MEMBERS, bands, strict=True)
        },
    }


def _write_panel(result: CaseResult, panel: PanelForces) -> dict[str, Any]:
    solved = panel.solution
    members = [name_in_panel(member) for member in SOLVED_MEMBERS]
    written = _write_forces(result, panel.anchors, members)
    if solved.panel.has_mid_anchors:
        written["mid_foot_kN"] = _write_force(solved.mid_foot)
    return {
        **written,
        "lower_rope": _write_rope(solved.lower),
        "upper_rope": _write_rope(solved.upper),
        "mid_head_drop_m": -solved.upper.mid_displacement[1],
        "foot_lift_m": solved.lower.mid_displacement[1],
    }


def _write_rope(rope: RopeForces) -> dict[str, float]:
    return {
        "H_kN": kilonewton_from_newton(rope.along),
        "T_kN": kilonewton_from_newton(rope.tension),
    }


def _write_end(end: EndForces, *, has_guy: bool) -> dict[str, Any]:
    """Forces at the row's end; those of its guy and post need the guy's angle."""
    x, y, z = map(kilonewton_from_newton, end.foot)
    return {
        "foot_kN": {
            "x": x,
            "y": y,
            "z": z,
            "size": kilonewton_from_newton(end.foot_size),
        },
        "head_along_kN": kilonewton_from_newton(end.head_along),
        "end_guy_kN": kilonewton_from_newton(end.guy_tension) if has_guy else None,
        "post_kN": kilonewton_from_newton(end.post_compression) if has_guy else None,
    }


def _write_force(force: Point) -> dict[str, float]:
    x, y = map(kilonewton_from_newton, force)
    return {"x": x, "y": y, "size": (x * x + y * y) ** 0.5}
