"""Layouts of a support, of which the worst counts: in a case, a grid, a search."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from netdesign.envelope.run import build_task, run_cases
from netdesign.envelope.search import run_grid, search_rows
from netdesign.envelope.signed_forces import read_signed
from netdesign.panel.inputs import list_panels
from netdesign.structure.layout import SupportLayout
from tests.envelope.tasks import build_row, draw_case
from tests.solving.small_scene import COARSE, PANEL, build_scene

SPACING = PANEL.post_spacing
PANELS = list_panels(
    SPACING,
    sags=(None, None),
    stiffnesses=((3e6, 40e6), (3e6, 40e6)),
    has_mid_anchors=False,
)
LAYOUTS = tuple(
    SupportLayout(
        post_spacing=SPACING,
        post_tilt=math.radians(tilt),
        uphill_anchor_distance=uphill,
        downhill_anchor_distance=downhill,
    )
    for tilt, uphill, downhill in product((9.5, 21.0), (2.1, 3.4), (1.9, 3.7))
)
TASK = build_row((251.0, 397.0), (16.0, 44.0), (24.0, 34.0), layouts=LAYOUTS)


def solve(case, layouts, panels=()):
    task = build_task(case, build_scene, layouts, COARSE, panels)
    (result,) = run_cases([task])
    return result


@pytest.mark.parametrize("panels", [(), PANELS])
@pytest.mark.parametrize("seed", range(3))
def test_each_layout_is_as_if_it_were_alone_and_the_worst_counts(seed, panels):
    case = draw_case(np.random.default_rng(seed))
    together = solve(case, LAYOUTS, panels)
    alone = [solve(case, [one], panels) for one in LAYOUTS]
    for name, band in together.member_forces.items():
        for end in ("low", "value", "high"):
            each = [getattr(one.member_forces[name], end) for one in alone]
            assert getattr(band, end) == pytest.approx(max(each), rel=1e-9, abs=1e-6)
    for place, one in enumerate(alone):
        found = together.on_layout(LAYOUTS[place])
        assert found.stand(LAYOUTS[place]).anchors == one.anchors
        for name, band in one.member_forces.items():
            size = max(1.0, band.value)
            for end in ("low", "value", "high"):
                value = getattr(found.member_forces[name], end)
                assert value == pytest.approx(getattr(band, end), abs=1e-9 * size)


@pytest.mark.parametrize("panels", [(), PANELS])
def test_signed_forces_are_the_largest_on_any_layout(panels):
    """The same of their errors."""
    case = draw_case(np.random.default_rng(11))
    together = read_signed([solve(case, LAYOUTS, panels)], LAYOUTS)
    alone = [read_signed([solve(case, [one], panels)], [one]) for one in LAYOUTS]
    assert np.isfinite(together).all()
    np.testing.assert_allclose(together, np.max(alone, axis=0), rtol=1e-9)


@pytest.mark.parametrize("panels", [(), PANELS[:2]])
def test_no_case_of_a_grid_exceeds_the_bound_on_any_layout(runner, panels):
    task = replace(TASK, panels=panels)
    (found,) = search_rows([task], runner)
    assert found.gap is None
    counts = {"density": 4, "friction_angle": 4, "inclination": 5}
    grid = run_grid(task, counts, runner)[0]
    for name, extreme in found.extremes.items():
        for result in grid:
            assert result.member_forces[name].value <= extreme.widened.high
    for place in range(len(LAYOUTS)):
        of_one = found.on_layout(LAYOUTS[place])
        assert of_one.task.layouts == (LAYOUTS[place],)
        for name, extreme in of_one.extremes.items():
            assert extreme.widened.high <= found.extremes[name].widened.high * 1.001
            for result in grid:
                force = result.on_layout(LAYOUTS[place]).member_forces[name].value
                assert force <= extreme.widened.high, (place, name, result.case)
