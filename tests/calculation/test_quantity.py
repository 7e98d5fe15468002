"""Quantities: their bands, their units, what is missing."""

import math
from itertools import product
from random import Random

import pytest
from hypothesis import given as draws
from hypothesis import settings
from hypothesis import strategies as st

from netdesign.calculation.quantity import (
    OPERATIONS,
    PURE,
    Kind,
    apply,
    at_value,
    cos,
    find_dimension,
    halve_dimension,
    largest,
    leaf,
    multiply_dimension,
    name_dimension,
    smallest,
    sqrt,
)
from netdesign.calculation.steps import list_named
from netdesign.outcome import ModelError
from netdesign.words.message import say
from tests.calculation.drawn import (
    PLAIN,
    draw_calculation,
    find_size,
    list_leaves,
    work_out,
)
from tests.each import each

SEEDS = st.integers(0, 2**40)
SIZES = st.floats(0.01, 1e4)
ROUNDED = 1e-12


@st.composite
def bands(draw, sizes=SIZES):
    return sorted(draw(st.tuples(sizes, sizes, sizes)))


def make(symbol, ends, unit="kN"):
    low, value, high = ends
    return leaf(symbol, value, unit, "Nets!A2", band=(low, high))


@draws(SEEDS, SEEDS)
@settings(max_examples=300)
def test_a_band_holds_all_that_its_inputs_may_give(seed, inside):
    made = draw_calculation(Random(seed), has_values=False)
    random, size = Random(inside), find_size(made)
    for _ in range(5):
        inputs = {
            one.symbol: random.choice((one.low, one.high, draw_between(random, one)))
            for one in list_leaves(made)
        }
        found = work_out(made, inputs)
        assert made.low - ROUNDED * size <= found <= made.high + ROUNDED * size


def draw_between(random, one):
    return random.uniform(one.low, one.high)


@draws(SEEDS)
@settings(max_examples=200)
def test_a_value_is_that_of_plain_arithmetic(seed):
    made = draw_calculation(Random(seed))
    inputs = {one.symbol: one.value for one in list_leaves(made)}
    size = ROUNDED * find_size(made)
    assert made.value == pytest.approx(work_out(made, inputs), rel=1e-12, abs=size)


TWO = ("+", "-", "*", "/", "max", "min")


@draws(st.sampled_from(TWO), bands(), bands())
@settings(max_examples=200)
def test_ends_of_two_that_differ_are_taken_and_not_exceeded(sign, one, other):
    made = apply(sign, make("a", one), make("b", other))
    corners = [PLAIN[sign](*pair) for pair in product((one[0], one[2]), other[::2])]
    assert (made.low, made.high) == (min(corners), max(corners))
    assert made.value == PLAIN[sign](one[1], other[1])


@draws(st.sampled_from(("sin", "cos", "tan")), bands(st.floats(0.0, 90.0)))
@settings(max_examples=100)
def test_ends_of_an_angle_s_function_are_its_own(name, ends):
    low, value, high = sorted(round(end, 3) for end in ends)
    made = apply(name, make("β", (low, value, high), "deg"))
    corners = [getattr(math, name)(math.radians(end)) for end in (low, high)]
    assert (made.low, made.high) == (min(corners), max(corners))


@draws(bands(), SIZES)
@settings(max_examples=100)
def test_what_is_divided_and_multiplied_again_keeps_its_band(ends, width):
    force, b = make("E", ends), leaf("b", width, "m", "Nets!L5")
    again = force / b * b
    assert (again.low, again.value, again.high) == pytest.approx(ends, rel=1e-14)
    assert again.dimension == force.dimension


def test_the_value_alone_has_no_band():
    force = at_value(make("E", (1.0, 2.0, 4.0)))
    assert (force.low, force.value, force.high) == (2.0, 2.0, 2.0)


@draws(SEEDS, st.integers(0, 6))
@settings(max_examples=200)
def test_nothing_that_rests_on_what_is_missing_has_a_number(seed, place):
    made = draw_calculation(Random(seed))
    leaves = list_leaves(made)
    gone = leaves[place % len(leaves)].symbol
    lack = say("text.as_given", text="nobody measured it")
    again = take_away(made, gone, lack)
    for then, now in zip(list_named(made), list_named(again), strict=True):
        rests = gone in {one.symbol for one in list_named(then)}
        assert now.is_known is not rests
        assert now.dimension == then.dimension
        if rests:
            assert (now.low, now.value, now.high) == (None, None, None)
            assert now.lacks == (lack,)


def take_away(quantity, symbol, lack, done=None):
    """The same calculation without the value of a leaf."""
    done = {} if done is None else done
    if id(quantity) in done:
        return done[id(quantity)]
    if not quantity.operation:
        is_gone = quantity.symbol == symbol
        made = leaf(symbol, None, quantity.unit, "", lack=lack) if is_gone else quantity
    else:
        of = [take_away(one, symbol, lack, done) for one in quantity.of]
        made = apply(quantity.operation, *of)
        if quantity.symbol and quantity.operation != "=":
            made = made.named(quantity.symbol, quantity.unit, quantity.source)
        elif quantity.symbol:
            made = of[0].named(quantity.symbol, quantity.unit, quantity.source)
    done[id(quantity)] = made
    return made


