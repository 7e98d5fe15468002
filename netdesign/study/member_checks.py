"""Checks of a row's members, from its forces and inputs alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import (
    Check,
    Open,
    OpenKind,
    RatedForce,
    Rating,
    Standard,
    rate_member,
)
from netdesign.checks.check import SingleTest, TestSeries
from netdesign.checks.comparison import find_missing_force, find_proof_factor
from netdesign.outcome import Verdict
from netdesign.resistance.ground import SingleTest as PullOutTest
from netdesign.site.model import Resistance
from netdesign.structure.members import ROPE_OF
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.anchor_pulls import (
    find_open_dip,
    find_pull,
)
from netdesign.study.case_records import PullRecord
from netdesign.study.member_force import (
    PUSHED,
    MemberForce,
    RowForces,
    find_force,
)
from netdesign.study.posts import find_short_post
from netdesign.study.row_resistances import (
    corrode,
    find_resistance_for_force,
    resist,
)
from netdesign.study.row_to_check import Basis
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say

FOOT_LOOSE, LOOSE_LIFTS = say("check.foot_loose"), say("check.loose_foot_lifts")
# A post of which the snow's moment leaves nothing for its force; ground that slides
UNBOUNDED = (
    *("post_bending.too_much", "wedge.slab", "direction.rope_beyond"),
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

    ``force`` is None where no case gives it. ``forces`` are those of the variant on
    which the check is worst, ``best`` those of the variant on which it is least used.
    ``again`` rates the same member on another variant.
    """

    forces: RowForces
    resistance: Resistance
    width: LoadedWidth
    check: Check
    force: MemberForce | None = None
    pull: PullRecord | None = None  # on an anchor, where one is known
    best: RowForces | None = None  # None where there is one variant
    again: Callable[[RowForces], Rated] | None = None

    @property
    def name(self) -> tuple[str, str]:
        """Member and mode."""
        return self.resistance.member, self.resistance.mode

    @property
    def is_of_end(self) -> bool:
        """A border rope, or what holds its pull along the row."""
        return self.resistance.member in ROPE_OF

    @property
    def ratio(self) -> float:
        """Upper end of the utilisation [-]; below 0 without one."""
        high = self.check.utilisation_band[1]
        return -1.0 if high is None else high

    @property
    def rating(self) -> Rating:
        """How far its check is met."""
        return self.check.rating

    def write(self) -> MemberCheck:
        """The same: its check is written."""
        return self


@dataclass(frozen=True, slots=True, kw_only=True)
class RatedMember:
    """Member of one support on one variant of the row, whose check is not yet written.

    The fields are those of a `MemberCheck`.
    """

    forces: RowForces
    resistance: Resistance
    width: LoadedWidth
    rated: RatedForce
    force: MemberForce | None = None
    pull: PullRecord | None = None

    @property
    def rating(self) -> Rating:
        """How far its check is met."""
        return self.rated.rating

    def write(self) -> MemberCheck:
        """Check with all its steps."""
        forces, force, resistance = self.forces, self.force, self.resistance
        is_beside = force is not None and forces.standard.is_by_guideline
        check = self.rated.write(force.on.by_model if force and is_beside else ())
        least = forces.find_least(resistance.member) if force else None
        check = replace(
            check,
            id=check.id + AT_SUPPORT[self.width.position],
            position=self.width.position,
            case=force.largest.case if force else None,
            load_case=least.load_case if least else "",
            load_inclination_deg=least.inclination_deg if least else None,
            resistance_derivation=resistance.derivation,
            tests=_record_tests(resistance, forces.standard),
            proof_limit_kN=kilonewton_if_known(resistance.proof_limit),
        )
        return MemberCheck(
            forces=forces,
            resistance=resistance,
            width=self.width,
            check=check,
            force=force,
            pull=self.pull,
        )


Rated = RatedMember | MemberCheck


