"""Rows on surfaces whose slopes and lengths are known; what of a zone they hold."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.terrain.coverage import find_coverage
from netdesign.addons.terrain.grid import require_ground
from netdesign.addons.terrain.measure import measure_plan
from netdesign.addons.terrain.site_lines import derive_cells, find_gap
from netdesign.outcome import TerrainError
from tests.addons.terrain.surfaces import (
    SPACING,
    build_grid,
    draw_line,
    plan_of,
    plane,
    turn,
)
from tests.each import each

PSI = math.radians(38.3)
CELLS = (0.5, 1.0, 2.0, 5.0)
ALONG_CONTOUR = [(-13.0, -20.0), (14.0, -20.0)]


def measure(grid, *lines, zones=(), most=60.0, at=0):
    return measure_plan(grid, plan_of(*lines, zones=zones), most=most)[1][at]


@each("cell", CELLS)
@each("turned", [0.0, 0.7391, 2.113])
def test_a_plane_has_its_angle_aspect_and_length(cell, turned):
    placed = {"turned": turned, "shift": (713.37, -219.61)}
    grid = build_grid(plane(PSI), cell=cell, size=160.0, **placed)
    row = draw_line(ALONG_CONTOUR, **placed)
    # another row 25 m up the slope, in plan 25 cos psi
    above = -20.0 + 25.0 * math.cos(PSI)
    upper = draw_line([(-30.0, above), (30.0, above)], name="R2", **placed)
    found = measure(grid, row, upper)
    assert found.slopes == pytest.approx(PSI, rel=1e-9)
    assert found.slope.value == pytest.approx(PSI, rel=1e-9)
    # the ground falls to the south of the surface's own axes
    assert found.aspect == pytest.approx((math.pi - turned) % (2 * math.pi), abs=1e-9)
    assert (found.upslope.end, found.upslope.row) == ("row", "R2")
    assert found.upslope.length.value == pytest.approx(25.0, rel=1e-9)
    assert measure(grid, row, upper, at=1).below_row == "R1"
    assert measure(grid, row, upper, at=1).below_length == pytest.approx(25.0, rel=1e-9)
    assert found.bends == pytest.approx(0.0, abs=1e-9)
    assert len(found.posts) == 10
    assert found.length == pytest.approx(9 * SPACING)
    heights = 1500.0 - 20.0 * math.tan(PSI)
    assert found.posts[:, 2] == pytest.approx(heights, abs=1e-8)


@each("cell", CELLS)
@each("turned", [0.0, 1.234])
def test_rows_on_a_cone_are_arcs_of_constant_slope(cell, turned):
    slope, radius = math.radians(36.9), 40.0

    def cone(x, y):
        return 2000.0 - math.tan(slope) * np.hypot(x, y)

    angles = np.linspace(-0.4, 0.4, 400) - math.pi / 2
    arc = np.column_stack((radius * np.cos(angles), radius * np.sin(angles)))
    grid = build_grid(cone, cell=cell, size=140.0, turned=turned)
    found = measure(grid, draw_line(arc, turned=turned), most=200.0)
    assert found.slopes == pytest.approx(slope, abs=0.02 * cell**2 / 4 + 2e-3)
    chord = 2.0 * math.asin(SPACING / 2.0 / radius)
    assert found.bends == pytest.approx(chord, rel=0.02)
    # up to the apex, where a window sees the top as flat
    apex = radius / math.cos(slope)
    assert found.upslope.end == "flat"
    assert found.upslope.length.value == pytest.approx(apex, abs=3.0 * cell)
    assert found.upslope.length.value <= apex + 1e-6


@each("cell", [0.5, 1.0])
@each("width", [1.3, 2.2, 6.1, 11.7])
def test_snow_reaches_across_a_bench_narrower_than_the_net_is_high(cell, width):
    """Level ground 12 m above the row, between two planes; in plan."""
    low, high = -8.0, -8.0 + width

    def bench(x, y):
        return 1500.0 + math.tan(PSI) * (
            np.minimum(y, low) + np.maximum(y, high) - high
        )

    grid = build_grid(lambda x, y: bench(x, y) + 0.0 * x, cell=cell, size=160.0)
    found = measure(grid, draw_line(ALONG_CONTOUR, net_height=4.0), most=40.0)
    if width < 4.0 - 3.0 * cell:
        assert found.upslope.end == "cap"
    elif width > 4.0 + 3.0 * cell:
        assert found.upslope.end == "flat"
        assert found.upslope.length.value == pytest.approx(
            12.0 / math.cos(PSI), abs=cell
        )


def wave(y):
    return 40.0 * np.sin(y / 45.0)


@pytest.mark.parametrize("upper", [23.0, 27.0, 25.0])
def test_an_edge_ends_the_snow_by_the_rule_of_25_degrees(upper):
    """Two planes that meet at y = 0, the upper one flatter."""
    below, above = math.radians(40.0), math.radians(upper)

    def edge(x, y):
        return 1000.0 + np.where(y < 0.0, math.tan(below), math.tan(above)) * y + 0 * x

    grid = build_grid(edge, size=160.0, noise=0.02)
    found = measure(grid, draw_line([(-10.0, -20.0), (10.0, -20.0)]), most=60.0)
    to_edge = 20.0 / math.cos(below)
    length = found.upslope.length
    if upper == 25.0:  # within the noise: the band covers both
        assert length.low < to_edge + 3.0
        assert length.high > 55.0
    elif upper < 25.0:
        assert length.value == pytest.approx(to_edge, abs=2.5)
    else:
        assert length.value == 60.0


def test_a_row_that_bends_too_much_is_refused_and_a_kink_is_named():
    grid = build_grid(plane(PSI), size=160.0)
    bent = [(-9.0, -20.0), (0.0, -20.0), (9.0, -20.0 + 9.0 * math.tan(0.15))]
    assert measure(grid, draw_line(bent)).kinks == (4,)
    holed = grid.heights.copy()
    holed[58:63, 40:120] = math.nan
    with pytest.raises(TerrainError, match="R1"):
        measure(replace(grid, heights=holed), draw_line(bent))
    broken = [(-9.0, -20.0), (0.0, -20.0), (9.0, -16.0)]
    with pytest.raises(TerrainError, match="post 4"):
        measure(grid, draw_line(broken))
    with pytest.raises(TerrainError, match="shorter than"):
        measure(grid, draw_line([(0.0, 0.0), (2.0, 0.0)]))


def test_a_zone_ends_the_snow_at_its_edge():
    grid = build_grid(plane(PSI), size=160.0)
    zone = np.array([(-40.0, -30.0), (40.0, -30.0), (40.0, -4.0), (-40.0, -4.0)])
    found = measure(grid, draw_line(ALONG_CONTOUR), zones=(zone,))
    assert found.upslope.end == "zone"
    assert found.upslope.length.value == pytest.approx(16.0 / math.cos(PSI), rel=1e-9)


@pytest.mark.parametrize("turned", [0.0, 0.77])
def test_snow_is_as_deep_as_on_the_flattest_ground_of_a_post(turned):
    """A row stood on 30 degrees below 52: its net was judged by the mean of both."""
    foot, above = math.radians(30.0), math.radians(52.0)

    def height(x, y):
        flat = math.tan(foot) * np.minimum(y, 4.0)
        return 1500.0 + flat + math.tan(above) * np.maximum(y - 4.0, 0.0) + 0.0 * x

    grid = build_grid(height, size=160.0, turned=turned)
    points = [(-15.0, -4.0), (15.0, -4.0)]
    line = draw_line(points, turned=turned, snow_height=3.3)
    row = measure(grid, line)
    assert row.slope.value > math.radians(40.0)
    cells = {one.key: one.value for one in derive_cells(row, [row], "grid.asc")}
    assert cells["snow_thickness"] == pytest.approx(3.3 * math.cos(foot), abs=2e-3)
    typed = draw_line(points, turned=turned, snow_height=3.3, snow_thickness=2.0)
    row = measure(grid, typed)
    assert "snow_thickness" not in {one.key for one in derive_cells(row, [row], "g")}


# --- fault 10: the end of the grid is not the end of the snow; relief is in the band -


def cut_above(grid, north):
    """The grid without its lines north of a place, as a tile ends."""
    count = int((north - grid.south) / grid.cell)
    return replace(grid, heights=grid.heights[:count].copy())


@each("seed", range(12))
def test_beyond_the_edge_or_a_hole_the_length_is_the_cap(seed):
    """Drawn angles, cells, places of the border; never less than the whole ground."""
    rng = np.random.default_rng([61, 10, seed])
    angle, cell = math.radians(rng.uniform(28.0, 48.0)), float(rng.choice(CELLS[1:3]))
    grid = build_grid(plane(angle), cell=cell, size=160.0)
    row = draw_line(ALONG_CONTOUR)
    most = float(rng.uniform(20.0, 45.0))
    whole = measure(grid, row, most=most)
    nearest = 2.5 * cell
    farthest = max(1.01 * nearest, 0.7 * most * math.cos(angle))
    border = -20.0 + float(rng.uniform(nearest, farthest))
    if seed % 2:
        cut = cut_above(grid, border)
    else:
        heights = grid.heights.copy()
        line = int((border - grid.south) / cell)
        heights[line : line + 2] = math.nan
        cut = replace(grid, heights=heights)
    found = measure(cut, row, most=most)
    assert found.upslope.end == "edge"
    assert found.upslope.length.value == most
    assert found.upslope.length.high >= whole.upslope.length.high


@each("seed", range(16))
def test_the_band_holds_the_slope_of_smooth_relief(seed):
    """Drawn waves of 40 m and more down the slope, on cells of 2 and 5 m, no noise."""
    rng = np.random.default_rng([61, 10, 1, seed])
    rise, wave = math.tan(rng.uniform(0.55, 0.8)), float(rng.uniform(40.0, 70.0))
    size, phase = float(rng.uniform(0.02, 0.035)) * wave, float(rng.uniform(0.0, 6.28))
    turn = 2.0 * math.pi / wave
    ground = lambda _, y: rise * y + size * np.sin(turn * y + phase)  # noqa: E731
    cell = (2.0, 5.0)[seed % 2]
    grid = build_grid(ground, cell=cell, size=220.0)
    most = float(rng.uniform(20.0, 50.0))
    found = measure(grid, draw_line(ALONG_CONTOUR), most=most)
    y = np.linspace(-60.0, 80.0, 140_001)
    slope = rise + size * turn * np.cos(turn * y + phase)
    along = np.cumsum(np.hypot(1.0, slope)) * (y[1] - y[0])
    along -= np.interp(-20.0, y, along)
    height = found.line.net_height
    inside = (along > -height) & (along < found.upslope.length.value)
    weights = np.hypot(1.0, slope[inside])
    exact = float((np.arctan(slope[inside]) * weights).sum() / weights.sum())
    assert found.slope.low <= exact <= found.slope.high
    assert found.slope.high - found.slope.low < math.radians(3.0)


@each("value", [0.0, -99.0, -100.0, 400.0])
def test_heights_that_stand_for_no_data_are_asked_about(value):
    heights = build_grid(plane(PSI), cell=5.0, size=160.0).heights.copy()
    require_ground(heights, 5.0)
    heights[3, 4] = value
    with pytest.raises(TerrainError, match=f"to {value:g} m within a cell"):
        require_ground(heights, 5.0)


def ring(*corners):
    return np.array(corners, dtype=float)


@pytest.mark.parametrize("turned", [0.0, 0.61])
def test_a_row_holds_its_bays_up_to_its_reach(turned):
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


def test_a_top_is_still_an_end_of_the_snow():
    """A ridge 25 m above the row in plan; the grid goes on beyond it."""
    grid = build_grid(lambda _, y: -np.abs(y - 5.0) * math.tan(PSI), size=160.0)
    found = measure(grid, draw_line(ALONG_CONTOUR), most=60.0)
    assert found.upslope.end in ("top", "flat")
    assert found.upslope.length.value == pytest.approx(25.0 / math.cos(PSI), abs=4.0)
