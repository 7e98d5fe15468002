"""Checks of a row's members, from its forces and inputs alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Check, Open, OpenKind, Standard, check_member
from netdesign.checks.check import SingleTest, TestSeries, rate_utilisation
from netdesign.checks.comparison import find_missing_force
from netdesign.checks.schema import BY_REPORT
from netdesign.checks.tested import find_proof_factor
from netdesign.outcome import Verdict
from netdesign.resistance.pull_out import SingleTest as PullOutTest
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import CONNECTED, ROPE_OF, Member
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.bores import check_anchor_distance, check_cover
from netdesign.study.dependent import (
    connect,
    corrode,
    find_resistance_for_force,
    resist,
    shorten_bond,
)
from netdesign.study.geometry_checks import check_row_geometry
from netdesign.study.member_force import (
    MemberForce,
    RowForces,
    find_force,
    find_lack,
    find_other_panel,
    lifts,
    name_unsaid,
)
from netdesign.study.posts import find_short_post
from netdesign.study.pulls import (
    check_direction,
    doubt_mortar,
    find_pull,
    lack_sharing,
)
from netdesign.study.row_to_check import Basis, find_doubt
from netdesign.study.sideways import check_sideways
from netdesign.study.support_records import PullRecord
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say

FOOT_LOOSE, LOOSE_LIFTS = say("check.foot_loose"), say("check.loose_foot_lifts")
# A post of which the snow's moment leaves nothing for its force; ground that slides
UNBOUNDED = (
    *("post_bending.too_much", "wedge.slab", "direction.rope_beyond"),
    LOOSE_LIFTS.key,
)


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
    checked = [
        (width, given)
        for width in effects.supports
        for given in row.resistances_at(width.position)
        if _concerns(known, given)
    ]
    checked += [(at_end, given) for given in (*parts, *held)]
    turned = [one for one in checked if one[1].mode == "direction"]
    judged = []
    for width, given in checked:
        if given.mode == "direction":
            continue
        judged.append(_judge_member(known, given, width))
        is_rope = given.mode in ("tendon", "rope") and given.member in CONNECTED
        if is_rope and "connections" not in not_checked:
            chain = _find_chain(known, given, width)
            judged.append(_judge_member(known, chain, width))
    gap = find_open(row, judged)
    return judged + [
        _judge_direction(known, given, width, gap) for width, given in turned
    ]


def _judge_direction(
    known: RowForces, given: Resistance, width: LoadedWidth, gap: Message | None
) -> MemberCheck:
    """Check of a rope anchor's angle; beyond what it turns by, of its head."""
    pull = find_pull(known.pulls, given.member, width.position)
    check = check_direction(pull, known.standard, gap) if pull else None
    if check is None:
        return _judge_member(known, given, width)
    is_at_end = width.position == "edge"
    check = replace(
        check,
        id=f"{check.id}.end" if is_at_end else check.id,
        position=width.position,
    )
    return MemberCheck(given=given, width=width, check=check, pull=pull)


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
        find_other_panel(known.row, given, width.position),
    )
    for gap in filter(None, gaps):
        yield Open(kind=OpenKind.UNSOLVED, message=gap)
    doubt = _find_doubt(known, force) if force else None
    if doubt is not None:
        yield Open(kind=OpenKind.OUTSIDE_LAW, message=doubt)


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
    standard, is_at_end = known.standard, width.position == "edge"
    gap = points[0].message if points else say("check.no_case_solved")
    check = check_member(
        force.action if force else find_missing_force(gap),
        given,
        standard,
        points,
        strength=resist(given, standard, force) if force else None,
    )
    least = known.find_least(given.member) if force else None
    doubted = check.has_open(OpenKind.RESISTANCE_IN_DOUBT)
    check = replace(
        check,
        id=f"{check.id}.end" if is_at_end else check.id,
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
    row = basis.row
    lasting, worn = corrode(shorten_bond(given, basis.standard), basis)
    doubt = worn or doubt_ground(row, given) or doubt_sharing(row, given)
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
    is_inside = width.position == "intermediate" and given.member in tuple(Member)
    return None if is_inside else find_lack(row, given)


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


def doubt_ground(row: NetRow, given: Resistance) -> Message | None:
    """Doubt that a pull-out resistance holds where nobody says in which ground."""
    names = row.list_unsaid_grounds(given)
    return say("check.no_ground", names=names) if names else None


def doubt_sharing(row: NetRow, given: Resistance) -> Message | None:
    """Doubt about an anchor of which nobody says whether it holds two guys."""
    of_guys = (Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR)
    return lack_sharing(row.guys) if given.member in of_guys else None


def find_open(row: NetRow, judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well.

    What is not known of the row's end alone leaves no other check open.
    """
    if row.unsaid:
        return name_unsaid(row)
    members = [one for one in judged if not one.is_of_end]
    of_end = [find_lack(row, one.given) or row.panel_lack for one in members]
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
