"""Resistances that a type sheet gives by dimensions instead of by one number."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TypeVar

from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import (
    SPIRAL,
    Datum,
    find_imperfection,
    find_loop_efficiency,
    find_termination,
    load_catalogue,
)
from netdesign.resistance.ground import (
    AnchorType,
    PullOutTests,
    Soil,
    limit_proof_load,
)
from netdesign.resistance.post import (
    BucklingResistance,
    compute_buckling_resistance,
)
from netdesign.resistance.products import find_bar, find_product
from netdesign.resistance.steel import HEAD_GRADE, RoundSection, find_ground_lever
from netdesign.site.cells.findings import Finding
from netdesign.site.columns.fields import from_si
from netdesign.site.lines import Types
from netdesign.site.readings import Row, refuse
from netdesign.structure.members import END_ANCHORS, NAMED_BY, EndMember, Member
from netdesign.structure.row_position import find_axis_at_dip
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import name
from netdesign.words.message import Message, say

_DEFAULT_TERMINATION, _DEFAULT_CURVE = "wedge", "d"
_INCLUDED = "included"  # the ends, in a breaking force that is given
SOLID = "bar"  # kind of an anchor that is no tube
SECTION = ("area", "second_moment", "buckling_length", "yield_strength")  # of a post
TEST_COLUMNS = ("test_count", "pull_out", "test_mean")
SOIL_COLUMNS = ("soil_cohesion", "soil_friction", "soil_weight")


def find_steel(line: Row) -> RoundSection | None:
    """Bar that the name of an anchor's type means, with a diameter that is typed.

    None where force and diameter are both typed, and where a typed diameter may be that
    of a hollow bar.
    """
    product, outer = find_bar(line["id"].word), line["bar_diameter"]
    if product is None or outer.state != "given" or line["kind"].word == "rope anchor":
        return None
    is_typed = outer.derivation is None
    if is_typed and line["tendon"].state == "given" and not line["tendon"].derivation:
        return None
    strengths = product.list_ends("yield_strength", "ultimate_strength")
    hollows = product.list_ends("inner_diameter")
    may_be_hollow = is_typed and not hollows and line["kind"].word != SOLID
    if not strengths or may_be_hollow:
        return None
    inner = max(hollows, default=0.0)
    try:
        return RoundSection(outer=outer.si, inner=inner, strength=min(strengths))
    except ModelError:  # the diameter is not that of the name, which is asked about
        return None


def describe_steel(steel: RoundSection) -> Message:
    """How a tendon's resistance follows from its steel."""
    outer, inner = (from_si(size, "mm") for size in (steel.outer, steel.inner))
    strength = from_si(steel.strength, "MPa")
    if inner:
        return say("derivation.tube", outer=outer, inner=inner, strength=strength)
    return say("derivation.bar", diameter=outer, strength=strength)


def find_tests(row: Row) -> PullOutTests | None:
    """Pull-out tests of an anchor type; None where none are given, or all are refused.

    Without a number of tests it is 1; without a mean, the mean is the least force.
    """
    count, least, mean = (row[key] for key in TEST_COLUMNS)
    if row["proven"].word != "tests" or least.state != "given":
        return None
    average = least.si if mean.given_si is None else mean.si
    if "faulty" in (count.state, mean.state) or least.si > average:  # is refused
        return None
    return PullOutTests(
        count=count.given_count or 1,
        least=least.si,
        mean=average,
        singles=count.singles,
    )


def check_tests(row: Row, findings: list[Finding]) -> None:
    """Refuse tests whose least force is beyond their mean."""
    least, mean = row["pull_out"].given_si, row["test_mean"].given_si
    if row["proven"].word == "tests" and least and mean and least > mean:
        rule = say("type.exceeds_mean", place=row["test_mean"].place)
        refuse(row["pull_out"], rule, say("type.at_most_mean"), findings)


