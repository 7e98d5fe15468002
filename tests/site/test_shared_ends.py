"""Rows that go on into others: two ends a row, no rings, and only into rows alike."""

import math
import random
from collections import Counter

import pytest

from netdesign.outcome import SiteDataError
from tests.each import each
from tests.make import load_tables, read_tables


def read_rows(statements, **of_row):
    """Alike rows with the neighbours that each of them names; others are free.

    What differs of a row's net is that of a net type of its own.
    """
    tables = load_tables("tiny")
    (line,), (net,) = tables["rows"], tables["net_types"]
    tables["ropes"].append({**tables["ropes"][0], "id": "G2"})
    tables["rows"] = []
    for name, into in statements.items():
        own = of_row.get(name, {})
        of_net = {key: own[key] for key in own if key in net}
        if of_net:
            tables["net_types"].append({**net, **of_net, "id": f"of {name}"})
        row = {**line, **{key: own[key] for key in own if key not in net}, "id": name}
        row["net_type"] = f"of {name}" if of_net else net["id"]
        row["gap"] = f"into {', '.join(into)}" if into else None
        tables["rows"].append(row)
    return read_tables(tables)


def draw_statements(draw):
    names = [f"R{k}" for k in range(1, draw.randint(3, 6) + 1)]
    said = {}
    for name in names:
        others = [one for one in names if one != name]
        count = draw.choice((0, 0, 2, 2, 2, 3))
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


def list_pairs(said):
    """Rows that go on into each other, whichever of the two says so."""
    return {frozenset((name, one)) for name, into in said.items() for one in into}


def is_a_row_of_rows(said):
    """No row has more than two neighbours, and no way leads back."""
    pairs = list_pairs(said)
    group = {name: {name} for name in said}
    for one, other in map(tuple, pairs):
        if group[one] is group[other]:
            return False
        group[one] |= group[other]
        for name in group[other]:
            group[name] = group[one]
    joined = Counter(one for pair in pairs for one in pair)
    return max(joined.values(), default=0) <= 2


@each("seed", range(30))
def test_a_row_has_two_ends_and_rows_close_no_ring(seed):
    draw = random.Random(seed)
    said = draw_chain(draw) if seed % 3 else draw_statements(draw)
    if is_a_row_of_rows(said):
        rows = {row.id: row for row in read_rows(said).rows}
        joined = Counter(one for pair in list_pairs(said) for one in pair)
        assert all(row.has_end == (joined[name] < 2) for name, row in rows.items())
        return
    with pytest.raises(SiteDataError) as caught:
        read_rows(said)
    found = [one for one in caught.value.findings if one.severity == "error"]
    assert {one.sheet for one in found} == {"Rows"}


STARS = [
    {"R1": ("R2", "R3", "R4"), "R2": (), "R3": (), "R4": ()},
    {"R1": ("R7", "R2"), "R2": (), "R3": ("R7", "R4"), "R4": ()}
    | {"R5": ("R7", "R6"), "R6": (), "R7": ()},
]
RING = {"R1": ("R2", "R3"), "R2": ("R1", "R3"), "R3": ("R1", "R2"), "R4": ()}


UNKNOWN = [
    {"R1": ("A99",), "R2": (), "R3": (), "R4": ()},
    {"R1": ("A99", "R2"), "R2": ("R3",), "R3": (), "R4": ()},
]


STATEMENTS = [*((one, "two ends") for one in STARS), (RING, "in a ring")]


@each("said, told", [*STATEMENTS, *((one, "A99") for one in UNKNOWN)])
def test_more_than_two_neighbours_rings_and_no_rows_are_refused(said, told):
    with pytest.raises(SiteDataError, match=told):
        read_rows(said)


NUMBERS = (
    *("slope_angle", "snow", "net_height", "post_spacing"),
    *("net_stiffness", "slack", "post_tilt"),
)
WORDS = {"ridge_rope": "G2", "uphill_guy": "G2", "guy_count": 1}


def find_ends(key, value):
    """Row between two like ones, of which one has another value: its end, and notes."""
    said = {"R1": (), "R2": ("R1", "R3"), "R3": ()}
    site = read_rows(said, R3={key: value})
    told = [one for one in map(str, site.notes) if "its own ends count" in one]
    return {row.id: row for row in site.rows}["R2"], told


@each("key", NUMBERS)
def test_a_row_goes_on_only_into_rows_alike_by_a_tenth(key):
    draw = random.Random(key)
    tables = load_tables("tiny")
    typed = {**tables["net_types"][0], **tables["rows"][0]}[key]
    for _ in range(3):
        for share, is_alike in ((draw.uniform(0, 0.09), True), (0.13, False)):
            factor = draw.choice((1.0 + share, 1.0 / (1.0 + share)))
            kept, told = find_ends(key, typed * factor)
            assert kept.has_end != is_alike
            assert (kept.gap == math.inf) != is_alike
            assert bool(told) != is_alike
            if not is_alike:
                assert "R3 is not built alike" in told[0]
                assert kept.row_end is not None


@each("key, value", WORDS.items())
def test_a_row_goes_on_only_into_a_row_of_the_same_net(key, value):
    kept, told = find_ends(key, value)
    assert kept.has_end
    assert told


def test_the_ground_and_a_neighbour_that_goes_on_count_too():
    """Of two rows that both go on, each has its own end where they are not alike."""
    said = {"R1": (), "R2": ("R1", "R3"), "R3": ("R2", "R4"), "R4": ()}
    plain = {"glide_factor": 1.5}
    changed = {one: {"glide_factor": 2.0} for one in ("R3", "R4")}
    changed |= {one: plain for one in ("R1", "R2")}
    assert [row.has_end for row in read_rows(said, **changed).rows] == [True] * 4
    alike = read_rows(said, **dict.fromkeys(said, plain))
    assert [row.has_end for row in alike.rows] == [True, False, False, True]
