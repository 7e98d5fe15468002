"""Row and winter that the tests of the chain share."""

import csv
import math
from dataclasses import replace
from importlib.resources import files

import numpy as np

from netdesign.addons.winter.day import DaySolver, WinterRow
from netdesign.addons.winter.settling import DayPack
from netdesign.checks.inputs import Band
from netdesign.coupling.scene import SolverSettings
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from tests.scenes import ICE, build_scene

SLOPE_DEG = 40.0
SLOPE = math.radians(SLOPE_DEG)


def a_scene(ground=None, net_height=3.0, density=300.0, thickness=None, **changes):
    """Scene of the figures of winters; slack, stiffness and angles may be others."""
    scene = build_scene(
        slope_deg=SLOPE_DEG,
        thickness_m=net_height if thickness is None else thickness,
        height_m=net_height,
        relative_density=density / ICE,
        **{"inclination_deg": 30.0, "slack": 0.03} | changes,
    )
    return replace(scene, ground=ground or GroundLaw(kind="no-slip"))


def loaded(density, thickness, ground):
    """Scene under uniform snow."""
    return a_scene(ground, density=density, thickness=thickness)


def a_solver(ground=None, accuracy=0.01, factor=1.0, layout=None, **changes):
    row = WinterRow(
        id="A", scene=a_scene(ground, **changes), height_factor=factor, layout=layout
    )
    return DaySolver(row=row, settings=SolverSettings(accuracy=accuracy))


def slides(glide_factor, height):
    """Ground of a glide factor at a vertical snow height [m]."""
    return build_ground_from_glide_factor(glide_factor, height * math.cos(SLOPE))


def read_winter():
    """Snow heights [m] of the made-up winter at 2000 m, from 1 November."""
    text = (
        files("netdesign.addons.winter").joinpath("winter_2000.csv").read_text("utf-8")
    )
    return [float(line["HS [cm]"]) / 100 for line in csv.DictReader(text.splitlines())]


def a_pack(heights, densities):
    """Layers from the ground, the lowest the oldest."""
    heights = np.array(heights)
    return DayPack(
        heights=heights,
        masses=heights * np.array(densities),
        ages=np.arange(heights.size)[::-1],
    )


class FormulaSolver(DaySolver):
    """Pulls that grow as rho^1.2 d^1.9: the season's logic without a solve."""

    def _run(self, days):
        return [
            replace(
                day, ending="solved", foot=self._pull(day), head=self._pull(day, 0.8)
            )
            for day in days
        ]

    def _pull(self, day, share=1.0):
        value = share * (day.density / 300.0) ** 1.2 * day.thickness**1.9 * 4e3
        return Band(low=0.99 * value, value=value, high=1.01 * value)


def a_formula_solver():
    return FormulaSolver(row=a_solver().row, settings=SolverSettings(accuracy=0.05))
