"""Checks of a row's members, from its forces and inputs alone.

Last: resistance and type with which one passes. No case is solved: neither changes a
force, but for a border rope's type, which says so. The type is the weakest one of the
workbook that does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from netdesign.checks import (
    Check,
    Open,
    OpenKind,
    RatedForce,
    Rating,
    find_resistance,
    rate_member,
)
from netdesign.checks.check import Change, SingleTest, TestSeries
from netdesign.checks.comparison import (
    find_missing_force,
    find_partial_factor,
)
from netdesign.outcome import Verdict
from netdesign.resistance.ground import SingleTest as PullOutTest
from netdesign.site.model import Resistance, Site
from netdesign.structure.members import END_ANCHORS, NAMED_BY, ROPE_OF, NetPart
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.anchor_pulls import (
    ANCHORS,
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
from netdesign.study.scopes import CLOSE
from netdesign.units import kilonewton_from_newton, kilonewton_if_known
from netdesign.words.message import Message, say

FOOT_LOOSE, LOOSE_LIFTS = say("check.foot_loose"), say("check.loose_foot_lifts")
# A post of which the snow's moment leaves nothing for its force; ground that slides
UNBOUNDED = (
    *("post_bending.too_much", "wedge.slab", "direction.rope_beyond"),
    LOOSE_LIFTS.key,
)
# What stands behind the id of a check, by the support that it is of.
AT_SUPPORT: Mapping[Position, str] = {
    "intermediate": "",
    "second": ".second",
    "edge": ".end",
}


@dataclass(frozen=True, kw_only=True)
class MemberCheck:
    """Check of one member of one support in one mode, with what it was judged from.

    It is written once it is asked for: of many corners of a row one is shown. ``force``
    is None where no case gives it. ``forces`` are those of the variant on which the
    check is worst, ``best`` those of the variant on which it is least used. ``again``
    rates the same member on another variant.
    """

    forces: RowForces
    resistance: Resistance
    width: LoadedWidth
    rated: RatedForce | Check
    force: MemberForce | None = None
    pull: PullRecord | None = None  # on an anchor, where one is known
    best: RowForces | None = None  # None where there is one variant
    again: Callable[[RowForces], MemberCheck] | None = None

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
        high = self.rating.high
        return -1.0 if high is None else high

    @property
    def rating(self) -> Rating:
        """How far its check is met."""
        return self.rated.rating

    @cached_property
    def check(self) -> Check:
        """Check with all its steps."""
        if isinstance(self.rated, Check):
            return self.rated
        forces, force, resistance = self.forces, self.force, self.resistance
        is_beside = force is not None and forces.standard.is_by_guideline
        check = self.rated.write(force.by_model if force and is_beside else ())
        least = forces.find_least(resistance.member) if force else None
        return replace(
            check,
            id=check.id + AT_SUPPORT[self.width.position],
            position=self.width.position,
            case=force.largest.case if force else None,
            load_case=least.load_case if least else "",
            load_inclination_deg=least.inclination_deg if least else None,
            resistance_derivation=resistance.derivation,
            tests=_record_tests(resistance),
            proof_limit_kN=kilonewton_if_known(resistance.proof_limit),
        )


def rate_at(
    forces: RowForces, resistance: Resistance, width: LoadedWidth
) -> MemberCheck:
    """Rate a member of one support, on one variant of the row."""
    open_end = forces.effects.open_end
    if resistance.member in ROPE_OF and open_end:  # whatever else is missing
        ends = (Open(kind=OpenKind.UNSOLVED, message=open_end),)
        rated = replace(_rate(forces, resistance, None, ends), open=ends)
        return MemberCheck(
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
    return MemberCheck(
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


def _record_tests(resistance: Resistance) -> TestSeries | None:
    tests = resistance.tests
    if tests is None or resistance.value is not None:
        return None
    return TestSeries(
        count=tests.count,
        least_kN=kilonewton_from_newton(tests.least),
        mean_kN=kilonewton_from_newton(tests.mean),
        singles=[_record_single(test) for test in tests.singles],
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


def list_remedies(member_check: MemberCheck) -> list[Change]:
    """List the changes with which a failing, unproven or close check passes."""
    basis = member_check.forces
    given = member_check.resistance
    is_of_ground = given.mode in ("sliding", "wedge") and given.dimensions
    is_of_head = given.mode == "direction"  # of which E_d sin δ is told
    if is_of_ground or is_of_head or not _is_worth_telling(basis, member_check):
        return []  # sliding goes with what presses the base; a ground is as it is
    changes = _list_resistance_remedies(basis, member_check)
    return _annotate(member_check, changes)


def _annotate(member_check: MemberCheck, changes: list[Change]) -> list[Change]:
    """Add a note to the changes that do not suffice alone.

    Another type has its own condition.
    """
    if member_check.check.has_open(OpenKind.UNSOLVED):
        note = say("change.as_far_as_solved")
        return [replace(change, note=note) for change in changes]
    if member_check.check.has_open(OpenKind.RESISTANCE_IN_DOUBT):
        note = say("change.if_rest_proven")
        return [x if x.sense == "has" else replace(x, note=note) for x in changes]
    return changes


def _is_worth_telling(basis: Basis, member_check: MemberCheck) -> bool:
    """The check has a force, and its utilisation is at least 0.9."""
    demand, used = (member_check.check.read_band(symbol)[1] for symbol in ("E_d", "μ"))
    if not demand or basis.row.is_overtopped:
        return False
    return used is None or used >= CLOSE


def _list_resistance_remedies(basis: Basis, member_check: MemberCheck) -> list[Change]:
    """Characteristic resistance that is needed, and the type that has it."""
    standard, check = basis.standard, member_check.check
    demand, factor = check.read_band("E_d")[1], check.read("γ_R")
    note: Message | None = None
    if factor is None:  # nothing is given, and so no basis: suppose a test
        tested = standard.find_resistance_factor(member_check.resistance.mode, "tested")
        factor = tested.value_si if tested else None
        note = say("change.on_basis_of_tests")
    if factor is None or demand is None:
        return []
    change = Change(
        quantity=say("change.characteristic_resistance"),
        now=check.read("R_k"),
        bound=math.ceil(demand * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        note=note,
    )
    if member_check.force is not None and member_check.force.by_truss is not None:
        return [change]  # another rope has another stiffness, and so another force
    kind = find_type_change(basis, member_check.resistance, demand, member_check.pull)
    return [change, kind] if kind else [change]


def find_ground(site: Site, type_id: str) -> str:
    """Ground of an anchor type of the workbook; "" where it is not given."""
    grounds = (kind.ground for kind in site.catalogue if kind.type_id == type_id)
    return next((ground for ground in grounds if ground), "")


def holds_in_ground(member: str, now: str, other: Resistance) -> bool:
    """Validity of a type in the ground of the type that it would replace.

    A type without a given ground proves nothing in any ground.

    Parameters
    ----------
    member : str
        What the type is for; only anchors stand in a ground.
    now : str
        Ground of the row, or of the type that is there; "" for an unknown one.
    other : Resistance
        Of the type that would replace it.
    """
    is_anchor = member in (*ANCHORS, *END_ANCHORS)
    return not is_anchor or not now or now == other.ground


def find_type_change(
    basis: Basis, resistance: Resistance, demand: float, pull: PullRecord | None
) -> Change | None:
    """Weakest type of the workbook whose design resistance reaches ``demand`` [kN].

    Whether a net row uses it or not; those whose own resistance is proven come before
    the others. None where the type that is there does, where it is that of another
    member, or no type would.

    An anchor type of another ground, or of one that is not known, is none of them.
    ``pull`` is that on the anchor.
    """
    if resistance.member in NAMED_BY:
        return None
    enough = list(_list_enough(basis, resistance, demand, pull))
    sure = [candidate for candidate in enough if candidate.note is None]
    if any(candidate.type_id == resistance.type_id for candidate in sure or enough):
        return None
    weakest = min(sure or enough, key=lambda x: (x.design, x.type_id), default=None)
    if weakest is None:
        return None
    return Change(
        quantity=say("change.type_of_workbook", type=weakest.type_id),
        now=kilonewton_if_known(resistance.value),
        bound=math.floor(weakest.value * 10.0) / 10.0,
        sense="has",
        note=weakest.note,
    )


def _find_note(resistance: Resistance, open_lasting: Message | None) -> Message | None:
    """Condition of another type; a border rope's stiffness changes its force."""
    if open_lasting:
        return say("change.if_rest_proven")
    is_of_net = resistance.member in tuple(NetPart)
    return say("change.solve_again") if is_of_net else None


@dataclass(frozen=True, slots=True)
class _Enough:
    """A type that reaches a demand: design and characteristic resistance [kN]."""

    type_id: str
    design: float
    value: float
    note: Message | None


def _list_enough(
    basis: Basis, resistance: Resistance, demand: float, pull: PullRecord | None
) -> Iterator[_Enough]:
    """List the types of the workbook that reach a demand in the same ground."""
    row, standard = basis.row, basis.standard
    ground = row.ground_type or resistance.ground
    for other in basis.site.catalogue:
        is_here = holds_in_ground(resistance.member, ground, other)
        if other.mode != resistance.mode or not is_here:
            continue
        other = replace(other, member=resistance.member)
        lasting, worn = corrode(other, basis)
        if worn or find_short_post(other, basis):
            continue
        value = find_resistance(lasting, standard).value
        factor = find_partial_factor(other, standard)
        if value is None or factor is None:
            continue
        _, open_lasting = find_lasting(basis, other, pull)
        design = value / factor.value_si
        if design >= demand:
            yield _Enough(other.type_id, design, value, _find_note(other, open_lasting))
