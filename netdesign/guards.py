"""Guards of frozen values: each names field, value and what is accepted.

All are written in the positive, so that NaN fails them.
"""

from __future__ import annotations

import math
import re

from netdesign.errors import ModelError
from netdesign.units import given_degree_from_radian, given_kilonewton_from_newton
from netdesign.words.message import Message, say


def require_positive(name: str, value: float, unit: str = "") -> None:
    """Refuse anything but a finite number above zero."""
    if not (math.isfinite(value) and value > 0):
        raise ModelError(
            say(
                "guard.positive",
                name=name_quantity(name),
                value=float(value),
                unit=_in(unit),
            )
        )


def require_count(name: str, value: int) -> None:
    """Refuse anything but a whole number above zero."""
    if not (isinstance(value, int) and value > 0):
        raise ModelError(say("guard.count", name=name_quantity(name), value=value))


def require_within(
    name: str, value: float, low: float, high: float, unit: str = ""
) -> None:
    """Refuse anything but a finite number with ``low <= value <= high``."""
    if not (math.isfinite(value) and low <= value <= high):
        raise ModelError(
            say(
                "guard.within",
                name=name_quantity(name),
                value=value,
                low=low,
                high=high,
                unit=_in(unit),
            )
        )


def require_one_of(name: str, value: str, accepted: tuple[str, ...]) -> None:
    """Refuse a word that is not one of the accepted ones."""
    if value not in accepted:
        raise ModelError(
            say(
                "guard.one_of",
                name=name_quantity(name),
                value=value,
                accepted=accepted,
            )
        )


def name_quantity(name: str) -> Message:
    """Name of a quantity in refusals: ``quantity.slope_angle`` of ``slope angle``."""
    return say(f"quantity.{re.sub('[^a-z]+', '_', name)}")


# Units inside, and what an engineer gives: the conversion and the unit's sign.
_GIVEN = {
    " rad": (given_degree_from_radian, " deg"),
    " N/m": (given_kilonewton_from_newton, " kN/m"),
}


def show_given_units(refusal: Message) -> Message:
    """Refusal of a number in the unit in which it was given; any other as it is."""
    unit = refusal.arguments.get("unit")
    if not isinstance(unit, str) or unit not in _GIVEN:
        return refusal
    convert, given = _GIVEN[unit]
    numbers = {
        name: convert(one)
        for name, one in refusal.arguments.items()
        if isinstance(one, int | float)
    }
    return say(refusal.key, **{**refusal.arguments, **numbers, "unit": given})


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
