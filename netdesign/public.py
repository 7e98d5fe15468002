"""Names that ``from netdesign import ...`` gives, each with the module it lives in.

``netdesign/__init__.py`` loads this module when one of them is first asked for. A line
``import X as X`` says to type checkers that the name is public.
"""

from netdesign.cable.net import Net as Net
from netdesign.checks import load_standard as load_standard
from netdesign.coupling.history.settings import TransientSettings as TransientSettings
from netdesign.coupling.history.transient import solve_transient as solve_transient
from netdesign.coupling.scene import Scene as Scene
from netdesign.coupling.scene import SolverSettings as SolverSettings
from netdesign.coupling.solution import FailedSolution as FailedSolution
from netdesign.coupling.solution import Solution as Solution
from netdesign.coupling.solution import WallSolution as WallSolution
from netdesign.coupling.steady.rigid import solve_rigid as solve_rigid
from netdesign.coupling.steady.solve import solve_steady as solve_steady
from netdesign.errors import NetDesignError as NetDesignError
from netdesign.errors import SolveError as SolveError
from netdesign.files.scene import read_scene as read_scene
from netdesign.site.reader import read_site as read_site
from netdesign.snow.ground import GroundLaw as GroundLaw
from netdesign.snow.ground import (
    build_ground_from_glide_factor as build_ground_from_glide_factor,
)
from netdesign.snow.snowpack import Layer as Layer
from netdesign.snow.snowpack import Snowpack as Snowpack
from netdesign.snow.snowpack import build_layered_snowpack as build_layered_snowpack
from netdesign.snow.wall import Wall as Wall
from netdesign.study.check_run import CheckRun as CheckRun
from netdesign.study.check_site import check_site as check_site
