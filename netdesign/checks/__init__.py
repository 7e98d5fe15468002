"""Demands against the limits of a profile: pass, fail or not proven."""

from netdesign.checks.check import check_inclination, check_member, judge
from netdesign.checks.loader import (
    Standard,
    StandardValue,
    list_standards,
    load_standard,
)
from netdesign.checks.result import Band, CheckResult, GivenResistance

__all__ = [
    "Band",
    "CheckResult",
    "GivenResistance",
    "Standard",
    "StandardValue",
    "check_inclination",
    "check_member",
    "judge",
    "list_standards",
    "load_standard",
]
