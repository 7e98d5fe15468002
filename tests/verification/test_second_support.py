"""The support beside a row's end, (S10a), (P10), (P11): lever rule and ropes.

Numbers of the built-in example, rows R1, R2, R4 and R5, by an independent derivation to
the digits given there.
"""

import math

import numpy as np
import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks.forces import calculate_force
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


UNITS = {"β": "deg", "γ": "deg", "b": "m", "Δl": "m"}
UNITS |= dict.fromkeys(("E_s", "E_p0", "P", "T_r", "T_min"), "kN")


def leaves_of(**values):
    return {
        name: leaf(name, value, UNITS.get(name, "-"), "here")
        for name, value in values.items()
    }


def take_second(row, gap, **more):
    spacing, edge = ROWS[row][0], find_edge(row, gap)
    _, second, _ = list_supports(spacing, edge, 20)
    effect = {"f_R": second.end_factor, "Δl": second.end_length, "s_2": second.share}
    return calculate_force(leaves_of(b=spacing, **effect, **more))


# Ridge rope and lower rope inside the row; unbalanced pull of both beside a gap of 1 m,
# of the ridge rope at a free end [kN].
ROPES = {
    "R1": (123.542, 128.855, 7.9, 8.2, 64.3),
    "R4": (182.106, 261.885, 19.0, 27.4, 230.0),
    "R5": (309.422, 463.470, 38.4, 57.5, 550.0),
}


@each("row", list(ROPES))
def test_head_and_foot_hold_what_the_last_bay_pulls_more(row):
    upper, lower, *expected, free = ROPES[row]
    for rope, pull in zip((upper, lower), expected, strict=True):
        found = take_second(row, 1.0, E_s=0.0, T_r=rope)
        assert found.push.value == pytest.approx(pull, abs=0.055)
    found = take_second(row, math.inf, E_s=0.0, T_r=upper)
    assert found.push.value == pytest.approx(free, abs=0.6)


def test_splayed_guy_post_foot_and_anchor_beside_the_end():
    """R5, gap 1 m, D = 38.37 kN: 0.534 * 38.37 / sin 25 = 48.5 kN on one guy."""
    load = {"k": 0.1, "P": 214.463, "β": 25.0, "T_r": 309.422}
    guy = take_second("R5", 1.0, E_s=139.634, c=0.534007, **load)
    spread = 0.534007 / math.sin(math.radians(25.0))
    assert guy.push.value == pytest.approx(48.48, abs=0.01)
    assert guy.action.value == pytest.approx(104.134 * 1.0062 + 48.48, abs=0.01)
    shared = take_second("R5", 1.0, E_s=139.634, c=0.534007, n_g=2.0, **load)
    width = (1.0062 + 1.0) / 2.0
    in_section = 139.634 * width + 48.48 * math.cos(math.radians(25.0))
    square = 2.0 * spread * 21.4463 * width + 48.48 * math.sin(math.radians(25.0))
    expected = math.hypot(in_section, square)
    assert shared.action.value == pytest.approx(expected, abs=0.02)
    assert shared.action.value < 2.0 * guy.action.value
    post = take_second("R5", 1.0, E_s=266.622, w=0.683428, T_min=16.786, **load)
    held = (21.4463 * 1.0062 + 38.37) / math.tan(math.radians(25.0)) - 16.786 * 1.0062
    expected = 266.622 * 1.0062 + 0.683428 * held
    assert post.action.value == pytest.approx(expected, abs=0.02)
    foot = take_second("R5", 1.0, E_s=300.0, k=0.1, T_r=463.470)
    along = 0.1 * 300.0 * 1.0062 + 463.470 * 0.124
    expected = math.hypot(300.0 * 1.0062, along)
    assert foot.action.value == pytest.approx(expected, abs=0.02)


@pytest.mark.parametrize(("count", "guys"), [(4, 2.0), (None, 2.0), (5, 1.0)])
def test_an_anchor_between_two_posts_beside_the_ends_holds_both(count, guys):
    """Four posts, free ends: 100 (3 + 12 s_1) / 3 kN, and 2 * 50 kN along the guys.

    Each head is pulled towards its own end: across the section the two cancel, and no
    more than one is counted there.
    """
    edge = find_edge("R5", math.inf)
    _, second, _ = list_supports(3.0, edge, count)
    told = {"E_s": 100.0, "c": 0.5, "k": 0.0, "P": 1.0, "β": 25.0}
    effect = {"b": 3.0, "f_R": 4.0, "Δl": second.end_length, "s_2": second.share}
    spread = 0.5 / math.sin(math.radians(25.0))
    growth = 4.0 * second.end_length / 3.0  # (P10), up to half a bay
    rope = 50.0 / (spread * growth)
    in_section = (
        100.0 * (second.width if guys > 1.0 else 0.5 * (second.width + 3.0)) / 3.0
    )
    both = guys * 50.0
    for symbol, expected in (
        (
            "n_g",
            math.hypot(
                in_section + both * math.cos(math.radians(25.0)),
                50.0 * math.sin(math.radians(25.0)),
            ),
        ),
        ("n_h", in_section / math.cos(math.radians(25.0)) + both),
    ):
        leaves = leaves_of(**told, **effect, T_r=rope, s_n=second.beside)
        leaves[symbol] = leaves_of(**{symbol: 2.0})[symbol]
        found = calculate_force(
            {k: x for k, x in leaves.items() if k != "s_n" or x.value}
        )
        assert found.action.value == pytest.approx(expected, rel=1e-9)


def test_what_the_guys_hold_anyway_holds_the_unbalanced_pull_too():
    load = {"k": 0.1, "P": 200.0, "β": 25.0, "T_r": 309.422, "w": 0.7}
    free, held = (
        take_second("R5", 1.0, E_s=266.0, T_min=least, **load).push.value
        for least in (0.0, 400.0)
    )
    assert free > 50.0
    assert held == 0.0


@pytest.mark.parametrize(("gap", "width"), [(1.0, 2.4453), (math.inf, 6.8333)])
def test_the_outer_bay_s_anchor_is_shared_with_the_second_post(gap, width):
    """R5: (1.872 + 3.0186) / 2 = 2.4453; at a free end 6.833 > (6.833 + 4.185) / 2."""
    edge = find_edge("R5", gap)
    _, second, last = list_supports(3.0, edge, 20)
    told = {"E_s": 100.0, "n_g": 2.0, "c": 0.5, "k": 0.0, "P": 1.0, "β": 25.0}
    effect = {"b": 3.0, "f_R": last.end_factor, "Δl": last.end_length}
    found = calculate_force(leaves_of(**told, **effect, s_n=last.beside))
    expected = max(last.width, (last.width + second.width) / 2.0)
    assert found.action.value == pytest.approx(100.0 * expected / 3.0)
    assert expected == pytest.approx(width, abs=1e-3)
    assert last.beside == second.share
