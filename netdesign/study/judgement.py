"""Checks of a row's members, from its forces and inputs alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Check, Open, OpenKind, Standard, check_member
from netdesign.checks.check import SingleTest, TestSeries, rate_utilisation
from netdesign.checks.comparison import find_missing_force
from netdesign.checks.schema import BY_REPORT
from netdesign.checks.tested import find_proof_factor
from netdesign.outcome import Verdict
from netdesign.resistance.pull_out import SingleTest as PullOutTest
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import (
    CONNECTED,
    ROPE_OF,
    EndMember,
    Member,
    NetPart,
)
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.bores import check_anchor_distance, check_cover
from netdesign.study.dependent import (
    connect,
    corrode,
    find_resistance_for_force,
    may_bend,
    resist,
    settle_basis,
    shorten_bond,
)
from netdesign.study.geometry_checks import check_row_geometry
from netdesign.study.member_force import (
    PUSHED,
    MemberForce,
    RowForces,
    find_force,
    lifts,
)
from netdesign.study.posts import ask_efficiency, find_short_post
from netdesign.study.pulls import (
    check_direction,
    doubt_mortar,
    find_pull,
)
from netdesign.study.row_to_check import Basis, find_doubt, name_unsaid
from netdesign.study.sideways import ask_end_guy, check_sideways
from netdesign.study.support_records import PullRecord
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say

_ROPES = (NetPart.RIDGE_ROPE, NetPart.LOWER_ROPE)
FOOT_LOOSE, LOOSE_LIFTS = say("check.foot_loose"), say("check.loose_foot_lifts")
# A post of which the snow's moment leaves nothing for its force; ground that slides
UNBOUNDED = (
    *("post_bending.too_much", "wedge.slab", "direction.rope_beyond"),
    "bearing.too_far",
    LOOSE_LIFTS.key,
)


# What stands behind the id of a check, by the support that it is of.
AT_SUPPORT: Mapping[Position, str] = {
    "intermediate": "",
    "second": ".second",
    "edge": ".end",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCheck:
    """Check of one member of one support in one mode, with what it was judged from.

    ``force`` is None where it is not known at all.
    """

    given: Resistance
    width: LoadedWidth
    check: Check
    force: MemberForce | None = None
    pull: PullRecord | None = None  # on an anchor, where one is known

    @property
    def name(self) -> tuple[str, str]:
        """Member and mode."""
        return self.given.member, self.given.mode

    @property
    def is_of_end(self) -> bool:
        """A border rope, or what holds its pull along the row."""
        return self.given.member in ROPE_OF

    @property
    def use(self) -> float | None:
        """Utilisation for each kN on a member inside the row [1/kN].

        None without a resistance.
        """
        factor, design = map(self.check.read, ("γ_E", "R_d"))
        if self.force is None or not (factor and design):
            return None
        return self.force.on_support * factor / design

    @property
    def ratio(self) -> float:
        """Upper end of the utilisation [-]; below 0 without one."""
        high = self.check.utilisation_band[1]
        return -1.0 if high is None else high


def judge_members(known: RowForces) -> list[MemberCheck]:
    """Checks of both supports' members, then of the net and what holds its ropes."""
    effects, row = known.effects, known.row
    at_end, not_checked = effects.find_support("edge"), known.standard.not_checked
    held = row.row_end.resistances if row.row_end else ()
    parts = () if "mesh" in not_checked else row.net_parts
    of_supports: dict[str, list[MemberCheck]] = {
        width.position: list(
            _judge_at(known, width, row.resistances_at(width.position))
        )
        for width in effects.supports
    }
    judged = [
        *_place_second(known, of_supports),
        *_judge_at(known, at_end, (*parts, *held)),
    ]
    gap = find_open(row, judged)
    turned: dict[str, list[MemberCheck]] = {
        width.position: _judge_directions(
            known, row.resistances_at(width.position), width, gap
        )
        for width in effects.supports
    }
    of_end = _judge_directions(known, held, at_end, gap)
    return [*judged, *_place_second(known, turned), *of_end]


def _judge_at(
    known: RowForces, width: LoadedWidth, resistances: Iterable[Resistance]
) -> Iterator[MemberCheck]:
    """Checks of the members of one support, each rope's with those of its links.

    Those of the directions come once these are known.
    """
    for given in resistances:
        if given.mode == "direction" or not _concerns(known, given):
            continue
        yield _judge_member(known, given, width)
        is_rope = given.mode in ("tendon", "rope") and given.member in CONNECTED
        if is_rope and "connections" not in known.standard.not_checked:
            chain = _find_chain(known, given, width)
            yield _judge_member(known, chain, width)


