"""Drawings of untidy rows: long distances, tiny angles, large forces, many axes."""

import math
import random
from dataclasses import replace
from datetime import date, timedelta

from netdesign.addons.winter.figure import draw_winter
from netdesign.report.drawing.pressure_figure import draw_pressure
from netdesign.report.drawing.section_figure import draw_section
from netdesign.study.case_records import GuidelineRecord, PullRecord
from tests.report.build_study import build_section, build_study


def draw_all(rng: random.Random, words) -> list[str]:
    """Every kind of drawing once, of values drawn with ``rng``."""
    section = build_section(rng)
    return [
        draw_section(section, build_pulls(rng), build_forces(rng), words),
        draw_pressure(build_guideline(rng), section.head_m[1], words),
        draw_winter(build_winter(rng), {"2023-01-05": -12.5, "2023-02-05": 3.1}, words),
    ]


def build_pulls(rng: random.Random) -> list[PullRecord]:
    """Pulls and bores of the anchors of a section."""
    found = []
    for anchor in ("foot_anchor", "uphill_anchor", "downhill_anchor"):
        least = rng.uniform(-5.0, 60.0)
        found.append(
            PullRecord(
                anchor=anchor,
                position="intermediate",
                kind="bar",
                least_deg=least,
                largest_deg=least + rng.uniform(0.0, 25.0),
                axis_deg=rng.uniform(10.0, 95.0),
                is_axis_given=False,
                angle_deg=12.0,
                dip_deg=20.0,
            )
        )
    return found


def build_forces(rng: random.Random) -> dict[str, tuple[float, str]]:
    """Design forces of any size; a slack anchor has none."""
    members = ("foot_anchor", "uphill_anchor", "downhill_anchor", "post_base")
    sizes = {one: rng.choice([0.0, 10 ** rng.uniform(-0.5, 3.2)]) for one in members}
    return {one: (size, f"{size:.3g} kN · 0.73") for one, size in sizes.items()}


def build_guideline(rng: random.Random) -> GuidelineRecord:
    """Pressures over a height, beside those of the guideline."""
    record = next(x.guideline for x in build_study().rows if x.guideline)
    high, most = rng.uniform(0.8, 5.9), 10 ** rng.uniform(-0.3, 1.9)
    along = [(high * k / 9, rng.uniform(-0.1, 1.0) * most) for k in range(10)]
    cases = [
        replace(
            record.cases[0],
            name=name,
            load_kN_per_m=rng.uniform(0.2, 1.4) * most * high,
            loaded_share=rng.uniform(0.6, 1.0),
        )
        for name in ("load_case_1", "load_case_2")
    ]
    load = 0.6 * most * high
    return replace(record, along_net=along, cases=cases, solved_load_kN_per_m=load)


def build_winter(rng: random.Random) -> dict:
    """Some weeks to more than a year of snow, its marks anywhere."""
    first, count = date(2022, 10, 3), rng.choice([21, 160, 400])
    days = [first + timedelta(days=k) for k in range(0, count, 7)]
    size = 10 ** rng.uniform(0.0, 2.5)
    curve = [
        {
            "date": f"{day}",
            "thickness_m": 0.3 + 2.0 * math.sin(k / len(days) * math.pi),
            "density_kg_m3": 300.0,
            "layers": [],
            "foot_kN_per_m": size * (1 + k % 5),
            "head_kN_per_m": size * (1 + k % 4),
            "members_kN": {
                "foot_anchor": size * (5 + k), "uphill_guy": size, "post": size * 4
            },
        }
        for k, day in enumerate(days)
    ]  # fmt: skip
    return {
        "name": "2022/23",
        "curve": curve,
        "height_max_date": f"{rng.choice(days)}",
        "governing_date": f"{rng.choice(days)}",
    }
