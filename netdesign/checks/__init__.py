"""Demands against the limits of a profile: pass, fail or not proven."""

from netdesign.checks.check import Check, Open, OpenKind
from netdesign.checks.comparison import check_member, find_resistance
from netdesign.checks.geometry import Approval, RowGeometry, StatedValue, check_geometry
from netdesign.checks.loader import (
    Standard,
    list_standards,
    load_default,
    load_standard,
)
from netdesign.checks.result import Band, Declaration, GivenResistance, Proof
from netdesign.checks.schema import StandardValue

__all__ = [
    "Approval",
    "Band",
    "Check",
    "Declaration",
    "GivenResistance",
    "Open",
    "OpenKind",
    "Proof",
    "RowGeometry",
    "Standard",
    "StandardValue",
    "StatedValue",
    "check_geometry",
    "check_member",
    "find_resistance",
    "list_standards",
    "load_default",
    "load_standard",
]
