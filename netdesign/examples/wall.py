"""A wall: the force of the snow on a wall, for ground that is smoother and smoother.

The picture shows the force along the slope for four glide factors N. The Swiss
guideline takes N times the force on rough ground: the broken line. That is meant for a
long snowpack. These 20 m of snow press less, since there is not more snow that slides.

Run ``python -m netdesign.examples.wall``. It writes ``wall.png``, or the file that you
name.
"""

from __future__ import annotations

import sys
from math import radians

from netdesign import (
    FailedSolution,
    GroundLaw,
    Scene,
    Snowpack,
    Wall,
    build_ground_from_glide_factor,
    solve_rigid,
)

SNOW = Snowpack(
    slope_angle=radians(38), thickness=3.0, upslope_length=20.0, density=350.0
)
WALL = Wall(height_normal=3.0)  # across the slope; the snow adheres to it
GLIDE_FACTORS = (1.0, 1.8, 2.4, 3.0)  # 1: no slip


def find_force(glide_factor: float) -> float:
    """Force of the snow along the slope [kN/m]."""
    ground = GroundLaw(kind="no-slip")
    if glide_factor > 1.0:
        ground = build_ground_from_glide_factor(glide_factor, SNOW.thickness)
    solution = solve_rigid(Scene(snowpack=SNOW, ground=ground, net=WALL))
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    return solution.force.x / 1e3


def draw(forces: list[float], path: str) -> None:
    """Draw the force against the glide factor, beside the rule of proportion."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(GLIDE_FACTORS, forces, "ko-", label="calculated")
    ruled = [forces[0] * factor for factor in GLIDE_FACTORS]
    axes.plot(GLIDE_FACTORS, ruled, "k--", label="N times that of rough ground")
    axes.set(
        xlabel="glide factor N", ylabel="force along the slope [kN/m]", ylim=(0, None)
    )
    axes.legend(loc="upper left")
    figure.savefig(path)


def main() -> None:
    """Solve the wall for each ground, print the forces and draw them."""
    path = sys.argv[1] if sys.argv[1:] else "wall.png"
    forces = [find_force(factor) for factor in GLIDE_FACTORS]
    for factor, force in zip(GLIDE_FACTORS, forces, strict=True):
        print(f"N = {factor:.1f}  {force:5.1f} kN/m")
    draw(forces, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
