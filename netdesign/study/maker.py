"""Anchor forces that a net's maker states, beside those that are worked out."""

from __future__ import annotations

from collections.abc import Mapping

from netdesign.calculation.quantity import Quantity, given
from netdesign.checks import Standard
from netdesign.site.model import NetRow
from netdesign.structure.members import Member
from netdesign.units import kilonewton_from_newton

_STATED: Mapping[str, str] = {
    Member.FOOT_ANCHOR: "foot_force",
    Member.UPHILL_ANCHOR: "uphill_force",
    Member.DOWNHILL_ANCHOR: "downhill_force",
}


def list_maker_leaves(row: NetRow, standard: Standard, member: str) -> list[Quantity]:
    """Characteristic force on an anchor by the net's maker, where it is a floor."""
    name = _STATED.get(member)
    stated = getattr(row.approval, name) if row.approval and name else None
    if stated is None or not standard.has_maker_floor:
        return []
    return [given("E_m0", kilonewton_from_newton(stated.value), "kN", stated.cell)]
