"""Judgement of a site by a profile: its cases and checks as one study.

First: the governing case of a row, its drawing, other creep laws.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from netdesign import addon_table
from netdesign.checks import Standard
from netdesign.checks.check import Check
from netdesign.envelope.rows import RowEnvelope
from netdesign.envelope.run import CaseResult
from netdesign.outcome import SENTENCE, ModelError
from netdesign.site.model import NetRow, Site
from netdesign.snow.creep_law import CREEP_LAWS, CreepLaw
from netdesign.snow.ground import (
    GroundLaw,
    build_ground_from_glide_factor,
    load_glide_tables,
)
from netdesign.structure.layout import place_support
from netdesign.structure.members import ROPE_OF, Member, name_in_panel
from netdesign.study.anchor_pulls import list_parts
from netdesign.study.case_records import Drawing, record_case, record_point
from netdesign.study.conditions import list_conditions, merge_conditions
from netdesign.study.guideline_load import (
    record_guideline,
)
from netdesign.study.notes import (
    list_judged_notes,
    list_site_notes,
)
from netdesign.study.record_provenance import record_profile, record_provenance
from netdesign.study.records import (
    SCHEMA,
    ModelFormRecord,
    ReliabilityRecord,
    RowStudy,
    Study,
    VariantRecord,
)
from netdesign.study.row_checks import (
    RowChecks,
    check_row,
    distrust,
)
from netdesign.study.row_forces import RowForces
from netdesign.study.row_to_check import CaseSolver, CheckRun, RowToCheck
from netdesign.study.row_variants import gather_variants
from netdesign.study.scopes import find_worst, record_assumed
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


def judge_site(
    site: Site,
    solved: Sequence[RowEnvelope],
    standard: Standard,
    run: CheckRun,
    solver: CaseSolver | None = None,
) -> Study:
    """Check every anchor of every net row against one profile.

    Parameters
    ----------
    site : Site
        What the engineer gives.
    solved : sequence of RowEnvelope
        As ``search_site`` returns them.
    standard : Standard
        Limit profile.
    run : CheckRun
        Settings and identity of the run, for the provenance.
    solver : CaseSolver, optional
        Solves what the envelope does not hold: other creep laws. Without it a study
        has none of them; give the same one for each profile.

    Returns
    -------
    Study
        Complete; a failed case is in it by name.
    """
    rows = [
        judge_row(site, row, of_row, standard, run, solver)
        for row, of_row in zip(site.rows, solved, strict=True)
    ]
    return gather_study(site, rows, standard, run)


def gather_study(
    site: Site, rows: Sequence[RowStudy], standard: Standard, run: CheckRun
) -> Study:
    """Study of a site whose rows are judged, in their order."""
    return Study(
        schema=SCHEMA,
        project=site.project,
        profile=record_profile(standard),
        rows=list(rows),
        range_inputs=list(site.range_inputs),
        notes=list_site_notes(site, rows, run.creep_law),
        provenance=record_provenance(site, run),
        what_if=list(site.what_if),
        left_out=list(site.left_out),
    )


def judge_row(
    site: Site,
    row: NetRow,
    solved: RowEnvelope,
    standard: Standard,
    run: CheckRun,
    solver: CaseSolver | None = None,
) -> RowStudy:
    """Study of one row of a site, as ``judge_site`` makes it."""
    task = RowToCheck(
        site=site.at_row(row),
        row=row,
        standard=standard,
        law=run.creep_law,
        solved=solved,
        solver=solver,
    )
    return _record_row(task, run)


def _record_row(task: RowToCheck, run: CheckRun) -> RowStudy:
    row, variants = task.row, gather_variants(task)
    row_checks = check_row(task, variants)
    forces = _find_worst_variant(row_checks, variants)
    row_checks, model_form = _ask_other_models(task, forces, row_checks)
    checks = row_checks.checks
    governing = _governing_result(find_worst(checks), forces)
    foot = forces.extremes.get(Member.FOOT_ANCHOR)
    return RowStudy(
        id=row.id,
        checks=checks,
        cases=list(map(record_case, task.solved.results)),
        inputs=list(row.inputs),
        parts=list_parts(forces.row),
        drawing=record_drawing(forces.row, governing),
        assumed=[
            record_assumed(assumed) for assumed in row.assumed if not assumed.is_typed
        ],
        pulls=list(forces.pulls),
        forces=list(forces.largest.values()),
        guideline=record_guideline(forces.row, foot, task.standard),
        floor=forces.floor,
        model_form=model_form,
        notes=list_judged_notes(forces, checks),
        held_sideways=forces.along_row,
        end_guy=forces.at_end,
        reliability=_find_reliability(task, forces, row_checks, run),
        conditions=merge_conditions(
            condition for each in variants for condition in list_conditions(each)
        ),
    )


def _find_worst_variant(
    row_checks: RowChecks, variants: Sequence[RowForces]
) -> RowForces:
    """Variant of the most used check: its forces and its drawing are those shown."""
    worst = find_worst(row_checks.checks)
    return row_checks.judged[worst.id].forces if worst else variants[0]


def _find_reliability(
    task: RowToCheck, forces: RowForces, row_checks: RowChecks, run: CheckRun
) -> ReliabilityRecord | None:
    if not run.has_reliability:
        return None
    solver = CaseSolver(run.settings, run.creep_law)
    record = addon_table.load("--reliability", addon_table.ROW_RECORDS["reliability"])
    on_layout = task.solved.on_layout(forces.row.layout)
    at = replace(task, row=forces.row, solved=on_layout)
    made: ReliabilityRecord = record(at, forces, row_checks, solver)
    return made


def _ask_other_models(
    task: RowToCheck, forces: RowForces, row_checks: RowChecks
) -> tuple[RowChecks, ModelFormRecord | None]:
    """Checks of a row, and its governing case by other models.

    Where the program fails in one of these solves, no check by its forces passes.
    """
    form = _find_model_form(task, forces, find_worst(row_checks.checks))
    if form and any(variant.reason == SENTENCE for variant in form.variants):
        checks = [distrust(check) for check in row_checks.checks]
        row_checks = replace(row_checks, checks=checks)
    return row_checks, form


def _name_largest(check: Check) -> str:
    """Force that a check follows: of section, panel, or a rope at the row's end."""
    if check.member in ROPE_OF:
        return ROPE_OF[check.member]
    return name_in_panel(check.member) if check.is_by_panel else check.member


def _governing_result(worst: Check | None, forces: RowForces) -> CaseResult | None:
    """Case of the worst check on its layout; without any, of the largest foot force."""
    largest = _name_largest(worst) if worst else Member.FOOT_ANCHOR
    extreme = forces.extremes.get(largest)
    return extreme.governing.stand(forces.row.layout) if extreme else None


def _find_model_form(
    task: RowToCheck, forces: RowForces, worst: Check | None
) -> ModelFormRecord | None:
    if task.solver is None or worst is None:
        return None
    member = _name_largest(worst)
    governing = forces.extremes[member].governing
    return record_model_form(task.solver, forces.row, governing, member, worst)
