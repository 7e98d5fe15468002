"""Part of a zone that no row holds, on a plane; gaps and overlaps of rows."""

import math

import numpy as np
import pytest

from netdesign.addons.terrain.coverage import find_coverage
from netdesign.addons.terrain.measure import measure_plan
from netdesign.addons.terrain.site_lines import find_gap
from tests.addons.terrain.surfaces import build_grid, draw_line, plan_of, plane

PSI = math.radians(38.3)


def ring(*corners):
    return np.array(corners, dtype=float)


@pytest.mark.parametrize("turned", [0.0, 0.61])
def test_a_row_holds_its_bays_up_to_its_reach(turned):
    from tests.addons.terrain.surfaces import turn

    corners = ring((-30, -30), (30, -30), (30, 30), (-30, 30))
    zone = np.column_stack(turn(*corners.T, turned))
    grid = build_grid(plane(PSI), size=160.0, turned=turned)
    row = draw_line([(-15.0, -20.0), (15.0, -20.0)], turned=turned)
    plan = plan_of(row, zones=(zone,))
    surface, rows = measure_plan(grid, plan, most=100.0)
    found = find_coverage(surface, plan, rows, {"R1": 25.0})
    held = 30.0 * 25.0 * math.cos(PSI)
    assert found.area == pytest.approx(3600.0, rel=0.01)
    assert found.area - found.uncovered == pytest.approx(held, rel=0.04)
    assert found.share == pytest.approx(1.0 - held / 3600.0, abs=0.02)


def test_gap_of_rows_beside_and_above():
    grid = build_grid(plane(PSI), size=160.0)
    lines = (
        draw_line([(-30.0, -20.0), (-3.0, -20.0)], name="A"),
        draw_line([(-1.5, -19.0), (25.5, -19.0)], name="B"),
        draw_line([(-60.0, -21.0), (-33.0, -21.0)], name="C"),
        draw_line([(-12.0, 5.0), (15.0, 5.0)], name="D"),
    )
    _, (a, b, c, d) = measure_plan(grid, plan_of(*lines), most=60.0)
    assert find_gap(a, [a, b, c, d]) == pytest.approx(3.0)
    assert find_gap(a, [a, b, d]) is None  # one end is free
    assert find_gap(d, [a, b, c, d]) is None
