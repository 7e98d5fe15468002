"""What a net row leaves open, and what stands for it.

An empty cell of net, snow or support is a range: `empty_cells.py`. What verdicts lack
else is listed once by `list_missing`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product

from netdesign.panel.inputs import (
    OF_BREAKING,
    STIFFNESSES,
    Ends,
    Panel,
    find_stiffness,
    list_panels,
)
from netdesign.resistance.catalogue import load_catalogue
from netdesign.resistance.ground import AnchorType
from netdesign.resistance.steel import Link
from netdesign.site.anchor_types import ANCHORS
from netdesign.site.lines import Types
from netdesign.site.model import NetRow, Resistance
from netdesign.site.readings import Row
from netdesign.site.type_resistances import find_breaking
from netdesign.structure.members import (
    CONNECTED,
    END_ANCHORS,
    LIFTED_MODE,
    MEMBER_MODES,
    NAMED_BY,
    EndMember,
    Member,
)
from netdesign.words.message import Message, say
from netdesign.words.names import name_check, name_member

_ROPES = ("ridge_rope", "lower_rope")
# Columns that name a type of a support.
TYPES = tuple(dict.fromkeys(NAMED_BY.get(member, member) for member, _ in MEMBER_MODES))


def build_panels(row: Row, ropes: Mapping[str, Row]) -> tuple[Panel, ...]:
    """Panels that a net row may have; what is not given is assumed.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row.
    ropes : mapping of str to mapping of str to Reading
        Lines of ropes by id.
    """
    ridge, lower = (ropes.get(row[key].word) for key in _ROPES)
    return list_panels(
        row["post_spacing"].si,
        sags=(row["ridge_sag"].given_si, row["lower_sag"].given_si),
        stiffnesses=(_find_stiffness(ridge), _find_stiffness(lower)),
        has_mid_anchors=row["mid_anchors"].word == "yes",
    )


def list_open_ropes(row: Row, ropes: Mapping[str, Row]) -> tuple[str, ...]:
    """Types of the border ropes of a row whose stiffness is not given."""
    type_ids = dict.fromkeys(row[key].word for key in _ROPES if row[key].word)
    lacking = (
        type_id
        for type_id in type_ids
        if ropes[type_id]["axial_stiffness"].state != "given"
    )
    return tuple(lacking)


def list_stiffnesses(at_end: Row, types: Types) -> tuple[tuple[float, ...], ...]:
    """Stiffnesses EA that uphill guy, downhill guy, end guy and post may have [N].

    Ropes without a stiffness are of one construction: their EA is the same multiple of
    their breaking force, or equal where none has a type. A rope without a type beside
    others has either end of all that is built.
    """
    guys = (Member.UPHILL_GUY, Member.DOWNHILL_GUY, EndMember.END_GUY)
    lines = [types["ropes"].get(at_end[guy].word) for guy in guys]
    alike = [
        _list_rope_stiffnesses(lines, multiple) for multiple in _list_multiples(lines)
    ]
    ropes = dict.fromkeys(chain.from_iterable(product(*spans) for spans in alike))
    post = _find_post_stiffness(types["posts"].get(at_end[Member.POST].word))
    return tuple(
        (*of_ropes, of_post) for of_ropes in ropes for of_post in dict.fromkeys(post)
    )


def _list_multiples(lines: Sequence[Row | None]) -> Sequence[float]:
    """EA over the breaking force: of the ropes that have both, else of all ropes."""
    multiples = [
        line["axial_stiffness"].si / force
        for line in lines
        if line
        and line["axial_stiffness"].state == "given"
        and (force := find_breaking(line))
    ]
    return multiples or OF_BREAKING


def _list_rope_stiffnesses(
    lines: Sequence[Row | None], multiple: float
) -> list[Sequence[float]]:
    """EA that each rope may have in one construction [N]: uphill, downhill, end guy."""
    stiffnesses: list[float | None] = []
    for line in lines:
        force = find_breaking(line) if line else None
        typed = line["axial_stiffness"].given_si if line else None
        stiffnesses.append(typed or (multiple * force if force else None))
    if all(stiffness is None for stiffness in stiffnesses):
        return [(math.sqrt(math.prod(STIFFNESSES)),)] * len(stiffnesses)
    return [
        STIFFNESSES if stiffness is None else (stiffness,) for stiffness in stiffnesses
    ]


_POST_AREAS = (5e-4, 2e-2)  # that are built [m2]


def _find_post_stiffness(line: Row | None) -> Ends:
    """Least and largest EA of a post's type [N]; without an area that of all posts."""
    area = line["area"].given_si if line else None
    low, high = _POST_AREAS if area is None else (area, area)
    modulus = 1e6 * load_catalogue()["buckling"]["E_MPa"]
    return modulus * low, modulus * high


