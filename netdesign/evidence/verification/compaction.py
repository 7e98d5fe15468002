"""Apparent compaction viscosity of the creep laws, beside models in operational use.

What an apparent viscosity is here: snow confined to one axis shortens under the stress
sigma at the rate E of snow/THEORY.md, N25; the viscosity is sigma / E.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from netdesign.coupling.scene import SolverSettings
from netdesign.evidence.scene import build_scene, solve
from netdesign.evidence.verification.case import VerificationCase, judge
from netdesign.snow.creep_law import (
    BOUTILLIER_2004,
    CREEP_LAWS,
    ICE_DENSITY,
    PAPER_FLUIDITY,
    CreepLaw,
    compute_confined_softness,
)
from netdesign.snow.ground import GroundKind, GroundLaw
from netdesign.snowpack.hs2swe import Hs2swe

DENSITIES = tuple(float(rho) for rho in range(150, 451, 25))  # [kg/m3]
STRESSES = (1e3, 3e3, 5e3, 10e3)  # [Pa]
PLACE = (367.0, 5e3)  # at which one figure is quoted [kg/m3, Pa]
_COLD = 5.0  # snow below freezing, for the band of temperature [K]


@dataclass(frozen=True, slots=True, kw_only=True)
class CompactionModel:
    """A snow model's law of settling.

    Attributes
    ----------
    name, source : str
        What it is, and where its constants were read.
    compute : callable
        Viscosity [Pa s] of density [kg/m3] and degrees below freezing [K].
    """

    name: str
    source: str
    compute: Callable[[float, float], float]


def _settle_as_hs2swe(density: float, cold: float) -> float:
    model = Hs2swe()  # its constants are those of the program's winters
    growth = model.stiffening * density + 0.081 * cold
    return model.viscosity * math.exp(growth)


MODELS = (
    CompactionModel(
        name="Crocus",
        source="Vionnet et al. 2012, constants as in a public snow solver",
        compute=lambda rho, cold: (
            7.62237e6 * rho / 250.0 * math.exp(0.1 * cold + 0.023 * rho)
        ),
    ),
    CompactionModel(
        name="ISBA",
        source="Boone 2002 by Essery et al. 2013, constants as in a public program",
        compute=lambda rho, cold: 3.7e7 * math.exp(0.081 * cold + 0.018 * rho),
    ),
    CompactionModel(
        name="HS2SWE",
        source="Magnusson et al. 2025, constants as in its public code",
        compute=_settle_as_hs2swe,
    ),
    CompactionModel(
        name="SNTHRM",
        source="SNTHRM.89, constants as in the public code of VIC",
        compute=lambda rho, cold: 3.6e6 * math.exp(0.08 * cold + 0.021 * rho),
    ),
)


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
    logs = [math.log(model.compute(density, 0.0)) for model in MODELS]
    return math.exp(sum(logs) / len(logs))


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """One density and stress, with the viscosity of each law and model [Pa s]."""

    density_kg_m3: float
    stress_Pa: float
    laws_Pa_s: dict[str, float]
    models_Pa_s: dict[str, tuple[float, float]]  # at freezing, and `_COLD` below


def list_places() -> list[Place]:
    """Every density at every stress."""
    return [_compare(rho, stress) for stress in STRESSES for rho in DENSITIES]


def _compare(density: float, stress: float) -> Place:
    return Place(
        density_kg_m3=density,
        stress_Pa=stress,
        laws_Pa_s={
            name: compute_viscosity(law, density, stress)
            for name, law in CREEP_LAWS.items()
        },
        models_Pa_s={
            model.name: (model.compute(density, 0.0), model.compute(density, _COLD))
            for model in MODELS
        },
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Contrast:
    """Tensions of a layered scene by two contrasts of the layers [N/m]."""

    ground: GroundKind
    own_N_m: tuple[float, float]  # foot, head, by the default law
    other_N_m: tuple[float, float]  # by a law with the contrast of the models
    uniform_N_m: tuple[float, float]  # of uniform snow of the same mass


# Layered scene of the verification (FACTS.md, section 7): height [m], density [kg/m3].
_LAYERS = ((1.2, 400.0), (1.0, 320.0), (0.8, 240.0))
_SPAN = (240.0, 400.0)  # densities between which the contrast is matched [kg/m3]
_STRESS = 3e3  # any: the contrast of a law does not depend on it [Pa]


def list_growth() -> dict[str, float]:
    """Growth of the viscosity with 100 kg/m3 at one stress, as a factor.

    Of the default law, and the least and largest of the models.
    """
    low, high = _SPAN
    own = compute_viscosity(BOUTILLIER_2004, high, _STRESS)
    ratios = [own / compute_viscosity(BOUTILLIER_2004, low, _STRESS)]
    ratios += [model.compute(high, 0.0) / model.compute(low, 0.0) for model in MODELS]
    own, *others = (ratio ** (100.0 / (high - low)) for ratio in ratios)
    return {"own": own, "least": min(others), "largest": max(others)}


def match_contrast(law: CreepLaw) -> CreepLaw:
    """Law whose layers differ as the models' do, its ratio of a and b as given."""
    low, high = _SPAN
    own = math.log(
        compute_viscosity(law, high, _STRESS) / compute_viscosity(law, low, _STRESS)
    )
    lacking = math.log(find_middle(high) / find_middle(low)) - own
    # viscosity goes with a to the power -(n + 1) / 2
    more = lacking * ICE_DENSITY / (high - low) * 2.0 / (law.exponent + 1.0)
    (c0, c1), (d0, d1) = law.shear_fit, law.bulk_fit
    offset = more * low / ICE_DENSITY  # a as given at the lowest density
    return replace(
        law,
        name=f"{law.name}-contrast",
        shear_fit=(c0 + offset, c1 + more),
        bulk_fit=(d0 + offset, d1 + more),
        calibrated=(law.calibrated[0], law.branch),
    )


def compare_contrasts() -> list[Contrast]:
    """Forces of a layered scene by two contrasts, on rough and on free ground."""
    other = match_contrast(BOUTILLIER_2004)
    return [
        Contrast(
            ground=ground,
            own_N_m=_find_tensions(BOUTILLIER_2004, ground),
            other_N_m=_find_tensions(other, ground),
            uniform_N_m=_find_tensions(BOUTILLIER_2004, ground, is_uniform=True),
        )
        for ground in ("no-slip", "free")
    ]


def _find_tensions(
    law: CreepLaw, ground: GroundKind, *, is_uniform: bool = False
) -> tuple[float, float]:
    scene = build_scene(
        *_LAYERS, slope=38.0, length=20.0, ground=GroundLaw(kind=ground), slack=0.03
    )
    if is_uniform:
        scene = replace(scene, snowpack=replace(scene.snowpack, layers=()))
    settings = SolverSettings(accuracy=0.01)
    solution = solve(replace(scene, creep_law=law), settings)
    return solution.foot.size, solution.head.size


def list_compaction() -> list[VerificationCase]:
    """Settling of the default law at one place, against models in operational use."""
    density, stress = PLACE
    own = compute_viscosity(BOUTILLIER_2004, density, stress)
    return judge({"compaction-default": math.log(own / find_middle(density))})