def test_all_that_is_missing_is_told_once():
    one, other = (leaf(symbol, None, "kN", "") for symbol in "ab")
    made = one + (other + one)
    assert made.lacks == (*one.lacks, *other.lacks)
    assert [str(lack) for lack in made.lacks] == ["a is missing", "b is missing"]


@pytest.mark.parametrize("ends", [(0.0, 0.0, 0.0), (0.0, 1.0, 2.0)])
def test_nothing_is_divided_by_what_may_be_zero(ends):
    made = make("E", (1.0, 1.0, 1.0)) / make("R", ends)
    assert not made.is_known
    assert [str(lack) for lack in made.lacks] == [
        "R is zero: nothing can be divided by it"
    ]


@each(
    "operation, ends",
    [
        *((name, (-1.0, 1.0, 2.0)) for name in ("*", "/")),
        *((name, (30.0, 60.0, 90.001)) for name in ("sin", "cos", "tan")),
        *((name, (-1.0, 0.0, 1.0)) for name in ("sin", "cos", "tan")),
    ],
)
def test_beyond_its_range_an_operation_gives_no_number(operation, ends):
    """Its band would not be that of its operand's ends."""
    is_angle = operation in ("sin", "cos", "tan")
    odd = make("x", ends, "deg" if is_angle else "kN")
    operands = [[odd]] if is_angle else [[odd, 2.0], [2.0, odd]]
    for pair in operands:
        made = apply(operation, *pair)
        assert not made.is_known
        assert "x lies outside the range of" in str(made.lacks[0])


def test_root_of_less_than_nothing_has_no_number():
    square = make("a", (1.0, 1.0, 1.0), "m2") - make("b", (0.5, 1.0, 2.0), "m2")
    assert not sqrt(square).is_known


UNFIT = [
    lambda a, b: a + b,
    lambda a, b: a - b,
    lambda a, b: largest(a, b),
    lambda a, b: smallest(b, a),
    lambda a, _: a + 1.0,
    lambda a, _: a - 1.0,
    lambda a, _: sqrt(a),
    lambda a, _: cos(a),
    lambda a, b: (a * b).named("F", "kN"),
    lambda a, b: (a / b).named("F", "kN"),
    lambda a, _: a.named("F", "-"),
    lambda a, _: (a / a).named("F", "deg"),
]


@each("fault", UNFIT)
@each("is_missing", [False, True])
def test_units_that_do_not_fit_are_refused(fault, is_missing):
    """Also of what has no number yet."""
    force = leaf("E", None if is_missing else 3.0, "kN", "")
    with pytest.raises(ModelError):
        fault(force, leaf("b", 2.0, "m", ""))


def test_nothing_has_any_unit():
    force = make("E", (1.0, 2.0, 3.0))
    assert (force - 5.0 * force).dimension == force.dimension
    assert (force + 0.0).value == (0.0 + force).value == 2.0


@each(
    "low, value, high",
    [
        *((2.0, 1.0, 3.0), (1.0, 3.0, 2.0), (math.nan, 1.0, 1.0)),
        *((1.0, math.nan, 1.0), (1.0, 1.0, math.inf), (-math.inf, 0.0, 1.0)),
    ],
)
def test_disorder_and_what_is_no_number_are_refused(low, value, high):
    with pytest.raises(ModelError, match="in the order low, value, high"):
        leaf("E", value, "kN", "", band=(low, high))


def test_a_number_with_a_reason_for_its_lack_is_refused():
    with pytest.raises(ModelError):
        leaf("E", 1.0, "kN", "", lack=say("text.as_given", text="odd"))


@each("operation", sorted(OPERATIONS))
def test_a_result_beyond_all_numbers_is_refused(operation):
    huge = leaf("E", 1e308, "-", "")
    if operation in ("+", "*"):
        with pytest.raises(ModelError):
            apply(operation, huge, huge)
    elif operation == "/":
        with pytest.raises(ModelError):
            apply(operation, huge, 1e-10)


def test_a_second_name_keeps_the_first_one():
    force = leaf("T_r", 2.0, "kN", "rope", kind=Kind.SOLVED)
    pull = force.named("H", "kN", "(P8)")
    assert [one.symbol for one in list_named(pull)] == ["T_r", "H"]
    assert (pull.value, pull.kind, pull.source) == (2.0, Kind.WORKED, "(P8)")


def test_units_that_do_not_fit_are_refused_by_their_names():
    force, length = leaf("F", 3.7, "kN", ""), leaf("l", 2.3, "m", "")
    with pytest.raises(ModelError) as refused:
        _ = force + length
    told = refused.value.message
    assert told.key == "calculation.units"
    assert told.arguments["operation"] == "+"
    assert len(told.arguments["units"].split(", ")) == 2


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
