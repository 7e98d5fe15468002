"""The map of net rows: the same wherever it lies, legible without colour."""

import math
import random
import re
from xml.etree import ElementTree

import pytest

from netdesign.files.rows_map import MeasuredPlace, RowsMap
from netdesign.outcome import Verdict
from netdesign.report.drawing.rows_map import MappedRow, draw_rows_map
from netdesign.report.words import Words

SVG = "{http://www.w3.org/2000/svg}"
KINDS = (*Verdict, None)


def draw_places(rng, names, east=0.0, north=0.0, height=0.0):
    """Rows one above the other, with a zone around them."""
    rows = {}
    for level, name in enumerate(names):
        y, start, count = 17.0 * level, rng.uniform(-9.0, 9.0), rng.randint(4, 15)
        posts = [
            (east + start + 3.5 * k, north + y + rng.uniform(-0.3, 0.3), height + y)
            for k in range(count)
        ]
        aspect = math.radians(rng.uniform(165.0, 195.0))
        rows[name] = MeasuredPlace(feature={}, aspect=aspect, slope=0.7, posts=posts)
    top = 17.0 * len(names)
    zone = [(-14.0, -5.0), (66.0, -5.0), (66.0, top), (-14.0, top), (-14.0, -5.0)]
    return RowsMap(
        file="rows.geojson",
        grid="slope.asc",
        sha256="ab" * 32,
        rows=rows,
        zones=(tuple((east + x, north + y) for x, y in zone),),
    )


def draw(seed, east=0.0, north=0.0, height=0.0, link="row-1"):
    rng = random.Random(seed)
    names = [f"L{number}" for number in range(1, len(KINDS) + 1)]
    places = draw_places(rng, names, east, north, height)
    rows = {
        name: MappedRow(verdict=kind, used="0.871" if kind else "", anchor=link)
        for name, kind in zip(names, KINDS, strict=True)
    }
    return draw_rows_map(places, rows, "title", Words("fr"))


@pytest.mark.parametrize("seed", range(5))
def test_a_map_says_nothing_of_where_it_lies(seed):
    """Moved by whole metres it is the same, byte by byte."""
    shift = random.Random(100 + seed)
    east, north, height = (float(shift.randrange(1000, 4_000_000)) for _ in range(3))
    moved = draw(seed, east, north, height)
    assert moved == draw(seed)
    numbers = re.findall(r"-?\d+(?:\.\d+)?", moved)
    # neither a coordinate nor a height; 2000 is in the name of SVG
    assert max(abs(float(one)) for one in numbers) <= 2000.0


def test_each_verdict_has_a_line_of_its_own_without_colour():
    root = ElementTree.fromstring(draw(3))
    lines = [
        (one.get("stroke-width"), one.get("stroke-dasharray", ""))
        for one in root.iter(f"{SVG}polyline")
        if float(one.get("stroke-width")) > 2.0
    ]
    # on the map, and in the legend
    assert sorted(lines) == sorted(2 * list(dict.fromkeys(lines)))
    assert len(set(lines)) == len(KINDS)


def test_names_stand_apart_and_inside():
    root = ElementTree.fromstring(draw(4))
    wide, tall = (float(one) for one in root.get("viewBox").split()[2:])
    names = [one for one in root.iter(f"{SVG}text") if (one.text or "").startswith("L")]
    places = [(float(one.get("x")), float(one.get("y"))) for one in names]
    assert len(places) == len(KINDS)
    for number, (x, y) in enumerate(places):
        assert 0.0 < x < wide
        assert 0.0 < y < tall
        assert all(math.dist((x, y), one) > 8.0 for one in places[:number])
