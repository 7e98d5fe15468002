"""Resistance and type with which a check passes.

No case is solved: neither changes a force, but for a border rope's type, which says so.
The type is the weakest one of the workbook that does.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from netdesign.checks import OpenKind, find_resistance
from netdesign.checks.check import Change
from netdesign.checks.comparison import find_partial_factor
from netdesign.site.model import Resistance, Site
from netdesign.structure.members import END_ANCHORS, NAMED_BY, NetPart
from netdesign.study.anchor_pulls import ANCHORS
from netdesign.study.case_records import PullRecord
from netdesign.study.member_checks import MemberCheck, find_lasting
from netdesign.study.posts import find_short_post
from netdesign.study.row_resistances import corrode
from netdesign.study.row_to_check import Basis
from netdesign.study.scopes import CLOSE
from netdesign.units import kilonewton_if_known
from netdesign.words.message import Message, say


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
        unit="kN",
        now=check.read("R_k"),
        bound=math.ceil(demand * factor * 10.0 - 1e-9) / 10.0,
        sense="at least",
        note=note,
    )
    if member_check.force is not None and member_check.force.on.shared is not None:
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
        unit="kN",
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
