"""Dimensions of anchors, guys and posts, where a resistance follows the demand.

How an anchor bends depends on where the pull points, how much compression a post bears
on the snow against it, how its base slides on what presses it: what is read here is
what the study needs to work such a resistance out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from netdesign.errors import ModelError
from netdesign.resistance.catalogue import find_imperfection, load_catalogue
from netdesign.resistance.post import (
    BucklingResistance,
    PostSection,
    compute_buckling_resistance,
)
from netdesign.resistance.steel import RoundSection
from netdesign.site.cells.findings import Finding
from netdesign.site.model import AnchorType, BaseFriction, Resistance
from netdesign.site.readings import Reading, Row, refuse
from netdesign.structure.members import Member
from netdesign.structure.splay import Guys
from netdesign.words.message import Message, say

_AXES = {
    Member.FOOT_ANCHOR: "foot_axis",
    Member.UPHILL_ANCHOR: "uphill_axis",
    Member.DOWNHILL_ANCHOR: "downhill_axis",
}
_BENT, _SOLID = ("bar", "micropile"), "bar"
_DEFAULT_CURVE = "d"
_SECTION = ("area", "second_moment", "buckling_length", "yield_strength")
_BENT_POST = ("post_width", "section_modulus", *_SECTION)


def read_guys(row: Row) -> Guys:
    """Number of guys on each side of a post, one if not given, and their splay."""
    count = row["guy_count"]
    return Guys(
        count=int(count.number) if count.state == "given" else 1,
        splay=row["guy_splay"].given_si,
    )


def read_axes(row: Row) -> dict[Member, float]:
    """Inclinations of those anchors that have one given [rad]."""
    return {m: row[key].si for m, key in _AXES.items() if row[key].state == "given"}


def read_anchor_types(row: Row, types: Mapping[str, Row]) -> dict[Member, AnchorType]:
    """Kind and steel of each anchor whose type is in its sheet."""
    return {m: _read_anchor(types[row[m].word]) for m in _AXES if row[m].word in types}


def _read_anchor(line: Row) -> AnchorType:
    outer, strength = line["bar_diameter"], line["bar_strength"]
    return AnchorType(
        kind=line["kind"].word,
        section=_build_section(line)
        if outer.state == strength.state == "given" and not lacks_inner(line)
        else None,
        lever=line["lever_arm"].given_si,
    )


def _build_section(line: Row) -> RoundSection | None:
    """Steel of an anchor; None of dimensions that ``check_support_types`` refused."""
    try:
        return RoundSection(
            outer=line["bar_diameter"].si,
            inner=read_inner(line),
            strength=line["bar_strength"].si,
        )
    except ModelError:
        return None


def lacks_inner(line: Row) -> bool:
    """Lack of an inner diameter of an anchor that may be hollow."""
    is_solid = line["kind"].word == _SOLID
    return (
        line["bar_diameter"].state == "given"
        and line["inner_diameter"].state != "given"
        and not is_solid
    )


def read_inner(line: Row) -> float:
    """Inner diameter of an anchor's steel [m]; 0 of a solid bar."""
    return line["inner_diameter"].given_si or 0.0


def list_dependent(
    row: Row, anchors: Mapping[str, Row], posts: Mapping[str, Row]
) -> tuple[Resistance, ...]:
    """Resistances of a net row that follow the demand, their values still open.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Nets.
    anchors, posts : mapping of str to mapping of str to Reading
        Lines of the type sheets by id.
    """
    types = read_anchor_types(row, anchors)
    bent = [
        _read_bent_anchor(row[member], member, types.get(member)) for member in _AXES
    ]
    post = row[Member.POST]
    line = posts.get(post.word)
    found = (one for one in bent if one is not None)
    return (*found, _read_bent_post(post, line), _read_sliding(post, line))


def _read_bent_anchor(
    named: Reading, member: Member, anchor: AnchorType | None
) -> Resistance | None:
    """Resistance of an anchor to bending; None of a rope anchor, which turns."""
    if anchor is None:
        return _open(named, member, "bending", None)
    if anchor.kind == "rope anchor":
        return None
    if not anchor.kind:
        return _open(named, member, "bending", None, say("bending.no_kind"))
    if anchor.lever is None:
        return _open(named, member, "bending", None, say("bending.no_lever"))
    return _open(named, member, "bending", anchor)


