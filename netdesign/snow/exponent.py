"""Creep laws of another exponent, derived from a set for n = 3.

Theory: snow/THEORY.md, section 7.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from netdesign.errors import ModelError
from netdesign.guards import require_within
from netdesign.snow.creep_law import CREEP_LAWS, CreepLaw
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class StatedExponent:
    """A creep exponent of the literature, with the densities it is stated for.

    Attributes
    ----------
    exponent : float
        n [-].
    source : str
        Who states it.
    densities : tuple of float
        From and to [kg/m3].
    """

    exponent: float
    source: str
    densities: tuple[float, float]

    def is_stated_for(self, density: float) -> bool:
        """The source states this exponent for such snow.

        Parameters
        ----------
        density : float
            [kg/m3].
        """
        low, high = self.densities
        return low <= density <= high


# Between 200 and 320 kg/m3 the tests of 2003 lie between both exponents.
STATED_EXPONENTS = (
    StatedExponent(
        exponent=1.8, source="Scapozza and Bartelt 2003", densities=(0.0, 200.0)
    ),
    StatedExponent(
        exponent=2.15, source="Védrine and Hagenmuller 2025", densities=(0.0, 550.0)
    ),
    StatedExponent(
        exponent=3.6, source="Scapozza and Bartelt 2003", densities=(320.0, 435.0)
    ),
)


def derive_exponent(law: CreepLaw, exponent: float) -> CreepLaw:
    """Law of another exponent that creeps alike at one stress, at every density; (N30).

    Parameters
    ----------
    law : CreepLaw
        A set with its own exponent.
    exponent : float
        m of the new law [-].

    Returns
    -------
    CreepLaw
        Named after both; calibrated below the branch only, beyond which nothing is
        derived.

    Raises
    ------
    ModelError
        If the exponent is out of its range, or the set knows no snow below its branch.

    Verified by
    -----------
    tests/snow/test_exponent.py
    """
    require_within("creep exponent", exponent, 1.0, 10.0)
    low, high = law.calibrated
    if low >= law.branch:
        raise ModelError(say("snow.no_exponent", law=law.name, branch=law.branch))
    power = (law.exponent + 1.0) / (exponent + 1.0)
    (c0, c1), (d0, d1) = law.shear_fit, law.bulk_fit
    shear = (power * c0, power * c1)
    return replace(
        law,
        name=f"{law.name}-n{exponent:g}",
        exponent=exponent,
        shear_fit=shear,
        bulk_fit=(shear[0] + d0 - c0, shear[1] + d1 - c1),
        calibrated=(low, min(high, law.branch)),
    )


DERIVED_LAWS = {
    law.name: law
    for one in CREEP_LAWS.values()
    for law in (derive_exponent(one, stated.exponent) for stated in STATED_EXPONENTS)
}
