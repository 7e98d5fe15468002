"""Documents of solved cases: ``netdesign envelope --json``, and a scene's support.

A scene's support has its forces and bands from the functions that a site's cases use.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from netdesign import __version__
from netdesign.core.library import name_core
from netdesign.coupling.solution import Solution
from netdesign.envelope.extremes import Extreme, describe_gap, find_extremes
from netdesign.envelope.panel_forces import PanelForces, stand_on
from netdesign.envelope.ranges import PARAMETERS, build_case
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult, CaseTask, resolve_case
from netdesign.files.scene import SceneSupport
from netdesign.panel.row_end import EndForces, compute_end_forces
from netdesign.panel.solve import RopeForces
from netdesign.search.maxima import RESOLVED_SHARE
from netdesign.search.upper_bound import CERTAINTY
from netdesign.solving.runner import Counts
from netdesign.solving.solve import Settings, keep_state
from netdesign.solving.workers import Job
from netdesign.structure.anchors import AnchorForces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportLayout, place_support
from netdesign.structure.members import SOLVED_MEMBERS, name_in_panel
from netdesign.study.case_records import (
    record_largest,
    show_case,
    show_coincident,
)
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import Language, render
from netdesign.words.message import say

SCHEMA = "netdesign.envelope/1"
# Quantity of the document for each force that is followed.
QUANTITY_KEYS = {
    "foot": "foot_size_kN_per_m",
    "head": "head_size_kN_per_m",
    "rope": "tension_max_kN_per_m",
}


def write_envelope_document(
    envelope: RowEnvelope, counts: Counts, wall_s: float, language: Language = "en"
) -> dict[str, Any]:
    """Document of a searched envelope.

    Parameters
    ----------
    envelope : RowEnvelope
        Of the net's own tensions.
    counts : Counts
        Of the run.
    wall_s : float
        Time that the search took [s].
    language : str
        Of the reason.
    """
    task, extremes = envelope.task, envelope.extremes
    spans = ((PARAMETERS[name], span) for name, span in task.ranges.intervals)
    run = _describe_run(envelope.results, envelope.skipped, counts, wall_s)
    run["provenance"]["creep_law"] = task.scene.creep_law.name
    run["provenance"]["settings"] = {"accuracy": task.settings.accuracy}
    return {
        "schema": SCHEMA,
        "outcome": "not_proven" if envelope.gap else "bounded",
        "reason": render(envelope.gap or "", language),
        "ranges": {
            parameter.key: [parameter.show(span.low), parameter.show(span.high)]
            for parameter, span in spans
        },
        "extremes": [
            _write_bound(envelope, extremes[member], language)
            for member in QUANTITY_KEYS
            if member in extremes
        ],
        "bound": {
            "gap_asked": task.search.gap,
            "certainty": CERTAINTY,
            "resolved_share": RESOLVED_SHARE,
            "rests_on": render(say("envelope.rests_on"), language),
        },
        **run,
    }


def write_grid_document(
    results: Sequence[CaseResult],
    skipped: int,
    counts: Counts,
    wall_s: float,
    language: Language = "en",
) -> dict[str, Any]:
    """Document of a grid of cases, which has no upper bound.

    Parameters
    ----------
    results : sequence of CaseResult
        All cases.
    skipped : int
        How many of them took no solve.
    counts : Counts
        Of the run.
    wall_s : float
        Time that the cases took [s].
    language : str
        Of the reason.
    """
    reason = describe_gap(results)
    extremes = find_extremes(results)
    return {
        "schema": SCHEMA,
        "outcome": "not_proven" if reason else "sampled",
        "reason": render(reason or "", language),
        "ranges": {
            key: [min(values), max(values)]
            for key, values in _list_values(results).items()
        },
        # a grid says nothing between its cases
        "extremes": [_write_extreme(extreme, None) for extreme in extremes.values()],
        **_describe_run(results, skipped, counts, wall_s),
    }


def _describe_run(
    results: Sequence[CaseResult], skipped: int, counts: Counts, wall_s: float
) -> dict[str, Any]:
    return {
        "cases": {
            "solved": counts.solved,
            "reused": counts.reused,
            "skipped": skipped,
            "failed": sum(not result.is_converged for result in results),
            "asked": len(results),
        },
        "cost": {"wall_s": wall_s},
        "provenance": {"version": __version__, "core": name_core()},
    }


def _write_extreme(extreme: Extreme, bound: float | None) -> dict[str, Any]:
    """Largest tension with its band, its case, and those of the others there."""
    force = extreme.widened
    coincident = show_coincident(extreme, tuple(QUANTITY_KEYS))
    return {
        "quantity": QUANTITY_KEYS[extreme.member],
        "max": kilonewton_from_newton(force.value),
        "upper_bound": bound,
        "low": kilonewton_from_newton(force.low),
        "high": kilonewton_from_newton(force.high),
        "case": show_case(extreme.governing.case.values),
        "coincident": {
            QUANTITY_KEYS[other]: size for other, size in coincident.items()
        },
    }


def _write_bound(
    envelope: RowEnvelope, extreme: Extreme, language: Language
) -> dict[str, Any]:
    """The same with its bound, and with the governing case solved again."""
    force = record_largest(extreme, envelope)
    confirmation, bound = None, force.bound_kN
    if force.confirmed is not None:
        reason = render(force.confirmed.reason or "", language)
        plain = asdict(replace(force.confirmed, reason=None))
        confirmation = _per_metre(plain | {"reason": reason})
    return _write_extreme(extreme, bound) | {
        "gap": bound / force.value_kN - 1.0 if force.value_kN else 0.0,
        "confirmation": confirmation,
    }


def _list_values(results: Sequence[CaseResult]) -> dict[str, list[float]]:
    cases = [show_case(result.case.values) for result in results]
    return {key: [case[key] for case in cases] for key in (cases[0] if cases else ())}


def _per_metre(values: dict[str, Any]) -> dict[str, Any]:
    """Keys of a record whose forces are per metre of width."""
    return {
        f"{key}_per_m" if key.endswith("_kN") else key: value
        for key, value in values.items()
    }


def resolve_support(
    solution: Solution, settings: Settings, support: SceneSupport
) -> CaseResult:
    """Forces of a support of the net that was solved, by the section and the panel."""
    task = CaseTask(
        case=build_case(solution.scene, {}),
        job=Job(scene=solution.scene, settings=settings),
        refusal=None,
        layouts=(support.layout,),
        panels=(support.panel,) if support.panel else (),
    )
    return resolve_case(task, keep_state(solution))


def write_support(
    result: CaseResult, support: SceneSupport, language: Language = "en"
) -> dict[str, Any]:
    """Part ``support`` of the solution document: kN on one support."""
    written: dict[str, Any] = {"plain": None, "panel": None, "row_end": None}
    if lack := result.lack:
        written["reason"] = render(lack, language)
    if result.anchors is None:
        return written
    written["plain"] = _write_forces(result, result.anchors, SOLVED_MEMBERS)
    if result.solution and isinstance(result.panel, PanelForces):
        head = result.solution.head_point
        points = place_support(support.layout, head)
        written["panel"] = _write_panel(result, result.panel, support.layout, head)
        angle = support.end_guy_angle
        end = compute_end_forces(result.panel.solution, points, angle or 0.0)
        if isinstance(end, EndForces):
            written["row_end"] = _write_end(end, has_guy=angle is not None)
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


def _write_panel(
    result: CaseResult, panel: PanelForces, layout: SupportLayout, head: Point
) -> dict[str, Any]:
    """Forces of the first panel, without anchors in mid-panel."""
    solved, anchors = panel.solution, stand_on(layout, head, panel.pulls.ends[0])
    if isinstance(anchors, FailedSupport):
        raise ValueError("forces on a support that does not stand")
    members = [name_in_panel(member) for member in SOLVED_MEMBERS]
    written = _write_forces(result, anchors, members)
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
