"""Formulas of the forces on a support, each with its own arithmetic by hand."""

import math
from dataclasses import replace

import pytest

from netdesign.calculation.quantity import leaf
from netdesign.checks import forces as formulas
from netdesign.checks.forces import MemberLoad, Support, place_end_support

UNITS = {"E_s": "kN", "b": "m", "Δl": "m", "P": "kN", "β": "deg"}
UNITS |= {"T_r": "kN", "γ": "deg", "V_k": "kN", "R_k": "kN", "R_m": "kN", "R_min": "kN"}
UNITS |= {"A": "kN", "Z": "kN", "E_k": "kN", "E_g0": "kN", "P_g": "kN"}
UNITS |= dict.fromkeys(("E_c", "E_p", "E_g", "E_p0"), "kN")


def q(symbol, value, low=None, high=None):
    band = (value if low is None else low, value if high is None else high)
    return leaf(symbol, value, UNITS.get(symbol, "-"), "test", band=band)


def ends(quantity):
    return quantity.low, quantity.value, quantity.high


END = place_end_support(q("b", 4.0), q("f_R", 1.5), q("Δl", 0.8))


def test_half_a_bay_and_the_end_effect_load_an_end_support():
    """(S9): 4 / 2 + 1.5 * 0.8 = 3.2 m."""
    assert END.width.value == pytest.approx(3.2, rel=1e-15)
    assert END.width.source == "(S9)"
    inside = Support()
    assert inside.width is None


def test_load_along_the_row_at_the_foot():
    """(S11): sqrt(1 + 0.75^2) = 1.25."""
    assert formulas.find_lateral_factor(q("k", 0.75)).value == 1.25


def test_a_guy_has_half_of_the_section_and_its_part_along_the_row():
    """(S17): 1 / (2 cos 60) = 1; 0.6 * 0.1 * 50 / sin 30 = 6 kN."""
    at_60 = formulas.load_guy(q("c", 0.6), q("k", 0.1), q("P", 50.0), q("β", 60.0))
    assert at_60.share.value == pytest.approx(1.0, rel=1e-14)
    at_30 = formulas.load_guy(
        q("c", 0.6), q("k", 0.1), q("P", 50.0, 40.0, 70.0), q("β", 30.0)
    )
    assert ends(at_30.added) == pytest.approx((4.8, 6.0, 8.4), rel=1e-14)
    assert at_30.share.value == pytest.approx(1.0 / math.sqrt(3.0), rel=1e-14)


def test_a_post_is_pressed_by_all_of_the_load_along_the_row():
    """(S18): 1.4 * 0.1 * 50 / tan 45 = 7 kN."""
    pull = q("P", 50.0, 10.0, 80.0)
    given_ = (q("w", 1.4), q("k", 0.1), pull, q("β", 45.0))
    found = ends(formulas.load_post(*given_).added)
    assert found == pytest.approx((1.4, 7.0, 11.2), rel=1e-14)


def test_a_force_inside_the_row_comes_to_its_support():
    """(V1): (0.6 * 100 + 5) * 3.2 / 4 = 52 kN; 52 + 7 = 59, 52 * 1.25 = 65 kN."""
    load = MemberLoad(share=q("g", 0.6), added=q("A", 5.0, 4.0, 8.0))
    load_at_foot = replace(load, lateral=q("k_q", 1.25))
    of = ("E_c", q("E_s", 100.0, 90.0, 120.0))
    push = q("Z", 7.0, 6.0, 9.0)
    force = formulas.bring_to_support(*of, load, END, push)
    assert ends(force) == pytest.approx((52.4, 59.0, 73.0), rel=1e-14)
    force = formulas.bring_to_support(*of, load_at_foot, END)
    assert ends(force) == pytest.approx((58.0, 65.0, 80.0), rel=1e-14)
    plain = formulas.bring_to_support("E_c", q("E_s", 100.0), MemberLoad(), Support())
    assert plain.value == 100.0


def test_guideline_has_the_load_along_the_row_of_its_own_pull():
    """(S18): 1.4 * 0.1 * 20 / tan 60 kN, under a symbol of its own."""
    along = (q("w", 1.4), q("k", 0.1), q("P_g", 20.0), q("β", 60.0))
    load = formulas.load_post(*along, mark="_g")
    assert load.added.symbol == "A_g"
    assert load.added.value == pytest.approx(2.8 / math.sqrt(3.0), rel=1e-14)


