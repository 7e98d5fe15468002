"""The names that ``from netdesign import ...`` gives."""

import subprocess
import sys

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


def test_a_solver_is_loaded_only_when_a_public_name_is_asked_for():
    probe = (
        "import sys, netdesign\n"
        "assert 'Scene' in dir(netdesign) and not hasattr(netdesign, 'wrong')\n"
        "from netdesign import outcome\n"
        "print('numpy' in sys.modules)\n"
        "from netdesign import Scene, solve_steady\n"
        "print('numpy' in sys.modules)\n"
    )
    printed = subprocess.run(
        [sys.executable, "-c", probe], capture_output=True, text=True, check=True
    )
    assert printed.stdout.split() == ["False", "True"]
