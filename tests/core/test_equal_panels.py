"""Panels by the compiled core against those in NumPy, on drawn rows."""

import numpy as np
import pytest

from netdesign.core.library import find_core
from netdesign.coupling.solution import Solution
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import ModelError
from netdesign.panel.solve import FailedPanel, solve_panel
from tests.panel.test_robustness import draw_panel, draw_scene

pytestmark = pytest.mark.skipif(find_core() is None, reason="no compiled core here")


def draw_pairs(count):
    """Solved nets and panels that are cut to them, by seed."""
    pairs, seed = {}, 0
    while len(pairs) < count:
        seed += 1
        rng = np.random.default_rng([57, seed])
        try:
            section = solve_steady(draw_scene(rng))
            panel = draw_panel(rng)
        except ModelError:
            continue
        if isinstance(section, Solution):
            pairs[seed] = (section, panel, int(rng.integers(1, 11)))
    return pairs


PAIRS = draw_pairs(30)


@pytest.mark.parametrize("seed", PAIRS)
def test_a_panel_is_that_of_numpy(seed, in_numpy):
    section, panel, stations = PAIRS[seed]
    for count in (stations, 6):
        found = solve_panel(section, panel, stations=count)
        known = in_numpy(lambda n: solve_panel(section, panel, stations=n), count)
        assert type(found) is type(known)
        if isinstance(known, FailedPanel):
            assert found.outcome is known.outcome
            assert found.reason.key == known.reason.key
            continue
        assert found.steps == known.steps
        for name in ("foot", "mid_foot", "head", "curves", "stations"):
            one, other = (np.asarray(getattr(end, name)) for end in (found, known))
            size = np.abs(other).max() if other.any() else 1.0
            np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-9 * size)
        for rope in ("lower", "upper"):
            one, other = getattr(found, rope), getattr(known, rope)
            assert one.tension == pytest.approx(other.tension, rel=1e-9)
            assert one.along == pytest.approx(other.along, rel=1e-9)
