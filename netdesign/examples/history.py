"""A history: a straight net takes up its load while the snow creeps into it.

The picture shows the pulls of the net against the time since the snow began to creep.
At first the straight net hardly holds the snow. Both pulls rise within hours and then
hardly change: the plateau. A steady solve gives the plateau alone.

Run ``python -m netdesign.examples.history``. It writes ``history.png``, or the file
that you name.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from math import hypot, radians
from typing import Any

from netdesign import (
    FailedSolution,
    Net,
    Scene,
    Snowpack,
    TransientSettings,
    build_ground_from_glide_factor,
    solve_transient,
)

HOUR = 3600.0  # [s]
SNOW = Snowpack(
    slope_angle=radians(40), thickness=3.0, upslope_length=20.0, density=380.0
)
NET = Net(
    height_normal=3.0,
    inclination=radians(30),
    stiffness_per_m=2e7,
    slack=0.05,
    friction_angle=radians(30),
)
SCENE = Scene(snowpack=SNOW, ground=build_ground_from_glide_factor(1.8, 3.0), net=NET)
SETTINGS = TransientSettings(
    accuracy=0.05, start="straight", horizon=96 * HOUR, densifies=False
)


def draw(moments: Sequence[Any], path: str) -> None:
    """Draw the pulls of foot and head against time."""
    from matplotlib.figure import Figure

    hours = [one.time / HOUR for one in moments]
    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(hours, [hypot(*one.foot) / 1e3 for one in moments], "k-", label="foot")
    axes.plot(hours, [hypot(*one.head) / 1e3 for one in moments], "k--", label="head")
    axes.set(xlabel="time [h]", ylabel="pull of the net [kN/m]", xscale="log")
    axes.set_xlim(left=0.01)
    axes.legend(loc="upper left")
    figure.savefig(path)


def main() -> None:
    """Follow the scene in time, print where it comes to rest and draw the way."""
    path = sys.argv[1] if sys.argv[1:] else "history.png"
    solution = solve_transient(SCENE, SETTINGS)
    if isinstance(solution, FailedSolution):
        raise SystemExit(f"{solution.outcome.value}: {solution.reason}")
    history = solution.history
    if history is None or history.plateau.time is None:
        raise SystemExit("no plateau within the time that was followed")
    for name, pull in (("foot", solution.foot), ("head", solution.head)):
        print(f"{name} {pull.size / 1e3:.1f} kN/m, error {pull.error / 1e3:.1f}")
    print(f"plateau from {history.plateau.time / HOUR:.1f} h on")
    draw(history.moments, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
