"""Resistances of an anchor in its ground: pull-out, and the wedge of ground above it.

Pull-out follows from tests, or from the bond of grout and ground. The wedge slides on
two planes. Theory: resistance/THEORY.md, (R1), (R18) to (R20) and (R30).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import require_count, require_positive, require_within
from netdesign.resistance.steel import RoundSection


@dataclass(frozen=True, slots=True, kw_only=True)
class SingleTest:
    """One anchor that was pulled.

    Attributes
    ----------
    load : float
        Largest load that it held [N]; a lower bound of its resistance where the test
        stopped before it gave way.
    is_held : bool or None
        It held that load to the end; False: it was pulled out; None: not said.
    proof_load : float or None
        Load that the test was to reach [N]; None where none is given.
    displacement : float or None
        Of its head at the largest load [m]; None where none is given.
    source : str
        Cell of the load.
    """

    load: float
    is_held: bool | None = None
    proof_load: float | None = None
    displacement: float | None = None
    source: str = ""

    def __post_init__(self) -> None:
        """Refuse a load that is none."""
        require_positive("load of a test", self.load, "N")


@dataclass(frozen=True, slots=True, kw_only=True)
class PullOutTests:
    """Pull-out tests on the site.

    Attributes
    ----------
    count : int
        Number of tests.
    least, mean : float
        Least and mean of the tested resistances [N].
    singles : tuple of SingleTest
        Each test; empty where only number, least and mean are given.
    """

    count: int
    least: float
    mean: float
    singles: tuple[SingleTest, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what no series of tests can give."""
        require_count("number of tests", self.count)
        require_positive("least tested resistance", self.least, "N")
        require_within("least tested resistance", self.least, 0.0, self.mean, "N")


def limit_proof_load(proof: float, ultimate: float) -> float:
    """Largest load of a test that its tendon allows; resistance/THEORY.md, (R32).

    Parameters
    ----------
    proof, ultimate : float
        Characteristic 0.1 % proof force and tensile strength of the tendon,
        P_t0.1k and P_tk [N]; the first where the second is not known.

    Returns
    -------
    float
        min(0.95 P_t0.1k, 0.80 P_tk) [N].
    """
    return min(0.95 * proof, 0.80 * ultimate)


_LEAST = math.radians(0.5)  # between a plane and the slope
_PLANES = 400  # tried at once
_NARROWINGS = 3  # each to two steps of the one before
WATER = 10e3  # unit weight [N/m3]


@dataclass(frozen=True, slots=True, kw_only=True)
class Soil:
    """Strength of the ground at an anchor, and its weight.

    Attributes
    ----------
    cohesion : float
        c' [Pa].
    friction : float
        phi' [rad].
    weight : float
        Unit weight [N/m3]; of the soaked ground, unless it is drained.
    is_drained : bool
        No water flows in it; else it seeps along the slope, up to the surface.
    """

    cohesion: float
    friction: float
    weight: float
    is_drained: bool = False

    def reduce(self, on_cohesion: float, on_friction: float) -> Soil:
        """Design strength.

        Parameters
        ----------
        on_cohesion, on_friction : float
            Factors on c' and on tan phi' [-].
        """
        return replace(
            self,
            cohesion=self.cohesion / on_cohesion,
            friction=math.atan(math.tan(self.friction) / on_friction),
        )

    @property
    def uplift(self) -> float:
        """Unit weight of the water that seeps in it [N/m3]."""
        return 0.0 if self.is_drained else WATER


@dataclass(frozen=True, slots=True, kw_only=True)
class WedgeResistance:
    """Pull that lifts the weakest wedge.

    Attributes
    ----------
    value : float
        [N]; 0 where a wedge slides by itself, as the slab below it then does, too.
    plane : float
        Between the slope's surface and the plane that the wedge slides on [rad].
    """

    value: float
    plane: float


