"""Creep laws of snow: how strain rate depends on stress, density and temperature.

Fluidity only rescales time
in homogeneous snow; between layers it shifts stresses. Theory: snow/THEORY.md, eqs (N1)
to (N5), sections 6 and 7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from netdesign.numerics.arrays import Floats
from netdesign.outcome import ModelError, require_positive, require_within
from netdesign.units import fluidity_from_mpa_year, kelvin_from_celsius
from netdesign.words.message import say

ICE_DENSITY = 917.0  # [kg/m3], the reference of relative density in the source paper
# Relative density from which snow counts as ice, a = 1 and b = 0 nearly; Elmer/Ice
# treats more than 0.99 as ice. The law needs b > 0, so denser snow is refused.
DENSEST_SNOW = 0.99
_LARGEST_COEFFICIENT = 60.0  # of the exponential fits: keeps their powers finite

# Tests of snow give 1.8 to 4 (snow/THEORY.md, section 7).
LARGEST_EXPONENT = 6.0
FLUIDITY_EXPONENT = 3.0  # creep exponent that every fluidity of this module is for

# The source paper's value, Lliboutry and Duval (1985), for n = 3 [Pa^-3 s^-1].
PAPER_FLUIDITY = fluidity_from_mpa_year(20.0, 3.0)

_GAS_CONSTANT = 8.314  # [J/(mol K)]
_BREAK = 263.15  # [K]
# Rate factor A [Pa^-3 s^-1] and activation energy [J/mol] below and above the break.
_COLD = (3.985e-13, 60e3)
_WARM = (1.916e3, 139e3)
# Settling of stations, delta-snow (Winkler et al. 2021): viscosity of snow without
# density [Pa s], and its growth with density [m3/kg].
_SETTLING_VISCOSITY, _STIFFENING = 8.523356e6, 0.02993175
COLDEST, WARMEST = kelvin_from_celsius(-60.0), kelvin_from_celsius(0.0)  # [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class CreepLaw:
    """Compressible power law with coefficients a(D) and b(D).

    Attributes
    ----------
    name : str
        Printed in every report: published sets differ much at low density.
    source : str
        Publication of the low-density fit.
    exponent : float
        Creep exponent n [-].
    own_exponent : float
        Exponent for which a(D) and b(D) are given; those of another follow (N28) [-].
    shear_fit, bulk_fit : tuple of float
        (c0, c1) of ``exp(c0 - c1 D)`` for a and for b below ``branch`` [-].
    branch : float
        Relative density at and above which the Duva-Crow forms hold [-].
    clamp : float
        Relative density below which the coefficients stay constant [-]; 0 if never.
    calibrated : tuple of float
        Relative densities for which the set is given [-]; outside it is flagged.
    """

    name: str
    source: str
    exponent: float = 3.0
    own_exponent: float = 3.0
    shear_fit: tuple[float, float]
    bulk_fit: tuple[float, float]
    branch: float
    clamp: float = 0.0
    calibrated: tuple[float, float]

    def __post_init__(self) -> None:
        """Refuse a set that is not convex, or breaks (N5) where it is calibrated."""
        for exponent in (self.exponent, self.own_exponent):
            require_within("creep exponent", exponent, 1.0, LARGEST_EXPONENT)
        require_positive("branch density", self.branch)
        require_within("branch density", self.branch, 0.0, DENSEST_SNOW)
        require_within("clamp density", self.clamp, 0.0, self.branch)
        low, high = self.calibrated
        require_within("calibrated density, low", low, 0.0, high)
        require_within("calibrated density, high", high, low, 1.0)
        for coefficient in (*self.shear_fit, *self.bulk_fit):
            require_within(
                "fit coefficient",
                coefficient,
                -_LARGEST_COEFFICIENT,
                _LARGEST_COEFFICIENT,
            )
        # a/b is monotonic on each branch: the ends of both branches decide
        ends = (max(low, 1e-3), min(high, DENSEST_SNOW))
        joints = (math.nextafter(self.branch, 0.0), self.branch)
        for density in (*ends, *(d for d in joints if ends[0] < d < ends[1])):
            require_admissible(self, density)

    def is_calibrated(self, relative_density: float) -> bool:
        """The set is given for this density.

        Parameters
        ----------
        relative_density : float
            D, density against ice [-].
        """
        low, high = self.calibrated
        return low <= relative_density <= high


def compute_shear_factor(law: CreepLaw, relative_density: float) -> float:
    """Coefficient a(D) of the creep law [-].

    Parameters
    ----------
    law : CreepLaw
        The set.
    relative_density : float
        D, density against ice [-], above 0 and at most ``DENSEST_SNOW``.

    Returns
    -------
    float
        a [-]; 1 for ice.

    Raises
    ------
    ModelError
        If the density is not that of snow.

    Verified by
    -----------
    tests/snow/test_creep_law.py
    """
    own = _compute_own_shear(law, _require_snow(law, relative_density))
    return float(own ** ((law.own_exponent + 1.0) / (law.exponent + 1.0)))


def compute_bulk_factor(law: CreepLaw, relative_density: float) -> float:
    """Coefficient b(D) of the creep law [-]; tends to 0 for incompressible ice.

    Parameters
    ----------
    law : CreepLaw
        The set.
    relative_density : float
        D [-], above 0 and at most ``DENSEST_SNOW``.

    Returns
    -------
    float
        b [-].

    Raises
    ------
    ModelError
        If the density is not that of snow.
    """
    density = _require_snow(law, relative_density)
    derived = compute_shear_factor(law, relative_density)
    share = derived / _compute_own_shear(law, density)
    return float(share * _compute_own_bulk(law, density))


def _compute_own_shear(law: CreepLaw, density: float) -> float:
    """Coefficient a(D) of the set's own exponent, (N3) and (N4)."""
    if density < law.branch:
        return math.exp(law.shear_fit[0] - law.shear_fit[1] * density)
    power = 2 * law.own_exponent / (law.own_exponent + 1)
    return float((1 + 2 * (1 - density) / 3) / density**power)


