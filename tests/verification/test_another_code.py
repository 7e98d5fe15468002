"""An independent code on three solved scenes."""

import numpy as np
import pytest

from netdesign.addons.evidence.verification.winters import (
    list_another_code,
    load_results,
    solve_shared,
)
from tests.verification import quads

SCENES = {scene.name: scene for scene in solve_shared()}


def test_snow_of_the_scenes_sticks_to_its_net():
    """Else the flow could not be run again with v = 0 on the net."""
    assert not any(scene.solution.net_slides.any() for scene in SCENES.values())


@pytest.mark.parametrize("name", ["free-upright", "rough-leaning"])
def test_independent_code_gives_its_stored_figures(name):
    """On a coarse grid; `python -m tests.verification.quads` for the stored ones."""
    (stored,) = (one for one in load_results() if one.scene == name)
    flow, unit, depth = quads.read_scene(SCENES[name])
    force, moment = quads.solve(flow, parts=8, least=8e-3)
    expected = np.array([stored.force_x, stored.force_y])
    away = np.hypot(*(force * unit / 1e3 - expected))
    assert away < 5e-3 * stored.force
    assert moment * unit * depth / 1e3 == pytest.approx(stored.moment, rel=5e-3)


def test_program_agrees_with_another_code():
    cases = list_another_code()
    assert len(cases) == 9
    assert all(case.passes for case in cases)
    whole = [case for case in cases if not case.id.endswith("force-y")]
    assert max(case.error for case in whole) < 4e-4
