"""Demands against the limits of a profile: pass, fail or not proven."""

from netdesign.checks.check import (
    check_member,
    declare,
    find_resistance,
    withhold,
)
from netdesign.checks.geometry import RowGeometry, check_geometry
from netdesign.checks.loader import (
    Standard,
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
    "StandardValue",
    "check_geometry",
    "check_member",
    "declare",
    "find_resistance",
    "list_standards",
    "load_standard",
    "withhold",
]
