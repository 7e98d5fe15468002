"""Net rows of the small scene, and cases of it."""

import math

from netdesign.envelope.ranges import Case, Interval, Ranges
from netdesign.envelope.rows import RowTask
from netdesign.search.maxima import SearchSettings
from tests.solving.small_scene import COARSE, LAYOUT, build_scene

SCENE = build_scene(Case(density=300.0, friction_angle=0.5, inclination=0.5))


def build_row(density, friction_deg, inclination_deg=None, *, gap=0.01, **given):
    """Row over ranges of density [kg/m3] and angles [deg]."""
    angles = {"friction_angle": friction_deg, "inclination": inclination_deg}
    spans = {"density": Interval(low=density[0], high=density[1])} | {
        name: Interval(low=math.radians(ends[0]), high=math.radians(ends[1]))
        for name, ends in angles.items()
        if ends
    }
    values = {"layouts": (LAYOUT,), "settings": COARSE, "confirmed_by": None, **given}
    search = SearchSettings(gap=gap)
    return RowTask(scene=SCENE, ranges=Ranges.of(**spans), search=search, **values)


def draw_case(rng):
    return Case(
        density=rng.uniform(240.0, 420.0),
        friction_angle=math.radians(rng.uniform(14.0, 46.0)),
        inclination=math.radians(rng.uniform(22.0, 38.0)),
    )
