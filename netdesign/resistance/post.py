"""Post: buckling as a strut hinged at both ends, and its plate on the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.guards import require_positive, require_within


@dataclass(frozen=True, slots=True, kw_only=True)
class BucklingResistance:
    """Result and its intermediate numbers, for a worked calculation.

    Attributes
    ----------
    critical : float
        Euler's load [N].
    slenderness, reduction : float
        Relative slenderness and chi [-].
    value : float
        chi A f_y [N].
    """

    critical: float
    slenderness: float
    reduction: float
    value: float


def compute_buckling_resistance(
    *,
    area: float,
    second_moment: float,
    length: float,
    yield_strength: float,
    modulus: float,
    imperfection: float,
) -> BucklingResistance:
    """Flexural buckling of EN 1993-1-1, 6.3.1; resistance/THEORY.md, eq. (R5).

    Parameters
    ----------
    area, second_moment : float
        Of the section, the latter about its weak axis [m2, m4].
    length : float
        Buckling length; that of the post between its hinges [m].
    yield_strength, modulus : float
        f_y and E [Pa].
    imperfection : float
        alpha of the buckling curve [-].

    Returns
    -------
    BucklingResistance
        Characteristic [N]. Sections of class 1 to 3 only: no local buckling.

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_positive("area", area, "m2")
    require_positive("second moment of area", second_moment, "m4")
    require_positive("buckling length", length, "m")
    require_within("yield strength", yield_strength, 1e8, 1e9, "Pa")
    require_positive("modulus", modulus, "Pa")
    require_within("imperfection factor", imperfection, 0.0, 1.0)
    critical = math.pi**2 * modulus * second_moment / length**2
    slenderness = math.sqrt(area * yield_strength / critical)
    shape = 0.5 * (1.0 + imperfection * (slenderness - 0.2) + slenderness**2)
    root = math.sqrt(max(shape**2 - slenderness**2, 0.0))
    reduction = min(1.0, 1.0 / (shape + root)) if slenderness > 0.2 else 1.0
    return BucklingResistance(
        critical=critical,
        slenderness=slenderness,
        reduction=reduction,
        value=reduction * area * yield_strength,
    )


def compute_bearing_resistance(
    *, plate_length: float, plate_width: float, bearing_stress: float
) -> float:
    """Resistance of the ground under a base plate; resistance/THEORY.md, eq. (R6).

    Parameters
    ----------
    plate_length, plate_width : float
        Of the plate that lies on the ground [m].
    bearing_stress : float
        Characteristic bearing resistance of the ground across the plate [Pa].

    Returns
    -------
    float
        Against the post's force, taken across the plate [N].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("plate length", plate_length, 0.05, 5.0, "m")
    require_within("plate width", plate_width, 0.05, 5.0, "m")
    require_positive("bearing stress", bearing_stress, "Pa")
    return plate_length * plate_width * bearing_stress
