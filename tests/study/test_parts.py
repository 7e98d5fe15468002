"""Numbers and lengths of what a row is built of, counted by hand."""

import math

import pytest

from netdesign.envelope.ranges import Interval
from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from netdesign.study.parts import list_parts
from tests.site_lines import write_lines
from tests.study.knowing_less.drawn_site import draw_lines

INCLINATION = Interval(low=math.radians(25.0), high=math.radians(35.0))
BARE = {
    **{"id": "R1", "slope_angle": 38.0, "snow_thickness": 2.4, "upslope_length": 18.0},
    **{"ground_law": "no-slip", "net_height": 2.5, "net_stiffness": 9000.0},
    **{"post_spacing": 3.5, "post_tilt": 0.0, "guy_count": 2, "guy_splay": 20.0},
    **{"guy_anchors": "own"},
    **{"uphill_anchor_distance": 3.0, "downhill_anchor_distance": 2.0},
    **{"foot_anchor": "A", "uphill_anchor": "A", "downhill_anchor": "A"},
    **{"uphill_guy": "G", "downhill_guy": "G", "post": "P"},
}
TYPES = {
    "Anchors": [{"id": "A", "tendon": 200.0, "drilled_length": 4.2}],
    "Ropes": [{"id": "G", "rope": 150.0}],
    "Posts": [{"id": "P", "compression": 300.0}],
}


END = {"row": "R1", "support_types": "as inside"}


def read_row(tmp_path, ends=(END,), **net):
    lines = draw_lines(3)
    lines = {
        **lines,
        "Nets": [{**BARE, **net}],
        **TYPES,
        **{"Ends": list(ends), "Snow": [], "Declared": [], "Links": []},
    }
    write_lines(tmp_path / "site.xlsx", lines)
    (row,) = read_site(tmp_path / "site.xlsx").rows
    return row


def count_parts(row):
    found = {}
    for one in list_parts(row, INCLINATION):
        found[one.part, one.type_id] = (one.count, one.size)
    return found


@pytest.mark.parametrize(
    ("given", "posts"),
    [
        ({"row_length": 21.0}, 7),
        ({"row_length": 21.05}, 7),
        ({"row_length": 21.2}, 8),
        ({"post_count": 5}, 5),
        ({"post_count": 5, "row_length": 13.5}, 5),
    ],
)
def test_posts_and_what_stands_at_each(tmp_path, given, posts):
    found = count_parts(read_row(tmp_path, panel_system="none", **given))
    assert found["foot_anchor", "A"] == (posts, pytest.approx(4.2))
    assert found["post", "P"][0] == posts
    for member in ("uphill_anchor", "downhill_anchor"):
        assert found[member, "A"] == (2 * posts, pytest.approx(4.2))
    for member in ("uphill_guy", "downhill_guy"):
        assert found[member, "G"][0] == 2 * posts


@pytest.mark.parametrize("posts", [2, 3, 7])
def test_an_anchor_of_two_guys_stands_once_between_two_posts(tmp_path, posts):
    shared = {"panel_system": "none", "guy_anchors": "shared", "post_count": posts}
    found = count_parts(read_row(tmp_path, **shared))
    assert found["uphill_anchor", "A"][0] == posts + 1
    assert found["uphill_guy", "G"][0] == 2 * posts
    shared["guy_anchors"] = ""
    assert count_parts(read_row(tmp_path, **shared))["uphill_anchor", "A"][0] is None


def test_lengths_are_the_longest_over_the_inclinations(tmp_path):
    found = count_parts(read_row(tmp_path, panel_system="none", row_length=21.0))
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
    row = read_row(
        tmp_path,
        panel_system="rectangular",
        ridge_rope="G",
        lower_rope="G",
        mid_anchors="yes",
        post_count=6,
    )
    found = count_parts(row)
    assert found["ridge_rope", "G"] == found["lower_rope", "G"] == (1, 17.5)
    assert found["mid_anchor", "A"] == (5, pytest.approx(4.2))


def test_without_length_or_number_nothing_is_counted(tmp_path):
    found = count_parts(read_row(tmp_path, panel_system="none"))
    assert {count for count, _ in found.values()} == {None}
    assert found["net", ""] == (None, None)


@pytest.mark.parametrize("length", [10.4, 17.6])
def test_a_length_that_does_not_go_with_the_posts_is_refused(tmp_path, length):
    with pytest.raises(SiteDataError) as caught:
        read_row(tmp_path, panel_system="none", post_count=5, row_length=length)
    (finding,) = [one for one in caught.value.findings if one.severity == "error"]
    assert "which make 14 m" in str(finding.rule)
