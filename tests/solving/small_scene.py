"""A small scene on the two coarsest meshes."""

import math

from netdesign.cable.net import Net
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseResult, CaseTask, run_cases
from netdesign.panel.inputs import Panel, Rope
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.structure.layout import SupportLayout

COARSE = SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2])
LAYOUT = SupportLayout(
    post_spacing=3.5, uphill_anchor_distance=3.0, downhill_anchor_distance=3.0
)
PANEL = Panel(
    post_spacing=3.5,
    lower=Rope(stiffness=17.3e6, sag=0.043),
    upper=Rope(stiffness=19.1e6, sag=0.057),
    cut="upper",
)


def solve_case(task: CaseTask) -> CaseResult:
    """Result of one case, solved here."""
    return run_cases([task])[0]


def build_scene(case: Case, kind: type[Scene] = Scene) -> Scene:
    """Three metres of snow on free ground, 6 m long, behind a net as high."""
    return kind(
        snowpack=Snowpack(
            slope_angle=math.radians(38.0),
            thickness=3.0,
            upslope_length=6.0,
            density=case.density,
        ),
        ground=GroundLaw(kind="free"),
        net=Net(
            height_normal=3.0,
            inclination=case.inclination,
            stiffness_per_m=1e7,
            slack=0.05,
            friction_angle=case.friction_angle,
        ),
    )
