"""Units of a calculation: products, roots, names."""

from netdesign.calculation.quantity import PURE, find_dimension, name_dimension
from tests.each import each

KN, M = find_dimension("kN"), find_dimension("m")


@each(
    "unit, dimension",
    [
        ("-", PURE),
        ("", PURE),
        ("kN/m", KN.times(M, -1)),
        ("kN/m2", KN.times(M, -2)),
        ("m3", M.times(M, 2)),
        ("1/m", PURE.times(M, -1)),
        ("m/m", PURE),
    ],
)
def test_a_unit_has_the_powers_of_its_parts(unit, dimension):
    assert find_dimension(unit) == dimension


def test_different_units_are_not_one():
    units = ("kN", "N", "m", "mm", "deg", "rad", "-", "kg/m3", "kN/m", "kN/m2")
    assert len({find_dimension(unit) for unit in units}) == len(units)


def test_a_root_halves_what_is_even():
    assert KN.times(KN, 1).root() == KN
    assert KN.root() is None
    assert PURE.root() == PURE


def test_a_unit_in_words():
    assert name_dimension(KN.times(M, -2)) == "kN m-2"
    assert name_dimension(PURE) == "-"


@each("unit", ["m" + "9" * 5000, "9", "/", "//", "m/s/s", "²", "м2"])
def test_any_text_is_some_unit(unit):
    assert find_dimension(unit) == find_dimension(unit)
