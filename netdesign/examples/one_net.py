"""A scene: one net under snow that glides freely on smooth ground.

The picture shows the net from the side, downslope to the right. The arrows are its
pulls on the foot anchors and on the post heads. The snow of 20 m of slope hangs on this
one net, since the ground holds none of it.

Run ``python -m netdesign.examples.one_net``. It writes ``one_net.png``, or the file
that you name: ``python -m netdesign.examples.one_net net.svg``.
"""

from __future__ import annotations

import sys
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
THICKNESS = 4.0 * cos(SLOPE_ANGLE)  # of 4 m of snow, normal to the slope [m]


def build_scene() -> Scene:
    """Scene of 20 m of snow that glides freely and hangs on one net."""
    snow = Snowpack(
        slope_angle=SLOPE_ANGLE,
        thickness=THICKNESS,
        upslope_length=20.0,  # [m], to the next net row
        density=380.0,  # [kg/m3]
    )
    net = Net(
        height_normal=THICKNESS,
        inclination=radians(30),  # from the slope normal, head downslope
        stiffness_per_m=2e7,  # [N/m] at unit strain
        slack=0.05,
        friction_angle=radians(30),
    )
    return Scene(snowpack=snow, ground=GroundLaw(kind="free"), net=net)


def draw(solution: Solution, path: str) -> None:
    """Draw the net and its pulls on what holds it."""
    from matplotlib.figure import Figure

    x, y = solution.net_curve
    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(x, y, "k.-", label="net")
    for end, pull in ((0, solution.foot), (-1, solution.head)):
        tip = x[end] + pull.x / 1e5, y[end] + pull.y / 1e5
        axes.annotate("", tip, (x[end], y[end]), arrowprops={"width": 1, "fc": "0.7"})
        axes.text(*tip, f"  {pull.size / 1e3:.0f} kN/m", va="top")
    axes.axhline(0.0, color="black", linewidth=2.0)
    axes.set(xlabel="downslope [m]", ylabel="above the ground [m]")
    axes.axis("equal")
    axes.legend(loc="upper left")
    figure.savefig(path)


def main() -> None:
    """Solve the scene, print its result and draw it."""
    path = sys.argv[1] if sys.argv[1:] else "one_net.png"
    solution = solve_steady(build_scene())
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    for name, pull in (("foot", solution.foot), ("head", solution.head)):
        print(f"{name} {pull.size / 1e3:6.1f} kN/m, error {pull.error / 1e3:.1f}")
    along = solution.foot.x + solution.head.x
    print(f"downslope, foot and head together {along / 1e3:.1f} kN/m")
    print(f"sag {solution.sag:.2f} m")
    draw(solution, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
