"""Against other codes: snow heights, a made-up winter, three solved scenes."""

from __future__ import annotations

import csv
import math
import tomllib
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from netdesign.addons.evidence.scene import build_scene, solve
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
from netdesign.checks.inputs import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import Solution
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
    path = files(__package__).joinpath("weissfluhjoch", "series.csv")
    lines = path.read_text(encoding="utf-8").splitlines()
    days = np.genfromtxt(lines, delimiter=",", names=True)
    return StationSeries(
        heights=days["hs_cm"] / 100.0,
        measured=days["swe_observed_mm"],
        reference=days["swe_hs2swe_mm"],
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


_ACCURACY = 0.002


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedScene:
    """One scene whose snow sticks to its net: the flow alone can be run again.

    Attributes
    ----------
    name : str
        By which results of other codes name it.
    solution : Solution
        As this program solved it.
    """

    name: str
    solution: Solution

    @property
    def resultant(self) -> tuple[float, float]:
        """Force of the snow on the net [N/m]."""
        x, y = self.solution.net_forces.sum(axis=1)
        return float(x), float(y)

    @property
    def moment(self) -> float:
        """Its moment about the foot, positive where it tips the head downslope."""
        (x, y), (force_x, force_y) = self.solution.net_curve, self.solution.net_forces
        return float((y * force_x - x * force_y).sum())


@lru_cache(maxsize=1)
def _load_tables() -> dict[str, Any]:
    text = files(__package__).joinpath("another_code.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


@lru_cache(maxsize=1)
def solve_shared() -> tuple[SharedScene, ...]:
    """The three scenes, solved; their snow sticks to the net (friction of 60 degrees).

    Raises
    ------
    SolveError
        If one has no solution.
    """
    return tuple(map(_solve_table, _load_tables()["scene"]))


def _solve_table(table: dict[str, Any]) -> SharedScene:
    scene = build_scene(
        *table["layers"],
        slope=table["slope_deg"],
        length=16.0,
        ground=GroundLaw(kind=table["ground"]),
        lean=table["inclination_deg"],
        friction=60.0,
        slack=0.03,
    )
    solution = solve(scene, SolverSettings(accuracy=_ACCURACY))
    return SharedScene(name=table["name"], solution=solution)


_WITHIN = 1e-3  # of the whole force or moment: stated errors of this program


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherResult:
    """Result of another code for one scene [kN/m, kN m/m]."""

    code: str
    recipe: str
    scene: str
    force_x: float
    force_y: float
    moment: float
    uncertainty_force: float
    uncertainty_moment: float

    @property
    def force(self) -> float:
        """Size of the force [kN/m]."""
        return math.hypot(self.force_x, self.force_y)


@lru_cache(maxsize=1)
def load_results() -> tuple[OtherResult, ...]:
    """Stored results of all codes."""
    return tuple(
        OtherResult(code=code["name"], recipe=code["recipe"], **result)
        for code in _load_tables()["code"]
        for result in code["result"]
    )


def list_another_code() -> list[VerificationCase]:
    """Force and moment on the net of each scene."""
    scenes = {scene.name: scene for scene in solve_shared()}
    return [
        case
        for other in load_results()
        for case in _compare(scenes[other.scene], other)
    ]


def _compare(scene: SharedScene, other: OtherResult) -> list[VerificationCase]:
    x, y = scene.resultant
    of_force = other.uncertainty_force + _WITHIN * other.force
    of_moment = other.uncertainty_moment + _WITHIN * other.moment
    rows = {
        "force-x": (x, other.force_x, of_force),
        "force-y": (y, other.force_y, of_force),
        "moment": (scene.moment, other.moment, of_moment),
    }
    name = f"another-code-{scene.name}"
    results = {
        f"{name}-{part}": Found(got / 1e3, expected)
        for part, (got, expected, _) in rows.items()
    }
    return [
        replace(case, tolerance=allowed / abs(case.expected))
        for case, (*_, allowed) in zip(judge(results), rows.values(), strict=True)
    ]
