"""A panel: the net between two posts hangs on two ropes, and pulls on what holds them.

The picture shows the two ropes from above, downslope is down. The dots hold them: foot
anchors the lower rope, post heads the upper one. Under the snow both ropes hang
downslope, so that they pull hard on the dots along the row, too.

Run ``python -m netdesign.examples.panel``. It writes ``panel.png``, or the file that
you name.
"""

from __future__ import annotations

import sys
from math import cos, hypot, radians

from netdesign import (
    FailedPanel,
    FailedSolution,
    GroundLaw,
    Net,
    Panel,
    PanelSolution,
    Rope,
    Scene,
    Snowpack,
    solve_panel,
    solve_steady,
)

SLOPE_ANGLE = radians(40)
THICKNESS = 4.0 * cos(SLOPE_ANGLE)  # [m]
SNOW = Snowpack(
    slope_angle=SLOPE_ANGLE, thickness=THICKNESS, upslope_length=20.0, density=380.0
)
NET = Net(
    height_normal=THICKNESS,
    inclination=radians(30),
    stiffness_per_m=2e7,
    slack=0.05,
    friction_angle=radians(30),
)
ROPE = Rope(stiffness=2e7, sag=0.06)  # axial stiffness EA [N]
PANEL = Panel(post_spacing=4.0, lower=ROPE, upper=ROPE, cut="upper")


def draw(panel: PanelSolution, head: float, path: str) -> None:
    """Draw both ropes from above; ``head`` is how far downslope a post head is [m]."""
    from matplotlib.figure import Figure

    order = panel.stations.argsort()  # from the post to the middle
    half = [0.0, *panel.stations[order]]
    across = [*half, *(PANEL.post_spacing - z for z in reversed(half))]
    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    for name, end, node, style in (("lower", 0.0, 0, "k-"), ("upper", head, -1, "k--")):
        along = [end, *panel.curves[order, 0, node]]
        axes.plot(across, [*along, *reversed(along)], style, label=f"{name} rope")
        axes.plot([0.0, PANEL.post_spacing], [end, end], "ko")
    axes.set(xlabel="along the row [m]", ylabel="downslope [m]")
    axes.invert_yaxis()
    axes.legend()
    figure.savefig(path)


def main() -> None:
    """Solve the net at a post, then the panel; print its forces and draw it."""
    path = sys.argv[1] if sys.argv[1:] else "panel.png"
    scene = Scene(snowpack=SNOW, ground=GroundLaw(kind="free"), net=NET)
    solution = solve_steady(scene)
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    panel = solve_panel(solution, PANEL)
    if isinstance(panel, FailedPanel):
        raise SystemExit(f"{panel.outcome.value}: {panel.reason}")
    for name, force in (("foot anchor", panel.foot), ("post head", panel.head)):
        print(f"{name} {hypot(*force) / 1e3:.1f} kN, downslope {force[0] / 1e3:.1f} kN")
    for name, rope in (("lower", panel.lower), ("upper", panel.upper)):
        print(f"{name} rope {rope.tension / 1e3:.1f} kN")
    draw(panel, solution.head_point[0], path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