def _compute_own_bulk(law: CreepLaw, density: float) -> float:
    """Coefficient b(D) of the set's own exponent, (N3) and (N4)."""
    if density < law.branch:
        return math.exp(law.bulk_fit[0] - law.bulk_fit[1] * density)
    n = law.own_exponent
    void = (1 - density) ** (1 / n)
    return float(0.75 * (void / (n * (1 - void))) ** (2 * n / (n + 1)))


def compute_factors(law: CreepLaw, densities: Floats) -> tuple[Floats, Floats]:
    """Coefficients a(D) and b(D) of many relative densities.

    Parameters
    ----------
    law : CreepLaw
        The set.
    densities : ndarray, any shape
        D [-], above 0; above ``DENSEST_SNOW`` they count as that: where snow settles
        against a corner a step may end there.

    Returns
    -------
    ndarray, ndarray
        a and b [-], of that shape.

    Raises
    ------
    ModelError
        If a density is not above 0.
    """
    each = np.minimum(densities, DENSEST_SNOW).ravel().tolist()
    factors = [
        (compute_shear_factor(law, temperature), compute_bulk_factor(law, temperature))
        for temperature in each
    ]
    shear, bulk = np.array(factors).T.reshape(2, *densities.shape)
    return shear, bulk


def compute_strain_rate(
    law: CreepLaw, relative_density: float, fluidity: float, stress: Floats
) -> Floats:
    """Strain rate of a three-dimensional stress, the inverse of (N2).

    Parameters
    ----------
    law : CreepLaw
        The set.
    relative_density : float
        D [-].
    fluidity : float
        B [Pa^-n s^-1].
    stress : ndarray, shape (3, 3)
        Symmetric, tension positive [Pa].

    Returns
    -------
    ndarray, shape (3, 3)
        [s^-1].

    Verified by
    -----------
    ``netdesign verify``, cases law-*
    """
    shear = compute_shear_factor(law, relative_density)
    bulk = compute_bulk_factor(law, relative_density)
    pressure = -np.trace(stress) / 3.0
    deviator = stress + pressure * np.eye(3)
    squared = shear * (deviator**2).sum() / 2.0 + bulk * pressure**2
    rate = fluidity * squared ** ((law.exponent - 1.0) / 2.0)
    return np.asarray(
        rate * (shear / 2.0 * deviator - bulk * pressure / 3.0 * np.eye(3))
    )


def require_admissible(law: CreepLaw, relative_density: float) -> None:
    """Refuse a density at which uniaxial compression would shrink sideways, (N5).

    Parameters
    ----------
    law : CreepLaw
        The set.
    relative_density : float
        D [-].

    Raises
    ------
    ModelError
        If 3a < 2b.
    """
    shear = compute_shear_factor(law, relative_density)
    bulk = compute_bulk_factor(law, relative_density)
    if not 3 * shear >= 2 * bulk:
        raise ModelError(
            say(
                "snow.law_shrinks",
                density=relative_density,
                law=law.name,
                shear=3 * shear,
                bulk=2 * bulk,
            )
        )


