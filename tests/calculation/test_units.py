"""Units of a calculation: products, roots, names."""

from netdesign.calculation.quantity import (
    PURE,
    find_dimension,
    halve_dimension,
    multiply_dimension,
    name_dimension,
)
from tests.each import each

KN, M = find_dimension("kN"), find_dimension("m")


@each(
    "unit, dimension",
    [
        ("-", PURE),
        ("", PURE),
        ("kN/m", multiply_dimension(KN, M, -1)),
        ("kN/m2", multiply_dimension(KN, M, -2)),
        ("m3", multiply_dimension(M, M, 2)),
        ("1/m", multiply_dimension(PURE, M, -1)),
        ("m/m", PURE),
    ],
)
def test_a_unit_has_the_powers_of_its_parts(unit, dimension):
    assert find_dimension(unit) == dimension


def test_different_units_are_not_one():
    units = ("kN", "N", "m", "mm", "deg", "rad", "-", "kg/m3", "kN/m", "kN/m2")
    assert len({find_dimension(unit) for unit in units}) == len(units)


def test_a_root_halves_what_is_even():
    assert halve_dimension(multiply_dimension(KN, KN, 1)) == KN
    assert halve_dimension(KN) is None
    assert halve_dimension(PURE) == PURE


def test_a_unit_in_words():
    assert name_dimension(multiply_dimension(KN, M, -2)) == "kN m-2"
    assert name_dimension(PURE) == "-"


@each("unit", ["m" + "9" * 5000, "9", "/", "//", "m/s/s", "²", "м2"])
def test_any_text_is_some_unit(unit):
    assert find_dimension(unit) == find_dimension(unit)
