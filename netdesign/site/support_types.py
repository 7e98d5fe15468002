"""From lines of the type sheets to what each member of a row bears.

A resistance that follows the demand stays open: how an anchor bends depends on where
the pull points, how much compression a post bears on the snow against it, how its base
slides on what presses it. Here stand the dimensions that the study works it out from,
and the stiffnesses of ropes and posts.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, product
from typing import NamedTuple, TypeAlias

from netdesign.panel.inputs import (
    OF_BREAKING,
    STIFFNESSES,
    Ends,
    Panel,
    find_stiffness,
    list_panels,
)
from netdesign.resistance.catalogue import load_catalogue
from netdesign.resistance.ground import BENDING, AnchorType
from netdesign.resistance.post import PostSection
from netdesign.resistance.steel import (
    Wear,
)
from netdesign.site.assumed import assume
from netdesign.site.lines import Types
from netdesign.site.model import Resistance, RowEnd
from netdesign.site.readings import Reading, Row
from netdesign.site.type_lines import find_depth
from netdesign.site.type_resistances import (
    ANCHORS,
    SECTION,
    SOLID,
    compute_buckling,
    find_proof_limit,
    find_steel,
    find_tests,
    may_be_rope,
    name_column,
    read_anchor,
    read_anchors,
    read_axes,
    reduce_breaking,
    reduce_loop,
)
from netdesign.structure.members import (
    END_ANCHORS,
    END_MODES,
    MEMBER_MODES,
    NET_MODES,
    EndMember,
    Member,
    NetPart,
)
from netdesign.structure.splay import Guys
from netdesign.words.message import Message, say

AnyMember: TypeAlias = Member | EndMember | NetPart

# Columns that name a type of a support.
TYPE_COLUMNS = tuple(dict.fromkeys(name_column(member) for member, _ in MEMBER_MODES))
_ENDS = ("head_eccentricity", "foot_eccentricity")  # one column gives both
_BENT_POST = ("post_width", "section_modulus", *SECTION)
# By table of types: a member that takes its types, and what these may fail by.
_CATALOGUE: Mapping[str, tuple[Member, tuple[str, ...]]] = {
    "anchor_types": (Member.FOOT_ANCHOR, ("tendon", "pull_out")),
    "ropes": (Member.UPHILL_GUY, ("rope",)),
    "posts": (Member.POST, ("compression",)),
}


def read_guys(row: Row) -> Guys:
    """Guys on each side of a post, one if not given, with their splay and anchors."""
    anchors = row["guy_anchors"].word
    return Guys(
        count=row["guy_count"].given_count or 1,
        splay=row["guy_splay"].given_si,
        are_shared=anchors == "shared" if anchors else None,
    )


class _Typed(NamedTuple):
    """Member of a row: the cell that names its type, its line, what an anchor is."""

    member: AnyMember
    cell: Reading
    line: Row | None
    anchor: AnchorType | None

    def leave_open(
        self,
        mode: str,
        dimensions: AnchorType | PostSection | float | None = None,
        lack: Message | None = None,
        source: str = "",
    ) -> Resistance:
        """Resistance that follows the demand: only its dimensions are given."""
        return Resistance(
            member=self.member,
            mode=mode,
            basis="computed" if dimensions else "",
            type_id=self.cell.word,
            source=source or self.cell.place or "Rows",
            dimensions=dimensions,
            lack=lack,
        )


def _list_typed(
    row: Row, members: Iterable[AnyMember], types: Types
) -> Iterator[_Typed]:
    """Members of a row with their types, where these are given."""
    for member in members:
        cell = row[name_column(member)]
        table = cell.field.refers_to
        line = types[table].get(cell.word)
        anchor = None
        if line and table == "anchor_types":
            anchor = read_anchor(line, row["ground"].word)
        yield _Typed(member, cell, line, anchor)


def _resist_modes(
    row: Row, modes: Sequence[tuple[AnyMember, str]], types: Types
) -> Iterator[Resistance]:
    """Resistances of members in their modes; no type or no value gives None."""
    members = _list_typed(row, (member for member, _ in modes), types)
    for typed, (member, mode) in zip(members, modes, strict=True):
        if typed.line is None:
            source = typed.cell.place or "Rows"
            yield Resistance(member=member, mode=mode, source=source)
        else:
            yield _describe_type(typed.line, mode, member)


def find_resistances(row: Row, types: Types) -> tuple[Resistance, ...]:
    """Resistances of all members of a row in every mode, given or not.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row, or one with the types of its end.
    types : mapping of str to mapping of str to Row
        Lines of types by table.
    """
    of_post = (Member.POST, Member.POST_BASE, Member.POST_FOOT)
    post, base, foot = _list_typed(row, of_post, types)
    return (
        *_resist_modes(row, MEMBER_MODES, types),
        *_list_beside_axis(tuple(_list_typed(row, ANCHORS, types))),
        _bend_post(post),
        _slide(base),
        _hold_foot(foot),
    )


def _list_beside_axis(anchors: Sequence[_Typed]) -> Iterator[Resistance]:
    """Resistances of anchors that follow how they are pulled, and of their ground."""
    for typed in anchors:
        if typed.anchor is None or typed.anchor.kind != "rope anchor":  # it turns
            yield _bend_anchor(typed)
    for typed in anchors:
        if typed.line and typed.anchor and typed.anchor.soil:
            place = typed.line["soil_cohesion"].place
            yield typed.leave_open("wedge", typed.anchor, source=place)
    for typed in anchors:
        own = typed.anchor
        if own is None or own.kind not in BENDING or own.across is not None:
            yield typed.leave_open("direction", own)


def build_row_end(at_end: Row, types: Types) -> RowEnd:
    """Members that hold a row along itself, all of them, given or not.

    ``at_end`` is its line with the types of its first and last support.
    """
    anchors = tuple(_list_typed(at_end, END_ANCHORS, types))
    axes = dict(read_axes(at_end, END_ANCHORS, types))
    angle = at_end["end_guy_angle"].given_si
    sliding = at_end["ropes_at_supports"].word
    return RowEnd(
        guy_angle=assume("end_guy_angle").high if angle is None else angle,
        stiffnesses=list_stiffnesses(at_end, types),
        ropes_slide=sliding == "slide" if sliding else None,
        lateral_axis=axes.get(EndMember.LATERAL_ANCHOR),
        resistances=(
            *_resist_modes(at_end, END_MODES, types),
            *_list_beside_axis(anchors),
        ),
        anchors=read_anchors(at_end, END_ANCHORS, types),
    )


def find_net_parts(row: Row, types: Types) -> tuple[Resistance, ...]:
    """Resistances of a row's mesh, and of its border ropes."""
    strength = row["mesh_strength"]
    mesh = Resistance(
        member=NetPart.MESH,
        mode="mesh",
        source=strength.place or "Rows",
        value=strength.given_si,
        basis="declared" if strength.state == "given" else "",
    )
    ropes = tuple(pair for pair in NET_MODES if pair[0] is not NetPart.MESH)
    return mesh, *_resist_modes(row, ropes, types)


