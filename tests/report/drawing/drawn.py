"""Drawings of untidy rows: long distances, tiny angles, large forces, many axes."""

import math
import random
from dataclasses import replace
from datetime import date, timedelta

import numpy as np

from netdesign.addons.winter.figure import draw_winter
from netdesign.checks.check import CasePoint
from netdesign.outcome import Verdict
from netdesign.report.drawing.chain_figure import draw_chains
from netdesign.report.drawing.charts import draw_monitoring
from netdesign.report.drawing.panel_figure import draw_panel
from netdesign.report.drawing.section_figure import draw_section
from netdesign.study.records import MonitoringRecord, RowStudy
from netdesign.study.support_records import (
    Arrow,
    Drawing,
    PanelDrawing,
    PanelRecord,
    RopeRecord,
)
from netdesign.words.message import say
from tests.report.build_study import build_row
from tests.turn import turn

AXES = {
    "density_kg_m3": (203.7, 487.3),
    "friction_deg": (11.9, 44.7),
    "inclination_deg": (17.3, 37.9),
    "thickness_m": (1.27, 4.83),
    "upslope_length_m": (8.3, 27.1),
    "slack": (0.0103, 0.1297),
    "stiffness_kN_per_m": (2130.0, 24700.0),
    "slip_length_m": (0.013, 13.7),
}


def draw_all(rng: random.Random, words) -> list[str]:
    """Every kind of drawing once, of values drawn with ``rng``."""
    return [
        draw_section(build_section(rng), "s", words),
        draw_panel(build_panel(rng), words),
        draw_chains(build_chains(rng), words),
        draw_winter(build_winter(rng), {"2023-01-05": -12.5, "2023-02-05": 3.1}, words),
        draw_monitoring([build_monitoring(rng)], words),
    ]


MODES = {
    "foot_anchor": ("tendon", "pull_out", "bent"),
    "uphill_guy": ("rope",),
    "uphill_anchor": ("tendon", "pull_out"),
    "post": ("compression", "compression_bending"),
    "post_base": ("bearing", "sliding"),
    "end_guy": ("rope",),
    "lateral_anchor": ("tendon",),
}


def build_chains(rng: random.Random) -> RowStudy:
    """Row with checks of many members, some without a resistance."""
    row = build_row("A", 3, scale=1.0)
    of_force = next(one for one in row.checks if one.is_of_force)
    used = [
        rng.choice([None, 10 ** rng.uniform(-3.0, 1.2)])
        for modes in MODES.values()
        for _ in modes
    ]
    places = [(member, mode) for member, modes in MODES.items() for mode in modes]
    checks = [
        replace(
            turn(of_force, judge_used(one), utilisation=one), member=member, mode=mode
        )
        for (member, mode), one in zip(places, used, strict=True)
    ]
    return replace(row, checks=checks)


def judge_used(used: float | None) -> Verdict:
    if used is None:
        return Verdict.NOT_PROVEN
    return Verdict.PASS if used <= 1.0 else Verdict.FAIL


def build_section(rng: random.Random) -> Drawing:
    """Section of any proportions that a layout allows."""
    height = rng.uniform(0.9, 6.2)
    lean = math.radians(rng.uniform(0.0, 40.0))
    head = (height * math.tan(lean), height)
    base = head[0] - height * math.tan(math.radians(rng.uniform(-30.0, 45.0)))
    uphill = rng.choice([0.0, rng.uniform(0.2, 3.0) * height])
    downhill = base + rng.choice([0.0, rng.uniform(0.2, 3.0) * height])
    shares = np.linspace(0.0, 1.0, 25)
    sag = rng.uniform(0.0, 0.15) * height * 4 * shares * (1 - shares)
    thickness = height * rng.uniform(0.5, 1.0)
    net = [(head[0] * s + f, head[1] * s) for s, f in zip(shares, sag, strict=True)]
    points = {
        "foot_anchor": (0.0, 0.0),
        "uphill_anchor": (-uphill, 0.0),
        "downhill_anchor": (downhill, 0.0),
        "post": (base, 0.0),
    }
    return Drawing(
        case=CasePoint(
            density_kg_m3=412.0, friction_deg=17.3, inclination_deg=math.degrees(lean)
        ),
        slope_deg=rng.uniform(22.0, 62.0),
        snow_thickness_m=thickness,
        net_m=[(float(x), float(y)) for x, y in net],
        sticks=[rng.random() < 0.7 for _ in net],
        mesh_edges_m=[],
        head_m=head,
        post_base_m=points["post"],
        uphill_anchor_m=points["uphill_anchor"],
        downhill_anchor_m=points["downhill_anchor"],
        arrows=[_pull(rng, name, at, head) for name, at in points.items()],
        pressure_kPa=[
            None, None, *(rng.uniform(-2.0, 80.0) for _ in net[4:]), None, None,
        ],
    )  # fmt: skip