def compute_wedge_resistance(
    soil: Soil,
    *,
    depth: float,
    width: float,
    slope: float,
    least_pull: float,
    largest_pull: float,
) -> WedgeResistance:
    """Least pull that lifts a wedge of the ground in front of a bond's middle.

    The wedge has no side faces: it is as wide as the ground that one anchor has.

    Parameters
    ----------
    soil : Soil
        With its design strength.
    depth : float
        Of the bond's middle, normal to the slope [m].
    width : float
        Along the row, of one anchor [m].
    slope : float
        Of the surface, downwards in the direction of the pull; negative where the
        anchor is pulled up the slope [rad].
    least_pull, largest_pull : float
        Directions of the pull against the surface [rad].

    Raises
    ------
    ModelError
        If a length is not above 0.

    Verified by
    -----------
    tests/verification/test_wedge.py
    """
    require_positive("depth of the bond", depth, "m")
    require_positive("width of the ground", width, "m")
    low, high = _LEAST, math.pi - 2.0 * soil.friction - _LEAST
    for _ in range(_NARROWINGS):
        planes = np.linspace(low, high, _PLANES)
        held = width * _hold(soil, depth, slope, planes)
        motion = planes + soil.friction
        aside = np.maximum(0.0, np.maximum(least_pull - motion, motion - largest_pull))
        working = np.cos(np.minimum(aside, 0.5 * math.pi))
        pulls = np.full(_PLANES, math.inf)
        np.divide(held, working, out=pulls, where=working > 1e-9)
        pulls[held <= 0.0] = 0.0
        weakest = int(np.argmin(pulls))
        low = planes[max(weakest - 1, 0)]
        high = planes[min(weakest + 1, _PLANES - 1)]
    return WedgeResistance(value=float(pulls[weakest]), plane=float(planes[weakest]))


def _hold(soil: Soil, depth: float, slope: float, planes: Floats) -> Floats:
    """Work of cohesion, weight and water for each length of the wedge's motion [N/m].

    Water that seeps along the slope is a force out of it, (R18).
    """
    behind = planes + 2.0 * soil.friction
    lengths = depth / np.sin(planes) + depth / np.sin(behind)
    area = 0.5 * depth**2 * (1.0 / np.tan(planes) - 1.0 / np.tan(behind))
    cohesion = soil.cohesion * math.cos(soil.friction) * lengths
    motion = planes + soil.friction
    weight = soil.weight * np.sin(motion - slope)
    return cohesion + area * (weight - soil.uplift * math.cos(slope) * np.sin(motion))


def compute_slab_stability(soil: Soil, depth: float, slope: float) -> float:
    """Strength of the ground under a slab of the slope over what it needs, (R30) [-].

    Parameters
    ----------
    soil : Soil
        With its design strength.
    depth : float
        Of the slab, normal to the slope [m].
    slope : float
        Of the surface, either way [rad].

    Returns
    -------
    float
        Below 1 the slab slides by itself.

    Verified by
    -----------
    tests/verification/test_wedge.py
    """
    pressing = (soil.weight - soil.uplift) * depth * math.cos(slope)
    held = soil.cohesion + pressing * math.tan(soil.friction)
    driving = soil.weight * depth * abs(math.sin(slope))
    return held / driving if driving else math.inf


