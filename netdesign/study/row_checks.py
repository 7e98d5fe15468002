"""All checks of one net row: of forces, geometry, structure, and open questions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import (
    Check,
    Open,
    OpenKind,
    Standard,
)
from netdesign.checks.comparison import compare, leave_open
from netdesign.checks.geometry import (
    MODE,
    check_approval,
    check_gap,
    check_height,
    check_inclination,
    check_row_spacing,
    check_slope,
)
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import SEVERITY, Verdict
from netdesign.site.model import NetRow
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import Member
from netdesign.structure.splay import Guys
from netdesign.study.anchor_ground import check_anchor_distance, check_cover
from netdesign.study.best_ends import settle
from netdesign.study.guideline_load import (
    check_ends,
    find_altitude_factor,
    find_effects,
    find_row_glide_factor,
    list_corners,
)
from netdesign.study.member_checks import (
    MemberCheck,
    find_open,
    list_remedies,
)
from netdesign.study.member_force import RowForces
from netdesign.study.row_resistances import CONNECTION
from netdesign.study.row_to_check import Basis, RowToCheck
from netdesign.study.scopes import STRUCTURE, is_of_structure
from netdesign.study.worst_checks import judge_members
from netdesign.units import degree_from_radian
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class RowChecks:
    """Every check of a row, and by id how each check of a force was judged."""

    checks: list[Check]
    judged: Mapping[str, MemberCheck]


def check_row(task: RowToCheck, variants: Sequence[RowForces]) -> RowChecks:
    """Every check of a row: the members of both supports, then the geometry.

    ``variants`` are its forces at each corner of the assumed statics.
    """
    judged = settle(task, variants, judge_members(variants))
    checks = []
    for member_check in judged:
        has_force = member_check.force is not None
        changes = list_remedies(member_check) if has_force else []
        checks.append(replace(member_check.check, changes=changes))
    forces = variants[0]
    checks += [*_check_without_force(variants, judged), *check_limits(forces)]
    checks = [_apply_declaration(task, check) for check in checks]
    return RowChecks(
        checks=settle_structure(forces, checks),
        judged={member_check.check.id: member_check for member_check in judged},
    )


def distrust(check: Check) -> Check:
    """Check that passes by its forces, beside which the program failed: not proven."""
    if not check.is_of_force or check.verdict is not Verdict.PASS:
        return check
    return check.with_open(OpenKind.UNSOLVED, say("check.fault_beside"))


_SLIDING = "sliding"


def check_limits(basis: Basis) -> list[Check]:
    """Check of a row against its approval's limits; none without an approval."""
    approval = basis.row.approval
    if approval is None or not approval.document:
        return []
    actual = _find_actual(basis.row, basis.site.ranges)
    return [check_approval(approval, actual)]


def _find_actual(row: NetRow, ranges: Ranges) -> dict[str, tuple[float, float]]:
    """Least and largest value of a row by what an approval limits, SI.

    An altitude that is not given may be any that the guideline knows.
    """
    factors = [find_row_glide_factor(corner) for corner in list_corners(row, ranges)]
    altitude = find_altitude_factor(row)
    least = 1.0 if row.altitude is None else altitude
    spacing = row.layout.post_spacing
    return {
        "height": (row.net_height, row.net_height),
        "glide_factor": (min(factors), max(factors)),
        "altitude_factor": (least, altitude),
        "spacing": (spacing, spacing),
    }


