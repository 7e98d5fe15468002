"""Why more than the guideline: ratios by hand, a picture whose areas are the loads."""

import random
import re
from dataclasses import replace

import pytest

from netdesign.report.drawing.chain_figure import draw_loads
from netdesign.report.drawing.plain_svg import WIDTH
from netdesign.report.sections.guideline import show_difference
from netdesign.report.words import ENGLISH, Words
from netdesign.words.catalogue import LANGUAGES
from tests.each import each
from tests.report.build_study import build_study

LABEL = re.compile(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>([^<]*)</text>')


def draw_record(seed):
    """Comparison of a row with a drawn profile of pressure."""
    rng = random.Random(seed)
    record = build_study().rows[0].guideline
    heights = sorted(rng.uniform(0.05, 2.9) for _ in range(12))
    cases = [
        replace(
            one,
            load_kN_per_m=rng.choice((None, rng.uniform(2.0, 40.0))),
            foot_anchor_kN=rng.uniform(20.0, 200.0),
        )
        for one in record.cases
    ]
    return replace(
        record,
        cases=cases,
        along_net=[(y, rng.uniform(-0.5, 12.0)) for y in heights],
        solved_load_kN_per_m=rng.uniform(3.0, 50.0),
        solved_foot_anchor_kN=rng.uniform(20.0, 400.0),
    )


@each("language", LANGUAGES)
@each("seed", range(8))
def test_the_picture_names_every_load_and_keeps_inside(seed, language):
    record, words = draw_record(seed), Words(language)
    svg = draw_loads(record, 3.0, words)
    known = [one for one in record.cases if one.load_kN_per_m is not None]
    if not known:
        assert svg == ""
        return
    labels = [text for *_, text in LABEL.findall(svg) if "kN/m" in text]
    assert len(labels) == 1 + len(known)
    assert all(text in svg.partition("aria-label=")[2] for text in labels)
    places = [float(x) for x in re.findall(r"([\d.]+),[\d.]+", svg)]
    assert max(places) <= WIDTH


def test_the_area_of_a_guideline_line_is_its_load():
    record = replace(draw_record(1), along_net=[(0.1, 1.0), (2.9, 1.0)])
    record = replace(record, cases=[replace(record.cases[0], load_kN_per_m=12.0)])
    svg = draw_loads(record, 3.0, ENGLISH)
    edges = re.findall(r'<polyline points="([^"]*)"', svg)
    solved, guideline = (
        [tuple(map(float, pair.split(","))) for pair in edge.split()]
        for edge in (edges[0], edges[2])
    )
    (left, _), (right, _), *_ = guideline  # 12 kN/m over 3 m: 4 kPa
    unit = (right - left) / 4.0
    assert solved[0][0] - left == pytest.approx(unit, abs=0.2)


def test_a_load_on_a_part_of_the_height_is_drawn_on_that_part():
    """12 kN/m on 0.77 of 3 m: 5.19 kPa, and nothing above 2.31 m."""
    record = replace(draw_record(1), along_net=[(0.1, 12.0 / 2.31), (2.9, 0.0)])
    case = replace(record.cases[0], load_kN_per_m=12.0, loaded_share=0.77)
    svg = draw_loads(replace(record, cases=[case]), 3.0, ENGLISH)
    edges = re.findall(r'<polyline points="([^"]*)"', svg)
    solved, guideline = (
        [tuple(map(float, pair.split(","))) for pair in edge.split()]
        for edge in (edges[0], edges[2])
    )
    (_, bottom), (right, _), (_, top), _ = guideline
    assert right == pytest.approx(solved[0][0], abs=0.2)
    unit = (bottom - solved[1][1]) / 2.9
    assert bottom - top == pytest.approx(0.77 * 3.0 * unit, abs=0.3)


def test_caption_says_of_which_line_the_area_is_the_load():
    """The coupled line is pressure alone: its area lies 6 to 31 % below the load."""
    for language in LANGUAGES:
        told = Words(language)("why_more.caption", row="R1")
        sentences = [one for one in told.split(". ") if one]
        assert len(sentences) == 3
    assert "guideline's line is its load downslope" in ENGLISH(
        "why_more.caption", row="R1"
    )
    assert "less the friction" in ENGLISH("why_more.caption", row="R1")


def test_ratios_are_those_of_the_forces():
    study = build_study()
    rows = [
        replace(row, guideline=draw_record(seed)) for seed, row in enumerate(study.rows)
    ]
    part = show_difference(replace(study, rows=rows), ENGLISH)
    table = next(one for one in part.blocks if hasattr(one, "columns"))
    assert len(table.rows) == len(rows)
    for cells, row in zip(table.rows, rows, strict=True):
        record = row.guideline
        forces = {one.name: one.foot_anchor_kN for one in record.cases}
        largest = max(forces[name] for name in forces if name != "same_snow")
        solved = record.solved_foot_anchor_kN
        assert cells[3].number == pytest.approx(solved / largest)
        if "same_snow" in forces:
            assert cells[5].number == pytest.approx(solved / forces["same_snow"])


def test_without_a_comparison_there_is_no_section():
    study = build_study()
    rows = [replace(row, guideline=None) for row in study.rows]
    assert show_difference(replace(study, rows=rows), ENGLISH) is None
