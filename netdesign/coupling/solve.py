"""One entry for every kind of scene."""

from __future__ import annotations

from netdesign.coupling.rigid import solve_rigid
from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution, Solution, WallSolution
from netdesign.coupling.steady import solve_steady
from netdesign.snow.wall import Wall


def solve_scene(
    scene: Scene, settings: SolverSettings | None = None
) -> Solution | WallSolution | FailedSolution:
    """Steady state of snow against the scene's net or wall."""
    if isinstance(scene.net, Wall):
        return solve_rigid(scene, settings)
    return solve_steady(scene, settings)
