"""NumPy is as it was, and SciPy complete, after the first import."""

import subprocess
import sys

import numpy as np
import pytest

from netdesign.numerics.scipy_start import importing_scipy

_TOOLS = ("numpy.testing", "numpy.f2py")


def run(*lines):
    """Modules that a new process has loaded after some lines."""
    code = "\n".join((*lines, "import sys; print(*sorted(sys.modules))"))
    ended = subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    )
    return ended.stdout.split()


@pytest.mark.parametrize(
    "first",
    ["from netdesign.snow.mesh import load_delaunay; load_delaunay()",
     "import netdesign.planview.free_gap"],
)  # fmt: skip
def test_tools_that_nothing_uses_are_not_loaded(first):
    assert set(_TOOLS).isdisjoint(run(first))


def test_whoever_uses_them_later_finds_them():
    lines = (
        "from netdesign.snow.mesh import load_delaunay",
        "load_delaunay()",
        "import numpy as np, scipy.linalg, scipy.special, scipy.stats",
        "np.testing.assert_allclose(scipy.linalg.norm([3.0, 4.0]), 5.0)",
        "np.testing.assert_allclose(scipy.special.erf(0.0), 0.0)",
        "np.testing.assert_allclose(scipy.stats.norm.cdf(0.0), 0.5)",
    )
    assert set(run(*lines)).issuperset(_TOOLS[:1])


def test_numpy_lists_all_its_names_again_even_after_a_failure():
    names, listed = list(np.__all__), dir(np)
    error = ImportError("spoilt")
    with pytest.raises(ImportError, match="spoilt"), importing_scipy():
        raise error
    with importing_scipy():
        assert set(np.__all__) == set(dir(np)) <= set(vars(np))
    assert (list(np.__all__), dir(np)) == (names, listed)
