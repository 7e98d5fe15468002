"""Steps of a calculation: stored, read, worked out again."""

from dataclasses import dataclass, field, replace
from random import Random
from typing import ClassVar

import pytest
from hypothesis import given as draws
from hypothesis import settings
from hypothesis import strategies as st

from netdesign.calculation.quantity import leaf
from netdesign.calculation.steps import (
    Step,
    list_named,
    list_steps,
    require_calculation,
)
from netdesign.edge.json_text import read_json, write_json
from netdesign.outcome import ContentError
from tests.calculation.drawn import draw_calculation, find_size
from tests.calculation.evaluate import evaluate
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
    require_calculation(stored)


def test_two_quantities_of_one_name_are_refused():
    one, other = leaf("E", 3.0, "kN", ""), leaf("E", 4.0, "kN", "")
    with pytest.raises(ValueError, match="two quantities are called E"):
        list_steps((one + other).named("F", "kN"))
    same = replace(one)  # worked out twice
    for other in (one, same):
        assert len(list_steps((one + other).named("F", "kN"))) == 2


FAULTS = [
    lambda a, b, c: [a, a, b, c],
    lambda a, b, c: [a, c, b],
    lambda a, _, c: [a, c],
    lambda a, b, c: [a, b, replace(c, formula="E.value")],
    lambda a, b, c: [a, b, replace(c, formula="E * 1e999")],
]


@each("fault", FAULTS)
def test_steps_that_are_no_calculation_are_refused(fault):
    force, width = leaf("E", 3.0, "kN", ""), leaf("b", 2.0, "m", "Nets!L5")
    steps = list_steps((force / width).named("q", "kN/m"))
    require_calculation(steps)
    with pytest.raises(ContentError):
        require_calculation(fault(*steps))


def test_an_end_that_is_the_value_is_not_stored_twice():
    above = leaf("E", 3.0, "kN", "", band=(3.0, 4.5))
    below = leaf("F", 3.0, "kN", "", band=(1.5, 3.0))
    stored = [
        (one.low, one.high) for one in list_steps((above + below).named("G", "kN"))
    ]
    assert stored == [
        (None, 4.5),
        (1.5, None),
        (4.5, 7.5),
    ]
