"""From lines of sheet Anchors to what an anchor is: its kind, steel, lever, ground.

What nobody gives of the steel that bends is assumed: resistance/THEORY.md, (R9d).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeVar

from netdesign.outcome import ModelError
from netdesign.resistance.ground import AnchorType, Soil
from netdesign.resistance.steel import HEAD_GRADE, RoundSection, find_ground_lever
from netdesign.site.lines import Types
from netdesign.site.readings import Row
from netdesign.site.type_resistances import SOIL_COLUMNS, lacks_inner, read_inner
from netdesign.structure.members import EndMember, Member

AXES = {
    Member.FOOT_ANCHOR: "foot_axis",
    Member.UPHILL_ANCHOR: "uphill_axis",
    Member.DOWNHILL_ANCHOR: "downhill_axis",
}
AnyMember = TypeVar("AnyMember", Member, EndMember)


def read_axes(row: Row) -> tuple[tuple[Member, float], ...]:
    """Inclinations of those anchors that have one given [rad]."""
    given = ((member, row[key].given_si) for member, key in AXES.items())
    return tuple((member, axis) for member, axis in given if axis is not None)


def read_anchor_types(row: Row, types: Types) -> tuple[tuple[Member, AnchorType], ...]:
    """Kind and steel of each anchor whose type is in its sheet."""
    ground = row["ground"].word
    return tuple(read_anchors(row, tuple(AXES), types, ground).items())


def read_anchors(
    row: Row, members: Sequence[AnyMember], types: Types, ground: str
) -> dict[AnyMember, AnchorType]:
    """Kind and steel of those anchors of a line whose type is in its sheet."""
    lines = types["Anchors"]
    return {
        member: _read_anchor(lines[row[member].word], ground)
        for member in members
        if row[member].word in lines
    }


def _read_anchor(line: Row, ground: str = "") -> AnchorType:
    """What an anchor is, in the ground of its type, else of its row."""
    has_tube = line["tube_diameter"].state == "given"
    section, word = _build_section(line), line["ground"].word or ground
    return AnchorType(
        kind=line["kind"].word,
        section=section,
        lever=_find_lever(line, section),
        is_lever_assumed=line["lever_arm"].state != "given",
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

    None of a rope, of what nobody gives, and of dimensions that
    ``check_support_types`` refused.
    """
    tube, wall = line["tube_diameter"].given_si, line["tube_wall"].given_si
    try:
        if tube is not None and wall is not None:
            inner = tube - 2.0 * wall
            return RoundSection(outer=tube, inner=inner, strength=HEAD_GRADE)
        outer, strength = line["bar_diameter"].given_si, line["bar_strength"].given_si
        if outer is None or strength is None or lacks_inner(line):
            return _assume_section(line)
        return RoundSection(outer=outer, inner=read_inner(line), strength=strength)
    except ModelError:
        return None


def _assume_section(line: Row) -> RoundSection | None:
    """Solid bar with the tendon's resistance, (R9d); None where that is not given.

    As thin as the strongest steel makes it, where nobody gives its diameter.
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


def _find_lever(line: Row, section: RoundSection | None) -> float | None:
    """Free length over which an anchor bends; the longest usual one if not given."""
    given = line["lever_arm"].given_si
    if given is not None or section is None:
        return given
    return _FREE * section.outer
