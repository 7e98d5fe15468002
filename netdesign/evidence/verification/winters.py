"""A winter on a net: the made-up winter against another code, and invariants."""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from importlib.resources import files

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.evidence.scene import build_scene
from netdesign.evidence.verification.case import VerificationCase
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Layer
from netdesign.snowpack.delta_snow import DELTA_SNOW
from netdesign.snowpack.follow import follow_heights
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
            reference=f"{_PROTOTYPE}: equivalent density [kg/m3]",
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