def list_catalogue(types: Types) -> tuple[Resistance, ...]:
    """Resistances of every type of the workbook, for one member that may have it.

    Resistances that follow the demand are left out: they need a member.
    """
    return tuple(
        _describe_type(line, mode, member)
        for sheet, (member, modes) in _CATALOGUE.items()
        for line in types[sheet].values()
        for mode in modes
    )


def _describe_type(line: Row, mode: str, member: AnyMember) -> Resistance:
    """Resistance of a type in one mode, given or not."""
    is_pulled, is_anchor = mode == "pull_out", "ground" in line
    tests = find_tests(line) if is_pulled else None
    value, derivation = (None, None) if tests else _find_strength(line, mode)
    strength, is_given = line[mode], value is not None
    # A report counts once sheet Declared names it; other numbers are makers' values.
    is_computed = is_pulled or strength.derivation is not None
    basis = ("computed" if is_computed else "declared") if is_given else ""
    is_strut = is_given and mode == "compression"
    is_rope = mode == "tendon" and may_be_rope(line)
    return Resistance(
        member=member,
        mode=mode,
        value=value,
        basis="tested" if tests else basis,
        type_id=line["id"].word,
        source=strength.place or line["id"].place,
        derivation=derivation,
        tests=tests,
        buckling_length=line["buckling_length"].si if is_strut else None,
        drilled_length=line["drilled_length"].given_si if is_anchor else None,
        ground=line["ground"].word if is_anchor else "",
        wear=_read_wear(line, mode),
        factored_as=("tendon", "rope") if is_rope else (),
        proof_limit=find_proof_limit(line, has_loop=True) if is_pulled else None,
        is_basis_assumed=is_pulled and is_given and line["proven"].word != "calculated",
    )


