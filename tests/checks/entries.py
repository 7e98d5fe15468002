"""A value of a limit profile, and a resistance of the foot anchor's tendon."""

from typing import Any

from netdesign.checks import StandardValue
from netdesign.site.model import Resistance


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