def check_ends(row: Row, findings: list[Finding]) -> None:
    """Refuse U-bolt grips on a spiral rope: EN 13411-5 is not for these."""
    product = find_product(row["id"].word)
    rope = product.id if product else ""
    if row["termination"].word == "clips" and rope.startswith(SPIRAL):
        rule = say("type.clips_on_spiral", rope=rope)
        refuse(row["termination"], rule, say("type.other_end"), findings)


def find_bond(row: Row, pull_out: float) -> float | None:
    """Mean bond stress under a pull-out force [N] over the bond length [kPa].

    None without the dimensions of the bond.
    """
    parts = (row["drill_diameter"], row["bond_length"])
    if any(reading.state != "given" for reading in parts):
        return None
    surface = math.pi * parts[0].si * parts[1].si
    return pull_out / surface / 1e3


def _describe_origin(datum: Datum) -> Message:
    """Status and source of a number of the catalogue."""
    status = name("status", datum.status)
    return say("derivation.origin", status=status, source=datum.source)


def reduce_breaking(row: Row) -> tuple[float, Message | None]:
    """Resistance of a rope by its breaking force and its ends [N], and how.

    A force that is said to include the ends stays as it is.
    """
    termination, force = row["termination"].word or _DEFAULT_TERMINATION, row["rope"]
    loss = find_termination(termination)
    if termination == _INCLUDED:
        return force.si, None
    return loss.value * force.si, say(
        "derivation.breaking",
        force=force.number,
        loss=loss.value,
        termination=name("termination", termination),
        origin=_describe_origin(loss),
    )


def may_be_rope(line: Row) -> bool:
    """Whether an anchor's tendon is a rope, or may be, as its kind is not given."""
    if line["kind"].word:
        return line["kind"].word == "rope anchor"
    product = find_product(line["id"].word)
    return product is None or not product.family.endswith("bar")


def reduce_loop(row: Row) -> tuple[float, Message]:
    """Resistance of a rope anchor's tendon with its loop [N], and how; (R31)."""
    force, loss = row["tendon"], find_loop_loss(row)
    how = _describe_origin(find_loop_efficiency())
    return loss * force.si, say(
        "derivation.loop", force=force.number, loss=loss, origin=how
    )


def find_loop_loss(row: Row) -> float:
    """Loss factor k_e of an anchor's loop [-]; 1 of one that has none."""
    return find_loop_efficiency().value if may_be_rope(row) else 1.0


def find_proof_limit(row: Row, *, has_loop: bool) -> float | None:
    """Largest load of a test that the tendon of an anchor type allows [N]; (R32).

    A bar breaks at the ultimate force of its product, else where its tendon yields.

    Parameters
    ----------
    row : mapping of str to Reading
        Line of sheet Anchors.
    has_loop : bool
        A rope anchor's loop counts; else the most that its rope may bear.
    """
    tendon = row["tendon"].given_si
    if tendon is None:
        return None
    tendon *= find_loop_loss(row) if has_loop else 1.0
    product = None if may_be_rope(row) else find_product(row["id"].word)
    ultimate, _ = (
        product.values.get("ultimate_force", (0.0, 0.0)) if product else (0, 0)
    )
    return limit_proof_load(tendon, max(tendon, ultimate))


def resist_buckling(row: Row) -> tuple[float, Message]:
    """Compression that a post's section bears [N], and how."""
    curve, buckling = name_curve(row), compute_buckling(row)
    imperfection = find_imperfection(curve)
    return buckling.value, say(
        "derivation.buckling",
        reduction=buckling.reduction,
        area=row["area"].number,
        strength=row["yield_strength"].number,
        slenderness=buckling.slenderness,
        curve=curve,
        imperfection=imperfection.value,
        critical=kilonewton_from_newton(buckling.critical),
        modulus=load_catalogue()["buckling"]["E_MPa"],
        second_moment=row["second_moment"].number,
        length=row["buckling_length"].number,
        origin=_describe_origin(imperfection),
    )


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