def test_shared_anchor_holds_both_guys_in_space():
    """(S20): 2 * 0.6 * 0.1 * 20 / sin 30 = 4.8 kN across 3.6: 6 kN."""
    along = (q("n_g", 2.0), q("c", 0.6), q("k", 0.1), q("P_g", 20.0), q("β", 30.0))
    load = formulas.load_shared_anchor(*along, mark="_g")
    force = formulas.bring_to_support("E_g", q("E_g0", 3.6), load, Support())
    assert force.value == pytest.approx(6.0, rel=1e-14)


def test_the_largest_force_counts_at_each_end():
    """(V1): of (3, 5, 9), (4, 4, 4) and (1, 6, 7) kN it is (4, 6, 9)."""
    three = [q("E_c", 5.0, 3.0, 9.0), q("E_g", 4.0), q("E_p", 6.0, 1.0, 7.0)]
    assert ends(formulas.take_largest("E_k", *three)) == (4.0, 6.0, 9.0)
    assert formulas.take_largest("E_k", three[0]) is three[0]


def test_a_rope_pulls_more_at_the_end_of_the_row():
    """(P8): 30 (1 + 1.5 * 0.8 / 4) = 39 kN; beyond half a bay 30 (1 + 1.5) = 75."""
    rope = q("T_r", 30.0, 20.0, 40.0)
    assert ends(formulas.pull_at_end(rope, END)) == pytest.approx(
        (26.0, 39.0, 52.0), rel=1e-14
    )
    for reach, pull in ((2.0, 52.5), (2.001, 75.0)):
        wide = place_end_support(q("b", 4.0), q("f_R", 1.5), q("Δl", reach))
        assert formulas.pull_at_end(rope, wide).value == pytest.approx(pull, rel=1e-14)
    with pytest.raises(ValueError, match="no end effect"):
        formulas.pull_at_end(rope, Support())


def test_an_end_guy_pulls_and_presses():
    """(P7), (S25): 39 / cos 60 = 78 kN; 1.2 * 39 tan 45 = 46.8 kN, half to a guy."""
    rope, angle, part = q("T_r", 39.0), q("γ", 45.0), q("e", 1.2)
    assert formulas.pull_end_guy(rope, q("γ", 60.0)).value == pytest.approx(78.0)
    assert formulas.push_by_end_guy(rope, angle).value == pytest.approx(39.0)
    assert formulas.push_by_end_guy(rope, angle, part).value == pytest.approx(46.8)
    one = formulas.push_by_end_guy(rope, angle, part, q("β", 60.0))
    assert one.value == pytest.approx(46.8)


def test_the_head_holds_the_end_guy_whatever_tells_its_net_s_pull():
    """(S24a): 46.8 kN beside 100, 60 and 20 kN inside, times 3.2 / 4: 126.8 kN."""
    pull = formulas.pull_at_end(q("T_r", 30.0), END)
    push = formulas.push_by_end_guy(pull, q("γ", 45.0), q("e", 1.2))
    found = [
        formulas.bring_to_support("E_c", q("E_s", inside), MemberLoad(), END, push)
        for inside in (100.0, 60.0, 20.0)
    ]
    assert [one.value for one in found] == pytest.approx([126.8, 94.8, 62.8])


def test_a_base_slides_by_the_tilt_of_its_post():
    """(S19): 0.25 * 80 = 20 kN."""
    assert formulas.slide_base(q("V_k", 80.0), q("t", 0.25)).value == 20.0


def test_friction_holds_the_base_that_its_design_force_presses():
    """(R12): 0.5 * 1.5 * 80 = 60 kN, of the value alone."""
    pressing = q("V_k", 80.0, 60.0, 90.0)
    found = formulas.resist_by_friction(q("μ_b", 0.5), q("γ_E", 1.5), pressing)
    assert ends(found) == (60.0, 60.0, 60.0)


def test_utilisation_of_a_design_force():
    """(V2): 1.5 * 100 / (500 / 1.25) = 0.375."""
    force = q("E_k", 100.0, 90.0, 120.0)
    used = formulas.rate(force, q("γ_E", 1.5), q("R_k", 500.0), q("γ_R", 1.25))
    assert ends(used) == pytest.approx((0.3375, 0.375, 0.45), rel=1e-15)
