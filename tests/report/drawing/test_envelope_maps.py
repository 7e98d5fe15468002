"""Drawings and tables of a made-up envelope record."""

import xml.etree.ElementTree as ET

import pytest

from netdesign.checks.check import CasePoint
from netdesign.report.drawing.envelope_maps import (
    EnvelopeView,
    draw_lines,
    draw_maps,
)
from netdesign.report.drawing.plain_svg import Frame
from netdesign.study.case_records import (
    DrawnForce,
    LargestForce,
    LineRecord,
    MapRecord,
)

NS = "{http://www.w3.org/2000/svg}"


def build_bound(quantity, *, size=100.0):
    densities, frictions = [250.0, 350.0, 450.0], [15.0, 30.0, 45.0]
    force = LargestForce(
        quantity=quantity,
        low_kN=size,
        value_kN=size,
        high_kN=1.01 * size,
        bound_kN=1.01 * size,
        case=CasePoint(
            **{"density_kg_m3": 450.0, "friction_deg": 15.0, "inclination_deg": 35.0}
        ),
        beside_kN={},
    )
    drawn = DrawnForce(
        quantity=force.quantity,
        lines=[
            LineRecord(
                key="density_kg_m3", values=densities,
                force_kN=[0.5 * size, 0.7 * size, size],
                bound_kN=[0.52 * size, 0.72 * size, 1.01 * size],
            )
        ],
        maps=[
            MapRecord(
                inclination_deg=inclination, density_kg_m3=densities,
                friction_deg=frictions,
                force_kN=[[0.5 * size, 0.7 * size, size]] * 3,
            )
            for inclination in (25.0, 35.0)
        ],
    )  # fmt: skip
    return EnvelopeView(force=force, drawn=drawn)


BOUND = build_bound("foot_anchor")


def shapes(svg, tag):
    return list(ET.fromstring(svg).iter(f"{NS}{tag}"))


def test_the_ring_stands_at_the_governing_case_in_the_map_of_its_inclination():
    """Governing: the densest snow, least friction, at 35 degrees: the right map."""
    (ring,) = shapes(draw_maps(BOUND), "circle")
    labels = {one.text: one for one in shapes(draw_maps(BOUND), "text")}
    right_end = float(labels["θ = 35°"].attrib["x"])  # set to the panel's right end
    assert float(ring.attrib["cx"]) == pytest.approx(right_end, abs=0.02)
    assert float(ring.attrib["cx"]) > float(labels["θ = 25°"].attrib["x"])


def test_the_bound_is_drawn_above_the_force():
    between = shapes(draw_lines(BOUND), "polygon")[0].attrib["points"].split()
    heights = [float(pair.split(",")[1]) for pair in between]
    half = len(heights) // 2
    force, bound = heights[:half], heights[: -half - 1 : -1]
    assert all(above < below for above, below in zip(bound, force, strict=True))


def test_values_find_their_place_on_the_page():
    frame = Frame(left=10, top=20, width=100, height=50,
                  x_low=0.0, x_high=2.0, y_low=-1.0, y_high=1.0)  # fmt: skip
    assert (frame.x(0.5), frame.y(-1.0), frame.y(1.0)) == (35.0, 70.0, 20.0)
