"""Fluidity of snow against temperature.

Fluidity only rescales time in homogeneous snow; between layers it shifts stresses.
"""

from __future__ import annotations

import math

from netdesign.guards import require_positive, require_within
from netdesign.snow.creep_law import (
    ICE_DENSITY,
    CreepLaw,
    compute_bulk_factor,
    compute_shear_factor,
)
from netdesign.units import fluidity_from_mpa_year, kelvin_from_celsius

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
    relative = density / ICE_DENSITY
    a, b = compute_shear_factor(law, relative), compute_bulk_factor(law, relative)
    softness = (4.0 / (3.0 * a) + 1.0 / b) ** (-(law.exponent + 1.0) / 2.0)
    rate = stress / (_SETTLING_VISCOSITY * math.exp(_STIFFENING * density))
    return float(rate / (stress**law.exponent * softness))
