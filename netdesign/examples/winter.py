"""A winter: daily snow heights of a station become forces on a net.

The upper picture shows the snow height, the lower one the force at the net's foot. The
largest force comes some days after the highest snow: the pack is lower, but denser. The
curve jumps where the layers of two days are joined in different ways.

Run ``python -m netdesign.examples.winter``. It writes ``winter.png``, or the file that
you name. The heights are made up: ``winter_2000.csv``, a station at 2000 m.
"""

from __future__ import annotations

import csv
import sys
from importlib.resources import files
from math import radians

from netdesign import (
    DaySolver,
    GroundLaw,
    Net,
    Scene,
    Season,
    Snowpack,
    SolverSettings,
    WinterRow,
    follow_heights,
    follow_season,
)

SNOW = Snowpack(  # each day's snow takes its place
    slope_angle=radians(40), thickness=3.0, upslope_length=20.0, density=300.0
)
NET = Net(
    height_normal=3.0,
    inclination=radians(30),
    stiffness_per_m=2e7,
    slack=0.03,
    friction_angle=radians(30),
)
SCENE = Scene(snowpack=SNOW, ground=GroundLaw(kind="no-slip"), net=NET)


def draw(heights: list[float], season: Season, path: str) -> None:
    """Draw snow height and force day by day."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 4), layout="constrained")
    upper, lower = figure.subplots(2, sharex=True)
    upper.fill_between(range(len(heights)), heights, color="0.8", edgecolor="black")
    upper.set(ylabel="snow height [m]")
    known = [
        (day.index, day.pull / 1e3) for day in season.curve if day.pull is not None
    ]
    lower.plot(*zip(*known, strict=True), "k.-")
    lower.set(xlabel="days since 1 November", ylabel="foot [kN/m]")
    figure.savefig(path)


def main() -> None:
    """Follow the winter, print its governing day and draw it."""
    path = sys.argv[1] if sys.argv[1:] else "winter.png"
    text = files("netdesign.examples").joinpath("winter_2000.csv").read_text("utf-8")
    lines = list(csv.DictReader(text.splitlines()))
    heights = [float(line["HS [cm]"]) / 100 for line in lines]
    packs = dict(enumerate(follow_heights(heights)))
    row = WinterRow(id="A", scene=SCENE)
    solver = DaySolver(row=row, settings=SolverSettings(accuracy=0.02))
    season = follow_season("2020/2021", packs, solver)
    day = season.governing
    if day is None or day.pull is None:
        raise SystemExit("no day has a force")
    print(f"largest force {day.pull / 1e3:.1f} kN/m on {lines[day.index]['date']}")
    print(f"snow of that day {packs[day.index].mass:.0f} kg/m2")
    print(f"highest snow on {lines[season.highest.index]['date']}")
    draw(heights, season, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