def compute_cone_resistance(
    soil: Soil, *, depth: float, slope: float, pull: tuple[float, float, float]
) -> WedgeResistance:
    """Least pull that lifts a cone of the ground out of which a single anchor is drawn.

    Its apex is the bond's middle, it opens by the friction angle about the way that it
    moves, which may turn to any side; resistance/THEORY.md, (R20).

    Parameters
    ----------
    soil : Soil
        With its design strength.
    depth : float
        Of the bond's middle, normal to the slope [m].
    slope : float
        Of the surface [rad].
    pull : tuple of float, shape (3,)
        Its direction: downslope, out of the ground, along the slope; of length 1.

    Returns
    -------
    WedgeResistance
        Its plane is the flattest line of the cone.

    Raises
    ------
    ModelError
        If the depth is not above 0.

    Verified by
    -----------
    tests/verification/test_wedge.py
    """
    require_positive("depth of the bond", depth, "m")
    phi = soil.friction
    rises = np.linspace(phi + _LEAST, 0.5 * math.pi, _NARROWINGS * _PLANES)
    flat, steep = np.cos(rises), np.sin(rises)
    front, rear = np.sin(rises - phi), np.sin(rises + phi)
    half = depth * math.sin(phi) / np.sqrt(front * rear)  # width of its mouth
    area = 0.5 * depth**2 * math.sin(2.0 * phi) / (front * rear)
    lengths = depth / front + depth / rear
    size = math.pi / 3.0 * half * area
    held = 0.5 * math.pi * half * soil.cohesion * math.cos(phi) * lengths
    held += size * (soil.weight - soil.uplift) * math.cos(slope) * steep
    slides = size * soil.weight * math.sin(slope) * flat  # as it moves straight down
    along, out, aside = pull[0] * flat, pull[1] * steep, pull[2] * flat
    working = held * out + slides * along
    root = working**2 - (out**2 - along**2 - aside**2) * (held**2 - slides**2)
    divisor = working + np.sqrt(np.maximum(root, 0.0))
    pulls = np.full_like(rises, math.inf)
    np.divide(held**2 - slides**2, divisor, out=pulls, where=divisor > 0.0)
    pulls[held <= slides] = 0.0
    weakest = int(np.argmin(pulls))
    plane = float(rises[weakest]) - phi
    return WedgeResistance(value=float(pulls[weakest]), plane=plane)


BENDING = ("bar", "micropile")  # kinds of anchors that bend; others turn to the pull


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchorType:
    """Steel, grout and ground of an anchor, beside its resistances along its axis.

    Attributes
    ----------
    kind : str
        "bar", "micropile", "rope anchor", or "" where none is given.
    section : RoundSection or None
        Of what bends: bar, micropile, or the tube at its head; None where its
        dimensions are not given.
    lever : float or None
        Free length over which it bends [m]; None where none is given.
    is_lever_assumed : bool
        No input gives that length: any shorter one is better.
    ground_lever : float
        Lever that the ground's yielding adds to it, e_0 of (R9a) [m].
    has_tube : bool
        The section is that of a tube at the head.
    drilled, bond : float or None
        Lengths from the ground's surface, and of the bond at its end [m].
    across : float or None
        Resistance of a block or tube at its head to a force across the axis [N]; None
        where none is given.
    soil : Soil or None
        Strength of the ground around the bond.
    """

    kind: str
    section: RoundSection | None
    lever: float | None
    is_lever_assumed: bool = False
    ground_lever: float = 0.0
    has_tube: bool = False
    across: float | None = None
    drilled: float | None = None
    bond: float | None = None
    soil: Soil | None = None

    @property
    def is_in_block(self) -> bool:
        """A bar or micropile that is fixed in a concrete block at its head."""
        return self.kind in BENDING and self.across is not None and not self.has_tube

    def find_cover(self, axis: float) -> float:
        """Depth of the bond's middle, normal to the slope [m]; (S22).

        A length that is not given is the other one.

        Parameters
        ----------
        axis : float
            Inclination of the anchor against the slope [rad].
        """
        drilled, bond = self.drilled or self.bond, self.bond or self.drilled
        return ((drilled or 0.0) - 0.5 * (bond or 0.0)) * math.sin(axis)

    def list_depths(self, axis: float) -> tuple[float, ...]:
        """Least and largest depth that the bond's middle may have [m].

        One where its length is given; none without a drilled length.
        """
        if self.drilled is None:
            return ()
        least = self.find_cover(axis)
        return (least,) if self.bond else (least, self.drilled * math.sin(axis))