def rate_at(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> RatedMember:
    """Rate a member of one support, on one variant of the row."""
    open_end = forces.effects.open_end
    if resistance.member in ROPE_OF and open_end:  # whatever else is missing
        ends = (Open(kind=OpenKind.UNSOLVED, message=open_end),)
        rated = replace(_rate(forces, resistance, None, ends), open=ends)
        return RatedMember(
            forces=forces, resistance=resistance, width=width, rated=rated
        )
    force = find_force(forces, resistance, width)
    pull = find_pull(forces.pulls, resistance.member, width.position)
    resistance, points = _resist_and_ask(forces, resistance, width, force)
    rated = _rate(forces, resistance, force, points)
    short = find_short_post(resistance, forces)
    if short and rated.rating.verdict is Verdict.PASS:  # a longer post fails the more
        resistance = replace(resistance, value=None, lack=short)
        rated = _rate(forces, resistance, force, points)
    met = rated.rating.by_numbers
    if resistance.open and (resistance.best is None or met is Verdict.NOT_PROVEN):
        rated = rated.with_open(OpenKind.RESISTANCE_IN_DOUBT, resistance.open)
    return RatedMember(
        forces=forces,
        resistance=resistance,
        width=width,
        rated=rated,
        force=force,
        pull=pull,
    )


def _resist_and_ask(
    forces: RowForces,
    resistance: Resistance,
    width: LoadedWidth,
    force: MemberForce | None,
) -> tuple[Resistance, tuple[Open, ...]]:
    """Find the resistance of a member to a force, and the open points of both."""
    pull = find_pull(forces.pulls, resistance.member, width.position)
    resistance, open_lasting = find_lasting(forces, resistance, pull)
    if force is not None:
        resistance = find_resistance_for_force(
            resistance, forces, pull, width, force.action
        )
    points = list(_list_open(forces, resistance, width))
    if open_lasting:
        points.append(Open(kind=OpenKind.RESISTANCE_IN_DOUBT, message=open_lasting))
    return resistance, tuple(points)


def _list_open(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> Iterator[Open]:
    """List the open points of a member's force."""
    open_forces = (
        forces.open_cases,
        forces.open_panel,
        None if resistance.member in ROPE_OF else forces.open_floor,
        _find_loose_end(forces, resistance.member, width.position),
    )
    for message in filter(None, open_forces):
        yield Open(kind=OpenKind.UNSOLVED, message=message)


def _rate(
    forces: RowForces,
    resistance: Resistance,
    force: MemberForce | None,
    points: Sequence[Open],
) -> RatedForce:
    """Rate a force; its check fails where a moment alone is too much for a post.

    Then no resistance is left for the post's force, and the utilisation has no bound.
    The same holds for a loose foot that its post surely lifts.
    """
    standard = forces.standard
    reason = points[0].message if points else say("check.no_case_solved")
    rated = rate_member(
        force.action if force else find_missing_force(reason),
        resistance,
        standard,
        points,
        strength=resist(resistance, standard, force) if force else None,
    )
    lack = resistance.lack
    if lack == FOOT_LOOSE and force and force.action.low:
        lack = LOOSE_LIFTS
    is_unbounded = lack is not None and lack.key in UNBOUNDED
    return rated.with_open(OpenKind.FAILS, lack) if lack and is_unbounded else rated


def _record_tests(resistance: Resistance, standard: Standard) -> TestSeries | None:
    tests = resistance.tests
    if tests is None or resistance.value is not None:
        return None
    return TestSeries(
        count=tests.count,
        least_kN=kilonewton_from_newton(tests.least),
        mean_kN=kilonewton_from_newton(tests.mean),
        singles=[_record_single(test) for test in tests.singles],
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
    basis: Basis, resistance: Resistance, pull: PullRecord | None
) -> tuple[Resistance, Message | None]:
    """Resistance at the end of the design life, and why it may not hold."""
    lasting, worn = corrode(resistance, basis)
    return lasting, worn or find_open_dip(resistance, pull, basis.standard)


def _find_loose_end(
    forces: RowForces, member: str, position: Position
) -> Message | None:
    """Reason why nothing holds what the end guy does to a member of the row's end."""
    is_pushed = member in PUSHED and position == "edge"
    return forces.end_guy if is_pushed and isinstance(forces.end_guy, Message) else None


def find_open(judged: Sequence[MemberCheck]) -> Message | None:
    """Reason why the forces of the row are not proven; None where they are.

    What is not known of the row's end alone leaves no other check open.
    """
    points = (
        point.message
        for member in judged
        if not member.is_of_end
        for point in member.check.open
        if point.kind is OpenKind.UNSOLVED
    )
    return next(points, None)
