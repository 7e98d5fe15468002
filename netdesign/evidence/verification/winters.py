"""Winters: snow heights and the made-up winter against other codes, invariants."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, replace
from importlib.resources import files

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.evidence.scene import build_scene
from netdesign.evidence.verification.case import VerificationCase, largest_difference
from netdesign.numerics.arrays import Floats
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Layer
from netdesign.snowpack.delta_snow import DELTA_SNOW
from netdesign.snowpack.follow import MODELS, follow_heights
from netdesign.snowpack.hs2swe import HS2SWE
from netdesign.snowpack.pack import DayPack
from netdesign.winter.day import DaySolver, RowDay, WinterRow
from netdesign.winter.season import Season, follow_season

_PROTOTYPE = (
    "prototype of the same chain on an earlier solver, made-up winter at 2000 m"
)
_SLOPE_DEG = 40.0
_SLIP = 1.5  # [m]


def build_row_scene(ground: GroundLaw) -> Scene:
    """Scene of the row whose winter was computed by another code.

    Parameters
    ----------
    ground : GroundLaw
        One of several.
    """
    return build_scene(
        (3.0, 300.0), slope=_SLOPE_DEG, length=20.0, ground=ground, slack=0.03
    )


def read_made_up_winter() -> dict[int, DayPack]:
    """Packs of the made-up winter by delta-snow, by their place from 1 November."""
    text = files("netdesign.examples").joinpath("winter_2000.csv").read_text("utf-8")
    lines = csv.DictReader(text.splitlines())
    heights = [float(line["HS [cm]"]) / 100.0 for line in lines]
    return dict(enumerate(follow_heights(heights, DELTA_SNOW)))


def solve_winter(ground: GroundLaw) -> Season:
    """Season of the row on some ground: the days that may govern."""
    solver = DaySolver(
        row=WinterRow(id="A", scene=build_row_scene(ground)),
        settings=SolverSettings(accuracy=0.01),
    )
    return follow_season("2020/2021", read_made_up_winter(), solver, step=0)


def list_winters() -> list[VerificationCase]:
    """Peaks of the made-up winter without slip; invariants of a day."""
    season = solve_winter(GroundLaw(kind="no-slip"))
    governing = season.governing
    figures = (
        ("winter-foot", governing and governing.foot, 18.2),
        ("winter-head", governing and governing.head, 16.5),
    )
    cases = [
        VerificationCase(
            id=name,
            kind="cross model",
            reference=f"{_PROTOTYPE}: largest pull [kN/m]",
            expected=expected,
            got=band.value / 1e3 if band else math.nan,
            tolerance=0.03,
        )
        for name, band, expected in figures
    ]
    cases.append(
        VerificationCase(
            id="winter-equivalent-density",
            kind="cross model",
            reference=f"{_PROTOTYPE}: equivalent density [kg/m³]",
            expected=263.0,
            got=season.equivalent_density or math.nan,
            tolerance=0.03,
        )
    )
    return [*cases, *_list_invariants()]


def _list_invariants() -> list[VerificationCase]:
    """Layers that are alike, and snow ten times as fluid, pull the same."""
    ground = GroundLaw(kind="sliding", slip_length=_SLIP)
    scene = build_row_scene(ground)
    one = _solve(scene, ())
    split = _solve(scene, (Layer(thickness=0.9, density=320.0),) * 2)
    fluid = _solve(replace(scene, fluidity=10.0 * scene.creep_fluidity), ())
    pairs = (
        ("winter-equal-layers", "two equal layers are one, on sliding ground", split),
        ("winter-fluidity", "snow ten times as fluid pulls the same", fluid),
    )
    return [
        VerificationCase(
            id=name,
            kind="invariant",
            reference=f"{reference} [kN/m]",
            expected=one,
            got=got,
            tolerance=1e-6 if name == "winter-fluidity" else 2e-3,
        )
        for name, reference, got in pairs
    ]


def _solve(scene: Scene, layers: tuple[Layer, ...]) -> float:
    solver = DaySolver(
        row=WinterRow(id="A", scene=scene), settings=SolverSettings(accuracy=2e-3)
    )
    day = RowDay(index=0, thickness=1.8, density=320.0, layers=layers, ending="open")
    (solved,) = solver.solve([day])
    return solved.foot.value / 1e3 if solved.foot else math.nan


_SOURCE = "Magnusson et al. (2025), test series of their code, 2016 to 2022"
_PRINTED = 1e-6  # digits of the series [kg/m2]
_ROUNDING = 1e-9  # [kg/m2]
# A model that is farther off than this does not know the snow it is used for [kg/m3].
_LARGEST_BIAS, _LARGEST_SPREAD = 45.0, 75.0


@dataclass(frozen=True, slots=True, kw_only=True)
class StationSeries:
    """Daily snow heights of a station, with what is known of their mass.

    Attributes
    ----------
    heights : ndarray, shape (n_days,)
        [m].
    measured, reference : ndarray, shape (n_days,)
        SWE of snow pits, NaN on days without one, and of the authors' HS2SWE [kg/m2].
    """

    heights: Floats
    measured: Floats
    reference: Floats


def read_weissfluhjoch() -> StationSeries:
    """Series of the Weissfluhjoch, 2540 m."""
    folder = files(__package__).joinpath("weissfluhjoch")
    text = folder.joinpath("series.csv").read_text(encoding="utf-8")
    lines = list(csv.DictReader(text.splitlines()))
    return StationSeries(
        heights=np.array([float(line["hs_cm"]) / 100.0 for line in lines]),
        measured=np.array([float(line["swe_observed_mm"] or "nan") for line in lines]),
        reference=np.array([float(line["swe_hs2swe_mm"]) for line in lines]),
    )


def measure_imbalance(packs: tuple[DayPack, ...]) -> float:
    """Largest mass that a day of a series loses or finds [kg/m2]."""
    masses = np.array([pack.mass for pack in packs])
    moved = np.array([pack.new_mass - pack.runoff for pack in packs])
    return float(np.abs(np.diff(masses) - moved[1:]).max())


def list_snow_heights() -> list[VerificationCase]:
    """HS2SWE against its reference; all models against pits and their own mass."""
    series = read_weissfluhjoch()
    heights = tuple(map(float, series.heights))
    followed = {name: follow_heights(heights, model) for name, model in MODELS.items()}
    reference = [pack.mass for pack in followed[HS2SWE.name]]
    cases = [
        VerificationCase(
            id="hs2swe-reference",
            kind="published",
            reference=f"{_SOURCE}: SWE, largest difference on 2191 days [kg/m2]",
            expected=0.0,
            got=largest_difference(reference, series.reference),
            tolerance=_PRINTED,
        )
    ]
    for name, packs in followed.items():
        cases += _compare_with_pits(name, packs, series)
        cases.append(
            VerificationCase(
                id=f"{name}-mass",
                kind="invariant",
                reference="mass of a day = that before + new snow - runoff [kg/m2]",
                expected=0.0,
                got=measure_imbalance(packs),
                tolerance=_ROUNDING,
            )
        )
    return cases


def _compare_with_pits(
    name: str, packs: tuple[DayPack, ...], series: StationSeries
) -> list[VerificationCase]:
    """Bias and spread of the mean density on the days of the pits."""
    pits = ~np.isnan(series.measured)
    masses = np.array([pack.mass for pack in packs])
    errors = (masses[pits] - series.measured[pits]) / series.heights[pits]
    figures = (
        ("bias", float(errors.mean()), _LARGEST_BIAS),
        ("rmse", float(np.sqrt((errors**2).mean())), _LARGEST_SPREAD),
    )
    return [
        VerificationCase(
            id=f"{name}-density-{figure}",
            kind="published",
            reference=f"{_SOURCE}: {pits.sum()} snow pits, mean density [kg/m³]",
            expected=0.0,
            got=got,
            tolerance=tolerance,
        )
        for figure, got, tolerance in figures
    ]