def settle_structure(basis: Basis, checks: Sequence[Check]) -> list[Check]:
    """Settle the checks of the structure by the row's approval, or leave it open.

    Inside its limits the approval proves the structure, and its calculated checks are
    information. Outside them, and without any resistance, it is not proven.
    """
    limits = next((check for check in checks if check.mode == MODE), None)
    if limits is None:
        mine = list(filter(is_of_structure, checks))
        if any(map(_is_given, mine)) or all(map(_has_result, mine)):
            return list(checks)
        line = _leave_structure_open("resistances", say("approval.nothing_given"))
        return _replace_structure(checks, _apply_declaration(basis, line))
    approval, reason = basis.row.approval, _find_open_approval(basis.row, limits)
    if approval is None or reason is not None:
        return _replace_structure(checks, _leave_structure_open(MODE, reason))
    proof = approval.prove()
    point = Open(kind=OpenKind.PROVEN_ELSEWHERE, message=proof.describe(), proof=proof)
    bare = _leave_structure_open(MODE, None)
    line = replace(bare, open=[point], finding=say("approval.rest"))
    return [
        _make_information(check, point) if is_of_structure(check) else check
        for check in _replace_structure(checks, line)
    ]


def _find_open_approval(row: NetRow, limits: Check) -> Message | None:
    """Reason why an approval does not hold for a row; None where it does."""
    if limits.verdict is not Verdict.PASS:
        return limits.reason
    return say("check.overtopped") if row.is_overtopped else None


def _leave_structure_open(mode: str, reason: Message | None) -> Check:
    reasons = () if reason is None else (reason,)
    return leave_open(mode, OpenKind.RESISTANCE_MISSING, *reasons, member=STRUCTURE)


def _is_given(check: Check) -> bool:
    """A type or a resistance is given for a check of the structure.

    The type of a chain is that of its anchor, which is none of the structure. Friction
    under a base of no type is assumed.
    """
    if check.resistance_type:
        return check.mode != CONNECTION
    is_rated = check.resistance_kN is not None or check.is_unbounded
    return is_rated and check.mode != _SLIDING


def _has_result(check: Check) -> bool:
    """Its numbers or a document give a result."""
    return check.used is not None or check.verdict is not Verdict.NOT_PROVEN


def _replace_structure(checks: Sequence[Check], line: Check) -> list[Check]:
    """Checks of which a line stands for those of the structure without a result."""
    kept = [
        check for check in checks if _has_result(check) or not is_of_structure(check)
    ]
    return [*kept, line]


def _make_information(check: Check, proof: Open) -> Check:
    """Check of what an approval proves: its numbers are information."""
    if check.declared is not None or check.member == STRUCTURE or not check.steps:
        return check
    used = check.used_band[1]
    is_beyond = used is None or used > 1.0
    finding = say("approval.beyond_by_model" if is_beyond else "approval.information")
    points = [point for point in check.open if point.kind is not OpenKind.FAILS]
    return replace(
        check, met=Verdict.NOT_PROVEN, finding=finding, open=[*points, proof]
    )


_SPACING, _UPSLOPE = "spacing", "upslope_length"


def check_row_geometry(basis: Basis) -> list[Check]:
    """Checks of a row that no force enters.

    Inclination and slope are checked under every profile: without limits, or a
    plausible range, they are not proven. Theory: checks/THEORY.md.
    """
    row, standard, ranges = basis.row, basis.standard, basis.site.ranges
    span, slope, height = ranges["inclination"], row.slope_angle, row.net_height
    checks = (
        check_inclination(span.low, span.high, standard),
        check_slope(slope, standard),
        check_height(height, row.snow_thickness, standard),
        check_row_spacing(slope, height, row.upslope_length, standard),
        check_gap(row.gap, standard),
        check_ends(find_effects(row, standard, ranges)),
    )
    present = [check for check in checks if check is not None]
    asked = _list_asked(row, standard)
    return [*(_leave_assumed_open(row, check) for check in present), *asked]


def _leave_assumed_open(row: NetRow, check: Check) -> Check:
    """Leave the distance of rows open where the length of the snow is assumed."""
    length = row.find_assumed(_UPSLOPE)
    if check.mode != _SPACING or length is None:
        return check
    reason = say("check.unsaid", names=(length.name,))
    return leave_open(_SPACING, OpenKind.VALUE_ASKED, reason)


