"""A fit: five readings of a load cell narrow the force to design for.

The readings are made up. They come from ground that is more slippery, and from snow
that is denser, than the row was designed for. The picture shows the readings beside the
forces after the fit, and the 90 % band of the governing day, before and after.

Run ``python -m netdesign.examples.fit``. It writes ``fit.png``, or the file that you
name.
"""

from __future__ import annotations

import csv
import sys
from importlib.resources import files
from math import radians

from netdesign import (
    DaySolver,
    FitReading,
    FitTask,
    Net,
    Noise,
    Scene,
    SeasonFit,
    Snowpack,
    SolverSettings,
    SupportLayout,
    WinterRow,
    build_ground_from_glide_factor,
    fit_season,
    follow_heights,
)

READINGS = {130: 114.2, 137: 98.3, 144: 112.8, 151: 149.6, 163: 155.1}  # day: [kN]
GOVERNING = 156  # days since 1 November
SURVEYED = frozenset({"height_factor", "slack", "friction_angle"})
LAYOUT = SupportLayout(
    post_spacing=3.7,
    post_tilt=radians(13),
    uphill_anchor_distance=3.1,
    downhill_anchor_distance=2.7,
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
ROW = WinterRow(
    id="A",
    scene=Scene(
        snowpack=SNOW, ground=build_ground_from_glide_factor(2.2, 2.2), net=NET
    ),
    layout=LAYOUT,
)


def build_task() -> FitTask:
    """Days of the readings and the governing one, by uniform snow."""
    text = files("netdesign.examples").joinpath("winter_2000.csv").read_text("utf-8")
    lines = csv.DictReader(text.splitlines())
    packs = follow_heights([float(line["HS [cm]"]) / 100 for line in lines])
    meshes = SolverSettings().levels[:3]  # the same for each day: errors cancel
    settings = SolverSettings(accuracy=2e-3, levels=meshes)
    solver = DaySolver(row=ROW, settings=settings)
    wanted = {day: packs[day] for day in sorted({*READINGS, GOVERNING})}
    return FitTask(
        winter="2020/2021",
        solver=solver,
        days={day.index: day for day in solver.prepare(wanted, layered=False)},
        readings=tuple(
            FitReading(index=day, member="foot_anchor", force=force * 1e3)
            for day, force in READINGS.items()
        ),
        noise=Noise(reading=0.05, cell=0.0),
        known=SURVEYED,
        governing=GOVERNING,
    )


def draw(fitted: SeasonFit, path: str) -> None:
    """Draw readings, forces after the fit, and both bands of the governing day."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5, 3.4), layout="constrained")
    axes = figure.subplots()
    axes.plot(list(READINGS), list(READINGS.values()), "kx", label="measured")
    after = [force / 1e3 for force in fitted.computed]
    axes.plot(list(READINGS), after, "ko", mfc="none", label="after the fit")
    foot = fitted.forces[0]
    for band, place, style, name in (
        (foot.before, -1, ":", "before"),
        (foot.after or foot.before, 1, "-", "after"),
    ):
        ends, label = [band.low / 1e3, band.high / 1e3], f"band {name}"
        axes.plot([GOVERNING + place] * 2, ends, f"k_{style}", label=label)
    axes.set(xlabel="days since 1 November", ylabel="foot anchor [kN]", ylim=(0, None))
    axes.legend(loc="lower left")
    figure.savefig(path)


def main() -> None:
    """Fit the row to its readings, print the bands and draw them."""
    path = sys.argv[1] if sys.argv[1:] else "fit.png"
    fitted = fit_season(build_task())
    foot = fitted.forces[0]
    if foot.after is None:
        raise SystemExit(f"the fit is refused: {fitted.ending}")
    for name, band in (("before", foot.before), ("after", foot.after)):
        low, value, high = (force / 1e3 for force in (band.low, band.value, band.high))
        print(f"{name:6} {value:.1f} kN, 90 % band {low:.1f} to {high:.1f}")
    draw(fitted, path)
    print(f"wrote {path}")


if __name__ == "__main__":
    main()
