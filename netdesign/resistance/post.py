"""Post: strut hinged at both ends, with snow against it, and its plate on ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import require_positive, require_within


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


@dataclass(frozen=True, slots=True, kw_only=True)
class PostSection:
    """Section of a post that bends, beside its resistance to buckling.

    Attributes
    ----------
    width : float
        That the snow presses on [m].
    length : float
        Between the hinges [m].
    modulus, strength : float
        Section modulus W and f_y [m3, Pa].
    critical, buckling : float
        N_cr and chi A f_y of `BucklingResistance` [N].
    """

    width: float
    length: float
    modulus: float
    strength: float
    critical: float
    buckling: float

    def __post_init__(self) -> None:
        """Refuse impossible numbers."""
        require_within("post width", self.width, 0.01, 1.0, "m")
        require_positive("buckling length", self.length, "m")
        require_positive("section modulus", self.modulus, "m3")
        require_positive("yield strength", self.strength, "Pa")
        require_positive("critical load", self.critical, "N")
        require_positive("buckling resistance", self.buckling, "N")

    @property
    def moment_resistance(self) -> float:
        """W f_y [N m]."""
        return self.modulus * self.strength


def compute_post_moment(
    section: PostSection, *, pressure: float, efficiency: float
) -> float:
    """Moment of the snow against a hinged post; resistance/THEORY.md, eq. (R10).

    Parameters
    ----------
    section : PostSection
        Of the post.
    pressure : float
        Of the snow on a plane across the slope, its mean over the thickness [Pa].
    efficiency : float
        eta, factor of a slender member [-].

    Returns
    -------
    float
        p l^2 / 8 [N m].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_positive("snow pressure", pressure, "Pa")
    require_within("efficiency factor", efficiency, 0.1, 50.0)
    return efficiency * pressure * section.width * section.length**2 / 8.0


def compute_bent_post_resistance(
    section: PostSection, *, moment: float, partial_factor: float
) -> float | None:
    """Compression that a post bears beside a moment; resistance/THEORY.md, (R11).

    Parameters
    ----------
    section : PostSection
        Of the post.
    moment : float
        Design moment of the load across it, before any amplification [N m].
    partial_factor : float
        gamma of the resistance [-].

    Returns
    -------
    float or None
        R_k: over the partial factor it is the design resistance [N]. None where the
        moment alone is too much.

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("design moment", moment, 0.0, math.inf, "N m")
    require_within("partial factor", partial_factor, 0.1, 10.0)
    used = partial_factor * moment / section.moment_resistance
    if used >= 1.0:
        return None
    buckling, amplified = partial_factor / section.buckling, 1.0 / section.critical
    root = math.sqrt((buckling - amplified) ** 2 + 4.0 * buckling * amplified * used)
    # the smaller root, in the form that does not cancel
    design = 2.0 * (1.0 - used) / (buckling + amplified + root)
    return partial_factor * design
