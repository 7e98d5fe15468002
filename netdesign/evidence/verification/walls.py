"""Rigid walls: other codes, the closed form of a slab, the Swiss guideline."""

from __future__ import annotations

import math
from dataclasses import replace

from netdesign.coupling.scene import SolverSettings
from netdesign.evidence.scene import build_scene, solve_wall
from netdesign.evidence.verification.case import Found, VerificationCase, judge
from netdesign.haefeli.pressure import compute_slab_force
from netdesign.haefeli.slab import Slab, scale_slip_length
from netdesign.snow.creep_law import BOUTILLIER_2004
from netdesign.snow.ground import GroundLaw
from netdesign.snow.snowpack import GRAVITY

_THICKNESS = 3.0  # [m]
_ROUGH = GroundLaw(kind="no-slip")
# Recalled, not read, from the guideline: density -> K / sin(2 psi).
_CREEP_FACTORS = {200.0: 0.70, 300.0: 0.76, 400.0: 0.83, 500.0: 0.92, 600.0: 1.05}
# Slip length and upslope length over d, friction of the wall.
_SLABS = (
    (0.0, 40.0, 0.0),
    (0.0, 40.0, None),
    (1.0, 3.0, 0.0),
    (4.0, 190.0, None),
    (16.0, 8.0, 0.0),
    (64.0, 190.0, None),
)


def list_walls() -> list[VerificationCase]:
    """Force along X on a wall normal to the slope, snow adhering, rough ground."""
    ratios = {
        f"wall-n{exponent}-{slope}": wall_force(slope, 300.0, exponent=exponent)
        / guideline_force(slope, 300.0)
        for exponent in (3, 1)
        for slope in (35, 45)
    }
    forces = {
        f"guideline-{density:.0f}-{slope}": Found(
            wall_force(slope, density) / 1e3, guideline_force(slope, density) / 1e3
        )
        for density in _CREEP_FACTORS
        for slope in (35, 40, 45)
    }
    return judge({**ratios, **forces})


def list_depth_averaged() -> list[VerificationCase]:
    """Linear creep against the closed form: long and short snow, rough to slippery."""
    found: dict[str, float | Found] = {}
    for ratio, aspect, friction in _SLABS:
        slab = Slab(thickness=_THICKNESS, slope_angle=math.radians(40), density=300.0)
        slip, length = ratio * _THICKNESS, aspect * _THICKNESS
        force = compute_slab_force(slab, slip_length=slip, upslope_length=length)
        got = wall_force(
            40,
            300.0,
            exponent=1,
            ground=GroundLaw(kind="sliding", slip_length=slip) if slip else _ROUGH,
            length=length,
            friction_angle=friction,
        )
        wall = "adhering" if friction is None else "smooth"
        name = f"haefeli-{ratio:g}-{aspect:g}-{wall}"
        found[name] = Found(got / 1e3, force.total / 1e3)
    # stagnation depth that halves the force on smooth ground, as published
    slab = Slab(thickness=2.0, slope_angle=math.radians(30), density=350.0)
    found["haefeli-half-the-force"] = scale_slip_length(slab, 10.0, 0.5)
    return judge(found)


def wall_force(
    slope: float,
    density: float,
    *,
    exponent: float = 3,
    ground: GroundLaw = _ROUGH,
    length: float = 40.0,
    friction_angle: float | None = None,
) -> float:
    """Force along X [N/m] on a wall, adhering unless told; slope in degrees."""
    scene = build_scene(
        (_THICKNESS, density), slope=slope, length=length, ground=ground, lean=0.0
    )
    law = replace(BOUTILLIER_2004, exponent=float(exponent))
    solution = solve_wall(
        replace(scene, creep_law=law),
        SolverSettings(accuracy=0.005),
        friction_angle=friction_angle,
    )
    return solution.force.x


def guideline_force(slope: float, density: float) -> float:
    """S'_N = rho g H^2 / 2 K with N = 1 [N/m]; H is the vertical height."""
    angle = math.radians(slope)
    height = _THICKNESS / math.cos(angle)
    creep_factor = _CREEP_FACTORS[density] * math.sin(2.0 * angle)
    return density * GRAVITY * height**2 / 2.0 * creep_factor
