"""The use case: site -> envelope -> checks -> study.

Here SI values become the engineer's units of ``study/records.py``.
"""

from __future__ import annotations

import importlib.metadata
import math
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import repeat
from types import MappingProxyType
from typing import Protocol

from netdesign import __version__
from netdesign.checks import Standard
from netdesign.coupling.solution import RELEASED
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.envelope.search import Wave
from netdesign.outcome import Verdict, merge_verdicts
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import ICE_DENSITY, CreepLaw
from netdesign.solving.runner import Runner
from netdesign.structure.layout import place_support
from netdesign.structure.members import REPORTED_MEMBERS, Member
from netdesign.study.cases import CheckRun, follow_site, search_site, solve_site
from netdesign.study.effects import RowEffects, find_effects
from netdesign.study.members import RowTask, check_row, record_point
from netdesign.study.probe import Probe
from netdesign.study.record_envelope import record_envelope
from netdesign.study.record_guideline import record_guideline
from netdesign.study.record_independent import record_independent
from netdesign.study.record_support import record_anchors, record_head
from netdesign.study.records import (
    SCHEMA,
    Arrow,
    CaseRecord,
    CheckRecord,
    Drawing,
    ExtremeRecord,
    IndependentRecord,
    MonitoringRecord,
    ProfileRecord,
    ProfileValue,
    Provenance,
    RowStudy,
    Study,
)
from netdesign.units import (
    degree_from_radian,
    kilonewton_from_newton,
    newton_from_kilonewton,
)
from netdesign.words.message import Message, say
from netdesign.words.names import name, name_check, name_member

_LIBRARIES = ("numpy", "scipy", "scikit-fem")
_DRAWN_DECIMALS = 4  # of positions in drawings: a tenth of a millimetre


class Watch(Protocol):
    """Who is told how far a check has come; ``edge.progress.RunProgress`` is one."""

    def enter(self, key: str) -> None:
        """Tell that a phase of ``cases.list_phases`` begins."""

    def tell_wave(self, wave: Wave) -> None:
        """Tell that a wave of the search is over."""

    def count_piece(self) -> None:
        """Tell that a check of a force is finished."""


class _Nobody:
    """Watch of a check whose progress nobody asks for."""

    def enter(self, key: str) -> None: ...
    def tell_wave(self, wave: Wave) -> None: ...
    def count_piece(self) -> None: ...


def check_site(
    site: Site,
    standards: Sequence[Standard],
    run: CheckRun,
    runner: Runner | None = None,
    watch: Watch | None = None,
) -> list[Study]:
    """Check a site against limit profiles; its cases are solved once.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    standards : sequence of Standard
        Limit profiles.
    run : CheckRun
        Settings and identity of the run.
    runner : Runner, optional
        Where cases are solved and kept; this process unless told otherwise. It
        remembers the faults of the program.
    watch : Watch, optional
        Told of every phase, wave and check.

    Returns
    -------
    list of Study
        One for each profile.
    """
    runner, watch = runner or Runner(), watch or _Nobody()
    envelopes: list[RowEnvelope] | None = None
    if site.ranges.is_grid:
        results = solve_site(site, run, runner)
    else:
        envelopes = search_site(site, run, runner, watch.tell_wave)
        results = [list(one.results) for one in envelopes]
    watch.enter("measured")
    measured = follow_site(site, run, runner)
    watch.enter("checks")
    probe = Probe(run.settings, run.creep_law, runner)
    count = watch.count_piece
    studies = [
        judge_site(site, results, one, run, probe, measured, envelopes, count)
        for one in standards
    ]
    _keep_faults(site, results, envelopes or (), runner)
    return studies


def _keep_faults(
    site: Site,
    results: Sequence[Sequence[CaseResult]],
    envelopes: Sequence[RowEnvelope],
    runner: Runner,
) -> None:
    """Tell the runner which net rows the faults in their cases befell."""
    for row, of_row in zip(site.rows, results, strict=True):
        for result in of_row:
            runner.keep_fault(result.fault, row.id)
    for row, envelope in zip(site.rows, envelopes, strict=False):
        for one in envelope.confirmations:
            runner.keep_fault(one.confirmed.fault, row.id)