def _judge_directions(
    known: RowForces,
    resistances: Iterable[Resistance],
    width: LoadedWidth,
    gap: Message | None,
) -> list[MemberCheck]:
    """Checks of the angles of rope anchors of one support, and of blocks that hold."""
    turns = (given for given in resistances if given.mode == "direction")
    judged = (_judge_direction(known, given, width, gap) for given in turns)
    return [
        one
        for one in judged
        if one.check.verdict is Verdict.PASS or not may_bend(one.given)
    ]


def _judge_direction(
    known: RowForces, given: Resistance, width: LoadedWidth, gap: Message | None
) -> MemberCheck:
    """Check of a rope anchor's angle; beyond what it turns by, of its head."""
    pull = find_pull(known.pulls, given.member, width.position)
    check = check_direction(pull, known.standard, gap) if pull else None
    if check is None:
        return _judge_member(known, given, width)
    check = replace(
        check, id=check.id + AT_SUPPORT[width.position], position=width.position
    )
    return MemberCheck(given=given, width=width, check=check, pull=pull)


_AS_INSIDE = 1.01  # times the utilisation inside the row: the second support is alike
_WORSE = (Verdict.PASS, Verdict.DECLARED, Verdict.NOT_PROVEN, Verdict.FAIL)


def _place_second(
    known: RowForces, of_supports: Mapping[str, Sequence[MemberCheck]]
) -> list[MemberCheck]:
    """Checks of all supports, those of the second one where they can govern.

    It has the types inside and no less load. Where that is alike, its check is the one
    inside; where the end has the same type with more load, that check says all.
    """
    inside, at_end = of_supports["intermediate"], of_supports.get("edge", ())
    kept, ends = ({one.name: one for one in each} for each in (inside, at_end))
    beside = []
    for one in of_supports.get("second", ()):
        within = kept.get(one.name, one)  # none of a block that does not hold inside
        if _is_no_worse(one, within) or _is_covered(known, one, ends.get(one.name)):
            continue
        if 0.0 < _rate_load(one) <= _AS_INSIDE * _rate_load(within):
            as_inside = replace(one.check, id=within.check.id, position="intermediate")
            kept[one.name] = replace(one, check=as_inside)
        else:
            beside.append(one)
    return [*kept.values(), *beside, *at_end]


def _rate_load(one: MemberCheck) -> float:
    """Upper end of the utilisation, or of the force where no resistance is known."""
    return one.ratio if one.ratio >= 0.0 else one.check.read_band("E_d")[1] or 0.0


def _is_no_worse(one: MemberCheck, other: MemberCheck) -> bool:
    """Neither more used nor loaded nor of a worse verdict."""
    verdicts = [_WORSE.index(each.check.verdict) for each in (one, other)]
    loads = [each.check.read_band("E_d")[1] or 0.0 for each in (one, other)]
    is_less = one.ratio <= other.ratio and loads[0] <= loads[1]
    return is_less and verdicts[0] <= verdicts[1]


def _is_covered(known: RowForces, one: MemberCheck, end: MemberCheck | None) -> bool:
    """The end's check of the same type is worse; no document for it alone."""
    if end is None or not end.given.type_id or end.given.type_id != one.given.type_id:
        return False
    at_end, here = (
        known.site.find_declaration(known.row, *one.name, place)
        for place in ("edge", "second")
    )
    return at_end == here and _is_no_worse(one, end)


def _concerns(known: RowForces, given: Resistance) -> bool:
    """The check is one of this row and profile: some case lifts a foot that is held."""
    if given.member == Member.POST_FOOT:
        return lifts(known.largest.values(), known.floor)
    return given.mode != "wedge" or "anchor_ground" not in known.standard.not_checked


def _find_chain(known: RowForces, given: Resistance, width: LoadedWidth) -> Resistance:
    """Resistance of the links between a rope and its anchor."""
    anchor = CONNECTED[given.member]
    pull = find_pull(known.pulls, anchor, width.position) if anchor else None
    return connect(given, known.site.links, pull, known.standard)


