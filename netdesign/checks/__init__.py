"""Demands against the limits of a profile: pass, fail or not proven."""

from netdesign.checks.check import (
    check_member,
    declare,
    find_resistance,
    judge,
    withhold,
)
from netdesign.checks.geometry import RowGeometry, check_geometry, check_inclination
from netdesign.checks.loader import (
    Standard,
    StandardTable,
    StandardValue,
    list_standards,
    load_standard,
)
from netdesign.checks.result import (
    Band,
    CheckResult,
    Declaration,
    GivenResistance,
    Proof,
)

__all__ = [
    "Band",
    "CheckResult",
    "Declaration",
    "GivenResistance",
    "Proof",
    "RowGeometry",
    "Standard",
    "StandardTable",
    "StandardValue",
    "check_geometry",
    "check_inclination",
    "check_member",
    "declare",
    "find_resistance",
    "judge",
    "list_standards",
    "load_standard",
    "withhold",
]
