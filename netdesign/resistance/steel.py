"""Steel of anchors and guys: bars, wire ropes and their ends."""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import require_within


@dataclass(frozen=True, slots=True, kw_only=True)
class RoundSection:
    """Round steel of an anchor: a bar, or a tube with an inner diameter above 0.

    Attributes
    ----------
    outer, inner : float
        Diameters, after any loss by corrosion [m].
    strength : float
        Characteristic 0.2 % proof strength or yield strength [Pa].
    """

    outer: float
    inner: float = 0.0
    strength: float

    def __post_init__(self) -> None:
        """Refuse what no anchor is made of."""
        require_within("bar diameter", self.outer, 0.005, 0.2, "m")
        require_within("inner diameter", self.inner, 0.0, 0.98 * self.outer, "m")
        require_within("steel strength", self.strength, 1e8, 2.5e9, "Pa")

    @property
    def area(self) -> float:
        """A [m2]."""
        return math.pi / 4.0 * (self.outer**2 - self.inner**2)

    @property
    def shear_area(self) -> float:
        """A_v: of a bar by its largest elastic stress, of a tube 2 A / pi [m2]."""
        return (2.0 / math.pi if self.inner else 0.75) * self.area

    @property
    def modulus(self) -> float:
        """Elastic section modulus W [m3]."""
        fourth = self.outer**4 - self.inner**4
        return math.pi / 32.0 * fourth / self.outer

    @property
    def axial_resistance(self) -> float:
        """N_Rk = A f, eq. (R3) [N]."""
        return self.area * self.strength

    @property
    def moment_resistance(self) -> float:
        """M_Rk = W f [N m]."""
        return self.modulus * self.strength

    @property
    def shear_resistance(self) -> float:
        """V_Rk = A_v f / sqrt(3) [N]."""
        return self.shear_area * self.strength / math.sqrt(3.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class BentBar:
    """Resistance of an anchor to a pull beside its axis, and how it comes about.

    Attributes
    ----------
    angle, lever : float
        Between pull and axis [rad]; free length over which it bends [m].
    shear_ratio : float
        Shear over V_Rk at the resistance [-]; above 1/2 it takes part of it.
    value : float
        Size of the pull that the bar resists [N].
    """

    angle: float
    lever: float
    shear_ratio: float
    value: float


def compute_bar_resistance(
    diameter: float, strength: float, inner: float = 0.0
) -> float:
    """Tension resistance of a steel bar or tube; resistance/THEORY.md, eq. (R3).

    Parameters
    ----------
    diameter : float
        Of the round area that carries, after any loss by corrosion [m].
    strength : float
        Characteristic 0.2 % proof strength or yield strength [Pa].
    inner : float
        Inner diameter of a tube [m]; 0 for a bar.

    Returns
    -------
    float
        A f [N].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    section = RoundSection(outer=diameter, inner=inner, strength=strength)
    return section.axial_resistance


def compute_bent_bar_resistance(
    section: RoundSection, *, angle: float, lever: float
) -> BentBar:
    """Resistance to a pull beside the axis; resistance/THEORY.md, (R7) to (R9).

    Axial force, bending and shear of EN 1993-1-1, elastic.

    Parameters
    ----------
    section : RoundSection
        Of the anchor.
    angle : float
        delta between pull and axis, below a right angle [rad].
    lever : float
        e, from where the ground holds the anchor to where it is pulled [m].

    Returns
    -------
    BentBar
        Characteristic.

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("angle of the pull", angle, 0.0, math.radians(89.0), "rad")
    require_within("lever arm", lever, 0.0, 2.0, "m")
    along, across = math.cos(angle), math.sin(angle)
    used = along / section.axial_resistance  # by each N of the pull
    used += lever * across / section.moment_resistance
    sheared = 2.0 * across / section.shear_resistance
    value = 1.0 / used
    if sheared > used:  # more than half of V_Rk: it takes part of the strength
        value = (2.0 * sheared - used) / sheared**2
    return BentBar(
        angle=angle,
        lever=lever,
        shear_ratio=0.5 * sheared * value,
        value=value,
    )


def compute_rope_resistance(
    *, diameter: float, grade: float, breaking_factor: float, termination: float
) -> float:
    """Breaking force of a wire rope with its ends; resistance/THEORY.md, eq. (R4).

    Parameters
    ----------
    diameter : float
        Nominal [m].
    grade : float
        Strength R_r of the wires [Pa].
    breaking_factor : float
        K of the construction [-].
    termination : float
        Loss factor k_e of the weaker end [-].

    Returns
    -------
    float
        K d^2 R_r k_e [N].

    Raises
    ------
    ModelError
        If a number is out of its range.
    """
    require_within("rope diameter", diameter, 0.004, 0.1, "m")
    require_within("rope grade", grade, 1e9, 2.5e9, "Pa")
    require_within("breaking factor", breaking_factor, 0.1, 0.7)
    require_within("termination factor", termination, 0.1, 1.0)
    return breaking_factor * diameter**2 * grade * termination
