"""An envelope: the largest force of one net over ranges of density and slack.

The picture shows the force at the net's foot for each case that the search solved. The
line is the bound: the search lets no case within the ranges lie above it. The force
grows with the density, and it falls with the slack: a taut net pulls more.

Run ``python -m netdesign.examples.envelope``. It writes ``envelope.png``, or the file
that you name.
"""

from __future__ import annotations

import sys
from math import radians

from netdesign import (
    Interval,
    Net,
    Ranges,
    RowEnvelope,
    Scene,
    Snowpack,
    build_ground_from_glide_factor,
    find_envelope,
)

SNOW = Snowpack(
    slope_angle=radians(40), thickness=3.0, upslope_length=20.0, density=300.0
)
GROUND = build_ground_from_glide_factor(1.8, 3.0)
NET = Net(
    height_normal=3.0,
    inclination=radians(30),
    stiffness_per_m=2e7,
    slack=0.05,
    friction_angle=radians(30),
)
SCENE = Scene(snowpack=SNOW, ground=GROUND, net=NET)
RANGES = Ranges.of(
    density=Interval(low=250.0, high=450.0),  # [kg/m3]
    slack=Interval(low=0.02, high=0.1),
)
ACCURACY = 0.005  # of every force; the bound lies so close to the largest one


def draw(envelope: RowEnvelope, path: str) -> None:
    """Draw the foot's force of each case against its density, and the bound."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    for low, high, marker in ((0.02, 0.05, "^"), (0.05, 0.08, "s"), (0.08, 0.11, "o")):
        cases = [
            (result.case.density, result.member_forces["foot"].value / 1e3)
            for result in envelope.results
            if low <= result.case.values["slack"] < high
        ]
        label = f"slack from {low:.0%}"
        axes.plot(*zip(*cases, strict=True), marker, mfc="none", mec="0", label=label)
    bound = envelope.extremes["foot"].widened.high / 1e3
    axes.axhline(bound, color="black", linestyle="--", label="bound")
    axes.set(xlabel="density of the snow [kg/m³]", ylabel="force at the foot [kN/m]")
    axes.set_ylim(bottom=0)
    axes.legend(loc="lower right")
    figure.savefig(path)


def main() -> None:
    """Search the ranges, print the worst case and draw all of them."""
    path = sys.argv[1] if sys.argv[1:] else "envelope.png"
    envelope = find_envelope(SCENE, RANGES, accuracy=ACCURACY)
    if envelope.gap:
        raise SystemExit(str(envelope.gap))
    foot = envelope.extremes["foot"]
    print(f"largest force at the foot {foot.force.value / 1e3:.2f} kN/m")
    cases = len(envelope.results)
    print(f"nowhere above {foot.widened.high / 1e3:.2f} kN/m, after {cases} cases")
    draw(envelope, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
