"""Numbers and lengths of a row's anchors, counted by hand."""

import pytest

from netdesign.study.anchor_pulls import list_parts
from tests.make import read_tables

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


def read_row(posts=None, **net):
    count = {} if posts is None else {"post_count": posts}
    tables = {"rows": [ROW | count], "net_types": [BARE | net], **TYPES}
    (row,) = read_tables(tables).rows
    return row


def count_parts(row):
    found = {}
    for one in list_parts(row):
        found[one.part, one.type_id] = (one.count, one.size)
    return found


@pytest.mark.parametrize("posts", [2, 5, 8])
def test_anchors_at_each_post(posts):
    found = count_parts(read_row(posts))
    assert found["foot_anchor", "A"] == (posts, pytest.approx(4.2))
    for member in ("uphill_anchor", "downhill_anchor"):
        assert found[member, "A"] == (2 * posts, pytest.approx(4.2))


@pytest.mark.parametrize("posts", [2, 3, 7])
def test_an_anchor_of_two_guys_stands_once_between_two_posts(posts):
    found = count_parts(read_row(posts, guy_anchors="shared"))
    assert found["uphill_anchor", "A"][0] == posts + 1
    unsaid = count_parts(read_row(posts, guy_anchors=None))
    assert unsaid["uphill_anchor", "A"][0] is None


def test_anchors_between_the_posts_count_with_the_foot_anchors():
    ropes = {"ridge_rope": "G", "lower_rope": "G", "mid_anchors": "yes"}
    found = count_parts(read_row(6, **ropes))
    assert found["foot_anchor", "A"] == (6 + 5, pytest.approx(4.2))


def test_without_a_number_nothing_is_counted():
    found = count_parts(read_row())
    assert {count for count, _ in found.values()} == {None}
