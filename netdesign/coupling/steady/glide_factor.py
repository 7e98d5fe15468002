"""Glide factor N of a slip length, by the recipe that made the stored table."""

from __future__ import annotations

import math

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.coupling.solution import FailedSolution
from netdesign.coupling.steady.rigid import solve_rigid
from netdesign.errors import SolveError
from netdesign.snow.creep_law import CreepLaw
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import Snowpack
from netdesign.snow.wall import Wall

# The recipe: snow adhering to a rigid wall normal to the slope, as high as the snow.
# What these leave open: coupling/THEORY.md, section 1.
_THICKNESS = 3.0  # [m]
_UPSLOPE_LENGTH = 240.0  # [m]
_SLOPE_ANGLE = math.radians(40.0)
_DENSITY = 340.0  # [kg/m3]
_SETTINGS = SolverSettings(accuracy=0.001)


def measure_glide_factor(law: CreepLaw, slip_ratio: float) -> float:
    """Ratio of snow pressures on a rigid wall with and without sliding.

    Parameters
    ----------
    law : CreepLaw
        Creep law.
    slip_ratio : float
        Slip length over snow thickness [-].

    Returns
    -------
    float
        N [-].

    Raises
    ------
    SolveError
        If one of the two scenes has no solution.
    """
    sliding = GroundLaw(kind="sliding", slip_length=slip_ratio * _THICKNESS)
    rough = GroundLaw(kind="no-slip")
    return _wall_force(law, sliding) / _wall_force(law, rough)


def _wall_force(law: CreepLaw, ground: GroundLaw) -> float:
    scene = Scene(
        snowpack=Snowpack(
            slope_angle=_SLOPE_ANGLE,
            thickness=_THICKNESS,
            upslope_length=_UPSLOPE_LENGTH,
            density=_DENSITY,
        ),
        ground=ground,
        net=Wall(height_normal=_THICKNESS),
        creep_law=law,
    )
    solution = solve_rigid(scene, _SETTINGS)
    if isinstance(solution, FailedSolution):
        raise SolveError(solution.outcome, solution.reason)
    return solution.force.x
