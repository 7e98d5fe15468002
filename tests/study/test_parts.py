"""Numbers and lengths of what a row is built of, counted by hand."""

import math

import pytest

from netdesign.envelope.ranges import Interval
from netdesign.site.reader import read_site
from netdesign.study.parts import list_parts
from tests.make import write_site

INCLINATION = Interval(low=math.radians(25.0), high=math.radians(35.0))
BARE = {
    **{"id": "N1", "net_height": 2.5, "net_stiffness": 9000.0, "post_tilt": 0.0},
    **{"guy_count": 2, "guy_splay": 20.0, "guy_anchors": "own"},
    **{"uphill_anchor_distance": 3.0, "downhill_anchor_distance": 2.0},
    **{"uphill_guy": "G", "downhill_guy": "G", "post": "P"},
}
ROW = {
    **{"id": "R1", "slope_angle": 38.0, "snow": 2.4, "upslope_length": 18.0},
    **{"glide_factor": 1.0, "net_type": "N1", "post_spacing": 3.5},
    **{"foot_anchor": "A", "uphill_anchor": "A", "downhill_anchor": "A"},
}
TYPES = {
    "anchor_types": [{"id": "A", "tendon": 200.0, "drilled_length": 4.2}],
    "ropes": [{"id": "G", "rope": 150.0}],
    "posts": [{"id": "P", "bearing": 300.0}],
}


def read_row(tmp_path, posts=None, **net):
    count = {} if posts is None else {"post_count": posts}
    tables = {"rows": [ROW | count], "net_types": [BARE | net], **TYPES}
    (row,) = read_site(write_site(tmp_path / "site.xlsx", tables)).rows
    return row


def count_parts(row):
    found = {}
    for one in list_parts(row, INCLINATION):
        found[one.part, one.type_id] = (one.count, one.size)
    return found


@pytest.mark.parametrize("posts", [2, 5, 8])
def test_posts_and_what_stands_at_each(tmp_path, posts):
    found = count_parts(read_row(tmp_path, posts))
    assert found["foot_anchor", "A"] == (posts, pytest.approx(4.2))
    assert found["post", "P"][0] == posts
    for member in ("uphill_anchor", "downhill_anchor"):
        assert found[member, "A"] == (2 * posts, pytest.approx(4.2))
    for member in ("uphill_guy", "downhill_guy"):
        assert found[member, "G"][0] == 2 * posts


@pytest.mark.parametrize("posts", [2, 3, 7])
def test_an_anchor_of_two_guys_stands_once_between_two_posts(tmp_path, posts):
    found = count_parts(read_row(tmp_path, posts, guy_anchors="shared"))
    assert found["uphill_anchor", "A"][0] == posts + 1
    assert found["uphill_guy", "G"][0] == 2 * posts
    unsaid = count_parts(read_row(tmp_path, posts, guy_anchors=None))
    assert unsaid["uphill_anchor", "A"][0] is None


def test_lengths_are_the_longest_over_the_inclinations(tmp_path):
    found = count_parts(read_row(tmp_path, 7))
    far, near = 2.5 * math.tan(INCLINATION.high), 2.5 * math.tan(INCLINATION.low)
    beside = math.cos(math.radians(20.0))
    assert found["post", "P"][1] == pytest.approx(2.5)
    assert found["uphill_guy", "G"][1] == pytest.approx(
        math.hypot(3.0 + far, 2.5) / beside
    )
    assert found["downhill_guy", "G"][1] == pytest.approx(
        math.hypot(2.0, 2.5) / beside  # below the head, however the net leans
    )
    assert near < far
    area = 21.0 * 2.5 / math.cos(INCLINATION.high)
    assert found["net", ""] == (1, pytest.approx(area))


def test_ropes_and_anchors_between_the_posts(tmp_path):
    ropes = {"ridge_rope": "G", "lower_rope": "G", "mid_anchors": "yes"}
    found = count_parts(read_row(tmp_path, 6, **ropes))
    assert found["ridge_rope", "G"] == found["lower_rope", "G"] == (1, 17.5)
    assert found["mid_anchor", "A"] == (5, pytest.approx(4.2))


def test_without_a_number_nothing_is_counted(tmp_path):
    found = count_parts(read_row(tmp_path))
    assert {count for count, _ in found.values()} == {None}
    assert found["net", ""] == (None, None)
