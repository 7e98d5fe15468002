"""The weakest type that would do: of the workbook, or a part of the catalogue."""

from __future__ import annotations

import math

from netdesign.checks import Standard, find_resistance
from netdesign.site.model import NAMED_BY, NetRow, Resistance, Site
from netdesign.structure.members import EndMember, Member
from netdesign.study.catalogue_sizes import find_size
from netdesign.study.corrosion import corrode
from netdesign.study.dependent import find_short_post
from netdesign.study.records import ChangeRecord
from netdesign.units import kilonewton_if_known
from netdesign.words.message import Message, say

_ANCHORS = (
    *(Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR, Member.DOWNHILL_ANCHOR),
    *(EndMember.LATERAL_ANCHOR, EndMember.END_GUY_ANCHOR),
)


def find_ground(site: Site, type_id: str) -> str:
    """Ground of an anchor type of the workbook; "" where nobody gives it."""
    found = (one.ground for one in site.catalogue if one.type_id == type_id)
    return next((ground for ground in found if ground), "")


def holds_in_ground(member: str, now: str, other: Resistance) -> bool:
    """Validity of a type in the ground of the type that it would replace.

    A type whose ground nobody gives proves nothing in any.

    Parameters
    ----------
    member : str
        What the type is for; only anchors stand in a ground.
    now : str
        Ground of the row, or of the type that is there; "" for an unknown one.
    other : Resistance
        Of the type that would replace it.
    """
    return member not in _ANCHORS or not now or now == other.ground


def find_type_change(
    site: Site, row: NetRow, given: Resistance, demand: float, standard: Standard
) -> ChangeRecord | None:
    """Type whose design resistance reaches the design ``demand`` [kN].

    First the weakest type of the workbook, whether a net row uses it or not; else the
    smallest part of the catalogue. None where the type that is there does, where
    it is that of another member, or nothing is known that would.

    An anchor type of another ground, or of one that is not known, is none of them.
    """
    if given.member in NAMED_BY:
        return None
    enough = _list_enough(site, row, given, demand, standard)
    if given.type_id in enough:
        return None
    if enough:
        weakest = min(enough, key=lambda key: (enough[key], key))
        told = say("change.type_of_workbook", type=weakest)
        return _record(told, enough[weakest][1], given)
    basis = "computed" if given.mode == "pull_out" else "declared"
    factor = standard.find_resistance_factor(given.mode, basis)
    needed = demand / _find_share(given)
    size = find_size(given, needed * factor.value_si) if factor else None
    return _record(size.told, size.resistance, given) if size else None


def _find_share(given: Resistance) -> float:
    """Share of a resistance that corrosion leaves [-]; a larger bar loses less."""
    how = given.derivation
    share = how.arguments.get("share") if how and given.wear else None
    return float(str(share)) if share else 1.0


def _list_enough(
    site: Site, row: NetRow, given: Resistance, demand: float, standard: Standard
) -> dict[str, tuple[float, float]]:
    """Types of the workbook that reach a demand; none of another ground.

    Each with its design and its characteristic resistance [kN].
    """
    found = {}
    for other in site.catalogue:
        ground = row.ground_type or given.ground
        is_here = holds_in_ground(given.member, ground, other)
        lasting, worn = corrode(other, row, standard)
        is_other = other.mode != given.mode or not is_here
        if is_other or worn or find_short_post(other, row, site.ranges):
            continue
        factor = standard.find_resistance_factor(other.mode, other.basis)
        value = find_resistance(lasting, standard).value
        if value is None or factor is None:
            continue
        if value / factor.value_si >= demand:
            found[other.type_id] = (value / factor.value_si, value)
    return found


def _record(quantity: Message, value: float, given: Resistance) -> ChangeRecord:
    return ChangeRecord(
        quantity=quantity,
        unit="kN",
        now=kilonewton_if_known(given.value),
        bound=math.floor(value * 10.0) / 10.0,
        sense="has",
        solves=0,
    )
