"""A value of a limit profile, and a resistance of the foot anchor's tendon."""

from typing import Any

from netdesign.calculation.quantity import Kind, Quantity, leaf
from netdesign.checks import Open, OpenKind, StandardValue
from netdesign.checks.comparison import find_missing_force
from netdesign.site.model import Resistance
from netdesign.units import kilonewton_from_newton
from netdesign.words.catalogue import as_given
from netdesign.words.message import say


def a_value(value_id: str, value: float, unit: str = "-") -> StandardValue:
    return StandardValue(
        id=value_id,
        clause="4.2",
        text="A value.",
        value=value,
        unit=unit,
        status="user",
        source="test",
    )


def a_resistance(value: float | None = 1.0, **changes: Any) -> Resistance:
    words = {
        "member": "foot_anchor",
        "mode": "tendon",
        "basis": "declared",
        "type_id": "GEWI 25",
        "source": "Anchors!B4",
    }
    return Resistance(value=value, **(words | changes))


def a_force(value: float, low: float | None = None, high: float | None = None):
    """Characteristic force E_k with its band [N]."""
    ends = [value if end is None else end for end in (low, value, high)]
    low_kN, value_kN, high_kN = map(kilonewton_from_newton, ends)
    return leaf(
        *("E_k", value_kN, "kN", "foot_anchor"),
        kind=Kind.SOLVED,
        band=(low_kN, high_kN),
    )


def no_force() -> Quantity:
    return find_missing_force(say("check.no_case_solved"))


def unsolved(gap: str | None) -> list[Open]:
    """Open point of forces that do not cover every case; none of no gap."""
    if not gap:
        return []
    return [Open(kind=OpenKind.UNSOLVED, message=as_given(gap))]
