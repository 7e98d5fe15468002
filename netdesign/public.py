"""Names that ``from netdesign import ...`` gives, each with the module it lives in.

``netdesign/__init__.py`` loads this module when one of them is first asked for. A line
``import X as X`` says to type checkers that the name is public.
"""

from netdesign.api import check as check
from netdesign.api import find_anchor_forces as find_anchor_forces
from netdesign.api import find_envelope as find_envelope
from netdesign.api import find_guideline_load as find_guideline_load
from netdesign.api import read_study as read_study
from netdesign.api import write_reports as write_reports
from netdesign.cable.net import Net as Net
from netdesign.checks import Standard as Standard
from netdesign.checks import load_standard as load_standard
from netdesign.coupling.scene import Scene as Scene
from netdesign.coupling.scene import SolverSettings as SolverSettings
from netdesign.coupling.solution import FailedSolution as FailedSolution
from netdesign.coupling.solution import Solution as Solution
from netdesign.coupling.steady.solve import solve_steady as solve_steady
from netdesign.envelope.ranges import Interval as Interval
from netdesign.envelope.ranges import Ranges as Ranges
from netdesign.envelope.rows import RowEnvelope as RowEnvelope
from netdesign.files.scene import read_scene as read_scene
from netdesign.outcome import NetDesignError as NetDesignError
from netdesign.outcome import SolveError as SolveError
from netdesign.panel.inputs import Panel as Panel
from netdesign.panel.inputs import Rope as Rope
from netdesign.panel.solve import FailedPanel as FailedPanel
from netdesign.panel.solve import PanelSolution as PanelSolution
from netdesign.panel.solve import solve_panel as solve_panel
from netdesign.site.model import Site as Site
from netdesign.site.reader import read_site as read_site
from netdesign.site.template.office_workbook import (
    write_site_workbook as write_site_workbook,
)
from netdesign.snow.ground import GroundLaw as GroundLaw
from netdesign.snow.ground import (
    build_ground_from_glide_factor as build_ground_from_glide_factor,
)
from netdesign.snow.snowpack import Layer as Layer
from netdesign.snow.snowpack import Snowpack as Snowpack
from netdesign.snow.snowpack import build_layered_snowpack as build_layered_snowpack
from netdesign.structure.anchors import AnchorForces as AnchorForces
from netdesign.structure.head import FailedSupport as FailedSupport
from netdesign.structure.layout import SupportLayout as SupportLayout
from netdesign.study.records import Study as Study
from netdesign.study.scopes import Scope as Scope
