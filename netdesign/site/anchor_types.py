"""From lines of anchor types to what an anchor is: its kind, steel, lever, ground.

Where the steel that bends is not given, it is assumed: resistance/THEORY.md, (R9d).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TypeVar

from netdesign.outcome import ModelError
from netdesign.resistance.ground import AnchorType, Soil
from netdesign.resistance.steel import HEAD_GRADE, RoundSection, find_ground_lever
from netdesign.site.lines import Types
from netdesign.site.readings import Row
from netdesign.site.type_resistances import SOIL_COLUMNS, find_steel
from netdesign.structure.members import END_ANCHORS, NAMED_BY, EndMember, Member
from netdesign.structure.row_position import find_axis_at_dip

ANCHORS = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
AnyMember = TypeVar("AnyMember", Member, EndMember)


def name_column(member: str) -> str:
    """Column of a net row or of its net type that names the type of a member."""
    return "end_anchor" if member in END_ANCHORS else NAMED_BY.get(member, member)


def read_axes(
    row: Row, members: Iterable[AnyMember], types: Types
) -> tuple[tuple[AnyMember, float], ...]:
    """Axes against the slope of those anchors whose bores dip by their type [rad]."""
    lines, slope = types["anchor_types"], row["slope_angle"].si
    lines_by_member = (
        (member, lines.get(row[name_column(member)].word)) for member in members
    )
    return tuple(
        (member, find_axis_at_dip(line["dip"].si, slope, member))
        for member, line in lines_by_member
        if line and line["dip"].state == "given"
    )


def read_anchors(
    row: Row, members: Iterable[AnyMember], types: Types
) -> tuple[tuple[AnyMember, AnchorType], ...]:
    """Kind and steel of those anchors of a row whose type is in its sheet."""
    lines, ground = types["anchor_types"], row["ground"].word
    lines_by_member = (
        (member, lines.get(row[name_column(member)].word)) for member in members
    )
    return tuple(
        (member, read_anchor(line, ground)) for member, line in lines_by_member if line
    )


def read_anchor(line: Row, ground: str) -> AnchorType:
    """Anchor of a type, in the ground of that type, else in that of the row."""
    has_tube = line["tube_diameter"].state == "given"
    section, word = _build_section(line), line["ground"].word or ground
    typed = line["lever_arm"].given_si  # else the longest usual free length
    return AnchorType(
        kind=line["kind"].word,
        section=section,
        lever=_FREE * section.outer if typed is None and section else typed,
        is_lever_assumed=typed is None,
        ground_lever=find_ground_lever(section, word) if section else 0.0,
        has_tube=has_tube,
        across=line["head_across"].given_si,
        drilled=line["drilled_length"].given_si,
        bond=line["bond_length"].given_si,
        soil=_read_soil(line),
    )


def _read_soil(line: Row) -> Soil | None:
    """Strength of the ground around an anchor; None unless all of it is given."""
    cohesion, friction, weight = (line[key].given_si for key in SOIL_COLUMNS)
    if cohesion is None or friction is None or weight is None:
        return None
    return Soil(
        cohesion=cohesion,
        friction=friction,
        weight=weight,
        is_drained=line["soil_water"].word == "drained",
    )


def _build_section(line: Row) -> RoundSection | None:
    """Steel that bends: a tube at the head, else the anchor's own.

    None of a rope, without the dimensions, and of dimensions that no section has.
    """
    tube, wall = line["tube_diameter"].given_si, line["tube_wall"].given_si
    try:
        if tube is not None and wall is not None:
            inner = tube - 2.0 * wall
            return RoundSection(outer=tube, inner=inner, strength=HEAD_GRADE)
        return find_steel(line) or _assume_section(line)
    except ModelError:
        return None


def _assume_section(line: Row) -> RoundSection | None:
    """Solid bar with the tendon's resistance, (R9d); None where that is not given.

    Without a diameter it is as thin as the strongest steel makes it.
    """
    tendon, outer = line["tendon"].given_si, line["bar_diameter"].given_si
    if tendon is None or line["kind"].word == "rope anchor":
        return None
    if outer is None:
        outer = math.sqrt(4.0 * tendon / (math.pi * _STRONGEST))
    strength = tendon / (0.25 * math.pi * outer**2)
    return RoundSection(outer=outer, strength=strength)


_STRONGEST = 1.2e9  # of a bar, the largest usual number of its column [Pa]
_FREE = 3.0  # diameters: the longest usual free length of a bar, (R9d)
