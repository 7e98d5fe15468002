"""A layered snowpack and uniform snow of the same weight, on three grounds.

Run it with ``python -m netdesign.examples.layered_pack``. The table shows how much the
ground decides, and what a dense layer at the ground changes.
"""

from __future__ import annotations

from math import radians

from netdesign import (
    FailedSolution,
    GroundLaw,
    Layer,
    Net,
    Scene,
    Snowpack,
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


def describe(snowpack: Snowpack, ground: GroundLaw) -> str:
    """Pulls of a net as high as the snow, with their errors [kN/m]."""
    net = Net(
        height_normal=snowpack.thickness,
        inclination=radians(30),
        stiffness_per_m=2e7,
        slack=0.03,
        friction_angle=radians(30),
    )
    solution = solve_steady(Scene(snowpack=snowpack, ground=ground, net=net))
    if isinstance(solution, FailedSolution):
        return f"{solution.outcome.value}: {solution.reason}"
    return "  ".join(
        f"{pull.size / 1e3:7.1f} ({pull.error / 1e3:.1f})"
        for pull in (solution.foot, solution.head)
    )


def main() -> None:
    """Solve both snowpacks on every ground and print a table."""
    print("ground   snow        foot (error)   head (error) [kN/m]")
    packs = build_packs()
    for name, ground in build_grounds(packs["uniform"].thickness).items():
        for kind, snowpack in packs.items():
            print(f"{name:8} {kind:8} {describe(snowpack, ground)}")


if __name__ == "__main__":
    main()