def _require_snow(law: CreepLaw, relative_density: float) -> float:
    """Relative density of the coefficients, clamped; refuses one outside 0 to 0.99."""
    if not 0 < relative_density <= DENSEST_SNOW:
        raise ModelError(
            say(
                "snow.relative_density_limit",
                density=relative_density,
                most=DENSEST_SNOW,
                densest=DENSEST_SNOW * ICE_DENSITY,
            )
        )
    return max(relative_density, law.clamp)


BOUTILLIER_2004 = CreepLaw(
    name="boutillier-2004",
    source="the source paper, Eqs 4-a and 4-b, fit to Landauer (1957)",
    shear_fit=(16.03, 19.25),
    bulk_fit=(16.75, 22.51),
    branch=0.81,
    # The paper gives no range; its sister set is given from 0.4 upwards.
    calibrated=(0.4, 1.0),
)
ZWINGER_2007 = CreepLaw(
    name="zwinger-2007",
    source="Zwinger et al. (2007) as coded in Elmer/Ice",
    shear_fit=(13.22240, 15.78652),
    bulk_fit=(15.09371, 20.46489),
    branch=0.81,
    clamp=0.4,
    calibrated=(0.4, 1.0),
)
GAGLIARDINI_1997 = CreepLaw(
    name="gagliardini-1997",
    source="Gagliardini and Meyssonnier (1997) as coded in a public firn model",
    shear_fit=(15.94, 19.67),
    bulk_fit=(20.37, 27.65),
    branch=0.785,
    # below 0.504 it breaks 3a >= 2b
    calibrated=(0.51, 1.0),
)
CREEP_LAWS = {
    law.name: law for law in (BOUTILLIER_2004, ZWINGER_2007, GAGLIARDINI_1997)
}


def compute_fluidity(temperature: float) -> float:
    """Fluidity B for creep exponent 3 by an Arrhenius law.

    Parameters
    ----------
    temperature : float
        Of the snow [K], between ``COLDEST`` and ``WARMEST``.

    Returns
    -------
    float
        B = 2 A [Pa^-3 s^-1].

    Raises
    ------
    ModelError
        Outside the range.

    Source
    ------
    Greve and Blatter (2009), Dynamics of ice sheets and glaciers; coefficients as
    coded in a public firn model. The paper's 20 MPa^-3 a^-1 is about -14 C on it.
    """
    require_within("snow temperature", temperature, COLDEST, WARMEST, "K")
    rate_factor, energy = _COLD if temperature <= _BREAK else _WARM
    return 2.0 * rate_factor * math.exp(-energy / (_GAS_CONSTANT * temperature))


def compute_confined_softness(law: CreepLaw, density: float) -> float:
    """Share of (N25) that the set has: strain rate over B and the stress to the n.

    Parameters
    ----------
    law : CreepLaw
        Set of a(D), b(D), n.
    density : float
        [kg/m3].

    Returns
    -------
    float
        Of snow that shortens in one direction alone [-].

    Raises
    ------
    ModelError
        If the density is not that of snow.
    """
    relative = density / ICE_DENSITY
    a, b = compute_shear_factor(law, relative), compute_bulk_factor(law, relative)
    return float((4.0 / (3.0 * a) + 1.0 / b) ** (-(law.exponent + 1.0) / 2.0))


def compute_settling_fluidity(law: CreepLaw, density: float, stress: float) -> float:
    """Fluidity at which snow under a stress settles as at stations, (N25) = (N26).

    Parameters
    ----------
    law : CreepLaw
        Set of a(D), b(D), n.
    density : float
        [kg/m3].
    stress : float
        In the one direction in which the snow shortens [Pa].

    Returns
    -------
    float
        B [Pa^-n s^-1].

    Raises
    ------
    ModelError
        If density or stress is not positive.
    """
    require_positive("density", density, "kg/m3")
    require_positive("stress", stress, "Pa")
    softness = compute_confined_softness(law, density)
    rate = stress / (_SETTLING_VISCOSITY * math.exp(_STIFFENING * density))
    return float(rate / (stress**law.exponent * softness))