def judge_site(
    site: Site,
    results: Sequence[Sequence[CaseResult]],
    standard: Standard,
    run: CheckRun,
    probe: Probe | None = None,
    monitoring: Mapping[str, list[MonitoringRecord]] = MappingProxyType({}),
    envelopes: Sequence[RowEnvelope] | None = None,
    on_check: Callable[[], None] = lambda: None,
) -> Study:
    """Check every anchor of every net row against one profile.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    results : sequence of sequence of CaseResult
        As ``solve_site`` returns them; of searched rows their ``results``.
    standard : Standard
        Limit profile.
    run : CheckRun
        Settings and identity of the run, for the provenance.
    probe : Probe, optional
        Solves what the envelope does not hold: other creep laws, and where a check
        flips. Without it a study has neither; give the same one for each profile.
    monitoring : mapping of str to list of MonitoringRecord
        As ``follow_site`` returns it; decides nothing.
    envelopes : sequence of RowEnvelope, optional
        As ``search_site`` returns them: their upper bounds are what is checked.
    on_check : callable, optional
        Called after each check of a force.

    Returns
    -------
    Study
        Complete; a failed case is in it by name.
    """
    rows = [
        _judge_row(
            RowTask(
                site=site,
                row=row,
                results=of_row,
                standard=standard,
                probe=probe,
                envelope=searched,
                on_check=on_check,
            ),
            run,
        )
        for row, of_row, searched in zip(
            site.rows, results, envelopes or repeat(None, len(site.rows)), strict=True
        )
    ]
    rows = [replace(row, monitoring=monitoring.get(row.id, [])) for row in rows]
    return Study(
        schema=SCHEMA,
        verdict=merge_verdicts(row.verdict for row in rows),
        project=site.project,
        profile=record_profile(standard),
        rows=rows,
        range_inputs=list(site.range_inputs),
        notes=list_notes(site, run.creep_law),
        provenance=_record_provenance(site, run),
    )


def _judge_row(task: RowTask, run: CheckRun) -> RowStudy:
    row, envelope = task.row, task.envelope
    extremes = task.extremes
    checks = check_row(task)
    cases = [_record_case(result, run.creep_law, row) for result in task.results]
    effects = find_effects(row, task.standard)
    governing = _governing_result(checks, extremes)
    foot = extremes.get(Member.FOOT_ANCHOR)
    head = record_head(row, governing) if governing else []
    independent = record_independent(governing, head) if governing else []
    held = [Verdict.NOT_PROVEN for one in independent if not one.is_met]
    return RowStudy(
        id=row.id,
        verdict=merge_verdicts([*(check.verdict for check in checks), *held]),
        checks=checks,
        extremes=[
            _record_extreme(extremes[member], envelope)
            for member in REPORTED_MEMBERS
            if member in extremes
        ],
        cases=cases,
        inputs=list(row.inputs),
        drawing=_draw(row, governing),
        reasons=list_reasons(checks, independent),
        anchors=record_anchors(governing, effects) if governing else [],
        head=head,
        independent=independent,
        guideline=record_guideline(row, foot.governing) if foot else None,
        notes=[
            *list_row_notes(row, effects),
            *list_case_notes(cases),
            *_list_history_notes(extremes),
        ],
        envelope=(
            None
            if envelope is None
            else record_envelope(
                envelope, REPORTED_MEMBERS, _list_levels(checks, effects)
            )
        ),
    )


def list_reasons(
    checks: Sequence[CheckRecord], independent: Sequence[IndependentRecord]
) -> list[Message]:
    """Why a row does not pass: each check that does not, each law that is not met."""
    unproven = [
        say(
            "row.check_reason",
            check=name_check(check.member, check.mode),
            reason=check.reason,
        )
        for check in checks
        if check.verdict is not Verdict.PASS
    ]
    unmet = [
        say("row.law_not_met", law=name("law", one.name))
        for one in independent
        if not one.is_met
    ]
    return [*unproven, *unmet]


def _list_levels(
    checks: Sequence[CheckRecord], effects: RowEffects
) -> dict[str, list[tuple[str, float]]]:
    """Solved force at which each check is just met, by member [N]."""
    levels: dict[str, list[tuple[str, float]]] = {}
    for check in checks:
        if check.resistance_kN is not None and check.action_factor:
            on_row = check.action_factor * effects.factor(check.member)
            level = newton_from_kilonewton(check.resistance_kN / on_row)
            levels.setdefault(check.member, []).append((check.id, level))
    return levels


def list_row_notes(row: NetRow, effects: RowEffects) -> list[Message]:
    """What was taken for granted about this row."""
    notes = []
    if not math.isfinite(row.gap):
        notes.append(say("row.ends_free"))
    if effects.width.position == "edge":
        notes.append(say("row.edge_governs"))
    checked = {given.mode for given in row.resistances}
    if "bearing" not in checked:
        notes.append(say("row.bearing_not_checked"))
    return notes


def list_case_notes(cases: Sequence[CaseRecord]) -> list[Message]:
    """What was done otherwise than asked in some cases."""
    released = sum(case.reason == RELEASED for case in cases)
    if not released:
        return []
    return [say("row.in_cases", count=released, all=len(cases), what=RELEASED)]


def _list_history_notes(extremes: Mapping[str, Extreme]) -> list[Message]:
    """Which of steady state and history is the demand, and why, by member."""
    notes = []
    for member in REPORTED_MEMBERS:
        compared = extremes[member].governing.compared if member in extremes else None
        if compared is None:
            continue
        history, steady = (
            one.member_forces[member] for one in (compared.history, compared.steady)
        )
        reaches = {
            "history_low": kilonewton_from_newton(history.low),
            "history_high": kilonewton_from_newton(history.high),
            "steady_low": kilonewton_from_newton(steady.low),
            "steady_high": kilonewton_from_newton(steady.high),
        }
        key = "row.history_exceeds" if compared.exceeds(member) else "row.history_stays"
        notes.append(say(key, member=name_member(member), **reaches))
    return notes


