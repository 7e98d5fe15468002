"""Rows proposed for a zone: as far apart as they may be, and no ground forgotten."""

import math
import random
from itertools import combinations

import numpy as np
import pytest

from netdesign.checks.geometry import compute_largest_row_spacing
from netdesign.terrain.coverage import find_coverage
from netdesign.terrain.layout import (
    GAP,
    LEAST_ROW,
    MOST_ROW,
    Construction,
    Task,
    propose_rows,
)
from netdesign.terrain.measure import measure_plan
from netdesign.terrain.plan import NetLine, Plan
from netdesign.terrain.surface import choose_window
from tests.each import each
from tests.terrain.surfaces import build_grid, plane, turn

FRICTION, CAP = 0.6, 13.0
NETS = (
    Construction(id="low", net_height=3.0, post_spacing=3.5),
    Construction(id="high", net_height=4.0, post_spacing=3.0),
)
LEFT = 10.0  # the least snow of a row; a lower end may stay open [m]


def find_reach(slope, height):
    most = compute_largest_row_spacing(slope, height, FRICTION)
    return min(most, CAP * height / math.cos(slope))


def rectangle(width, depth, *, turned=0.0, shift=(0.0, 0.0)):
    half, tall = 0.5 * width, 0.5 * depth
    corners = np.array([(-half, -tall), (half, -tall), (half, tall), (-half, tall)])
    return np.column_stack(turn(*corners.T, turned)) + shift


def propose(grid, zone, *, snow=3.2, nets=NETS, gradient=0.0):
    surface = choose_window(grid, zone)

    def find_snow(places):
        return snow + gradient * (places[:, 1] - zone[:, 1].min())

    return surface, propose_rows(
        Task(
            surface=surface,
            zones=[zone],
            constructions=nets,
            find_snow=find_snow,
            find_reach=find_reach,
        )
    )


def measure(grid, rows, zone):
    lines = tuple(
        NetLine(
            id=f"R{number}",
            points=row.points,
            cells={
                "id": f"R{number}",
                "net_height": row.construction.net_height,
                "post_spacing": row.spacing,
            },
        )
        for number, row in enumerate(rows)
    )
    plan = Plan(lines=lines, zones=(zone,))
    surface, measured = measure_plan(grid, plan, most=80.0)
    reach = {
        one.line.id: find_reach(one.slope.high, one.line.net_height) for one in measured
    }
    return measured, reach, find_coverage(surface, plan, measured, reach)


def gully(angle, depth):
    def height(x, y):
        return 1500.0 + math.tan(angle) * y - depth * np.exp(-((x / 25.0) ** 2))

    return height


DRAWS = random.Random(20_261_126)
CASES = [
    (
        DRAWS.uniform(33.0, 46.0),
        DRAWS.uniform(-4.0, 4.0),  # a gully, or a rib
        DRAWS.uniform(0.0, 2.0 * math.pi),
        (DRAWS.uniform(-9e3, 9e3), DRAWS.uniform(-9e3, 9e3)),
        DRAWS.choice((1.0, 2.0)),
        DRAWS.choice((0.0, 0.05)),
    )
    for _ in range(4)
]


@each("angle, depth, turned, shift, cell, noise", CASES)
def test_rows_hold_the_zone_as_far_apart_as_they_may(
    angle, depth, turned, shift, cell, noise
):
    psi = math.radians(angle)
    grid = build_grid(
        gully(psi, depth),
        cell=cell,
        size=240.0,
        turned=turned,
        shift=shift,
        noise=noise,
    )
    zone = rectangle(110.0, 70.0, turned=turned, shift=shift)
    _, rows = propose(grid, zone)
    measured, reach, coverage = measure(grid, rows, zone)
    for row, one in zip(rows, measured, strict=True):
        assert LEAST_ROW - 0.1 <= one.length <= MOST_ROW + 1.0
        assert one.upslope.length.high <= reach[one.line.id]
        assert row.spacing <= row.construction.post_spacing + 1e-9
    below = coverage.places[
        turn(*(coverage.places - shift).T, -turned)[1] < -35.0 + LEFT
    ]
    lost = coverage.uncovered - len(below) * coverage.side**2
    assert lost <= 0.08 * coverage.area
    for one, other in combinations(rows, 2):
        away = one.points[:, None] - other.points[None]
        assert np.hypot(*np.moveaxis(away, -1, 0)).min() > 0.45 * GAP


