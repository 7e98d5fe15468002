"""Winters: snow heights and the made-up winter against other codes, invariants."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, replace
from importlib.resources import files

import numpy as np

from netdesign.addons.evidence.scene import build_scene
from netdesign.addons.evidence.verification.case import (
    Found,
    VerificationCase,
    judge,
    largest_difference,
)
from netdesign.addons.winter.day import DaySolver, RowDay, WinterRow
from netdesign.addons.winter.season import Season, follow_season
from netdesign.addons.winter.settling import (
    DELTA_SNOW,
    HS2SWE,
    MODELS,
    DayPack,
    follow_heights,
)
from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.numerics.arrays import Floats
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Layer

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
    path = files("netdesign.addons.winter") / "winter_2000.csv"
    text = path.read_text("utf-8")
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
    results: dict[str, float | Found] = {
        "winter-foot": _pull(governing.foot if governing else None),
        "winter-head": _pull(governing.head if governing else None),
        "winter-equivalent-density": season.equivalent_density or math.nan,
    }
    return judge({**results, **_list_invariants()})


def _pull(force: Band | None) -> float:
    """Value of a pull [kN/m]; NaN without one."""
    return force.value / 1e3 if force else math.nan


def _list_invariants() -> dict[str, Found]:
    """Layers that are alike, and snow ten times as fluid, pull the same."""
    ground = GroundLaw(kind="sliding", slip_length=_SLIP)
    scene = build_row_scene(ground)
    uniform = _solve(scene, ())
    split = _solve(scene, (Layer(thickness=0.9, density=320.0),) * 2)
    fluid = _solve(replace(scene, fluidity=10.0 * scene.creep_fluidity), ())
    return {
        "winter-equal-layers": Found(split, uniform),
        "winter-fluidity": Found(fluid, uniform),
    }


def _solve(scene: Scene, layers: tuple[Layer, ...]) -> float:
    solver = DaySolver(
        row=WinterRow(id="A", scene=scene), settings=SolverSettings(accuracy=2e-3)
    )
    day = RowDay(index=0, thickness=1.8, density=320.0, layers=layers, ending="open")
    (solved,) = solver.solve([day])
    return _pull(solved.foot)


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
    results = {"hs2swe-reference": largest_difference(reference, series.reference)}
    for name, packs in followed.items():
        results |= _compare_with_pits(name, packs, series)
        results[f"{name}-mass"] = measure_imbalance(packs)
    return judge(results)


def _compare_with_pits(
    name: str, packs: tuple[DayPack, ...], series: StationSeries
) -> dict[str, float]:
    """Bias and spread of the mean density on the days of the pits."""
    pits = ~np.isnan(series.measured)
    masses = np.array([pack.mass for pack in packs])
    errors = (masses[pits] - series.measured[pits]) / series.heights[pits]
    return {
        f"{name}-density-bias": float(errors.mean()),
        f"{name}-density-rmse": float(np.sqrt((errors**2).mean())),
    }
