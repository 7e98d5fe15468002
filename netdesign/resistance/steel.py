"""Steel of anchors and guys: bars, links of a chain, and loss by corrosion.

The weakest link between a rope and its anchor bears the force.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import ModelError, require_within
from netdesign.resistance.catalogue import (
    Datum,
    interpolate,
    load_catalogue,
    quote,
)
from netdesign.words.message import say


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


# Ground that yields at a bore's mouth: by its kind, bar diameters that it adds to the
# lever. Any other kind of ground, and an unknown one, is soil.
ROCK = ("slate", "limestone", "sandstone", "granite", "gneiss", "rock")
IN_SOIL, IN_ROCK = 3.0, 1.0
# M beta / V at the most, where a force V bends a beam at its end on elastic ground.
END_MOMENT = math.exp(-0.25 * math.pi) * math.sin(0.25 * math.pi)
HEAD_GRADE = 235e6  # of a tube at the head of an anchor [Pa]


def find_ground_lever(section: RoundSection, ground: str) -> float:
    """Lever that the ground's yielding at the mouth adds, e_0; (R9a), (R9b).

    A solid bar yields over ``IN_SOIL`` or ``IN_ROCK`` of its diameter.

    Parameters
    ----------
    section : RoundSection
        Of the bar or tube that bends.
    ground : str
        Kind of the ground, as in sheet Anchors; "" where it is not known: soil.

    Returns
    -------
    float
        [m].

    Verified by
    -----------
    tests/verification/test_members_by_hand.py
    """
    hollow = section.inner / section.outer
    most = IN_ROCK if ground in ROCK else IN_SOIL
    return most * section.outer * math.sqrt(math.sqrt(1.0 - hollow**4))


def find_least_tube(ground_lever: float) -> float:
    """Least length of a tube that bends in the ground, pi / beta [m]; (R9a)."""
    return math.pi * ground_lever / END_MOMENT


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
    is_of_whole : bool
        Somebody says that its chain has no links but those that are listed.
    """

    kind: str
    breaking: float | None
    limit: float | None
    count: int
    angle: float | None
    source: str
    is_of_whole: bool = False


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
    return quote("shackle", factor)


def find_angle(link: Link, pulled: float | None) -> float:
    """Angle of the force to the line of a link: of the pull, else as stated, or 90 deg.

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


# Protections under which the steel itself corrodes, and is counted with what is left.
# Ground by its corrosion where its class is not given: undisturbed, a condition.
USUAL_SOIL = "natural"
BARE = ("none", "sacrificial")


@dataclass(frozen=True, slots=True, kw_only=True)
class Wear:
    """Statements of an anchor type or rope type about its corrosion.

    Attributes
    ----------
    kind : str
        "bar", "micropile", "rope anchor", "rope", or "" where none is given.
    protection : str
        As in sheet Anchors; "" where none is given, and of a rope.
    soil : str
        Class of the ground by its corrosion; "" where none is given.
    outer, inner : float or None
        Diameters of bar or tube [m]; None where they are not given.
    """

    kind: str
    protection: str = ""
    soil: str = ""
    outer: float | None = None
    inner: float | None = None

    @property
    def is_bare(self) -> bool:
        """The steel itself corrodes, and there is a thickness to lose.

        What has a diameter may be a bar, where no kind is given.
        """
        is_known = None not in (self.outer, self.inner)
        kinds = ("bar", "micropile", *([""] if is_known else []))
        return self.protection in BARE and self.kind in kinds


def find_loss(soil: str, years: int) -> Datum:
    """Loss of each exposed face, r_e, after some years [mm].

    Linear between the years of the table; resistance/THEORY.md, (R16).

    Raises
    ------
    ModelError
        If the table ends before.

    Verified by
    -----------
    tests/verification/test_corrosion.py
    """
    table = load_catalogue()["corrosion"]
    if not 0 <= years <= table["years"][-1]:
        raise ModelError(say("corrosion.beyond", years=years, most=table["years"][-1]))
    loss = interpolate([0, *table["years"]], [0.0, *table["loss_mm"][soil]], years)
    return quote("corrosion", loss)


def leave_area(outer: float, inner: float, loss: float) -> float:
    """Share of the steel's area that is left, A_eff / A [-]; 0 where none is.

    Parameters
    ----------
    outer, inner : float
        Diameters as built [m]; 0 for the inner one of a bar.
    loss : float
        r_e, of the outer face alone [m].

    Verified by
    -----------
    tests/verification/test_corrosion.py
    """
    left = max(outer - 2.0 * loss, inner)
    return (left**2 - inner**2) / (outer**2 - inner**2)
