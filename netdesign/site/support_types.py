"""From lines of the type sheets to what each member of a row bears.

A resistance that follows the demand stays open: how an anchor bends depends on where
the pull points, how much compression a post bears on the snow against it, how its base
slides on what presses it. Here stand the dimensions that the study works it out from.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from netdesign.resistance.ground import BENDING, AnchorType
from netdesign.resistance.post import PostSection
from netdesign.resistance.steel import (
    Wear,
)
from netdesign.site.anchor_types import (
    ANCHORS,
    AnyMember,
    name_column,
    read_anchor_types,
    read_anchors,
    read_axes,
)
from netdesign.site.assumed import assume
from netdesign.site.lines import Types
from netdesign.site.model import Resistance, RowEnd
from netdesign.site.readings import Reading, Row
from netdesign.site.statements import list_stiffnesses
from netdesign.site.type_lines import find_depth
from netdesign.site.type_resistances import (
    SECTION,
    compute_buckling,
    find_proof_limit,
    find_tests,
    lacks_inner,
    may_be_rope,
    read_inner,
    reduce_breaking,
    reduce_loop,
)
from netdesign.structure.members import (
    END_ANCHORS,
    END_MODES,
    LIFTED_MODE,
    MEMBER_MODES,
    NET_MODES,
    EndMember,
    Member,
    NetPart,
)
from netdesign.structure.splay import Guys
from netdesign.words.message import Message, say

_ENDS = ("head_eccentricity", "foot_eccentricity")  # one column says both
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


def find_resistances(row: Row, types: Types) -> tuple[Resistance, ...]:
    """Resistances of all members of a row in every mode, given or not.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of a net row, or one with the types of its end.
    types : mapping of str to mapping of str to Row
        Lines of types by table.
    """
    anchors, post = dict(read_anchor_types(row, types)), row[Member.POST]
    line = types["posts"].get(post.word)
    return (
        *(_find_resistance(row, mode, member, types) for member, mode in MEMBER_MODES),
        *_list_beside_axis(row, ANCHORS, anchors, types),
        _bend_post(post, line),
        _slide(post, line),
        _hold_foot(post, line),
    )


def _list_beside_axis(
    row: Row,
    members: Sequence[AnyMember],
    anchors: Mapping[AnyMember, AnchorType],
    types: Types,
) -> Iterator[Resistance]:
    """Resistances of anchors that follow how they are pulled, and of their ground."""
    named = {member: row[name_column(member)] for member in members}
    bent = (_bend_anchor(named[x], x, anchors.get(x), types) for x in members)
    yield from (one for one in bent if one is not None)
    for member, kind in anchors.items():
        if kind.soil:
            yield _hold_by_ground(named[member], member, kind, types)
    for member in members:
        own = anchors.get(member)
        if own is None or own.kind not in BENDING or own.across is not None:
            yield _open(named[member], member, "direction", own)


def build_row_end(at_end: Row, types: Types) -> RowEnd:
    """Members that hold a row along itself, all of them, given or not.

    ``at_end`` is its line with the types of its first and last support.
    """
    anchors = read_anchors(at_end, END_ANCHORS, types)
    axes = dict(read_axes(at_end, END_ANCHORS, types))
    angle = at_end["end_guy_angle"].given_si
    sliding = at_end["ropes_at_supports"].word
    return RowEnd(
        guy_angle=assume("end_guy_angle").high if angle is None else angle,
        stiffnesses=list_stiffnesses(at_end, types),
        ropes_slide=sliding == "slide" if sliding else None,
        lateral_axis=axes.get(EndMember.LATERAL_ANCHOR),
        resistances=(
            *(_find_resistance(at_end, mode, one, types) for one, mode in END_MODES),
            *_list_beside_axis(at_end, END_ANCHORS, anchors, types),
        ),
        anchors=tuple(anchors.items()),
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
    return mesh, *(
        _find_resistance(row, mode, part, types)
        for part, mode in NET_MODES
        if part is not NetPart.MESH
    )


def list_catalogue(types: Types) -> tuple[Resistance, ...]:
    """Resistances of every type of the workbook, of some member that may have it.

    Those that follow the demand have no place here: they need a member.
    """
    return tuple(
        _describe_type(kind, mode, member, sheet)
        for sheet, (member, modes) in _CATALOGUE.items()
        for kind in types[sheet].values()
        for mode in modes
    )


def _find_resistance(
    row: Row, mode: str, member: Member | EndMember | NetPart, types: Types
) -> Resistance:
    """Resistance of a member in one mode; no type or no value gives None."""
    reading = row[name_column(member)]
    if not reading.word:
        return Resistance(member=member, mode=mode, source=reading.place or "Rows")
    sheet = reading.field.refers_to
    return _describe_type(types[sheet][reading.word], mode, member, sheet)


def _describe_type(
    kind: Row, mode: str, member: Member | EndMember | NetPart, sheet: str
) -> Resistance:
    """Resistance of a type in one mode, given or not."""
    resistance = kind[mode]
    is_pulled = mode == "pull_out"
    tests = find_tests(kind) if is_pulled else None
    is_given = resistance.state == "given"
    is_derived = is_given and resistance.derivation is not None
    # A report counts once sheet Declared names it; other numbers are makers' values.
    basis = "computed" if is_derived or is_pulled else "declared"
    is_strut = is_derived and mode == "compression"
    value, derivation = _find_strength(kind, mode)
    if tests:
        value = None
    is_rope = mode == "tendon" and may_be_rope(kind)
    place = (resistance if is_given or not tests else kind["test_least"]).place
    is_anchor = "ground" in kind
    return Resistance(
        member=member,
        mode=mode,
        value=value,
        basis="tested" if tests else basis if is_given else "",
        type_id=kind["id"].word,
        source=place or kind["id"].place or sheet,
        derivation=derivation,
        tests=tests,
        buckling_length=kind["buckling_length"].si if is_strut else None,
        drilled_length=kind["drilled_length"].given_si if is_anchor else None,
        ground=kind["ground"].word if is_anchor else "",
        wear=_read_wear(kind, mode),
        factored_as=("tendon", "rope") if is_rope else (),
        proof_limit=find_proof_limit(kind, has_loop=True) if is_pulled else None,
        is_basis_assumed=is_pulled and is_given and kind["proven"].word != "calculated",
    )


def _find_strength(kind: Row, mode: str) -> tuple[float | None, Message | None]:
    """Characteristic resistance of a type in one mode [N], and how it follows."""
    given = kind[mode]
    if given.state != "given":
        return None, None
    if mode == "rope":
        return reduce_breaking(kind)
    if mode == "tendon" and may_be_rope(kind):
        return reduce_loop(kind)
    return given.si, given.derivation


def _read_wear(kind: Row, mode: str) -> Wear | None:
    """Corrosion of a type's steel; None of posts, and of the grout in the ground."""
    if mode == "rope":
        return Wear(kind="rope")
    if "protection" not in kind or mode == "pull_out":
        return None
    outer = kind["bar_diameter"].given_si
    return Wear(
        kind=kind["kind"].word,
        protection=kind["protection"].word,
        soil=kind["soil"].word,
        outer=outer,
        inner=None if outer is None or lacks_inner(kind) else read_inner(kind),
    )


