import math

import pytest

from netdesign.errors import ModelError
from netdesign.guards import (
    require_count,
    require_one_of,
    require_positive,
    require_within,
)

NO_NUMBERS = [math.nan, math.inf, -math.inf]


@pytest.mark.parametrize("value", [math.ulp(0.0), 1e-300, 1, 1e300])
def test_positive_numbers_are_taken(value):
    assert require_positive("slack", value) is None


@pytest.mark.parametrize("value", [0.0, -0.0, -math.ulp(0.0), -1, *NO_NUMBERS])
def test_anything_else_is_not_positive(value):
    with pytest.raises(
        ModelError, match=r"^slack = .*: must be a finite number above 0"
    ):
        require_positive("slack", value, "m")


@pytest.mark.parametrize("value", [-1.0, math.nextafter(-1.0, 0.0), 0.0, 2.0])
def test_both_bounds_lie_within(value):
    assert require_within("slope angle", value, -1.0, 2.0) is None


@pytest.mark.parametrize(
    "value", [math.nextafter(-1.0, -2.0), math.nextafter(2.0, 3.0), *NO_NUMBERS]
)
def test_beyond_the_bounds_is_refused(value):
    with pytest.raises(
        ModelError, match=r"^slope angle = .*: must lie between -1 and 2 rad"
    ):
        require_within("slope angle", value, -1.0, 2.0, "rad")


def test_infinity_is_no_number_even_within_endless_bounds():
    with pytest.raises(ModelError, match="load = inf"):
        require_within("load", math.inf, 0.0, math.inf)


@pytest.mark.parametrize("word", ["free", "no-slip"])
def test_known_words_are_taken(word):
    assert require_one_of("ground law", word, ("free", "no-slip")) is None


@pytest.mark.parametrize("word", ["Free", "", "free ", "slip"])
def test_other_words_are_refused_with_those_accepted(word):
    with pytest.raises(ModelError, match=r"must be one of free, no-slip$"):
        require_one_of("ground law", word, ("free", "no-slip"))


def test_a_message_names_field_value_and_unit():
    with pytest.raises(ModelError) as caught:
        require_positive("post spacing", -2.5, "m")
    assert str(caught.value) == (
        "post spacing = -2.5: must be a finite number above 0 m"
    )


@pytest.mark.parametrize("value", [1, 80])
def test_counts_are_accepted(value):
    assert require_count("rounds", value) is None


@pytest.mark.parametrize("value", [0, -1, 1.5, 2.0, math.nan, math.inf, "3", None])
def test_what_is_no_count_is_refused(value):
    with pytest.raises(ModelError, match=r"rounds = .* a whole number above 0"):
        require_count("rounds", value)
