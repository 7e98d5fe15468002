"""Snow and net where a history of a scene begins."""

from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.state import build_problem, build_start, find_start
from netdesign.snow.mesh import build_template


def begin(scene, start="sagged", size=TRANSIENT_LEVELS[0], densifies=True, **given):
    """The scene, dimensionless, and its state at the start."""
    pack = scene.snowpack
    problem = build_problem(scene, densifies=densifies, **given)
    aspect = pack.upslope_length / pack.thickness
    template = build_template(aspect, size, scene.layer_tops)
    return problem, build_start(problem, template, find_start(scene, size, start))
