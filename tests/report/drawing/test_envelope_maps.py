"""Drawings and tables of a made-up envelope record."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from netdesign.report.drawing.envelope_maps import (
    bound_grid,
    draw_envelope,
    draw_lines,
    draw_maps,
)
from netdesign.report.drawing.plain_svg import Chart, Frame, list_ticks, shade
from netdesign.report.words import ENGLISH
from netdesign.study.case_records import (
    BoundRecord,
    DriverRecord,
    EnvelopeRecord,
    LineRecord,
    MapRecord,
)
from tests.digits import write_force
from tests.report.build_study import build_row

NS = "{http://www.w3.org/2000/svg}"


def build_bound(quantity, *, size=100.0):
    densities, frictions = [250.0, 350.0, 450.0], [15.0, 30.0, 45.0]
    return BoundRecord(
        quantity=quantity,
        max_kN=size,
        upper_bound_kN=1.01 * size,
        case={"density_kg_m3": 450.0, "friction_deg": 15.0, "inclination_deg": 35.0},
        coincident_kN={},
        unexplained=0.001,
        drivers=[
            DriverRecord(
                key="density_kg_m3", at_low_kN=0.5 * size, at_high_kN=size,
                least_kN=0.5 * size, most_kN=size, first_order=0.9, total=0.95,
            )
        ],
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
        confirmation=None,
    )  # fmt: skip


def build_envelope(bounds):
    return EnvelopeRecord(
        axes=[], is_per_metre=False, is_closed=True, gap_asked_percent=1.0,
        certainty=3.0, resolved_share=0.6, cases=50, skipped=0, skips_tested=0,
        failed=0, bounds=bounds,
    )  # fmt: skip


BOUND = build_bound("foot_anchor")
DRAWINGS = [draw_maps, draw_lines]


def shapes(svg, tag):
    return list(ET.fromstring(svg).iter(f"{NS}{tag}"))


@pytest.mark.parametrize("draw", DRAWINGS)
def test_drawings_are_sound_xml_with_the_same_bytes_each_time(draw):
    svg = draw(BOUND)
    assert ET.fromstring(svg).tag == f"{NS}svg"
    assert draw(BOUND) == svg
    assert "Foot anchor [kN]" in svg


@pytest.mark.parametrize("draw", DRAWINGS)
def test_nothing_to_draw_gives_nothing(draw):
    assert draw(replace(BOUND, maps=[], lines=[])) == ""


def test_the_ring_stands_at_the_governing_case_in_the_map_of_its_inclination():
    """Governing: the densest snow, least friction, at 35 degrees: the right map."""
    (ring,) = shapes(draw_maps(BOUND), "circle")
    labels = {one.text: one for one in shapes(draw_maps(BOUND), "text")}
    right_end = float(labels["θ = 35°"].attrib["x"])  # set to the panel's right end
    assert float(ring.attrib["cx"]) == pytest.approx(right_end, abs=0.02)
    assert float(ring.attrib["cx"]) > float(labels["θ = 25°"].attrib["x"])


def test_darker_is_larger():
    assert shade(0.0, 0.0, 1.0) > shade(0.5, 0.0, 1.0) > shade(1.0, 0.0, 1.0)
    assert shade(2.0, 0.0, 1.0) == shade(1.0, 0.0, 1.0)
    assert shade(5.0, 5.0, 5.0) == shade(0.0, 0.0, 1.0)


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


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (15.0, 45.0, [20.0, 30.0, 40.0]),
        (25.0, 35.0, [25.0, 27.5, 30.0, 32.5, 35.0]),
        (0.0, 0.1, [0.0, 0.025, 0.05, 0.075, 0.1]),
    ],
)
def test_ticks_are_round_and_inside(low, high, expected):
    assert list_ticks(low, high) == expected


def test_words_on_a_chart_are_escaped():
    chart = Chart()
    chart.text(0.0, 0.0, "<script>")
    assert "&lt;script&gt;" in chart.write(10.0, 'a "title"')
    assert "<script>" not in chart.write(10.0, "<script>")


@pytest.mark.parametrize("samples", [2, 3])
def test_a_grid_has_the_same_maps_with_a_cross_where_a_case_has_no_result(samples):
    row = build_row("A", samples, scale=0.72, failed_case=True)
    for bound, extreme in zip(bound_grid(row), row.extremes, strict=True):
        svg = draw_maps(bound)
        shown = [one.text for one in shapes(svg, "text")]
        assert write_force(extreme.max_kN) in svg
        assert len(shapes(svg, "circle")) == 1
        assert f"θ = {extreme.case.inclination_deg:.0f}°" in shown
        assert {"×", "× no result"} <= set(shown)


def test_a_grid_shows_the_force_of_each_of_its_cases():
    row = build_row("A", 3, scale=0.72)
    for bound in bound_grid(row):
        forces = {
            force for one in bound.maps for line in one.force_kN for force in line
        }
        assert forces == {getattr(one, f"{bound.quantity}_kN") for one in row.cases}
        assert max(forces) == bound.max_kN


def test_a_grid_of_one_density_is_one_column():
    row = build_row("A", 3, scale=0.72)
    densest = row.extremes[0].case.density_kg_m3
    cases = [one for one in row.cases if one.case.density_kg_m3 == densest]
    (one, *_) = bound_grid(replace(row, cases=cases))
    assert [map_.density_kg_m3 for map_ in one.maps] == [[densest]] * 3
    svg = draw_maps(one)
    assert "nan" not in svg
    assert f"{densest:g}" in [one.text for one in shapes(svg, "text")]


def test_a_fine_grid_shows_three_inclinations_with_the_governing_one():
    row = build_row("A", 7, scale=0.72, failed_case=True)
    for bound in bound_grid(row):
        angles = [one.inclination_deg for one in bound.maps]
        assert len(angles) <= 3
        assert bound.case["inclination_deg"] in angles


def test_a_member_without_a_force_is_not_drawn():
    row = build_row("A", 3, scale=0.72, failed_case=True)
    bounds = [build_bound("downhill_guy", size=0.0), BOUND]
    svg = draw_envelope(replace(row, envelope=build_envelope(bounds)), ENGLISH)
    assert "Foot anchor [kN]" in svg
    failed = next(case for case in row.cases if case.foot_anchor_kN is None)
    row = replace(row, cases=[failed], extremes=[], envelope=None)
    assert draw_envelope(row, ENGLISH) == ""
