"""End effect and lateral load against the guideline's formulas by hand."""

import math

import pytest

from netdesign.errors import ModelError
from netdesign.structure.row_position import (
    EndEffectRule,
    compute_edge_width,
    compute_lateral_factor,
    find_governing_width,
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


@pytest.mark.parametrize(
    ("gap", "position"), [(1.0, "intermediate"), (math.inf, "edge")]
)
def test_larger_width_governs(gap, position):
    governing = find_governing_width(4.0, an_edge(gap=gap))
    assert governing.position == position
    assert governing.width == pytest.approx(4.0 if gap == 1.0 else 5.5, rel=1e-14)


def test_without_a_rule_a_whole_bay_is_loaded():
    assert find_governing_width(4.0, None).width == 4.0


@pytest.mark.parametrize(
    ("name", "value"),
    [("gap", -0.1), ("gap", math.nan), ("glide_factor", 0.9), ("net_height", 0.0)],
)
def test_impossible_input_is_named(name, value):
    with pytest.raises(ModelError, match=name.replace("_", " ")):
        an_edge(**{name: value})


@pytest.mark.parametrize("share", [0.0, 0.1, 1.0])
def test_lateral_part_stands_across_the_force(share):
    assert compute_lateral_factor(share) == pytest.approx(
        math.sqrt(1.0 + share**2), rel=1e-15
    )
