"""The use case: site -> envelope -> checks -> study.

Here SI values become the engineer's units of ``study.py``.
"""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal

from netdesign import __version__
from netdesign.cable.net import Net
from netdesign.checks import (
    Band,
    CheckResult,
    Standard,
    check_inclination,
    check_member,
)
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.envelope.confirm import build_history_settings, confirm_rows
from netdesign.envelope.extremes import Extreme, describe_gap, find_extremes
from netdesign.envelope.grid import Case, Ranges, build_cases
from netdesign.envelope.run import CaseResult, CaseTask, build_task, run_cases
from netdesign.monitoring import follow_monitoring
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import BOUTILLIER_2004, ICE_DENSITY, CreepLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.structure.layout import place_support
from netdesign.study import (
    SCHEMA,
    Arrow,
    CasePoint,
    CaseRecord,
    CheckRecord,
    Drawing,
    ExtremeRecord,
    MonitoringRecord,
    ProfileRecord,
    ProfileValue,
    Provenance,
    RowStudy,
    Study,
)
from netdesign.units import degree_from_radian, kilonewton_from_newton

# Members whose force is reported; each guy stands for its anchor too.
REPORTED_MEMBERS = ("foot_anchor", "uphill_guy", "downhill_guy", "post")
_METHODS = {
    "steady": "steady",
    "transient": "steady; governing cases confirmed by a history from a sagged net",
}
_LIBRARIES = ("numpy", "scipy", "scikit-fem")
_ANGLE_DECIMALS = 9  # undoes the rounding of degrees to radians and back
_DRAWN_DECIMALS = 4  # of positions in drawings: a tenth of a millimetre


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckRun:
    """How a site is to be solved."""

    settings: SolverSettings
    method: Literal["steady", "transient"] = "steady"
    creep_law: CreepLaw = BOUTILLIER_2004
    jobs: int = 1
    command: str = "netdesign check"
    started: str = ""  # ISO 8601, UTC; given, so that equal input gives equal bytes


def count_cases(site: Site) -> int:
    """Number of cases that ``solve_site`` will solve."""
    return len(site.rows) * len(build_cases(site.ranges))


def solve_site(
    site: Site, run: CheckRun, on_done: Callable[[CaseResult], None] | None = None
) -> list[list[CaseResult]]:
    """Solve all cases of all net rows; no limit profile is needed for it.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    run : CheckRun
        Settings.
    on_done : callable, optional
        Called after each case, for a progress display.

    Returns
    -------
    list of list of CaseResult
        For each row its cases in the order of the grid; failed ones are named.
    """
    cases = build_cases(site.ranges)
    tasks = [_build_tasks(row, cases, run) for row in site.rows]
    every = [task for of_row in tasks for task in of_row]
    results = run_cases(every, jobs=run.jobs, on_done=on_done)
    count = len(cases)
    by_row = [results[k * count : (k + 1) * count] for k in range(len(site.rows))]
    if run.method == "steady":
        return by_row
    settings = build_history_settings(run.settings)
    return confirm_rows(tasks, by_row, settings, jobs=run.jobs)


def follow_site(site: Site, run: CheckRun) -> dict[str, list[MonitoringRecord]]:
    """Measured series by net row, each beside a history of the middle of the ranges.

    Nothing is solved for rows without a measurement.
    """
    ranges = (site.ranges.density, site.ranges.friction_angle, site.ranges.inclination)
    density, friction_angle, inclination = ((one.low + one.high) / 2 for one in ranges)
    middle = Case(
        density=density, friction_angle=friction_angle, inclination=inclination
    )
    found = {}
    for row in site.rows:
        series = [one for one in site.monitoring if one.row_id == row.id]
        if series:
            (task,) = _build_tasks(row, [middle], run)
            found[row.id] = follow_monitoring(task, series)
    return found


def judge_site(
    site: Site,
    results: Sequence[Sequence[CaseResult]],
    standard: Standard,
    run: CheckRun,
    monitoring: Mapping[str, list[MonitoringRecord]] = MappingProxyType({}),
) -> Study:
    """Check every anchor of every net row against one profile.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    results : sequence of sequence of CaseResult
        As ``solve_site`` returns them.
    standard : Standard
        Limit profile.
    run : CheckRun
        Settings and identity of the run, for the provenance.
    monitoring : mapping of str to list of MonitoringRecord
        As ``follow_site`` returns it; decides nothing.

    Returns
    -------
    Study
        Complete; a failed case is in it by name.
    """
    rows = [
        _judge_row(row, site.ranges, of_row, standard, run.creep_law)
        for row, of_row in zip(site.rows, results, strict=True)
    ]
    rows = [replace(row, monitoring=monitoring.get(row.id, [])) for row in rows]
    return Study(
        schema=SCHEMA,
        verdict=merge_verdicts(row.verdict for row in rows),
        project=site.project,
        profile=_record_profile(standard),
        rows=rows,
        range_inputs=list(site.range_inputs),
        notes=[*site.notes, *_validity_notes(site.ranges, run.creep_law)],
        provenance=_record_provenance(site, run),
    )


