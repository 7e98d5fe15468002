"""Creep laws of snow: how strain rate depends on stress and density.

Theory: snow/THEORY.md, eqs (N1) to (N4).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.errors import ModelError
from netdesign.guards import require_positive, require_within

ICE_DENSITY = 917.0  # [kg/m3], the reference of relative density in the source paper


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
    shear_fit, bulk_fit : tuple of float
        (c0, c1) of ``exp(c0 - c1 D)`` for a and for b below ``branch`` [-].
    branch : float
        Relative density at and above which the Duva-Crow forms hold [-].
    calibrated : tuple of float
        Relative densities for which the fit was made [-].
    """

    name: str
    source: str
    exponent: float
    shear_fit: tuple[float, float]
    bulk_fit: tuple[float, float]
    branch: float
    calibrated: tuple[float, float]

    def __post_init__(self) -> None:
        """Refuse exponents below 1: the potential would not be convex."""
        require_within("creep exponent", self.exponent, 1.0, 10.0)
        require_positive("branch density", self.branch)


BOUTILLIER_2004 = CreepLaw(
    name="boutillier-2004",
    source="the source paper, Eqs 4-a and 4-b (fit to Landauer 1957)",
    exponent=3.0,
    shear_fit=(16.03, 19.25),
    bulk_fit=(16.75, 22.51),
    branch=0.81,
    calibrated=(0.25, 0.81),
)
CREEP_LAWS = {law.name: law for law in (BOUTILLIER_2004,)}


def compute_shear_factor(law: CreepLaw, relative_density: float) -> float:
    """Coefficient a(D) of the creep law [-].

    Parameters
    ----------
    law : CreepLaw
        The set.
    relative_density : float
        D, density against ice [-], above 0 and below 1.

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
    _require_snow(relative_density)
    if relative_density < law.branch:
        return math.exp(law.shear_fit[0] - law.shear_fit[1] * relative_density)
    power = 2 * law.exponent / (law.exponent + 1)
    return float((1 + 2 * (1 - relative_density) / 3) / relative_density**power)


def compute_bulk_factor(law: CreepLaw, relative_density: float) -> float:
    """Coefficient b(D) of the creep law [-]; tends to 0 for incompressible ice.

    Parameters, returns and errors as in ``compute_shear_factor``.
    """
    _require_snow(relative_density)
    if relative_density < law.branch:
        return math.exp(law.bulk_fit[0] - law.bulk_fit[1] * relative_density)
    n = law.exponent
    void = (1 - relative_density) ** (1 / n)
    return float(0.75 * (void / (n * (1 - void))) ** (2 * n / (n + 1)))


def _require_snow(relative_density: float) -> None:
    if not 0 < relative_density < 1:
        raise ModelError(
            f"relative density = {relative_density!r}: must lie above 0 and below 1, "
            f"that is below {ICE_DENSITY:g} kg/m3"
        )
