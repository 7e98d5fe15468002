"""Apparent compaction viscosity of the creep laws, beside models in operational use.

What an apparent viscosity is here: snow confined to one axis shortens under the stress
sigma at the rate E of snow/THEORY.md, N25; the viscosity is sigma / E.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from netdesign.addons.evidence.verification.case import VerificationCase, judge
from netdesign.addons.winter.settling.models import Hs2swe
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    PAPER_FLUIDITY,
    CreepLaw,
    compute_confined_softness,
)

PLACE = (367.0, 5e3)  # at which one figure is quoted [kg/m3, Pa]


def _settle_as_hs2swe(density: float) -> float:
    model = Hs2swe()  # its constants are those of the program's winters
    return model.viscosity * math.exp(model.stiffening * density)


# Viscosity of snow at freezing [Pa s] by its density [kg/m3]; constants of Crocus as in
# a public snow solver (Vionnet et al. 2012), of ISBA as in a public program (Boone 2002
# by Essery et al. 2013), of SNTHRM.89 as in the public code of VIC.
MODELS: Mapping[str, Callable[[float], float]] = {
    "Crocus": lambda density: 7.62237e6 * density / 250.0 * math.exp(0.023 * density),
    "ISBA": lambda density: 3.7e7 * math.exp(0.018 * density),
    "HS2SWE": _settle_as_hs2swe,
    "SNTHRM": lambda density: 3.6e6 * math.exp(0.021 * density),
}


def compute_viscosity(law: CreepLaw, density: float, stress: float) -> float:
    """Apparent compaction viscosity of a creep law of the paper's fluidity [Pa s].

    Parameters
    ----------
    law : CreepLaw
        A set for n = 3.
    density : float
        [kg/m3].
    stress : float
        Across the layer, positive [Pa].
    """
    softness = compute_confined_softness(law, density)
    return float(stress / (PAPER_FLUIDITY * stress**law.exponent * softness))


def find_middle(density: float) -> float:
    """Geometric mean of the operational models at freezing [Pa s]."""
    logs = [math.log(compute(density)) for compute in MODELS.values()]
    return math.exp(sum(logs) / len(logs))


def list_compaction() -> list[VerificationCase]:
    """Settling of the default law at one place, against models in operational use."""
    density, stress = PLACE
    own = compute_viscosity(BOUTILLIER_2004, density, stress)
    return judge({"compaction-default": math.log(own / find_middle(density))})
