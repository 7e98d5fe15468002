"""Layers: a layered snowpack and uniform snow of the same weight, on three grounds.

The picture shows the pull at the net's foot. The ground decides most: on free ground it
is several times that on rough ground. On rough and on sliding ground a dense layer at
the ground lowers the pull; on free ground it raises it.

Run ``python -m netdesign.examples.layered_pack``. It writes ``layered_pack.png``, or
the file that you name.
"""

from __future__ import annotations

import sys
from math import radians

from netdesign import (
    FailedSolution,
    GroundLaw,
    Layer,
    Net,
    Scene,
    Snowpack,
    Solution,
    build_ground_from_glide_factor,
    build_layered_snowpack,
    solve_steady,
)

SLOPE_ANGLE = radians(38)
UPSLOPE_LENGTH = 20.0  # [m]
LAYERS = (  # from the ground up
    Layer(thickness=1.2, density=400.0),
    Layer(thickness=1.0, density=320.0),
    Layer(thickness=0.8, density=240.0),
)


def build_packs() -> dict[str, Snowpack]:
    """Layered snow, and uniform snow of its thickness and mean density."""
    layered = build_layered_snowpack(
        LAYERS, slope_angle=SLOPE_ANGLE, upslope_length=UPSLOPE_LENGTH
    )
    uniform = Snowpack(
        slope_angle=SLOPE_ANGLE,
        thickness=layered.thickness,
        upslope_length=UPSLOPE_LENGTH,
        density=layered.density,
    )
    return {"layered": layered, "uniform": uniform}


def build_grounds(thickness: float) -> dict[str, GroundLaw]:
    """Rough, sliding and freely gliding ground under snow of a thickness [m]."""
    return {
        "no slip": GroundLaw(kind="no-slip"),
        "N = 1.8": build_ground_from_glide_factor(1.8, thickness),
        "free": GroundLaw(kind="free"),
    }


def solve(snowpack: Snowpack, ground: GroundLaw) -> Solution:
    """Net as high as the snow."""
    net = Net(
        height_normal=snowpack.thickness,
        inclination=radians(30),
        stiffness_per_m=2e7,
        slack=0.03,
        friction_angle=radians(30),
    )
    solution = solve_steady(Scene(snowpack=snowpack, ground=ground, net=net))
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    return solution


def describe(solution: Solution) -> str:
    """Pulls of a net with their errors [kN/m]."""
    return "  ".join(
        f"{pull.size / 1e3:7.1f} ({pull.error / 1e3:.1f})"
        for pull in (solution.foot, solution.head)
    )


def draw(feet: dict[str, list[float]], grounds: list[str], path: str) -> None:
    """Draw the pull at the foot for each ground [kN/m], both snowpacks side by side."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    for kind, shift, hatch in (("layered", -0.2, ""), ("uniform", 0.2, "///")):
        places = [place + shift for place in range(len(grounds))]
        axes.bar(places, feet[kind], 0.4, fc="white", ec="0", hatch=hatch, label=kind)
    axes.set(ylabel="pull at the foot [kN/m]")
    axes.set_xticks(range(len(grounds)), grounds)
    axes.legend(loc="upper left")
    figure.savefig(path)


def main() -> None:
    """Solve both snowpacks on each ground, print a table and draw the pulls."""
    path = sys.argv[1] if sys.argv[1:] else "layered_pack.png"
    print("ground   snow        foot (error)   head (error) [kN/m]")
    packs = build_packs()
    grounds = build_grounds(packs["uniform"].thickness)
    feet: dict[str, list[float]] = {kind: [] for kind in packs}
    for name, ground in grounds.items():
        for kind, snowpack in packs.items():
            solution = solve(snowpack, ground)
            feet[kind].append(solution.foot.size / 1e3)
            print(f"{name:8} {kind:8} {describe(solution)}")
    draw(feet, list(grounds), path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
