"""Checks of a row's members, from what its study states of forces and inputs.

The same functions judge after a solve and judge a stored study again: nothing here
knows a solved case.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import CheckResult, withhold
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import CONNECTED, ROPE_OF, Member
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.bores import check_anchor_distance, check_cover
from netdesign.study.case_records import ForceRecord
from netdesign.study.check_to_record import (
    doubt_ground,
    doubt_sharing,
    judge_force,
    record_geometry,
    record_result,
)
from netdesign.study.dependent import (
    connect,
    corrode,
    find_resistance_for_force,
    find_short_post,
)
from netdesign.study.member_force import (
    MemberForce,
    RowForces,
    find_force,
    find_lack,
    find_other_panel,
    lifts,
    name_governing,
    name_unsaid,
)
from netdesign.study.pulls import check_directions, doubt_mortar, find_pull
from netdesign.study.records import CheckRecord
from netdesign.study.row_to_check import Basis, find_doubt
from netdesign.study.sideways import check_sideways
from netdesign.study.support_records import PullRecord
from netdesign.words.message import Message, say
from netdesign.words.names import name


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCheck:
    """One member of one support in one mode, judged.

    ``force`` is None where it is not known at all; ``gap`` says why it is not known as
    a whole, ``doubt`` why the creep law may not hold for the governing snow, ``unsure``
    why the resistance may not hold; None if all is well.
    """

    given: Resistance
    width: LoadedWidth
    result: CheckResult
    force: MemberForce | None = None
    gap: Message | None = None
    doubt: Message | None = None
    unsure: Message | None = None
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
    def id(self) -> str:
        """Name of its check, with its support."""
        end = ".end" if self.width.position == "edge" else ""
        return f"{self.result.id}{end}"

    @property
    def use(self) -> float | None:
        """Utilisation for each kN on a member inside the row [1/kN].

        None without a resistance.
        """
        factor, design = map(self.result.find_value, ("γ_E", "R_d"))
        if self.force is None or not (factor and design):
            return None
        return self.force.on_support * factor / design

    @property
    def ratio(self) -> float:
        """Upper end of the utilisation [-]; below 0 without one."""
        used = self.result.used
        return -1.0 if used is None or used.high is None else used.high


def is_worst(one: MemberCheck, judged: Iterable[MemberCheck]) -> bool:
    """No other support uses the member more."""
    rivals = [other for other in judged if other.name == one.name]
    return one is max(rivals, key=lambda other: other.ratio)


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
    judged = []
    for width, given in checked:
        judged.append(_judge_member(known, given, width))
        is_rope = given.mode in ("tendon", "rope") and given.member in CONNECTED
        if is_rope and "connections" not in not_checked:
            chain = _find_chain(known, given, width)
            judged.append(_judge_member(known, chain, width))
    return judged


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
    row, standard = known.row, known.standard
    unsaid = _find_unsaid(known, given, width)
    if unsaid:  # whatever else is missing
        result = judge_force(given, None, standard, gap=unsaid, doubt=None)
        result = withhold(result, unsaid)
        return MemberCheck(given=given, width=width, gap=unsaid, result=result)
    force = find_force(known, given, width)
    pull = find_pull(known.pulls, given.member, width.position)
    given, unsure = find_lasting(known, given, pull)
    doubt = None
    if force is not None:
        given = find_resistance_for_force(given, known, pull)
        doubt = _find_doubt(known, force)
    gap = known.gap or (None if given.member in ROPE_OF else known.floor_gap)
    gap = gap or _find_unseen(force.solved if force else ())
    gap = gap or find_other_panel(row, given, width.position)
    result = judge_force(given, force, standard, gap=gap, doubt=doubt or unsure)
    short = find_short_post(given, known)
    if short and result.verdict is Verdict.PASS:  # a longer post fails all the more
        given = replace(given, value=None, lack=short)
        result = judge_force(given, force, standard, gap=gap, doubt=doubt)
    return MemberCheck(
        given=given,
        width=width,
        force=force,
        gap=gap,
        doubt=doubt,
        result=result,
        unsure=unsure,
        pull=pull,
    )


def find_lasting(
    basis: Basis, given: Resistance, pull: PullRecord | None
) -> tuple[Resistance, Message | None]:
    """Resistance at the end of the design life, and why it may not hold."""
    row = basis.row
    lasting, worn = corrode(given, basis)
    doubt = worn or doubt_ground(row, given) or doubt_sharing(row, given)
    return lasting, doubt or doubt_mortar(given, pull)


def _find_unsaid(
    known: RowForces, given: Resistance, width: LoadedWidth
) -> Message | None:
    """Lack of what a force depends on, so that nothing is known of it."""
    row = known.row
    if row.unsaid:
        return name_unsaid(row)
    if known.panel_gap is not None:
        return known.panel_gap
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


def _find_unseen(forces: Sequence[ForceRecord]) -> Message | None:
    """Quantities between whose samples nothing is known of some largest force."""
    unknown = dict.fromkeys(axis for one in forces for axis in one.unknown)
    if not unknown:
        return None
    return say("check.unseen_between", axes=tuple(name("axis", one) for one in unknown))


def find_open(row: NetRow, judged: Sequence[MemberCheck]) -> Message | None:
    """Gap of the forces, else a doubt about any of them; None if all is well.

    What is not known of the row's end alone leaves no other check open.
    """
    if row.unsaid:
        return name_unsaid(row)
    members = [one for one in judged if not one.is_of_end]
    found = (find_lack(row, one.given) or row.panel_lack for one in members)
    of_end = [one for one in found if one is not None]
    points = ((None if one.gap in of_end else one.gap) or one.doubt for one in members)
    return next((one for one in points if one is not None), None)


def record_member(known: RowForces, one: MemberCheck) -> CheckRecord:
    """Check of a force as the study has it, without what a solve adds to it."""
    position = one.width.position
    check = record_result(known, one.result, position, one.given, one.force)
    if one.unsure is None:
        check = replace(
            check,
            resistance_years=known.row.design_life if one.given.wear else None,
        )
    if one.force is None:
        return check
    check = replace(check, case=one.force.largest.case)
    if one.is_of_end:
        return replace(check, governs="panel")
    least = known.find_least(one.given.member)
    load_case = least.load_case if least else ""
    return replace(
        check,
        load_case=load_case,
        load_inclination_deg=least.inclination_deg if least else None,
        reason=name_governing(check.reason, one.force, load_case),
    )


def record_others(
    known: RowForces, judged: Sequence[MemberCheck]
) -> Iterator[CheckRecord]:
    """Checks that compare no force: load along the row, directions, geometry."""
    gap = find_open(known.row, judged)
    lateral = check_sideways(known.row, known.held, known.standard, gap)
    yield record_result(known, lateral)
    for place, one in check_directions(known.pulls, known.standard, gap):
        yield record_result(known, one, place)
    for found in (check_anchor_distance(known, gap), check_cover(known, gap)):
        if found is not None:
            yield record_result(known, found)
    yield from record_geometry(known)
