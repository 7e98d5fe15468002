"""Steps of a calculation: stored, read, worked out again, compared."""

from dataclasses import dataclass, field, replace
from random import Random
from typing import ClassVar

import pytest
from hypothesis import given as draws
from hypothesis import settings
from hypothesis import strategies as st

from netdesign.calculation.quantity import given
from netdesign.calculation.steps import (
    Step,
    compare_steps,
    evaluate,
    list_named,
    list_steps,
)
from netdesign.edge.json_text import read_json, write_json
from netdesign.outcome import ContentError, ModelError
from tests.calculation.drawn import draw_calculation, find_size
from tests.each import each

SEEDS = st.integers(0, 2**40)


@dataclass(frozen=True, kw_only=True)
class Stored:
    """Steps as a study has them."""

    __pydantic_config__: ClassVar = {
        "extra": "forbid",
        "strict": True,
        "allow_inf_nan": False,
    }

    steps: list[Step] = field(default_factory=list)


def store(steps):
    return read_json(Stored, write_json(Stored(steps=steps))).steps


@draws(SEEDS)
@settings(max_examples=200)
def test_steps_of_a_file_give_the_same_numbers_and_units(seed):
    made = draw_calculation(Random(seed))
    steps = list_steps(made)
    stored = store(steps)
    assert stored == steps
    again = evaluate(stored)
    for one in list_named(made):
        found = again[one.symbol]
        ends, size = (one.low, one.value, one.high), 1e-12 * find_size(one)
        assert (found.low, found.value, found.high) == pytest.approx(
            ends, rel=1e-12, abs=size
        )
        assert (found.dimension, found.unit) == (one.dimension, one.unit)
        assert (found.kind, found.source) == (one.kind, one.source)
    assert list(compare_steps(stored)) == []


@draws(SEEDS, st.integers(0, 99), st.sampled_from(("low", "value", "high")))
@settings(max_examples=300)
def test_a_changed_number_is_found(seed, place, end):
    """Of any quantity that is worked out, at any end."""
    steps = list_steps(draw_calculation(Random(seed)))
    worked = [one for one in steps if one.formula]
    changed = worked[place % len(worked)]
    number = dict(zip(("low", "value", "high"), changed.ends, strict=True))[end]
    altered = replace(changed, **{end: number + max(1e-6 * abs(number), 1e-6)})
    told = list(compare_steps([altered if x is changed else x for x in steps]))
    assert changed.symbol in {str(one).partition(" is ")[0] for one in told}


@draws(SEEDS, st.integers(0, 99))
@settings(max_examples=300)
def test_a_changed_leaf_is_found_where_it_counts(seed, place):
    made = draw_calculation(Random(seed), has_bands=False)
    steps = list_steps(made)
    leaves = [one for one in steps if not one.formula]
    leaf = leaves[place % len(leaves)]
    moved = [replace(x, value=1.001 * x.value) if x is leaf else x for x in steps]
    again, before = evaluate(moved), evaluate(steps)
    differs = any(
        abs(again[x.symbol].value - before[x.symbol].value) > 1e-6
        for x in steps
        if x.formula
    )
    if differs:
        assert list(compare_steps(moved))


def test_a_lost_number_and_a_new_one_are_found():
    force, width = given("E", 3.0, "kN", ""), given("b", None, "m", "Nets!L5")
    known, missing = (force * 2.0).named("F", "kN"), (force / width).named("q", "kN/m")
    steps = list_steps((missing * width + known).named("G", "kN"))
    assert [one.symbol for one in steps] == ["E", "b", "q", "F", "G"]
    assert list(compare_steps(store(steps))) == []
    for symbol, value in (("F", None), ("q", 1.0), ("G", 6.0)):
        altered = [replace(x, value=value) if x.symbol == symbol else x for x in steps]
        (told,) = compare_steps(altered)
        assert str(told).startswith(f"{symbol} is ")


FAULTS = [
    lambda a, b, c: [a, a, b, c],
    lambda a, b, c: [a, c, b],
    lambda a, _, c: [a, c],
    lambda a, b, c: [a, b, replace(c, formula="E.value")],
    lambda a, b, c: [a, b, replace(c, formula="E * (1e308 * 10)")],
    lambda a, b, c: [a, b, replace(c, unit="kN")],
    lambda a, b, c: [a, b, replace(c, unit="m" + "9" * 5000)],
    lambda a, b, c: [replace(a, unit="kN" * 9), b, replace(c, formula="E + b")],
    lambda a, b, c: [replace(a, low=4.0), b, c],
    lambda a, b, c: [replace(a, high=-4.0), b, c],
]


@each("fault", FAULTS)
def test_steps_that_are_no_calculation_are_refused(fault):
    force, width = given("E", 3.0, "kN", ""), given("b", 2.0, "m", "Nets!L5")
    steps = list_steps((force / width).named("q", "kN/m"))
    assert list(compare_steps(steps)) == []
    with pytest.raises((ContentError, ModelError)):
        list(compare_steps(fault(*steps)))


def test_two_quantities_of_one_name_are_refused():
    one, other = given("E", 3.0, "kN", ""), given("E", 4.0, "kN", "")
    with pytest.raises(ValueError, match="two quantities are called E"):
        list_steps((one + other).named("F", "kN"))
    assert len(list_steps((one + one).named("F", "kN"))) == 2