def _find_strength(line: Row, mode: str) -> tuple[float | None, Message | None]:
    """Characteristic resistance of a type in one mode [N], and how it follows."""
    strength = line[mode]
    if strength.state != "given":
        return None, None
    if mode == "rope":
        return reduce_breaking(line)
    if mode == "tendon" and may_be_rope(line):
        return reduce_loop(line)
    return strength.si, strength.derivation


def _read_wear(line: Row, mode: str) -> Wear | None:
    """Corrosion of a type's steel; None of posts, and of the grout in the ground."""
    if mode == "rope":
        return Wear(kind="rope")
    if "protection" not in line or mode == "pull_out":
        return None
    outer, steel = line["bar_diameter"].given_si, find_steel(line)
    is_solid = outer is not None and line["kind"].word == SOLID
    return Wear(
        kind=line["kind"].word,
        protection=line["protection"].word,
        soil=line["soil"].word,
        outer=outer,
        inner=steel.inner if steel else 0.0 if is_solid else None,
    )


def _bend_anchor(typed: _Typed) -> Resistance:
    """Resistance of an anchor to bending."""
    bent = typed.leave_open("bending", typed.anchor)
    if typed.line is None or typed.anchor is None:
        return bent
    wear, section = _read_wear(typed.line, "bending"), typed.anchor.section
    if wear is not None and typed.anchor.has_tube and section is not None:
        wear = replace(wear, outer=section.outer, inner=section.inner)
    return replace(bent, wear=wear)


def _bend_post(post: _Typed) -> Resistance:
    """Resistance of a post to compression and the snow against it."""
    mode, line = "compression_bending", post.line
    if line is None:
        return post.leave_open(mode)
    blank = [key for key in _BENT_POST if line[key].state != "given"]
    if blank:
        names = tuple(line[key].field.name for key in blank)
        return post.leave_open(mode, lack=say("check.bent_post_needs", names=names))
    buckling, typed = compute_buckling(line), line["head_eccentricity"].given_si
    eccentricity = 0.5 * find_depth(line) if typed is None else typed
    section = PostSection(
        width=line["post_width"].si,
        length=line["buckling_length"].si,
        modulus=line["section_modulus"].si,
        strength=line["yield_strength"].si,
        critical=buckling.critical,
        buckling=buckling.value,
        at_head=eccentricity,
        at_foot=eccentricity,
        assumed=("efficiency", *(_ENDS if typed is None else ())),
    )
    bent = post.leave_open(mode, section, source=line["post_width"].place)
    return replace(bent, buckling_length=section.length)


def _slide(base: _Typed) -> Resistance:
    """Resistance of a post's base to sliding: by its friction."""
    friction = base.line["base_friction"] if base.line else None
    if friction is None or friction.state != "given":
        return base.leave_open("sliding", assume("base_friction").low)
    return base.leave_open("sliding", friction.si, source=friction.place)


def _hold_foot(foot: _Typed) -> Resistance:
    """Resistance of a post's foot to tension, as declared; 0 of a loose foot."""
    strength = foot.line["foot_tension"] if foot.line else None
    if strength is None or strength.state != "given":
        return foot.leave_open("tension", lack=say("check.no_foot_tension"))
    lack = None if strength.si > 0.0 else say("check.foot_loose")
    tension = foot.leave_open("tension", lack=lack, source=strength.place)
    return replace(tension, value=None if lack else strength.si, basis="declared")


_BORDER_ROPES = (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE)


def build_panels(row: Row, ropes: Mapping[str, Row]) -> tuple[Panel, ...]:
    """Panels that a net row may have; what is not given is assumed.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row.
    ropes : mapping of str to mapping of str to Reading
        Lines of ropes by id.
    """
    ridge, lower = (ropes.get(row[key].word) for key in _BORDER_ROPES)
    return list_panels(
        row["post_spacing"].si,
        sags=(row["ridge_sag"].given_si, row["lower_sag"].given_si),
        stiffnesses=(_find_stiffness(ridge), _find_stiffness(lower)),
        has_mid_anchors=row["mid_anchors"].word == "yes",
    )


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
        and (force := line["rope"].given_si)
    ]
    return multiples or OF_BREAKING


def _list_rope_stiffnesses(
    lines: Sequence[Row | None], multiple: float
) -> list[Sequence[float]]:
    """EA that each rope may have in one construction [N]: uphill, downhill, end guy."""
    stiffnesses: list[float | None] = []
    for line in lines:
        force = line["rope"].given_si if line else None
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
    return find_stiffness(line["axial_stiffness"].given_si, line["rope"].given_si)