def _build_tasks(row: NetRow, cases: Sequence[Case], run: CheckRun) -> list[CaseTask]:
    def build_scene(case: Case) -> Scene:
        return Scene(
            snowpack=Snowpack(
                slope_angle=row.slope_angle,
                thickness=row.snow_thickness,
                upslope_length=row.upslope_length,
                density=case.density,
            ),
            ground=row.ground,
            net=Net(
                height_normal=row.net_height,
                inclination=case.inclination,
                stiffness_per_m=row.net_stiffness_per_m,
                slack=row.slack,
                friction_angle=case.friction_angle,
            ),
            creep_law=run.creep_law,
        )

    return [build_task(case, build_scene, row.layout, run.settings) for case in cases]


def _judge_row(
    row: NetRow,
    ranges: Ranges,
    results: Sequence[CaseResult],
    standard: Standard,
    law: CreepLaw,
) -> RowStudy:
    extremes = find_extremes(results)
    gap = describe_gap(results)
    checks = [
        _record_check(
            check_member(_force_of(extremes, given.member), given, standard, gap=gap),
            extremes.get(given.member),
            given.basis,
            given.type_id,
            given.source,
        )
        for given in row.resistances
    ]
    inclination = ranges.inclination
    checks.append(
        _record_check(check_inclination(inclination.low, inclination.high, standard))
    )
    unproven = [
        f"{check.id}: {check.reason}"
        for check in checks
        if check.verdict != Verdict.PASS
    ]
    return RowStudy(
        id=row.id,
        verdict=merge_verdicts(check.verdict for check in checks),
        checks=checks,
        extremes=[
            _record_extreme(extremes[member])
            for member in REPORTED_MEMBERS
            if member in extremes
        ],
        cases=[_record_case(result, law) for result in results],
        inputs=list(row.inputs),
        drawing=_draw(row, _governing_result(checks, extremes)),
        reasons=unproven,
    )


def _force_of(extremes: Mapping[str, Extreme], member: str) -> Band | None:
    return extremes[member].force if member in extremes else None


def _record_check(
    result: CheckResult,
    extreme: Extreme | None = None,
    basis: str = "",
    type_id: str = "",
    cell: str = "",
) -> CheckRecord:
    demand, utilisation = result.demand, result.utilisation
    return CheckRecord(
        id=result.id,
        clause=result.clause,
        member=result.member,
        mode=result.mode,
        demand_kN=_kilonewton(demand.value if demand else None),
        demand_low_kN=_kilonewton(demand.low if demand else None),
        demand_high_kN=_kilonewton(demand.high if demand else None),
        resistance_kN=_kilonewton(result.design_resistance),
        utilisation=utilisation.value if utilisation else None,
        verdict=result.verdict,
        case=_record_point(extreme.governing.case) if extreme else None,
        reason=result.reason,
        action_kN=_kilonewton(result.action.value if result.action else None),
        action_factor=result.action_factor,
        resistance_characteristic_kN=_kilonewton(result.resistance),
        resistance_factor=result.resistance_factor,
        resistance_basis=basis,
        resistance_type=type_id,
        resistance_cell=cell,
    )


def _record_extreme(extreme: Extreme) -> ExtremeRecord:
    coincident = extreme.governing.member_forces
    return ExtremeRecord(
        quantity=extreme.member,
        max_kN=kilonewton_from_newton(extreme.force.value),
        low_kN=kilonewton_from_newton(extreme.force.low),
        high_kN=kilonewton_from_newton(extreme.force.high),
        case=_record_point(extreme.governing.case),
        coincident_kN={
            member: kilonewton_from_newton(coincident[member].value)
            for member in REPORTED_MEMBERS
            if member != extreme.member
        },
    )


def _record_case(result: CaseResult, law: CreepLaw) -> CaseRecord:
    forces = {
        f"{member}_kN": _kilonewton(
            result.member_forces[member].value if result.is_converged else None
        )
        for member in REPORTED_MEMBERS
    }
    solution = result.solution
    return CaseRecord(
        case=_record_point(result.case),
        outcome=result.outcome,
        reason=result.reason,
        error_percent=_largest_error_percent(result),
        balance_residual=solution.balance.relative_residual if solution else None,
        is_calibrated=law.is_calibrated(result.case.density / ICE_DENSITY),
        **forces,
    )


