"""Rows that go on into others: two ends a row, no rings, and only into rows alike."""

import math
import random

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.each import each
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines


def write_rows(path, statements, **of_row):
    """Alike rows with the neighbours that each of them names; others are free."""
    lines = draw_lines(12)
    net = {k: v for k, v in lines["Nets"][0].items() if k not in ("gap", "row_end")}
    net.pop("neighbour", None)
    net |= {"snow_layers": "uniform", "slack": 0.05, "post_tilt": 15.0}
    net["panel_system"] = "rectangular"
    net.pop("post_base_distance", None)
    lines["Snow"], lines["Ends"] = [], []
    lines["Nets"] = [
        net
        | {"id": name}
        | ({"row_end": "continuous", "neighbour": ", ".join(into)} if into else {})
        | of_row.get(name, {})
        for name, into in statements.items()
    ]
    write_lines(path, lines)
    return path


def draw_statements(draw):
    names = [f"R{k}" for k in range(1, draw.randint(3, 6) + 1)]
    said = {}
    for name in names:
        others = [one for one in names if one != name]
        count = draw.choice((0, 0, 1, 2, 2, 2, 3))
        said[name] = draw.sample(others, min(count, len(others)))
    return said


def draw_chain(draw):
    """Rows beside each other, the inner ones of which may say that they go on."""
    names = [f"R{k}" for k in range(1, draw.randint(3, 6) + 1)]
    draw.shuffle(names)
    said = dict.fromkeys(names, ())
    for before, name, after in zip(names, names[1:], names[2:], strict=False):
        said[name] = draw.sample([before, after], 2) if draw.random() < 0.7 else ()
    return said


def is_a_row_of_rows(said):
    """A row that goes on has two neighbours, none has more, no way leads back."""
    edges = {frozenset((name, one)) for name, into in said.items() for one in into}
    degree = {name: sum(name in edge for edge in edges) for name in said}
    if any(degree[name] != 2 for name, into in said.items() if into):
        return False
    group = {name: {name} for name in said}
    for one, other in map(tuple, edges):
        if group[one] is group[other]:
            return False
        group[one] |= group[other]
        for name in group[other]:
            group[name] = group[one]
    return max(degree.values()) <= 2


@each("seed", range(60))
def test_a_row_has_two_ends_and_rows_close_no_ring(tmp_path, seed):
    draw = random.Random(seed)
    said = draw_chain(draw) if seed % 3 else draw_statements(draw)
    path = write_rows(tmp_path / "site.xlsx", said)
    if is_a_row_of_rows(said):
        rows = {row.id: row for row in read_site(path).rows}
        assert all(rows[name].has_end != bool(into) for name, into in said.items())
        return
    with pytest.raises(SiteDataError) as caught:
        read_site(path)
    found = [one for one in caught.value.findings if one.severity == "error"]
    assert {one.sheet for one in found} == {"Nets"}


STARS = [
    {"R1": ("R2", "R3", "R4"), "R2": (), "R3": (), "R4": ()},
    {"R1": ("R7", "R2"), "R2": (), "R3": ("R7", "R4"), "R4": ()}
    | {"R5": ("R7", "R6"), "R6": (), "R7": ()},
]
RING = {"R1": ("R2", "R3"), "R2": ("R1", "R3"), "R3": ("R1", "R2"), "R4": ()}


@each("said, told", [*((one, "two ends") for one in STARS), (RING, "in a ring")])
def test_any_number_of_rows_into_one_end_and_rings_are_refused(tmp_path, said, told):
    with pytest.raises(SiteDataError, match=told):
        read_site(write_rows(tmp_path / "site.xlsx", said))


NUMBERS = (
    *("slope_angle", "snow_thickness", "net_height", "post_spacing"),
    *("net_stiffness", "slack", "post_tilt"),
)
WORDS = {"post": "plain", "uphill_guy": "stiff", "guy_count": 1}


def find_ends(tmp_path, key, value):
    """Row between two like ones, of which one has another value: its end, and notes."""
    said = {"R1": (), "R2": ("R1", "R3"), "R3": ()}
    path = write_rows(tmp_path / "site.xlsx", said, R3={key: value})
    site = read_site(path)
    told = [one for one in map(str, site.notes) if "its own ends count" in one]
    return {row.id: row for row in site.rows}["R2"], told


@each("key", NUMBERS)
def test_a_row_goes_on_only_into_rows_alike_by_a_tenth(tmp_path, key):
    draw = random.Random(key)
    write_rows(tmp_path / "plain.xlsx", {"R1": ()})
    row = read_site(tmp_path / "plain.xlsx").rows[0]
    typed = next(one.value for one in row.inputs if one.label.key.endswith(key))
    for _ in range(3):
        for share, is_alike in ((draw.uniform(0, 0.09), True), (0.13, False)):
            factor = draw.choice((1.0 + share, 1.0 / (1.0 + share)))
            kept, told = find_ends(tmp_path, key, typed * factor)
            assert kept.has_end != is_alike
            assert (kept.gap == math.inf) != is_alike
            assert bool(told) != is_alike
            if not is_alike:
                assert "R3 is not built alike" in told[0]
                assert kept.row_end is not None


@each("key, value", WORDS.items())
def test_a_row_goes_on_only_into_a_row_of_the_same_net(tmp_path, key, value):
    write_rows(tmp_path / "plain.xlsx", {"R1": ()})
    kept, told = find_ends(tmp_path, key, value)
    row = read_site(tmp_path / "plain.xlsx").rows[0]
    same = next(one.value for one in row.inputs if one.label.key.endswith(f".{key}"))
    assert kept.has_end == (same != value)
    assert bool(told) == (same != value)


def test_the_ground_and_a_neighbour_that_goes_on_count_too(tmp_path):
    """Of two rows that both go on, each has its own end where they are not alike."""
    said = {"R1": (), "R2": ("R1", "R3"), "R3": ("R2", "R4"), "R4": ()}
    other = {"ground_law": "sliding", "glide_factor": 2.0, "slip_length": None}
    changed = dict.fromkeys(("R3", "R4"), other)
    plain = {"ground_law": "sliding", "glide_factor": 1.5, "slip_length": None}
    changed |= dict.fromkeys(("R1", "R2"), plain)
    path = write_rows(tmp_path / "site.xlsx", said, **changed)
    assert [row.has_end for row in read_site(path).rows] == [True] * 4
    path = write_rows(tmp_path / "site.xlsx", said, **dict.fromkeys(said, plain))
    assert [row.has_end for row in read_site(path).rows] == [True, False, False, True]
