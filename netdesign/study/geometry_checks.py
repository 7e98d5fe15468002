"""Checks of a row that no force enters: its geometry, its ends, what is asked about."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from netdesign.checks import Check, OpenKind, RowGeometry, Standard, check_geometry
from netdesign.checks.comparison import compare, leave_open
from netdesign.envelope.ranges import Ranges
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow
from netdesign.study.effects import check_ends, find_effects
from netdesign.study.row_to_check import Basis
from netdesign.words.message import say

_SPACING, _UPSLOPE = "spacing", "upslope_length"


def check_row_geometry(basis: Basis) -> list[Check]:
    """Checks of a row that no force enters."""
    row, standard, ranges = basis.row, basis.standard, basis.site.ranges
    geometry = check_geometry(read_geometry(row, ranges), standard)
    ends = check_ends(find_effects(row, standard, ranges))
    return [
        *(_leave_assumed_open(row, one) for one in geometry),
        *([ends] if ends else []),
        *_list_asked(row, standard),
    ]


def _leave_assumed_open(row: NetRow, check: Check) -> Check:
    """Check of the distance of rows, open where nobody says how far the snow goes."""
    length = row.find_assumed(_UPSLOPE)
    if check.mode != _SPACING or length is None:
        return check
    lack = say("check.unsaid", names=(length.name,))
    return leave_open(_SPACING, OpenKind.VALUE_ASKED, lack)


def _list_asked(row: NetRow, standard: Standard) -> Iterator[Check]:
    """Checks that are there only while something is asked about."""
    if standard.is_default:  # nobody has named the limit profile
        lack = say("check.no_profile", profile=standard.id)
        asked = leave_open("profile", OpenKind.VALUE_ASKED, lack)
        yield replace(asked, id="profile.named")
    if row.questions:
        sheet = say("sheet.Declared")
        finding = say("check.questions", questions=row.questions, sheet=sheet)
        asked = compare("plausible", Verdict.NOT_PROVEN, finding)
        asked = asked.with_open(OpenKind.VALUE_ASKED, *row.questions)
        yield replace(asked, id="inputs.plausible")


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
