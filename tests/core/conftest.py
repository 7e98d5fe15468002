"""Both cores, for whatever compares them."""

import pytest

from netdesign.core.library import find_core
from netdesign.core.sources import SWITCH, SWITCHED_OFF


@pytest.fixture
def in_numpy(monkeypatch):
    """Calls a function with the compiled core switched off."""

    def call(function, *arguments):
        with monkeypatch.context() as patch:
            patch.setenv(SWITCH, SWITCHED_OFF)
            assert find_core() is None
            return function(*arguments)

    return call
