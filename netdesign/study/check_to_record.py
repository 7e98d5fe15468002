"""Result of a check -> its record in the study, in kN and degrees."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from netdesign.calculation.steps import list_steps
from netdesign.checks import (
    CheckResult,
    RowGeometry,
    Standard,
    check_geometry,
    check_member,
    declare,
    withhold,
)
from netdesign.checks.check import conclude, find_missing_force, not_proven
from netdesign.checks.tested import find_proof_factor
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import Verdict
from netdesign.resistance.pull_out import SingleTest
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import Member
from netdesign.structure.row_position import Position
from netdesign.study.dependent import resist
from netdesign.study.effects import check_ends, find_effects
from netdesign.study.member_force import MemberForce
from netdesign.study.pulls import lack_sharing
from netdesign.study.records import (
    CheckRecord,
    SingleTestRecord,
    TestsRecord,
)
from netdesign.study.row_to_check import Basis
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say

INCLINATION = "column.quantities.inclination"  # name of the net's inclination
FOOT_LOOSE, LOOSE_LIFTS = say("check.foot_loose"), say("check.loose_foot_lifts")
# A post of which the snow's moment leaves nothing for its force; ground that slides
# without any; a foot without hold.
UNBOUNDED = ("post_bending.too_much", "wedge.slides", LOOSE_LIFTS.key)


def record_geometry(basis: Basis) -> list[CheckRecord]:
    """Checks of a row that no force enters."""
    row, standard, ranges = basis.row, basis.standard, basis.site.ranges
    geometry = check_geometry(read_geometry(row, ranges), standard)
    ends = check_ends(find_effects(row, standard, ranges))
    results = [
        *(_leave_default_open(row, one) for one in geometry),
        *([ends] if ends else []),
        *_list_open(row, standard),
    ]
    return [record_result(basis, one) for one in results]


def _leave_default_open(row: NetRow, result: CheckResult) -> CheckResult:
    """Check of the inclination, not proven where nobody gives its range."""
    is_of_it = result.mode == "inclination" and result.verdict is Verdict.PASS
    names = [one for one in row.unsaid if one.key == INCLINATION]
    if not (is_of_it and names):
        return result
    return withhold(result, say("check.unsaid", names=tuple(names)))


def _list_open(row: NetRow, standard: Standard) -> Iterator[CheckResult]:
    """Checks that are there only while something is open."""
    if standard.is_default:  # nobody has named the limit profile
        lack = say("check.no_profile", profile=standard.id)
        yield _leave_open("profile.named", "profile", not_proven(lack))
    if row.questions:
        sheet = say("sheet.Declared")
        asked = say("check.questions", questions=row.questions, sheet=sheet)
        yield _leave_open("inputs.plausible", "plausible", asked)


def _leave_open(name: str, mode: str, reason: Message) -> CheckResult:
    return replace(conclude(mode, Verdict.NOT_PROVEN, reason), id=name)


def read_geometry(row: NetRow, ranges: Ranges) -> RowGeometry:
    """Input of a row's checks of geometry."""
    return RowGeometry(
        inclination_low=ranges["inclination"].low,
        inclination_high=ranges["inclination"].high,
        slope_angle=row.slope_angle,
        snow_thickness=row.snow_thickness,
        net_height=row.net_height,
        upslope_length=row.upslope_length,
        gap=row.gap,
    )


def _apply_declaration(basis: Basis, result: CheckResult, position: str) -> CheckResult:
    """Check on a support, if it has one, with what the workbook says of it.

    Forces of a net below its snow are those of snow up to its head: information.
    A check may be declared as proven elsewhere, unless these fail already.
    """
    row, member = basis.row, result.member
    if row.is_overtopped and member != Member.NET:
        fails = result.verdict is Verdict.FAIL
        result = withhold(result, say("check.overtopped"))
        if fails:
            return result
    declaration = basis.site.find_declaration(row, member, result.mode, position)
    return declare(result, declaration)


def judge_force(
    given: Resistance,
    force: MemberForce | None,
    standard: Standard,
    *,
    gap: Message | None,
    doubt: Message | None,
) -> CheckResult:
    """Check of a force; it fails where a moment alone is too much for a post.

    Nothing of the post is left for its force then: the utilisation has no bound. So it
    is with a loose foot that its post surely lifts.
    """
    missing = find_missing_force(gap or say("check.no_case_solved"))
    result = check_member(
        force.action if force else missing,
        given,
        standard,
        gap=gap,
        doubt=doubt,
        strength=resist(given, standard, force) if force else None,
    )
    lack = given.lack
    if lack == FOOT_LOOSE and force and force.action.low:
        lack = LOOSE_LIFTS
    if lack is None or lack.key not in UNBOUNDED:
        return result
    return replace(result, verdict=Verdict.FAIL, reason=lack, is_unbounded=True)


def doubt_ground(row: NetRow, given: Resistance) -> Message | None:
    """Doubt that a pull-out resistance holds where nobody says in which ground."""
    names = row.list_unsaid_grounds(given)
    return say("check.no_ground", names=names) if names else None


def doubt_sharing(row: NetRow, given: Resistance) -> Message | None:
    """Doubt about an anchor of which nobody says whether it holds two guys."""
    of_guys = (Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
    return lack_sharing(row.guys) if given.member in of_guys else None


def record_result(
    basis: Basis,
    result: CheckResult,
    position: Position | None = None,
    given: Resistance | None = None,
    force: MemberForce | None = None,
) -> CheckRecord:
    """Check as the study has it, without its case and what would change it.

    That of a member on a support has its ``position``; what is declared of it holds.
    """
    result = _apply_declaration(basis, result, position or "")
    return CheckRecord(
        id=f"{result.id}.end" if position == "edge" else result.id,
        position=position or "",
        clause=result.clause,
        member=result.member,
        mode=result.mode,
        demand_kN=result.find_value("E_d"),
        resistance_kN=result.find_value("R_d"),
        utilisation=result.find_value("μ"),
        verdict=result.verdict,
        case=None,
        reason=result.reason,
        governs=force.governs if force else "",
        resistance_basis=given.basis if given else "",
        resistance_type=given.type_id if given else "",
        resistance_cell=given.source if given else "",
        resistance_derivation=given.derivation if given else None,
        tests=_record_tests(given, basis.standard) if given else None,
        steps=[] if result.used is None else list_steps(result.used),
        declared=result.declared,
        is_unbounded=result.is_unbounded,
    )


def _record_tests(given: Resistance, standard: Standard) -> TestsRecord | None:
    tests = given.tests
    if tests is None or given.value is not None:
        return None
    return TestsRecord(
        count=tests.count,
        least_kN=kilonewton_from_newton(tests.least),
        mean_kN=kilonewton_from_newton(tests.mean),
        singles=[_record_single(one) for one in tests.singles],
        proof_factor=find_proof_factor(standard),
    )


def _record_single(test: SingleTest) -> SingleTestRecord:
    proof, moved = test.proof_load, test.displacement
    return SingleTestRecord(
        cell=test.source,
        load_kN=kilonewton_from_newton(test.load),
        is_held=test.is_held,
        proof_load_kN=None if proof is None else kilonewton_from_newton(proof),
        displacement_mm=None if moved is None else 1e3 * moved,
    )