def _largest_error_percent(result: CaseResult) -> float | None:
    """Largest error of the two end pulls over their size, in per cent."""
    if result.solution is None:
        return None
    pulls = (result.solution.foot, result.solution.head)
    return 100.0 * max(pull.error / pull.size for pull in pulls)


def _governing_result(
    checks: Sequence[CheckRecord], extremes: Mapping[str, Extreme]
) -> CaseResult | None:
    """Case of the largest utilisation; without any, of the largest foot force."""
    rated = [c for c in checks if c.utilisation is not None and c.member in extremes]
    if rated:
        worst = max(rated, key=lambda check: check.utilisation or 0.0)
        return extremes[worst.member].governing
    foot = extremes.get("foot_anchor")
    return foot.governing if foot else None


def _draw(row: NetRow, result: CaseResult | None) -> Drawing | None:
    if result is None or result.solution is None or result.anchors is None:
        return None
    solution = result.solution
    points = place_support(row.layout, solution.head_point)
    curve = solution.net_curve.T.round(_DRAWN_DECIMALS).tolist()
    in_snow = len(solution.net_slides)
    sticks = [not bool(slides) for slides in solution.net_slides]
    edges = solution.mesh_nodes[:, solution.mesh_edges].round(_DRAWN_DECIMALS)
    arrows = [
        Arrow(
            member=member,
            x_m=place[0],
            y_m=place[1],
            force_x_kN=kilonewton_from_newton(force.x),
            force_y_kN=kilonewton_from_newton(force.y),
        )
        for member, place, force in (
            ("foot_anchor", points.net_foot, result.anchors.foot_anchor),
            ("uphill_anchor", points.uphill_anchor, result.anchors.uphill_anchor),
            ("downhill_anchor", points.downhill_anchor, result.anchors.downhill_anchor),
            ("post", points.post_base, result.anchors.post_base),
        )
    ]
    return Drawing(
        case=_record_point(result.case),
        slope_deg=degree_from_radian(row.slope_angle),
        snow_thickness_m=row.snow_thickness,
        net_m=[(x, y) for x, y in curve],
        sticks=sticks + [True] * (len(curve) - in_snow),
        mesh_edges_m=[
            (float(x0), float(y0), float(x1), float(y1))
            for (x0, x1), (y0, y1) in zip(edges[0].T, edges[1].T, strict=True)
        ],
        head_m=points.head,
        post_base_m=points.post_base,
        uphill_anchor_m=points.uphill_anchor,
        downhill_anchor_m=points.downhill_anchor,
        arrows=arrows,
    )


def _record_point(case: Case) -> CasePoint:
    return CasePoint(
        density_kg_m3=case.density,
        friction_deg=round(degree_from_radian(case.friction_angle), _ANGLE_DECIMALS),
        inclination_deg=round(degree_from_radian(case.inclination), _ANGLE_DECIMALS),
    )


def _record_profile(standard: Standard) -> ProfileRecord:
    return ProfileRecord(
        id=standard.id,
        title=standard.title,
        edition=standard.edition,
        sha256=standard.sha256,
        values=[
            ProfileValue(
                id=entry.id,
                clause=entry.clause,
                text=entry.text,
                value=entry.value,
                unit=entry.unit,
                status=entry.status,
                source=entry.source,
            )
            for entry in standard.values
        ],
    )


def _record_provenance(site: Site, run: CheckRun) -> Provenance:
    settings = run.settings
    return Provenance(
        version=__version__,
        command=run.command,
        started=run.started,
        site_file=site.file_name,
        site_sha256=site.sha256,
        settings={
            "method": _METHODS[run.method],
            "creep law": f"{run.creep_law.name} ({run.creep_law.source})",
            "accuracy": f"{settings.accuracy:g}",
            "stress tolerance": f"{settings.stress_tolerance:g}",
            "shape tolerance": f"{settings.shape_tolerance:g}",
            "balance tolerance": f"{settings.balance_tolerance:g}",
        },
        libraries={
            "python": platform.python_version(),
            **{name: importlib.metadata.version(name) for name in _LIBRARIES},
        },
    )


def _validity_notes(ranges: Ranges, law: CreepLaw) -> list[str]:
    """Say where the creep law is used outside the densities it was fitted to."""
    low, high = (bound * ICE_DENSITY for bound in law.calibrated)
    if low <= ranges.density.low and ranges.density.high <= high:
        return []
    return [
        f"snow densities of {ranges.density.low:g} to {ranges.density.high:g} kg/m3 "
        f"reach outside the {low:.0f} to {high:.0f} kg/m3 for which the creep law "
        f"{law.name} is given"
    ]


def _kilonewton(value: float | None) -> float | None:
    return None if value is None else kilonewton_from_newton(value)