@each("cell, turned", [(0.5, 1.234), (1.0, 0.0), (2.0, 1.234), (5.0, 0.0)])
def test_on_a_plane_rows_share_the_ground(cell, turned):
    psi, depth = math.radians(41.7), 60.0
    grid = build_grid(plane(psi), cell=cell, size=200.0, turned=turned)
    zone = rectangle(70.0, depth, turned=turned)
    _, rows = propose(grid, zone)
    up = sorted({round(turn(*row.points.T, -turned)[1].mean()) for row in rows})
    longest = 0.92 * 0.98 * find_reach(psi, 3.0)
    count = max(1, math.ceil((depth / math.cos(psi) - LEFT) / longest))
    assert len(up) == count
    apart = min(longest, depth / math.cos(psi) / count) * math.cos(psi)
    wanted = 0.5 * depth - apart * np.arange(count, 0, -1)
    assert up == pytest.approx(wanted, abs=2.0 * cell + 1.0)
    for row in rows:  # along the contour
        assert np.ptp(turn(*row.points.T, -turned)[1]) < 0.02


def test_the_lowest_net_that_is_as_high_as_the_snow_is_built():
    psi = math.radians(38.0)
    grid = build_grid(plane(psi), size=240.0)
    zone = rectangle(60.0, 90.0)
    _, rows = propose(grid, zone, snow=3.0, gradient=0.02)  # more snow higher up
    heights = {row.construction.net_height for row in rows}
    assert heights == {3.0, 4.0}
    for row in rows:
        needed = row.snow * math.cos(psi)
        assert row.construction.net_height >= needed - 1e-6
        assert row.construction.net_height == 4.0 or needed <= 3.0


def test_ground_that_is_flat_or_narrow_has_no_rows():
    flat = build_grid(plane(math.radians(23.0)), size=160.0)
    assert propose(flat, rectangle(60.0, 60.0))[1] == []
    steep = build_grid(plane(math.radians(40.0)), size=160.0)
    assert propose(steep, rectangle(8.0, 60.0))[1] == []


def test_a_hill_all_round_is_closed_by_rows_that_do_not_meet():
    def cone(x, y):
        return 1700.0 - math.tan(math.radians(37.0)) * np.hypot(x, y)

    grid = build_grid(cone, size=200.0)
    angles = np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)
    zone = 70.0 * np.column_stack((np.cos(angles), np.sin(angles)))
    _, rows = propose(grid, zone)
    measured, reach, _ = measure(grid, rows, zone)
    assert rows
    for one in measured:
        assert one.upslope.length.value <= reach[one.line.id]
    for row in rows:  # each at one distance from the top
        away = np.hypot(*row.points.T)
        assert np.ptp(away) < 1.0
    for one, other in combinations(rows, 2):
        apart = one.points[:, None] - other.points[None]
        assert np.hypot(*np.moveaxis(apart, -1, 0)).min() > 0.45 * GAP


def test_a_profile_without_a_cap_ends_what_is_looked_at():
    """On 25 degrees the ground alone may hold the snow: no distance is too large."""
    grid = build_grid(plane(math.radians(33.0)), size=200.0)
    zone = rectangle(40.0, 50.0)
    task = Task(
        surface=choose_window(grid, zone),
        zones=[zone],
        constructions=NETS,
        find_snow=lambda places: np.full(len(places), 3.2),
        find_reach=lambda slope, height: compute_largest_row_spacing(
            slope, height, FRICTION
        ),
    )
    assert math.isinf(task.find_reach(math.radians(25.0), 3.0))
    assert propose_rows(task)
