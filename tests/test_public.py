"""The names that ``from netdesign import ...`` gives."""

import pytest

import netdesign
from tests.each import each


@each("name", netdesign.__all__)
def test_a_public_name_is_found_documented_and_listed(name):
    found = getattr(netdesign, name)
    assert found.__name__ == name
    assert found.__doc__
    assert name in dir(netdesign)


def test_an_unknown_name_is_refused():
    with pytest.raises(AttributeError, match="'netdesign' has no attribute 'solve'"):
        _ = netdesign.solve
