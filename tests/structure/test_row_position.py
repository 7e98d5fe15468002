"""End effect and lateral load against the guideline's formulas by hand."""

import math
from itertools import pairwise

import pytest

from netdesign.outcome import ModelError
from netdesign.structure.row_position import (
    EndEffectRule,
    compute_edge_width,
    list_supports,
)

RULE = EndEffectRule(
    constant=0.92,
    per_glide=0.65,
    cap_constant=1.0,
    cap_per_glide=1.25,
    length=0.60,
    length_cap=1.0 / 3.0,
    isolated_gap=2.0,
)


def an_edge(**changes):
    values = {"post_spacing": 4.0, "net_height": 3.0, "gap": 1.0, "glide_factor": 2.0}
    return compute_edge_width(RULE, **(values | changes))


def test_edge_beside_a_narrow_gap():
    """f_R = (0.92 + 1.30) 0.5 = 1.11 over 0.60 * 0.5 = 0.30 m: 2 + 0.333 m."""
    edge = an_edge()
    assert edge.end_factor == pytest.approx(1.11, rel=1e-14)
    assert edge.end_length == pytest.approx(0.30, rel=1e-14)
    assert edge.width == pytest.approx(2.333, rel=1e-14)


@pytest.mark.parametrize("gap", [2.0, 50.0, math.inf])
def test_isolated_edge_takes_both_caps(gap):
    """f_R = 1.00 + 2.50 = 3.50 over a third of 3 m: 2 + 3.5 m."""
    edge = an_edge(gap=gap)
    assert (edge.end_factor, edge.end_length) == (3.5, 1.0)
    assert edge.width == pytest.approx(5.5, rel=1e-14)


def test_without_a_gap_the_edge_is_half_a_bay():
    assert an_edge(gap=0.0).width == 2.0


def test_length_is_capped_by_the_net_height():
    assert an_edge(gap=1.9, net_height=1.5).end_length == 0.5


@pytest.mark.parametrize("gap", [1.81, 1.99, 2.0, 2.19])
def test_gap_close_to_the_threshold_gives_both_widths_and_takes_the_wider(gap):
    """Free end 2 + 3.5 m; beside the gap 2 + (0.92 + 1.30) gap / 2 * 0.60 gap / 2."""
    edge = an_edge(gap=gap)
    beside = 2.0 + min(2.22 * gap / 2.0, 3.5) * 0.30 * gap
    assert edge.width == pytest.approx(5.5, rel=1e-14)
    assert edge.other_width == pytest.approx(beside, rel=1e-14)
    assert (edge.end_factor, edge.end_length) == (3.5, 1.0)


@pytest.mark.parametrize("gap", [0.0, 1.79, 2.21, math.inf])
def test_gap_away_from_the_threshold_has_one_width(gap):
    assert an_edge(gap=gap).other_width is None


def test_width_has_no_jump_that_a_slip_of_the_gap_could_hide():
    """0.1.0 rose from 2.666 to 5.5 m between 1.99 and 2 m; the rise has two values."""
    gaps = [0.01 * k for k in range(400)]
    edges = [an_edge(gap=gap) for gap in gaps]
    for below, above in pairwise(edges):
        least = above.width if above.other_width is None else above.other_width
        assert least - below.width < 0.02
        assert above.width >= below.width - 1e-12


def test_row_has_a_support_inside_and_its_end():
    edge = an_edge(gap=1.0)
    inside, second, end = list_supports(4.0, edge, 12)
    assert (inside.position, inside.width, inside.end_factor) == (
        "intermediate", 4.0, 0.0,
    )  # fmt: skip
    assert second.position == "second"
    assert end.width == edge.width
    assert end.share == 0.0
    assert [one.width for one in list_supports(4.0, None)] == [4.0]


@pytest.mark.parametrize(
    ("name", "value"),
    [("gap", -0.1), ("gap", math.nan), ("glide_factor", 0.9), ("net_height", 0.0)],
)
def test_impossible_input_is_named(name, value):
    with pytest.raises(ModelError, match=name.replace("_", " ")):
        an_edge(**{name: value})
