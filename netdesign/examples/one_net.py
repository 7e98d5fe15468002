"""One net under uniform snow: what it pulls with at foot and head, and its shape.

Run it with ``python -m netdesign.examples.one_net``; it writes ``one_net.svg``.
"""

from __future__ import annotations

from math import cos, radians

from netdesign import (
    FailedSolution,
    GroundLaw,
    Net,
    Scene,
    Snowpack,
    Solution,
    solve_steady,
)

SLOPE_ANGLE = radians(40)
SNOW_HEIGHT = 4.0  # vertical [m]
PICTURE = "one_net.svg"


def build_scene() -> Scene:
    """Scene of 20 m of snow that glides freely and hangs on one net."""
    thickness = SNOW_HEIGHT * cos(SLOPE_ANGLE)  # normal to the slope [m]
    snow = Snowpack(
        slope_angle=SLOPE_ANGLE,
        thickness=thickness,
        upslope_length=20.0,  # [m], to the next net row
        density=380.0,  # [kg/m3]
    )
    net = Net(
        height_normal=thickness,
        inclination=radians(30),  # from the slope normal, head downslope
        stiffness_per_m=2e7,  # [N/m] at unit strain
        slack=0.05,
        friction_angle=radians(30),
    )
    return Scene(snowpack=snow, ground=GroundLaw(kind="free"), net=net)


def describe(solution: Solution) -> str:
    """Pulls of the net with their errors, and its sag."""
    lines = [
        f"{name} {pull.size / 1e3:6.1f} kN/m, error {pull.error / 1e3:.1f}"
        for name, pull in (("foot", solution.foot), ("head", solution.head))
    ]
    return "\n".join([*lines, f"sag  {solution.sag:6.2f} m"])


def draw(solution: Solution, path: str) -> None:
    """Write a drawing of the net's shape and the forces of the snow on it."""
    from matplotlib.figure import Figure

    x, y = solution.net_curve
    force_x, force_y = solution.net_forces / abs(solution.net_forces).max()
    figure = Figure(figsize=(5, 5), layout="constrained")
    axes = figure.subplots()
    axes.plot(x, y, marker=".", label="net")
    axes.quiver(x, y, force_x, force_y, width=0.003, label="snow on the mesh's nodes")
    axes.axhline(0.0, color="black", linewidth=1.0)
    axes.set(xlabel="along the slope [m]", ylabel="normal to the slope [m]")
    axes.axis("equal")
    axes.legend()
    figure.savefig(path)


def main() -> None:
    """Solve the scene, print its result and draw it."""
    solution = solve_steady(build_scene())
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    print(describe(solution))
    draw(solution, PICTURE)
    print(f"wrote {PICTURE}")


if __name__ == "__main__":
    main()
