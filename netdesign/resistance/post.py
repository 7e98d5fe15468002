"""Post: strut hinged at both ends, with snow against it."""

from __future__ import annotations

import math
from dataclasses import dataclass


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

    """
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
    at_head, at_foot : float
        Eccentricities of the compression at both ends [m].
    assumed : tuple of str
        What of eta and of both eccentricities no cell gives.
    """

    width: float
    length: float
    modulus: float
    strength: float
    critical: float
    buckling: float
    at_head: float
    at_foot: float
    assumed: tuple[str, ...] = ()

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
    """
    return efficiency * pressure * section.width * section.length**2 / 8.0


def compute_bent_post_resistance(
    section: PostSection, *, moment: float, partial_factor: float
) -> float | None:
    """Compression that a post bears beside a moment; resistance/THEORY.md, (R11).

    The compression acts beside the axis at both ends and brings moments of its own.

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
    """
    over = partial_factor / section.moment_resistance
    used = over * moment
    if used >= 1.0:
        return None
    head, foot = section.at_head, section.at_foot
    apart = abs(head - foot)
    square = over * apart**2 / (16.0 * moment) if moment else 0.0
    design = _solve(section, partial_factor, used, 0.5 * over * (head + foot), square)
    if design * apart >= 4.0 * moment:
        design = _solve(section, partial_factor, 0.0, over * max(head, foot), 0.0)
    return partial_factor * design


def _solve(
    section: PostSection, factor: float, used: float, linear: float, square: float
) -> float:
    """Design compression C [N] that uses all of the section; (R11b).

    (1 - factor C / N_k) (1 - C / N_cr) = used + linear C + square C^2.
    """
    buckling, amplified = factor / section.buckling, 1.0 / section.critical
    slope = buckling + amplified + linear
    bend = buckling * amplified - square
    root = math.sqrt(max(slope**2 - 4.0 * bend * (1.0 - used), 0.0))
    # the smaller root, in the form that does not cancel
    return 2.0 * (1.0 - used) / (slope + root)
