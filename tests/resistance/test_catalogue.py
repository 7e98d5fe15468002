"""What the catalogue refuses and how it tells it; where its numbers come from."""

import pytest

from netdesign.outcome import ModelError
from netdesign.resistance.catalogue import (
    find_imperfection,
    find_rope_factor,
    find_termination,
    pick,
)
from netdesign.words.message import say
from tests.each import each


@each(
    "find, given, told",
    [
        (find_rope_factor, ("6x91",), "rope construction = '6x91': must be "),
        (find_termination, ("spelters",), "termination = 'spelters': must be one of "),
        (find_imperfection, ("x",), "buckling curve = 'x': must be one of "),
    ],
)
def test_an_unknown_name_is_refused_by_what_it_names(find, given, told):
    with pytest.raises(ModelError) as refused:
        find(*given)
    assert str(refused.value).startswith(told)


def test_a_refusal_names_what_is_accepted():
    known = {"alpha1": 1, "alpha2": 2}
    with pytest.raises(ModelError) as refused:
        pick("termination", "alpha4", known)
    assert refused.value.message.arguments["accepted"] == tuple(known)
    assert pick("termination", "alpha2", known) == 2


@pytest.mark.parametrize(
    ("find", "given", "source"),
    [
        (find_rope_factor, ("6x19-FC",), "rope"),
        (find_termination, ("spelter",), "termination"),
        (find_imperfection, ("b",), "buckling"),
    ],
)
def test_every_number_has_its_source(find, given, source):
    found = find(*given)
    assert found.source == say(f"resistance_source.{source}")
    assert found.status in ("secondary", "assumed")
