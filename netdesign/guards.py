"""Guards of frozen values: each names field, value and what is accepted.

All are written in the positive, so that NaN fails them.
"""

from __future__ import annotations

import math

from netdesign.errors import ModelError


def require_positive(name: str, value: float, unit: str = "") -> None:
    """Refuse anything but a finite number above zero."""
    if not (math.isfinite(value) and value > 0):
        raise ModelError(
            f"{name} = {value!r}: must be a finite number above 0{_in(unit)}"
        )


def require_count(name: str, value: int) -> None:
    """Refuse anything but a whole number above zero."""
    if not (isinstance(value, int) and value > 0):
        raise ModelError(f"{name} = {value!r}: must be a whole number above 0")


def require_within(
    name: str, value: float, low: float, high: float, unit: str = ""
) -> None:
    """Refuse anything but a finite number with ``low <= value <= high``."""
    if not (math.isfinite(value) and low <= value <= high):
        raise ModelError(
            f"{name} = {value!r}: must lie between {low:g} and {high:g}{_in(unit)}"
        )


def require_one_of(name: str, value: str, accepted: tuple[str, ...]) -> None:
    """Refuse a word that is not one of the accepted ones."""
    if value not in accepted:
        raise ModelError(f"{name} = {value!r}: must be one of {', '.join(accepted)}")


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
