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


def test_tools_that_nothing_uses_are_not_loaded():
    first = "from netdesign.snow.triangulation import load_delaunay; load_delaunay()"
    assert set(_TOOLS).isdisjoint(run(first))


def test_whoever_uses_them_later_finds_them():
    lines = (
        "from netdesign.snow.triangulation import load_delaunay",
        "load_delaunay()",
        "import numpy as np, scipy.linalg, scipy.special, scipy.stats",
        "np.testing.assert_allclose(scipy.linalg.norm([3.0, 4.0]), 5.0)",
        "np.testing.assert_allclose(scipy.special.erf(0.0), 0.0)",
        "np.testing.assert_allclose(scipy.stats.norm.cdf(0.0), 0.5)",
    )
    assert set(run(*lines)).issuperset(_TOOLS[:1])


PARTS = (
    "from netdesign.snow.triangulation import load_delaunay",
    "part = load_delaunay()",
)


def test_the_rest_of_a_package_is_not_loaded():
    loaded = run(*PARTS)
    assert "scipy.spatial._qhull" in loaded
    assert {"scipy.spatial", "scipy.spatial.transform"}.isdisjoint(loaded)
    assert "scipy.linalg.cython_lapack" in loaded
    assert {"scipy.linalg", "scipy.linalg._basic"}.isdisjoint(loaded)


def test_a_package_is_whole_for_whoever_asks_later():
    loaded = run(
        *PARTS,
        "import numpy as np, scipy.interpolate, scipy.linalg, scipy.spatial",
        "import scipy.special, scipy.sparse.linalg",
        "assert part is scipy.spatial.Delaunay",
        "points = np.array([[0.0, 0.0], [1.3, 0.0], [0.0, 1.7], [1.1, 0.9]])",
        "assert scipy.spatial.ConvexHull(points).volume > 0.0",
        "assert scipy.spatial.transform.Rotation.identity().magnitude() == 0.0",
        "np.testing.assert_allclose(scipy.linalg.solve([[2.3]], [1.0]), 1.0 / 2.3)",
        "assert scipy.special.roots_gegenbauer(3, 0.7)[0].size == 3",
        "solve = scipy.sparse.linalg.splu(scipy.sparse.eye(3, format='csc')).solve",
        "np.testing.assert_allclose(solve(np.ones(3)), 1.0)",
        "found = scipy.interpolate.LinearNDInterpolator(points, points[:, 0])",
        "np.testing.assert_allclose(found([[0.31, 0.27]]), 0.31)",
    )
    assert {"scipy.special", "scipy.linalg", "scipy.spatial"} <= set(loaded)


def test_where_a_module_has_moved_the_package_is_asked():
    loaded = run(
        "import inspect, netdesign.snow.triangulation as mesh",
        "text = inspect.getsource(mesh.load_delaunay).replace('_qhull', '_moved')",
        "exec(text, vars(mesh))",
        "assert mesh.load_delaunay().__name__ == 'Delaunay'",
    )
    assert "scipy.spatial" in loaded


def test_numpy_lists_all_its_names_again_even_after_a_failure():
    names, listed = list(np.__all__), dir(np)
    error = ImportError("spoilt")
    with pytest.raises(ImportError, match="spoilt"), importing_scipy():
        raise error
    with importing_scipy():
        assert set(np.__all__) == set(dir(np)) <= set(vars(np))
    assert (list(np.__all__), dir(np)) == (names, listed)
