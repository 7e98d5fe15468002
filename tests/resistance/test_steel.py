"""Bars and ropes against published breaking forces."""

import math

import pytest

from netdesign.resistance.catalogue import find_termination, make_rope
from netdesign.resistance.steel import RoundSection
from tests.each import each


@each(
    "diameter_mm, construction, grade, published_kN",
    [
        # API 9A, 6x7 with fibre core
        (8, "6x7-FC", 1770, 37.6),
        (12, "6x7-FC", 1770, 84.6),
        (16, "6x7-FC", 1960, 167.0),
        (22, "6x7-FC", 1770, 284.0),
        # collection of standards, section 4.4, IWRC
        (14, "6x36-IWRC", 1770, 123.5),
        (20, "6x19-IWRC", 1770, 252.0),
    ],
)
def test_breaking_force_of_ropes(diameter_mm, construction, grade, published_kN):
    values, _ = make_rope(construction, diameter_mm, [grade])
    low, high = values["breaking_force"]
    assert low / 1e3 == high / 1e3 == pytest.approx(published_kN, rel=5e-3)


@pytest.mark.parametrize(("kind", "share"), [("ferrule", 0.9), ("clips", 0.8)])
def test_ends_take_their_share(kind, share):
    termination = find_termination(kind)
    assert (termination.value, termination.status) == (share, "assumed")


def test_bar_of_28_mm_and_500_mpa():
    bar = RoundSection(outer=0.028, strength=500e6)
    assert bar.axial_resistance == pytest.approx(math.pi * 14.0**2 * 500.0, rel=1e-15)