def _bend_anchor(
    named: Reading, member: Member | EndMember, anchor: AnchorType | None, types: Types
) -> Resistance | None:
    """Resistance of an anchor to bending; None of a rope anchor, which turns."""
    if anchor is None:
        return _open(named, member, "bending")
    if anchor.kind == "rope anchor":
        return None
    wear = _read_wear(types["anchor_types"][named.word], "bending")
    if wear is not None and anchor.has_tube and anchor.section is not None:
        outer, inner = anchor.section.outer, anchor.section.inner
        wear = replace(wear, outer=outer, inner=inner)
    return replace(_open(named, member, "bending", anchor), wear=wear)


def _hold_by_ground(
    named: Reading, member: Member | EndMember, anchor: AnchorType, types: Types
) -> Resistance:
    """Resistance of the ground that an anchor may pull out with itself."""
    place = types["anchor_types"][named.word]["soil_cohesion"].place
    return _open(named, member, "wedge", anchor, source=place)


def _open(
    named: Reading,
    member: Member | EndMember,
    mode: str,
    dimensions: AnchorType | PostSection | float | None = None,
    lack: Message | None = None,
    source: str = "",
) -> Resistance:
    """Resistance of which only the dimensions are known."""
    return Resistance(
        member=member,
        mode=mode,
        basis="computed" if dimensions else "",
        type_id=named.word,
        source=source or named.place or "Rows",
        dimensions=dimensions,
        lack=lack,
    )


def _bend_post(named: Reading, line: Row | None) -> Resistance:
    """Resistance of a post to compression and the snow against it."""
    mode = "compression_bending"
    if line is None:
        return _open(named, Member.POST, mode)
    blank = [key for key in _BENT_POST if line[key].state != "given"]
    if blank:
        names = tuple(line[key].field.name for key in blank)
        lack = say("check.bent_post_needs", names=names)
        return _open(named, Member.POST, mode, lack=lack)
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
    place = line["post_width"].place
    found = _open(named, Member.POST, mode, section, source=place)
    return replace(found, buckling_length=section.length)


def _slide(named: Reading, line: Row | None) -> Resistance:
    """Resistance of a post's base to sliding: by its friction."""
    friction = line["base_friction"] if line else None
    typed = friction.given_si if friction else None
    friction_si = assume("base_friction").low if typed is None else typed
    place = friction.place if friction and typed is not None else ""
    return _open(named, Member.POST_BASE, "sliding", friction_si, source=place)


def _hold_foot(named: Reading, line: Row | None) -> Resistance:
    """Resistance of a post's foot to tension, as declared; 0 is that of a loose one."""
    held = line["foot_tension"] if line else None
    if held is None or held.state != "given":
        return _open(named, *LIFTED_MODE, lack=say("check.no_foot_tension"))
    lack = None if held.si > 0.0 else say("check.foot_loose")
    found = _open(named, *LIFTED_MODE, lack=lack, source=held.place)
    return replace(found, value=None if lack else held.si, basis="declared")
