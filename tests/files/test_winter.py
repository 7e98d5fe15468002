"""The winter document: trend of the annual maxima."""

import pytest

from netdesign.files.winter import _write_trend
from netdesign.winter.statistics import Trend


def a_trend(tau, p_value):
    return Trend(count=23, rank_correlation=tau, p_value=p_value, slope=175.0 * tau)


def test_a_trend_has_its_numbers_and_a_sentence_of_its_own():
    found = [
        _write_trend(one)
        for one in (a_trend(0.5, 0.0113), a_trend(-0.5, 3e-7), a_trend(0.5, 0.05), None)
    ]
    assert [one["is_shown"] for one in found] == [True, True, False, False]
    assert len({one["why"] for one in found}) == 4
    grown, fallen, _, without = found
    for one, word in zip((grown, fallen), ("grown", "fallen"), strict=True):
        assert word in one["why"]
    assert grown["slope_kN_per_m_per_decade"] == pytest.approx(0.875)
    assert fallen["slope_kN_per_m_per_decade"] == pytest.approx(-0.875)
    assert (grown["winters"], grown["p_value"], grown["kendall_tau"]) == (
        23,
        0.0113,
        0.5,
    )
    assert "10" in without["why"]
    assert {key for key, value in without.items() if value is None} == {
        *("winters", "p_value", "kendall_tau", "slope_kN_per_m_per_decade")
    }
    for number in ("23 ", "+0.88 kN/m", "≤ 0.012"):
        assert number in grown["why"]
    assert "≤ 0.001" in fallen["why"]