def _record_extreme(extreme: Extreme, envelope: RowEnvelope | None) -> ExtremeRecord:
    coincident, upper = extreme.governing.member_forces, None
    force = extreme.force
    if envelope is not None:
        force = envelope.bound(extreme.member)
        upper = kilonewton_from_newton(envelope.upper_bound(extreme.member))
    return ExtremeRecord(
        quantity=extreme.member,
        max_kN=kilonewton_from_newton(force.value),
        low_kN=kilonewton_from_newton(force.low),
        high_kN=kilonewton_from_newton(force.high),
        case=record_point(extreme.governing.case),
        coincident_kN={
            member: kilonewton_from_newton(coincident[member].value)
            for member in REPORTED_MEMBERS
            if member != extreme.member
        },
        upper_bound_kN=upper,
    )


def _record_case(result: CaseResult, law: CreepLaw, row: NetRow) -> CaseRecord:
    forces = {
        f"{member}_kN": _kilonewton(
            result.member_forces[member].value if result.is_converged else None
        )
        for member in REPORTED_MEMBERS
    }
    solution = result.solution
    return CaseRecord(
        case=record_point(result.case),
        outcome=result.outcome,
        reason=result.reason,
        error_percent=_largest_error_percent(result),
        balance_residual=solution.balance.relative_residual if solution else None,
        is_calibrated=is_calibrated(law, row, result.case.density),
        **forces,
    )


def is_calibrated(law: CreepLaw, row: NetRow, density: float) -> bool:
    """Whether a law is given for the density of a case [kg/m3], and of each layer."""
    layers = tuple(layer.density for layer in row.layers_at(density))
    return all(law.is_calibrated(one / ICE_DENSITY) for one in layers or (density,))


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
    foot = extremes.get(Member.FOOT_ANCHOR)
    return foot.governing if foot else None


def _draw(row: NetRow, result: CaseResult | None) -> Drawing | None:
    if result is None or result.solution is None or result.anchors is None:
        return None
    solution, anchors = result.solution, result.anchors
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
            (Member.FOOT_ANCHOR, points.net_foot, anchors.foot_anchor),
            (Member.UPHILL_ANCHOR, points.uphill_anchor, anchors.uphill_anchor),
            (
                Member.DOWNHILL_ANCHOR,
                points.downhill_anchor,
                anchors.downhill_anchor,
            ),
            (Member.POST, points.post_base, anchors.post_base),
        )
    ]
    return Drawing(
        case=record_point(result.case),
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


def record_profile(standard: Standard) -> ProfileRecord:
    """Every value of a limit profile, as a study states it."""
    return ProfileRecord(
        id=standard.id,
        title=standard.title,
        edition=standard.edition,
        sha256=standard.sha256,
        version=standard.version,
        choice=standard.choice,
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
            for entry in standard.listed
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
            "method": run.method,
            "creep_law": name_law(run.creep_law),
            "accuracy": repr(settings.accuracy),  # in full: the study is solved again
            "stress_tolerance": f"{settings.stress_tolerance:g}",
            "shape_tolerance": f"{settings.shape_tolerance:g}",
            "balance_tolerance": f"{settings.balance_tolerance:g}",
        },
        libraries={
            "python": platform.python_version(),
            **{name: importlib.metadata.version(name) for name in _LIBRARIES},
        },
    )


def name_law(law: CreepLaw) -> str:
    """Name and source of a creep law, as a study states it."""
    return f"{law.name} ({law.source})"


def list_notes(site: Site, law: CreepLaw) -> list[Message]:
    """What the reader noted, and what the model does with the site's snow."""
    return [*site.notes, *_validity_notes(site, law), *_layer_notes(site)]


def _validity_notes(site: Site, law: CreepLaw) -> list[Message]:
    """Say where the creep law is used outside the densities it was fitted to."""
    low, high = (bound * ICE_DENSITY for bound in law.calibrated)
    return [
        say(
            "note.outside_calibration",
            what=what,
            least=least,
            largest=largest,
            low=low,
            high=high,
            law=law.name,
        )
        for what, least, largest in _list_density_spans(site)
        if least < low or largest > high
    ]


def _list_density_spans(site: Site) -> list[tuple[Message, float, float]]:
    """Densities over the range [kg/m3]: of uniform snow, and of each row's layers."""
    span = site.ranges["density"]
    spans = []
    if not all(row.layers for row in site.rows):
        spans.append((say("note.snow_densities"), span.low, span.high))
    for row in site.rows:
        if row.layers:
            least = min(layer.density for layer in row.layers_at(span.low))
            largest = max(layer.density for layer in row.layers_at(span.high))
            spans.append((say("note.layer_densities", row=row.id), least, largest))
    return spans


def _layer_notes(site: Site) -> list[Message]:
    """Say what the range of density does to layered snow."""
    return [
        say(
            "note.layers_scaled",
            row=row.id,
            count=len(row.layers),
            density=row.mean_density,
        )
        for row in site.rows
        if row.layers
    ]


def _kilonewton(value: float | None) -> float | None:
    return None if value is None else kilonewton_from_newton(value)