def _list_asked(row: NetRow, standard: Standard) -> Iterator[Check]:
    """List the checks that are there only while the program asks about an input."""
    if standard.is_default:  # the limit profile is not named
        reason = say("check.no_profile", profile=standard.id)
        asked = leave_open("profile", OpenKind.VALUE_ASKED, reason)
        yield replace(asked, id="profile.named")
    if row.questions:
        sheet = say("sheet.Declared")
        finding = say("check.questions", questions=row.questions, sheet=sheet)
        asked = compare("plausible", Verdict.NOT_PROVEN, finding)
        asked = asked.with_open(OpenKind.VALUE_ASKED, *row.questions)
        yield replace(asked, id="inputs.plausible")


def _check_sideways(forces: RowForces, open_cases: Message | None) -> Check:
    """Check of the load along the row; ``open_cases`` is that of the cases."""
    row, held = forces.row, forces.held
    reason = held if isinstance(held, Message) else open_cases
    share = forces.standard.find(LATERAL_SHARE)
    if reason:
        return leave_open("lateral", OpenKind.UNSOLVED, reason, member=Member.POST)
    finding = say(
        "sideways.held",
        share=100.0 * (share.value if share else 0.0),
        splay=degree_from_radian(row.guys.splay or 0.0),
    )
    return compare("lateral", Verdict.PASS, finding, member=Member.POST)


def _check_without_force(
    variants: Sequence[RowForces], judged: Sequence[MemberCheck]
) -> Iterator[Check]:
    """Checks that compare no force: load along the row, geometry; each at its worst."""
    open_cases = find_open(judged)
    yield _take_gravest(_check_sideways(forces, open_cases) for forces in variants)
    apart = _list_anchor_places(variants)
    for checks in (
        [check_anchor_distance(forces, open_cases) for forces in apart],
        [check_cover(forces) for forces in apart],
    ):
        if present := [check for check in checks if check is not None]:
            yield _take_gravest(present)
    yield from check_row_geometry(variants[0])


def _list_anchor_places(variants: Sequence[RowForces]) -> Sequence[RowForces]:
    """Variants whose anchors stand at different places, one of those that are alike."""
    apart = {_place_anchors(each.row): each for each in reversed(variants)}
    return list(apart.values())


def _place_anchors(row: NetRow) -> tuple[SupportLayout, Guys, float | None]:
    end_guy = row.row_end.guy_angle if row.row_end else None
    return row.layout, row.guys, end_guy


def _take_gravest(checks: Iterable[Check]) -> Check:
    """Check of the gravest verdict; one that does not fail everywhere is not proven."""
    every = list(checks)
    gravest = min(every, key=lambda check: SEVERITY.index(check.verdict))
    if all(check.verdict is gravest.verdict for check in every):
        return gravest
    is_fail = gravest.verdict is Verdict.FAIL
    return replace(gravest, met=Verdict.NOT_PROVEN) if is_fail else gravest


def _apply_declaration(basis: Basis, check: Check) -> Check:
    """Check with what the workbook says of it: a document that proves it elsewhere.

    Forces of a net below its snow are those of snow up to its head: information, which
    proves nothing either way. No document proves them where they fail already.
    """
    row, member = basis.row, check.member
    if row.is_overtopped and member != Member.NET:
        fails = check.verdict is Verdict.FAIL
        point = Open(kind=OpenKind.UNSOLVED, message=say("check.overtopped"))
        check = replace(check, met=Verdict.NOT_PROVEN, finding=None, open=[point])
        if fails:
            return check
    declared = basis.site.find_declaration(row, member, check.mode, check.position)
    if declared is None:
        return check
    proof = declared.proof
    kind, message = OpenKind.PROVEN_ELSEWHERE, proof.describe()
    elsewhere = Open(kind=kind, message=message, proof=proof)
    return replace(check, open=[*check.open, elsewhere])
