"""One entry for every kind of scene and every method."""

from __future__ import annotations

from netdesign.coupling.history.settings import StaggeredSettings, TransientSettings
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Method, Solution, WallSolution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.snow.wall import Wall

Settings = SolverSettings | TransientSettings | StaggeredSettings


def solve_scene(
    scene: Scene, settings: Settings | None = None
) -> Solution | WallSolution | FailedSolution:
    """Snow against the scene's net or wall; the settings choose the method.

    Parameters
    ----------
    scene : Scene
        Snow, ground and net or wall.
    settings : SolverSettings, TransientSettings or StaggeredSettings, optional
        Of the steady state (default), of a history, or of the paper's exchange.
    """
    # few runs follow histories or push a wall: they alone wait for the imports
    if isinstance(settings, TransientSettings):
        from netdesign.coupling.history.transient import solve_transient

        return solve_transient(scene, settings)
    if isinstance(settings, StaggeredSettings):
        from netdesign.coupling.history.staggered import solve_staggered

        return solve_staggered(scene, settings)
    if isinstance(scene.net, Wall):
        from netdesign.coupling.steady.rigid import solve_rigid

        return solve_rigid(scene, settings)
    return solve_steady(scene, settings)


def method_of(settings: Settings) -> Method:
    """Name of the method that the settings choose."""
    if isinstance(settings, TransientSettings):
        return "transient"
    if isinstance(settings, StaggeredSettings):
        return "staggered"
    return "steady"
