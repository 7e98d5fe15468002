"""What proves the structure of a net row: its approval, or types with resistances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from netdesign.checks import Check, Open, OpenKind
from netdesign.checks.comparison import leave_open
from netdesign.checks.geometry import MODE, check_approval
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow
from netdesign.study.dependent import CONNECTION
from netdesign.study.effects import (
    find_altitude_factor,
    find_row_glide_factor,
    list_corners,
)
from netdesign.study.judgement import apply_declaration
from netdesign.study.row_to_check import Basis
from netdesign.study.scopes import STRUCTURE, is_of_structure
from netdesign.words.message import Message, say

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

    Where nobody gives the altitude, it may be whatever the guideline knows.
    """
    factors = [find_row_glide_factor(one) for one in list_corners(row, ranges)]
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
    """Checks of a row with one line for what is not listed of its structure.

    Inside its limits an approval proves it, and what was calculated of it is
    information. Outside, and where nothing is given of it, it is not proven.
    """
    limits = next((one for one in checks if one.mode == MODE), None)
    if limits is None:
        mine = list(filter(is_of_structure, checks))
        if any(map(_is_given, mine)) or all(map(_has_result, mine)):
            return list(checks)
        line = _leave_structure_open("resistances", say("approval.nothing_given"))
        return _replace_structure(checks, apply_declaration(basis, line))
    approval, lack = basis.row.approval, _find_lack(basis.row, limits)
    if approval is None or lack is not None:
        return _replace_structure(checks, _leave_structure_open(MODE, lack))
    proof = approval.prove()
    point = Open(kind=OpenKind.PROVEN_ELSEWHERE, message=proof.describe(), proof=proof)
    line = replace(_leave_structure_open(MODE, None), open=[point])
    return [
        _make_information(one, point) if is_of_structure(one) else one
        for one in _replace_structure(checks, line)
    ]


def _find_lack(row: NetRow, limits: Check) -> Message | None:
    """Reason why an approval does not hold for a row; None where it does."""
    if limits.verdict is not Verdict.PASS:
        return limits.reason
    return say("check.overtopped") if row.is_overtopped else None


def _leave_structure_open(mode: str, lack: Message | None) -> Check:
    lacks = () if lack is None else (lack,)
    return leave_open(mode, OpenKind.RESISTANCE_MISSING, *lacks, member=STRUCTURE)


def _is_given(check: Check) -> bool:
    """Something is given that a check of the structure rests on.

    The type of a chain is that of its anchor, which is none of the structure. Friction
    under a base of no type is assumed.
    """
    if check.resistance_type:
        return check.mode != CONNECTION
    is_rated = check.resistance_kN is not None or check.is_unbounded
    return is_rated and check.mode != _SLIDING


def _has_result(check: Check) -> bool:
    """Its numbers, or a document, say something of it."""
    return check.used is not None or check.verdict is not Verdict.NOT_PROVEN


def _replace_structure(checks: Sequence[Check], line: Check) -> list[Check]:
    """Checks of which a line stands for those of the structure without a result."""
    kept = [one for one in checks if _has_result(one) or not is_of_structure(one)]
    return [*kept, line]


def _make_information(check: Check, proof: Open) -> Check:
    """Check of what an approval proves: its numbers are information."""
    if check.declared is not None or check.member == STRUCTURE or not check.steps:
        return check
    used = check.used_band[1]
    is_beyond = used is None or used > 1.0
    finding = say("approval.beyond_by_model" if is_beyond else "approval.information")
    points = [one for one in check.open if one.kind is not OpenKind.FAILS]
    return replace(
        check, met=Verdict.NOT_PROVEN, finding=finding, open=[*points, proof]
    )
