"""Row and winter that the tests of the chain share."""

import csv
import math
from dataclasses import replace
from importlib.resources import files

import numpy as np

from netdesign.addons.winter.day import DaySolver, WinterRow
from netdesign.addons.winter.settling import DayPack
from netdesign.cable.net import Net
from netdesign.checks.result import Band
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack

SLOPE = math.radians(40.0)


def a_scene(ground=None, net_height=3.0, **changes):
    """Scene of the figures of winters; slack, stiffness and angles may be others."""
    return Scene(
        snowpack=Snowpack(
            slope_angle=SLOPE,
            thickness=net_height,
            upslope_length=20.0,
            density=300.0,
        ),
        ground=ground or GroundLaw(kind="no-slip"),
        net=Net(
            height_normal=net_height,
            inclination=math.radians(changes.pop("inclination_deg", 30.0)),
            stiffness_per_m=2e7,
            slack=changes.pop("slack", 0.03),
            friction_angle=math.radians(30.0),
        ),
        **changes,
    )


def loaded(density, thickness, ground):
    """Scene under uniform snow."""
    snow = Snowpack(
        slope_angle=SLOPE, thickness=thickness, upslope_length=20.0, density=density
    )
    return replace(a_scene(ground), snowpack=snow)


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
