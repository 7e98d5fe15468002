"""Reach of a net upslope: glide over the free glide, by distance.

An endless row is solved as a scene, a net that stands alone by the plan view. Glide was
measured around nets with glide shoes; forces were not. So this tests what no band of
forces does.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.coupling.scene import Scene, SolverSettings
from netdesign.evidence.scene import build_scene, solve
from netdesign.evidence.verification.planview.row import find_row_velocity, solve_row
from netdesign.evidence.verification.planview.scales import compute_scales
from netdesign.evidence.verification.slab import Slab, find_linear_slip
from netdesign.numerics.arrays import Floats
from netdesign.snow.ground import build_ground_from_glide_factor

GLIDE_FACTORS = (1.2, 1.6, 2.4, 3.2)
HEIGHT, WIDTH = 2.0, 2.0  # of the measured net, vertical and along the slope [m]
MARKS = (3.0, 4.0, 3.0 * HEIGHT)  # of what was observed, and of the guideline [m]
PLACES = np.concatenate([np.linspace(0.1, 1.0, 10), np.linspace(1.25, 10.0, 36)])
SLOPE, _DENSITY = 35.0, 300.0  # [degrees], [kg/m3]
_LENGTH = 80.0 * HEIGHT  # [m]
_SETTINGS = SolverSettings(accuracy=0.001)


@dataclass(frozen=True, slots=True, kw_only=True)
class Reach:
    """Glide at one glide factor, over the glide without a net.

    Attributes
    ----------
    glide_factor : float
        N [-].
    distances : tuple of float
        Upslope of the net [m].
    of_row, of_net : tuple of float
        Beside an endless row, and a net of `WIDTH` that stands alone [-].
    """

    glide_factor: float
    distances: tuple[float, ...]
    of_row: tuple[float, ...]
    of_net: tuple[float, ...]

    def find(self, distance: float) -> tuple[float, float]:
        """Shares of row and net at a distance [m]."""
        row, net = (
            float(np.interp(distance, self.distances, one))
            for one in (self.of_row, self.of_net)
        )
        return row, net


def find_reaches(glide_factors: Sequence[float] = GLIDE_FACTORS) -> list[Reach]:
    """Glide upslope of a net for each glide factor.

    Raises
    ------
    SolveError
        If a scene has no steady state.

    Verified by
    -----------
    tests/evidence/validation/test_reach.py
    """
    return [
        Reach(
            glide_factor=one,
            distances=tuple(map(float, PLACES)),
            of_row=tuple(map(float, _follow_row(one))),
            of_net=tuple(map(float, _follow_net(one))),
        )
        for one in glide_factors
    ]


def _follow_row(glide_factor: float) -> Floats:
    """Glide of the ground's nodes upslope of an endless row."""
    thickness = HEIGHT * math.cos(math.radians(SLOPE))
    ground = build_ground_from_glide_factor(glide_factor, thickness)
    snow = (thickness, _DENSITY)
    scene = build_scene(snow, slope=SLOPE, length=_LENGTH, ground=ground, slack=0.04)
    solution = solve(scene, _SETTINGS)
    on_ground = np.abs(solution.mesh_nodes[1]) < 1e-9 * thickness
    distances = -solution.mesh_nodes[0, on_ground]
    glides = solution.mesh_velocity[0, on_ground]
    order = np.argsort(distances)
    shares = glides[order] / _find_free_glide(scene)
    return np.asarray(np.interp(PLACES, distances[order], shares))


def _find_free_glide(scene: Scene) -> float:
    """Glide far from any net [m/s]; (N12) under the slab's own weight."""
    pack = scene.snowpack
    slip = scene.ground.slip_length / pack.thickness
    shear = math.sin(pack.slope_angle) ** scene.creep_law.exponent
    return float(slip * shear * scene.velocity_scale)


def _follow_net(glide_factor: float) -> Floats:
    """Glide upslope of the middle of a net that stands alone, by linear creep."""
    angle = math.radians(SLOPE)
    slab = Slab(thickness=HEIGHT * math.cos(angle), slope_angle=angle, density=_DENSITY)
    scales = compute_scales(slab, find_linear_slip(slab, glide_factor))
    row = solve_row(WIDTH / 2.0 / scales.lateral)
    return find_row_velocity(row, PLACES / scales.longitudinal)