def _pull(rng, name, at, head):
    size = rng.choice([0.0, 10 ** rng.uniform(-0.5, 3.2)])
    across, up = head[0] - at[0], head[1] - at[1]
    length = math.hypot(across, up)
    sign = -1.0 if name == "post" else 1.0
    return Arrow(
        member=name,
        x_m=at[0],
        y_m=at[1],
        force_x_kN=sign * size * across / length,
        force_y_kN=sign * size * up / length,
    )


def build_panel(rng: random.Random) -> PanelRecord:
    """Panel from flat to tall."""
    half, height = rng.uniform(1.0, 3.5), rng.uniform(1.5, 5.5)
    head = (height * math.tan(math.radians(rng.uniform(0.0, 38.0))), height)
    places = np.linspace(0.05, half, 9).tolist()
    size = 10 ** rng.uniform(0.5, 3.0)
    tensions = [size * (1.0 + 0.01 * k) for k in range(9)]
    ropes = [
        RopeRecord(**_fill_rope(name, f"2 x {rng.choice(['B22', 'GALFAN 26'])}"))
        for name in ("lower", "upper")
    ]
    pull = (rng.uniform(0, size), rng.uniform(0, size))
    drawing = PanelDrawing(
        case=CasePoint(density_kg_m3=400.0, friction_deg=15.0, inclination_deg=25.0),
        places_m=places,
        post_head_m=head,
        lower_m=[(0.2 * z, 0.05 * z) for z in places],
        upper_m=[(head[0] + 0.2 * z, head[1] - 0.2 * z) for z in places],
        mid_net_m=[(0.0, 0.0), head],
        rope_places_m=places,
        lower_tensions_kN=tensions,
        upper_tensions_kN=[0.9 * one for one in tensions],
        foot_kN=pull,
        mid_foot_kN=pull,
        head_kN=(pull[0], -pull[1]),
        lower_along_kN=rng.uniform(0.5, 1.5) * size,
        upper_along_kN=rng.uniform(0.5, 1.5) * size,
    )
    return PanelRecord(cut="upper", has_mid_anchors=False, ropes=ropes, drawing=drawing)


def _fill_rope(name, kind):
    return {
        "rope": name, "type": kind, "stiffness_kN": 1e4, "sag": 0.06,
        "along_kN": 90.0, "tension_kN": 100.0, "breaking_kN": 300.0, "cell": "Ends!B2",
    }  # fmt: skip


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


def build_monitoring(rng: random.Random) -> MonitoringRecord:
    """Measured series of days or of months."""
    last = rng.uniform(3.0, 200.0)
    times = [last * k / 9 for k in range(10)]
    return MonitoringRecord(
        member="uphill_guy",
        source="Monitoring!A2",
        times_d=times,
        tensions_kN=[10.0 + k for k in range(10)],
        air_temperatures_C=[-5.0 - k for k in range(10)],
        model=say("monitoring.needs_winter"),
    )


def without_pressure(drawing: Drawing) -> Drawing:
    """The same section as an earlier version kept it."""
    return replace(drawing, pressure_kPa=[])
