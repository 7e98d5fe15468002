"""Both cores, as the tests of the core have them."""

from tests.core.conftest import in_numpy as in_numpy
