"""The support beside a row's end, (S10a), (P10), (P11): lever rule and ropes."""

import math

import numpy as np
import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import (
    MemberLoad,
    bring_to_support,
    hold_one_way,
    place_end_support,
    press_one_way,
    pull_one_way,
)
from netdesign.structure.row_position import (
    EndEffectRule,
    compute_edge_width,
    list_supports,
    share_end_effect,
)
from tests.each import each

RULE = EndEffectRule(
    constant=0.92,
    per_glide=0.65,
    cap_constant=1.0,
    cap_per_glide=1.25,
    length=0.60,
    length_cap=1.0 / 3.0,
    isolated_gap=2.0,
)
# b, D_K [m], N.
ROWS = {"R1": (4.0, 2.5, 1.2), "R2": (3.5, 3.0, 1.2)}
ROWS |= {"R4": (3.0, 3.5, 1.8), "R5": (3.0, 4.0, 2.4)}


def find_edge(row, gap):
    spacing, height, glide = ROWS[row]
    return compute_edge_width(
        RULE, post_spacing=spacing, net_height=height, gap=gap, glide_factor=glide
    )


@each("reach", [0.1, 0.44, 0.75, 1.0, 1.3, 1.8, 2.0, 2.6, 3.4])
def test_strips_hang_between_their_posts_by_the_lever_rule(reach):
    """Every strip's load to its two posts, by its distances."""
    z = (np.arange(400_000) + 0.5) * reach / 400_000
    for support in range(5):
        part = np.clip(1.0 - np.abs(z - support), 0.0, None).mean() * reach
        found = share_end_effect(reach, support)
        assert found == pytest.approx(part, abs=1e-9)
    assert sum(share_end_effect(reach, k) for k in range(8)) == pytest.approx(reach)


def test_the_share_grows_with_the_reach_and_has_no_jump():
    reaches = np.linspace(0.0, 3.5, 3501)
    for support in range(4):
        shares = np.array([share_end_effect(one, support) for one in reaches])
        assert (np.diff(shares) >= 0.0).all()
        assert np.diff(shares).max() <= 1.0000001e-3
    assert share_end_effect(0.0, 1) == 0.0


# f_R, l_R [m] and growth of the second support [%] beside a gap of 1 m; at a free end
# besides lambda, width of the last one [m].
GAP = {
    "R1": (0.850, 0.24),
    "R2": (0.850, 0.31),
    "R4": (1.045, 0.52),
    "R5": (1.240, 0.62),
}
FREE = {
    "R1": (2.50, 0.833, 0.208, 4.083, 5.43),
    "R2": (2.50, 1.000, 0.286, 4.250, 10.20),
    "R4": (3.25, 1.167, 0.389, 5.292, 24.58),
    "R5": (4.00, 1.333, 0.444, 6.833, 39.51),
}


@each("row", list(ROWS))
def test_second_support_beside_a_gap_and_a_free_end(row):
    spacing = ROWS[row][0]
    factor, growth = GAP[row]
    edge = find_edge(row, 1.0)
    assert (edge.end_factor, edge.end_length) == pytest.approx((factor, 0.3))
    _, second, _ = list_supports(spacing, edge, 20)
    assert 100.0 * (second.width / spacing - 1.0) == pytest.approx(growth, abs=6e-3)
    edge = find_edge(row, math.inf)
    inside, second, last = list_supports(spacing, edge, 20)
    factor, length, reach, width, growth = FREE[row]
    assert (edge.end_factor, edge.end_length) == pytest.approx(
        (factor, length), abs=5e-4
    )
    assert edge.end_length / spacing == pytest.approx(reach, abs=5e-4)
    assert last.width == pytest.approx(width, abs=5e-4)
    assert 100.0 * (second.width / spacing - 1.0) == pytest.approx(growth, abs=6e-3)
    assert inside.width == spacing


def test_rows_of_two_and_three_posts_have_the_shares_of_both_ends():
    """R5 with a free end: f_R b = 12 m, s_1 = 0.4444^2 / 2 = 0.098765."""
    edge = find_edge("R5", math.inf)
    lone = list_supports(3.0, edge, 2)
    assert [one.position for one in lone] == ["intermediate", "edge"]
    assert lone[1].width == pytest.approx(6.8333 + 12.0 * 0.098765, abs=1e-4)
    _, middle, last = list_supports(3.0, edge, 3)
    assert middle.width == pytest.approx(3.0 + 2.0 * 12.0 * 0.098765, abs=1e-4)
    assert last.width == edge.width
    _, second, _ = list_supports(3.0, edge, 4)
    assert second.width == pytest.approx(3.0 + 12.0 * 0.098765, abs=1e-4)


@pytest.mark.parametrize("gap", [0.4, 1.0, 1.9, math.inf])
@pytest.mark.parametrize("row", list(ROWS))
def test_no_number_of_posts_is_worse_than_an_unknown_one(row, gap):
    spacing, edge = ROWS[row][0], find_edge(row, gap)
    unknown = {one.position: one for one in list_supports(spacing, edge)}
    for count in range(2, 12):
        for one in list_supports(spacing, edge, count):
            at = unknown[one.position]
            assert one.width <= at.width
            assert one.share <= at.share
            assert one.beside <= at.beside
            assert one.position != "second" or one.beside <= one.share


UNITS = {"β": "deg", "b": "m", "Δl": "m"}
UNITS |= dict.fromkeys(("E_s", "P", "T_r", "D"), "kN")


def leaves_of(**values):
    return [leaf(x, value, UNITS.get(x, "-"), "here") for x, value in values.items()]


def test_a_guy_of_the_second_head_holds_its_part_of_the_ropes_pull():
    """(P11): c D / sin beta = 0.4 * 38.37 / sin 30 = 30.696 kN."""
    found = hold_one_way(*leaves_of(c=0.4, D=38.37, β=30.0))
    assert found.value == pytest.approx(30.696, rel=1e-12)


def test_the_second_post_is_pressed_by_rope_and_load_along_the_row():
    """R5, gap 1 m: D = 38.37 kN; w (21.4463 * 1.0062 + D) / tan 25."""
    edge = find_edge("R5", 1.0)
    _, second, _ = list_supports(3.0, edge, 20)
    at = place_end_support(
        *leaves_of(b=3.0, f_R=second.end_factor, Δl=second.end_length),
        second=leaf("s_2", second.share, "-", "here"),
    )
    inside, rope = leaves_of(E_s=266.622, T_r=309.422)
    along = leaves_of(w=0.683428, k=0.1, P=214.463, β=25.0)
    push = press_one_way(pull_one_way(rope, at), at, *along)
    found = bring_to_support("E_k", inside, MemberLoad(), at, push).value
    held = (21.4463 * 1.0062 + 38.37) / math.tan(math.radians(25.0))
    expected = 266.622 * 1.0062 + 0.683428 * held
    assert found == pytest.approx(expected, abs=0.02)
