"""An envelope: the largest force of one net over ranges of density and friction.

The picture shows the force at the net's foot for each case that the search solved. The
line is the bound: no case within the ranges has a larger force. The force grows with
the density; for one density it depends on the friction between snow and net.

Run ``python -m netdesign.examples.envelope``. It writes ``envelope.png``, or the file
that you name.
"""

from __future__ import annotations

import sys
from math import radians

from netdesign import (
    GroundLaw,
    Interval,
    Net,
    Ranges,
    RowEnvelope,
    RowTask,
    Runner,
    Scene,
    SearchSettings,
    Snowpack,
    SolverSettings,
    search_rows,
)

SNOW = Snowpack(
    slope_angle=radians(40), thickness=3.0, upslope_length=20.0, density=300.0
)
NET = Net(
    height_normal=3.0,
    inclination=radians(30),
    stiffness_per_m=2e7,
    slack=0.05,
    friction_angle=radians(30),
)
TASK = RowTask(
    scene=Scene(snowpack=SNOW, ground=GroundLaw(kind="no-slip"), net=NET),
    ranges=Ranges.of(
        density=Interval(low=250.0, high=450.0),  # [kg/m3]
        friction_angle=Interval(low=radians(15), high=radians(45)),
    ),
    layout=None,
    settings=SolverSettings(accuracy=0.005),
    search=SearchSettings(gap=0.005),  # the bound lies so close to the maximum
    confirmed_by=None,
)


def draw(found: RowEnvelope, path: str) -> None:
    """Draw the foot's force of each case against its density, and the bound."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    for low, high, marker in ((15, 25, "o"), (25, 35, "s"), (35, 46, "^")):
        cases = [
            (one.case.density, one.member_forces["foot"].value / 1e3)
            for one in found.results
            if radians(low) <= one.case.friction_angle + 1e-9 < radians(high)
        ]
        label = f"friction angle from {low}°"
        axes.plot(*zip(*cases, strict=True), marker, mfc="none", mec="0", label=label)
    bound = found.extremes["foot"].widened.high / 1e3
    axes.axhline(bound, color="black", linestyle="--", label="bound")
    axes.set(xlabel="density of the snow [kg/m³]", ylabel="force at the foot [kN/m]")
    axes.legend(loc="upper left")
    figure.savefig(path)


def main() -> None:
    """Search the ranges, print the worst case and draw all of them."""
    path = sys.argv[1] if sys.argv[1:] else "envelope.png"
    (found,) = search_rows([TASK], Runner())
    if found.gap:
        raise SystemExit(str(found.gap))
    foot = found.extremes["foot"]
    print(f"largest force at the foot {foot.force.value / 1e3:.2f} kN/m")
    print(
        f"nowhere above {foot.widened.high / 1e3:.2f} kN/m, after {len(found.results)} cases"
    )
    draw(found, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