def _find_stiffness(line: Row | None) -> Ends:
    """Least and largest EA of a rope's type [N]; without a type that of all ropes."""
    if line is None:
        return find_stiffness(None, None)
    return find_stiffness(line["axial_stiffness"].given_si, find_breaking(line))


def has_same_types(at_end: Row, row: Row) -> bool:
    """Whether every type at the row's end is the same as inside."""
    return all(at_end[key].word == row[key].word for key in TYPES)


def list_missing(
    row: NetRow, links: Mapping[str, tuple[Link, ...]]
) -> tuple[Message, ...]:
    """Names of what a verdict on a net row lacks, each once.

    A member without a type is named itself, else the check whose resistance is not
    given, and each chain whose links are not given.

    What an approval proves is not asked for. Where nothing of the structure is given,
    only that is said.

    Parameters
    ----------
    row : NetRow
        As read.
    links : mapping of str to tuple of Link
        Chains of links, by type.
    """
    lacking = [
        name_member(resistance.member)
        if not resistance.type_id and resistance.mode != "mesh"
        else name_check(resistance.member, resistance.mode)
        for resistance in find_lacking(row)
    ]
    if _is_structure_asked(row):
        lacking += _list_chains(row, links)
    elif row.approval is None or not row.approval.document:
        lacking.append(say("approval.nothing_given"))
    return tuple(dict.fromkeys(lacking))


def find_lacking(row: NetRow) -> tuple[Resistance, ...]:
    """Resistances of a net row that are not given, and that no approval proves."""
    is_structure_asked = _is_structure_asked(row)
    return tuple(
        resistance
        for resistance in _list_resistances(row)
        if (resistance.member in _ANCHORS or is_structure_asked)
        and _is_lacking(resistance)
    )


_ANCHORS = (*ANCHORS, *END_ANCHORS)


def _list_resistances(row: NetRow) -> tuple[Resistance, ...]:
    along = row.row_end.resistances if row.row_end else ()
    return (
        *(*row.resistances, *row.net_parts),
        *(*(row.end_resistances or ()), *along),
    )


def _is_structure_asked(row: NetRow) -> bool:
    """Something of the structure is given, and no approval proves it."""
    if row.approval is not None and row.approval.document:
        return False
    parts = (
        resistance
        for resistance in _list_resistances(row)
        if resistance.member not in _ANCHORS
    )
    return any(
        resistance.basis if resistance.mode == "mesh" else resistance.type_id
        for resistance in parts
    )


def _is_lacking(resistance: Resistance) -> bool:
    if resistance.mode == "mesh":
        return not resistance.basis
    if (resistance.member, resistance.mode) == LIFTED_MODE:
        return False  # asked for once some case lifts a post
    if resistance.mode == "direction" and not resistance.type_id:
        return False  # asked for once a type is named
    if isinstance(resistance.dimensions, AnchorType):
        is_bent = (
            resistance.mode == "bending" and resistance.dimensions.kind != "rope anchor"
        )
        needed = (
            resistance.dimensions.section if is_bent else resistance.dimensions.kind
        )
        return resistance.value is None and not needed
    has_value = (
        resistance.value is not None or resistance.tests or resistance.dimensions
    )
    return not (resistance.type_id and has_value)


def _list_chains(
    row: NetRow, links: Mapping[str, tuple[Link, ...]]
) -> Iterator[Message]:
    """Types of ropes and anchors whose links are not given."""
    for resistance in _list_resistances(row):
        is_rope = (
            resistance.mode in ("rope", "tendon") and resistance.member in CONNECTED
        )
        if is_rope and resistance.type_id and resistance.type_id not in links:
            yield say("links.of_type", type=resistance.type_id)
