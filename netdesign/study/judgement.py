"""Checks of a row's members, from its forces and inputs alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Check, Open, OpenKind, Standard, check_member
from netdesign.checks.check import SingleTest, TestSeries, rate_utilisation
from netdesign.checks.comparison import find_missing_force, find_proof_factor
from netdesign.checks.schema import BY_REPORT
from netdesign.outcome import ModelError, Verdict
from netdesign.resistance.ground import SingleTest as PullOutTest
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import (
    ROPE_OF,
    EndMember,
    Member,
    NetPart,
)
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.case_records import PullRecord
from netdesign.study.dependent import (
    corrode,
    find_resistance_for_force,
    resist,
    settle_basis,
    shorten_bond,
)
from netdesign.study.member_force import (
    PUSHED,
    MemberForce,
    RowForces,
    find_force,
    size_force,
)
from netdesign.study.posts import ask_efficiency, find_short_post
from netdesign.study.pulls import (
    doubt_mortar,
    find_pull,
)
from netdesign.study.row_to_check import Basis
from netdesign.study.sideways import ask_end_guy
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


WORSE = (Verdict.PASS, Verdict.DECLARED, Verdict.NOT_PROVEN, Verdict.FAIL)
# What stands behind the id of a check, by the support that it is of.
AT_SUPPORT: Mapping[Position, str] = {
    "intermediate": "",
    "second": ".second",
    "edge": ".end",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCheck:
    """Check of one member of one support in one mode, with what it was judged from.

    ``force`` is None where it is not known at all; ``known`` is the variant of the row
    on which the check is worst, ``best`` that on which it is least used, ``again``
    judges the same on another one.
    """

    known: RowForces
    given: Resistance
    width: LoadedWidth
    check: Check
    force: MemberForce | None = None
    pull: PullRecord | None = None  # on an anchor, where one is known
    best: RowForces | None = None  # None where there is one variant
    again: Callable[[RowForces], MemberCheck] | None = None

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


def judge_member(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> MemberCheck:
    """Check of a member of one support, on one variant of the row."""
    unsaid = _find_unsaid(known, given, width)
    if unsaid:  # whatever else is missing
        points = [Open(kind=OpenKind.UNSOLVED, message=unsaid)]
        check = replace(judge_force(known, given, None, width, points), open=points)
        return MemberCheck(known=known, given=given, width=width, check=check)
    force = find_force(known, given, width)
    pull = find_pull(known.pulls, given.member, width.position)
    given, points = _resist_and_ask(known, given, width, force)
    check = judge_force(known, given, force, width, points)
    short = find_short_post(given, known)
    if short and check.verdict is Verdict.PASS:  # a longer post fails all the more
        given = replace(given, value=None, lack=short)
        check = judge_force(known, given, force, width, points)
    met = rate_utilisation(*check.utilisation_band)
    if given.doubt and (given.best is None or met is Verdict.NOT_PROVEN):
        check = check.with_open(OpenKind.RESISTANCE_IN_DOUBT, given.doubt)
    return MemberCheck(
        known=known, given=given, width=width, force=force, check=check, pull=pull
    )


def _resist_and_ask(
    known: RowForces, given: Resistance, width: LoadedWidth, force: MemberForce | None
) -> tuple[Resistance, list[Open]]:
    """Resistance of a member to a force, and all that is open of both."""
    pull = find_pull(known.pulls, given.member, width.position)
    given, unsure = find_lasting(known, given, pull)
    if force is not None:
        given = find_resistance_for_force(given, known, pull, width, force.action)
    points = list(_list_open(known, given, width))
    if asked := ask_efficiency(given, known, width):
        points.append(Open(kind=OpenKind.VALUE_ASKED, message=asked))
    if unsure:
        points.append(Open(kind=OpenKind.RESISTANCE_IN_DOUBT, message=unsure))
    return given, points


@dataclass(frozen=True, slots=True, kw_only=True)
class Rating:
    """What decides how grave a member's check is, before its calculation is made.

    Attributes
    ----------
    group : tuple
        What is open of it: of two checks with the same that of the larger use is the
        graver one.
    low, high : float
        Force over resistance, ends of its band [kN/N]; over 1 without a resistance.
    """

    group: tuple[object, ...]
    low: float
    high: float


def rate_member(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> Rating | None:
    """Rating of a member's check; None where only the check itself tells it."""
    if _find_unsaid(known, given, width):
        return Rating(group=(), low=0.0, high=0.0)
    try:
        force = size_force(known, given, width)
    except ModelError:  # outside the range of an operation
        return None
    if force is None:
        return None
    lasting, points = _resist_and_ask(known, given, width, force)
    least, most = _find_resistance_ends(lasting, force)
    action, short = force.action, find_short_post(lasting, known)
    if action.low is None or action.high is None:
        return None
    lack = lasting.lack.key if lasting.lack else ""
    kinds = [(one.kind, one.message.key) for one in points]
    is_known = (lasting.value is None, lasting.doubt is None, lasting.best is None)
    group = (*kinds, lack, short is None, *is_known, action.low > 0.0)
    return Rating(group=group, low=action.low / most, high=action.high / least)


def _find_resistance_ends(given: Resistance, force: MemberForce) -> tuple[float, float]:
    """Least and largest resistance to a force, [N] or of any unit; 1 where unknown."""
    pressing = force.on.pressing
    if isinstance(given.dimensions, float) and pressing is not None:
        found = given.dimensions * (pressing.value or 0.0)
        return found or 1.0, found or 1.0
    least = given.value or 1.0
    return least, max(least, given.best or 0.0)


def _list_open(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> Iterator[Open]:
    """What is open of a member's force: of its cases, of what pulls it."""
    gaps = (
        known.gap,
        known.panel_gap,
        None if given.member in ROPE_OF else known.floor_gap,
        _find_other_panel(known.row, given, width.position),
        _find_loose_end(known, given.member, width.position),
    )
    for gap in filter(None, gaps):
        yield Open(kind=OpenKind.UNSOLVED, message=gap)
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


def find_open(row: NetRow, judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well.

    What is not known of the row's end alone leaves no other check open.
    """
    members = [one for one in judged if not one.is_of_end]
    of_end = [_find_lack(row, one.given) or row.panel_lack for one in members]
    points = (
        point.message
        for one in members
        for point in one.check.open
        if point.kind is OpenKind.UNSOLVED and point.message not in of_end
    )
    return next(points, None)