def _open(
    named: Reading,
    member: Member,
    mode: str,
    dimensions: AnchorType | PostSection | BaseFriction | None,
    lack: Message | None = None,
    source: str = "",
) -> Resistance:
    """Resistance of which only the dimensions are known."""
    return Resistance(
        member=member,
        mode=mode,
        value=None,
        basis="computed" if dimensions else "",
        type_id=named.word,
        source=source or named.place or "Nets",
        dimensions=dimensions,
        lack=lack,
    )


def _read_bent_post(named: Reading, line: Row | None) -> Resistance:
    mode = "compression_bending"
    if line is None:
        return _open(named, Member.POST, mode, None)
    blank = [key for key in _BENT_POST if line[key].state != "given"]
    if blank:
        names = tuple(line[key].field.name for key in blank)
        lack = say("check.bent_post_needs", names=names)
        return _open(named, Member.POST, mode, None, lack)
    buckling = compute_buckling(line)
    section = PostSection(
        width=line["post_width"].si,
        length=line["buckling_length"].si,
        modulus=line["section_modulus"].si,
        strength=line["yield_strength"].si,
        critical=buckling.critical,
        buckling=buckling.value,
    )
    place = line["post_width"].place
    found = _open(named, Member.POST, mode, section, source=place)
    return replace(found, buckling_length=section.length)


def compute_buckling(line: Row) -> BucklingResistance:
    """Buckling resistance of a post by its dimensions, all of them given."""
    return compute_buckling_resistance(
        area=line["area"].si,
        second_moment=line["second_moment"].si,
        length=line["buckling_length"].si,
        yield_strength=line["yield_strength"].si,
        modulus=1e6 * load_catalogue()["buckling"]["E_MPa"],
        imperfection=find_imperfection(name_curve(line)).value,
    )


def name_curve(line: Row) -> str:
    """Buckling curve of a post; the lowest where none is given."""
    return line["buckling_curve"].word or _DEFAULT_CURVE


def _read_sliding(named: Reading, line: Row | None) -> Resistance:
    friction = line["base_friction"] if line else None
    given = line["sliding"] if line else None
    if friction is not None and friction.state == "given":
        base = BaseFriction(coefficient=friction.si)
        place = friction.place
        return _open(named, Member.POST_BASE, "sliding", base, source=place)
    lack = say("check.no_sliding_resistance")
    found = _open(named, Member.POST_BASE, "sliding", None, lack)
    if given is None or given.state != "given":
        return found
    return Resistance(
        member=found.member,
        mode=found.mode,
        value=given.si,
        basis="declared",
        type_id=found.type_id,
        source=given.place,
    )


def _check_lever(row: Row, findings: list[Finding]) -> None:
    """Refuse a lever arm of an anchor that is not said to bend."""
    if "lever_arm" not in row or row["lever_arm"].state != "given":
        return
    lever, kind = row["lever_arm"], row["kind"]
    if kind.state == "faulty" or kind.word in _BENT:
        return
    rule = say("type.needs_more", names=(kind.field.name,))
    if kind.word:
        rule = say("type.beside", name=kind.field.name, place=kind.place)
    bent = tuple(kind.field.name_word(word) for word in _BENT)
    refuse(lever, rule, say("accepted.words", words=bent), findings)


def check_support_types(row: Row, findings: list[Finding]) -> None:
    """Refuse what is given twice, the inside of no tube, the lever of what turns."""
    _check_lever(row, findings)
    if "base_friction" in row and row["base_friction"].state == "given":
        beside = row["sliding"]
        if beside.state == "given":
            rule = say("type.beside", name=beside.field.name, place=beside.place)
            refuse(row["base_friction"], rule, say("accepted.one_of_two"), findings)
    if "inner_diameter" in row and row["inner_diameter"].state == "given":
        outer, inner, kind = (
            row[key] for key in ("bar_diameter", "inner_diameter", "kind")
        )
        if kind.word == _SOLID:
            rule = say("type.beside", name=kind.field.name, place=kind.place)
            hollow = kind.field.name_word("micropile")
            refuse(inner, rule, say("accepted.words", words=(hollow,)), findings)
        if outer.state == "blank":  # a tube without a wall has no tendon resistance
            rule = say("type.needs_more", names=(outer.field.name,))
            refuse(inner, rule, say("type.all_or_none"), findings)
