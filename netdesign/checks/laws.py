"""Laws that a solved case obeys whatever the mesh, and when each counts as met."""

from __future__ import annotations

BALANCE = 1e-3  # of a largest force or of the weight: tight enough for print
DIRECTION = 2e-2  # pulls are those of two meshes, the shape that of the finer one
DIRECTION_ERRORS = 3.0  # or so many times the relative error of the end's pull
RATIO = 1e-2  # of the ratio of tensions, as the allowed error of forces

# Largest value of each law whose limit does not depend on the case [-].
LIMITS = {
    "global_balance": BALANCE,
    "friction_excess": BALANCE,
    "head_balance": BALANCE,
    "tension_share": 0.0,  # that one lies above it
}


def is_law_met(name: str, value: float | None, limit: float | None) -> bool:
    """A law is met.

    Parameters
    ----------
    name : str
        As in an ``IndependentRecord``.
    value : float or None
        Share or ratio [-]; None where there is none, which never meets a law.
    limit : float or None
        Its limit [-]; None where nothing bounds a ratio of tensions.
    """
    if value is None or (limit is None and name != "capstan_ratio"):
        return False
    if name == "tension_share":  # a net does not push
        return value > 0.0
    if name == "capstan_ratio":
        return limit is None or value <= limit * (1.0 + RATIO)
    return limit is not None and abs(value) <= limit
