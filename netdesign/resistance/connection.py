"""Links between a rope and its anchor: the weakest of them bears the force."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.resistance.catalogue import Datum, interpolate, load_catalogue
from netdesign.words.message import say

SHACKLE = "shackle"


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """One link of a chain, such as a shackle, or several that share the force.

    Attributes
    ----------
    kind : str
        As in sheet Links.
    breaking : float or None
        Characteristic strength, the least that breaks it [N]; None beside a ``limit``.
    limit : float or None
        Working load limit [N]; None beside ``breaking``.
    count : int
        How many of them share the force.
    angle : float or None
        Of the force to the line of a shackle, where it is given [rad]; it counts where
        no pull tells it.
    source : str
        Cell of its strength.
    """

    kind: str
    breaking: float | None
    limit: float | None
    count: int
    angle: float | None
    source: str


def find_direction_factor(angle: float) -> Datum:
    """Share of its strength that a shackle has under a force beside its line [-].

    Linear between the angles of the catalogue; resistance/THEORY.md, (R17).

    Parameters
    ----------
    angle : float
        0 in line, at most a right angle [rad]; beyond as at a right angle.

    Verified by
    -----------
    tests/verification/test_connection.py
    """
    table = load_catalogue()["shackle"]
    angles, factors = table["angle_deg"], table["factor"]
    factor = interpolate(angles, factors, min(math.degrees(abs(angle)), angles[-1]))
    source = say("resistance_source.shackle")
    return Datum(value=factor, status=table["status"], source=source)


def find_angle(link: Link, pulled: float | None) -> float:
    """Angle of the force to the line of a link: of the pull, else as given, else right.

    Parameters
    ----------
    link : Link
        One of a chain.
    pulled : float or None
        Angle of the pull to its line, where that is known [rad].
    """
    if pulled is not None:
        return pulled
    return math.pi / 2 if link.angle is None else link.angle


def resist_link(
    link: Link, *, pulled: float | None, on_action: float, on_resistance: float
) -> float:
    """Characteristic resistance of a link, R_k [N]; resistance/THEORY.md, (R17).

    A working load limit is met by the characteristic force: both partial factors are
    in what stands for it.

    Parameters
    ----------
    link : Link
        One of a chain.
    pulled : float or None
        Angle of the pull to its line, where that is known [rad].
    on_action, on_resistance : float
        Partial factors by which the check goes [-].

    Verified by
    -----------
    tests/verification/test_connection.py
    """
    strength = link.count * (link.breaking or 0.0)
    if link.limit is not None:
        strength = link.count * link.limit * on_action * on_resistance
    if link.kind != SHACKLE:
        return strength
    return find_direction_factor(find_angle(link, pulled)).value * strength