def _judge_member(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> MemberCheck:
    unsaid = _find_unsaid(known, given, width)
    if unsaid:  # whatever else is missing
        points = [Open(kind=OpenKind.UNSOLVED, message=unsaid)]
        check = replace(judge_force(known, given, None, width, points), open=points)
        return MemberCheck(given=given, width=width, check=check)
    force = find_force(known, given, width)
    pull = find_pull(known.pulls, given.member, width.position)
    given, unsure = find_lasting(known, given, pull)
    if force is not None:
        given = find_resistance_for_force(given, known, pull, width, force.action)
    points = list(_list_open(known, given, width, force))
    if asked := ask_efficiency(given, known, width):
        points.append(Open(kind=OpenKind.VALUE_ASKED, message=asked))
    if unsure:
        points.append(Open(kind=OpenKind.RESISTANCE_IN_DOUBT, message=unsure))
    check = judge_force(known, given, force, width, points)
    short = find_short_post(given, known)
    if short and check.verdict is Verdict.PASS:  # a longer post fails all the more
        given = replace(given, value=None, lack=short)
        check = judge_force(known, given, force, width, points)
    met = rate_utilisation(*check.utilisation_band)
    if given.doubt and (given.best is None or met is Verdict.NOT_PROVEN):
        check = check.with_open(OpenKind.RESISTANCE_IN_DOUBT, given.doubt)
    return MemberCheck(given=given, width=width, force=force, check=check, pull=pull)


def _list_open(
    known: RowForces, given: Resistance, width: LoadedWidth, force: MemberForce | None
) -> Iterator[Open]:
    """What is open of a member's force: of its cases, its snow, what pulls it."""
    gaps = (
        known.gap,
        None if given.member in ROPE_OF else known.floor_gap,
        _find_other_panel(known.row, given, width.position),
        _find_loose_end(known, given.member, width.position),
    )
    for gap in filter(None, gaps):
        yield Open(kind=OpenKind.UNSOLVED, message=gap)
    doubt = _find_doubt(known, force) if force else None
    if doubt is not None:
        yield Open(kind=OpenKind.OUTSIDE_LAW, message=doubt)
    if width.position == "edge" and (asked := ask_end_guy(known)):
        yield Open(kind=OpenKind.VALUE_ASKED, message=asked)


def judge_force(
    known: RowForces,
    given: Resistance,
    force: MemberForce | None,
    width: LoadedWidth,
    points: Sequence[Open] = (),
) -> Check:
    """Check of a force; it fails where a moment alone is too much for a post.

    Nothing of the post is left for its force then: the utilisation has no bound. So it
    is with a loose foot that its post surely lifts.
    """
    standard = known.standard
    gap = points[0].message if points else say("check.no_case_solved")
    check = check_member(
        force.action if force else find_missing_force(gap),
        given,
        standard,
        points,
        strength=resist(given, standard, force) if force else None,
        beside=force.on.by_model if force and standard.is_by_guideline else (),
    )
    least = known.find_least(given.member) if force else None
    doubted = check.has_open(OpenKind.RESISTANCE_IN_DOUBT)
    check = replace(
        check,
        id=check.id + AT_SUPPORT[width.position],
        position=width.position,
        case=force.largest.case if force else None,
        load_case=least.load_case if least else "",
        load_inclination_deg=least.inclination_deg if least else None,
        resistance_derivation=given.derivation,
        resistance_years=known.row.design_life if given.wear and not doubted else None,
        tests=_record_tests(given, standard),
        proof_limit_kN=kilonewton_if_known(given.proof_limit),
    )
    lack = given.lack
    if lack == FOOT_LOOSE and force and force.action.low:
        lack = LOOSE_LIFTS
    is_unbounded = lack is not None and lack.key in UNBOUNDED
    return check.with_open(OpenKind.FAILS, lack) if lack and is_unbounded else check


def _record_tests(given: Resistance, standard: Standard) -> TestSeries | None:
    tests = given.tests
    if tests is None or given.value is not None:
        return None
    return TestSeries(
        count=tests.count,
        least_kN=kilonewton_from_newton(tests.least),
        mean_kN=kilonewton_from_newton(tests.mean),
        singles=[_record_single(one) for one in tests.singles],
        proof_factor=find_proof_factor(standard),
    )


def _record_single(test: PullOutTest) -> SingleTest:
    proof, moved = test.proof_load, test.displacement
    return SingleTest(
        cell=test.source,
        load_kN=kilonewton_from_newton(test.load),
        is_held=test.is_held,
        proof_load_kN=None if proof is None else kilonewton_from_newton(proof),
        displacement_mm=None if moved is None else 1e3 * moved,
    )


def find_lasting(
    basis: Basis, given: Resistance, pull: PullRecord | None
) -> tuple[Resistance, Message | None]:
    """Resistance at the end of the design life, and why it may not hold."""
    given, unsaid = settle_basis(given, basis.standard)
    lasting, worn = corrode(shorten_bond(given, basis.standard), basis)
    doubt = unsaid or worn
    if given.basis == BY_REPORT:
        doubt = doubt or say("check.by_report", sheet=say("sheet.Declared"))
    return lasting, doubt or doubt_mortar(given, pull, basis.standard)


def _find_unsaid(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> Message | None:
    """Lack of what a force depends on, so that nothing is known of it."""
    row = known.row
    if row.unsaid:
        return name_unsaid(row)
    if known.panel_gap is not None:
        return known.panel_gap
    if given.member in ROPE_OF and known.effects.end_lack is not None:
        return known.effects.end_lack
    is_inside = width.position != "edge" and given.member in tuple(Member)
    return None if is_inside else _find_lack(row, given)


def _find_lack(row: NetRow, given: Resistance) -> Message | None:
    """Lack of the workbook that leaves a rope, an end member, or the end post, open."""
    if given.member in _ROPES:
        return None if row.panels else row.panel_lack
    if row.row_end is None or given.member not in (*EndMember, *PUSHED):
        return None
    return None if row.panels else row.panel_lack


def _find_loose_end(
    forces: RowForces, member: str, position: Position
) -> Message | None:
    """Reason why nothing holds what the end guy does to a member of the row's end."""
    is_pushed = member in PUSHED and position == "edge"
    return forces.end_guy if is_pushed and isinstance(forces.end_guy, Message) else None


def _find_other_panel(
    row: NetRow, given: Resistance, position: Position
) -> Message | None:
    """Doubt that the ropes between the posts are those that were computed.

    It concerns what they load more than the section does.
    """
    pulled = [Member.UPHILL_GUY, Member.UPHILL_ANCHOR, *_ROPES]
    if row.layout.is_foot_shared or (position == "second" and row.row_end):
        pulled.append(Member.FOOT_ANCHOR)
    at_end = (*EndMember, *PUSHED) if position != "intermediate" and row.row_end else ()
    return row.panel_lack if given.member in (*pulled, *at_end) else None


def _find_doubt(known: RowForces, force: MemberForce) -> Message | None:
    """Doubt that the creep law holds for the snow of a force that a check rests on.

    That is its member's, and what adds to it: the net's pull on the head brings that,
    as it does the post's force.
    """
    adding = [known.largest[Member.POST]] if force.added_high > 0.0 else []
    doubts = (
        find_doubt(known, density=one.case.density_kg_m3, largest=one.high_kN)
        for one in (*force.solved, *adding)
    )
    return next((one for one in doubts if one is not None), None)


def find_open(row: NetRow, judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well.

    What is not known of the row's end alone leaves no other check open.
    """
    if row.unsaid:
        return name_unsaid(row)
    members = [one for one in judged if not one.is_of_end]
    of_end = [_find_lack(row, one.given) or row.panel_lack for one in members]
    points = (
        point.message
        for one in members
        for point in one.check.open
        if point.kind in (OpenKind.UNSOLVED, OpenKind.OUTSIDE_LAW)
        and point.message not in of_end
    )
    return next(points, None)


def check_others(known: RowForces, judged: Sequence[MemberCheck]) -> Iterator[Check]:
    """Checks that compare no force: load along the row, geometry."""
    gap = find_open(known.row, judged)
    yield check_sideways(known.row, known.held, known.standard, gap)
    for found in (check_anchor_distance(known, gap), check_cover(known, gap)):
        if found is not None:
            yield found
    yield from check_row_geometry(known)


def apply_declaration(basis: Basis, check: Check) -> Check:
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
    found = basis.site.find_declaration(row, member, check.mode, check.position)
    if found is None:
        return check
    elsewhere = Open(
        kind=OpenKind.PROVEN_ELSEWHERE,
        message=found.proof.describe(),
        proof=found.proof,
    )
    return replace(check, open=[*check.open, elsewhere])
