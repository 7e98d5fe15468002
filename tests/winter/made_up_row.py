"""Row and winter that the tests of the chain share."""

import csv
import math
from importlib.resources import files

from netdesign.cable.net import Net
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.snow.ground import GroundLaw, build_ground_from_glide_factor
from netdesign.snow.snowpack import Snowpack
from netdesign.winter.day import DaySolver, WinterRow

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
    text = files("netdesign.examples").joinpath("winter_2000.csv").read_text("utf-8")
    return [float(line["HS [cm]"]) / 100 for line in csv.DictReader(text.splitlines())]
