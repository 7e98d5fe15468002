"""Truth for a solution: the same scene on a mesh four times finer."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from netdesign.coupling.balance import SuctionError
from netdesign.coupling.interface import STEADY_ERROR
from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.solution import (
    EndPull,
    FailedSolution,
    Solution,
    require_solved,
)
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.element import share_template
from netdesign.snow.mesh import MeshSize

HALVINGS = 2  # of every side: a truth is four times finer
# Rounding in the balance grows with the mesh; a truth is not handed out as a result.
_TRUTH_BALANCE = 1e-6
# Rounds beside which the snow lifts off take up to 25 on a fine mesh; a result would be
# left to a coarser one (measured: 180 linear solves, where 40 to 100 are usual).
_TRUTH_PATIENCE = 10.0
# No second mesh states an error as small: refinement goes on to the last.
_EVERY_MESH = 0.8 * STEADY_ERROR.floor


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Truth:
    """End pulls of the fine mesh, shape (2,) each [N/m]."""

    foot: NDArray[np.float64]
    head: NDArray[np.float64]

    def compare(self, solution: Solution) -> float:
        """Larger relative error of the two end pulls, as vectors [-]."""
        return max(self.compare_ends(solution))

    def compare_ends(self, solution: Solution) -> tuple[float, float]:
        """Relative errors of the pulls at foot and head [-]."""
        return (
            _relative(_vector(solution.foot), self.foot),
            _relative(_vector(solution.head), self.head),
        )


def solve_truth(
    scene: Scene,
    size: MeshSize,
    settings: SolverSettings,
    *,
    halvings: int = HALVINGS,
) -> Truth:
    """End pulls on a mesh finer than ``size`` in each direction, at the net's ends too.

    Every side of a triangle is halved so many times; by default it is four times finer.

    Raises
    ------
    SolveError
        If the fine mesh gives no converged solution.
    """
    fine = replace(
        settings,
        levels=(size, refine_size(size, halvings)),
        balance_tolerance=_TRUTH_BALANCE,
        step=None,
    )
    return solve_fine(scene, fine)


def solve_fine(scene: Scene, settings: SolverSettings) -> Truth:
    """Truth on the finest of the settings' meshes, however long it takes.

    Where the first flow on a fine mesh finds no contact, the coarsest of the usual
    meshes leads there. Suction just beyond what is accepted keeps it from being a
    result, not from being what coarser meshes are held against.

    Raises
    ------
    SolveError
        If that mesh gives no solution in balance.
    """
    patient = replace(settings, patience=_TRUTH_PATIENCE)
    try:
        return _solve_finest(scene, patient)
    except SolveError:
        levels = (MESH_LEVELS[0], *settings.levels)
        accuracy = min(settings.accuracy, _EVERY_MESH)
        return _solve_finest(scene, replace(patient, levels=levels, accuracy=accuracy))


def _solve_finest(scene: Scene, settings: SolverSettings) -> Truth:
    try:
        solution = solve_steady(scene, settings, on_failure="raise")
    except SuctionError as refusal:
        if refusal.held is None:
            raise
        solution = refusal.held
    if not _is_on(settings.levels[-1], require_solved(solution)):
        raise SolveError(Outcome.MAX_ITERATIONS)  # left to a coarser mesh
    return build_truth(solution)


def build_truth(solution: Solution | FailedSolution) -> Truth:
    """Truth from a fine solution.

    Raises
    ------
    SolveError
        If it has failed.
    """
    solved = require_solved(solution)
    return Truth(foot=_vector(solved.foot), head=_vector(solved.head))


def refine_size(size: MeshSize, times: int) -> MeshSize:
    """Mesh size whose triangles are cut in four ``times`` times."""
    return replace(size, subdivisions=size.subdivisions + times)


def find_level(solution: Solution, levels: tuple[MeshSize, ...]) -> MeshSize:
    """Level whose mesh a solution was found on, by its number of triangles."""
    return next((level for level in levels if _is_on(level, solution)), levels[-1])


def _is_on(size: MeshSize, solution: Solution) -> bool:
    """A mesh of this size has as many triangles as that of a solution."""
    scene = solution.scene
    template = share_template(scene.modelled_aspect, size, scene.layer_tops)
    return bool(template.triangles.shape[1] == solution.cost.elements)


def state_error(solution: Solution) -> float:
    """Larger relative error of the end forces that a solution states [-]."""
    return max(pull.error / pull.size for pull in (solution.foot, solution.head))


def _relative(pull: NDArray[np.float64], true: NDArray[np.float64]) -> float:
    return float(np.hypot(*(pull - true)) / np.hypot(*true))


def _vector(pull: EndPull) -> NDArray[np.float64]:
    return np.array([pull.x, pull.y])
