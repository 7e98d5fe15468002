"""Snow heights at places: by altitude, and from grids with holes."""

import math

import numpy as np
import pytest

from netdesign.outcome import TerrainError
from netdesign.terrain.grid import Grid
from netdesign.terrain.snow_height import follow_altitude, read_heights

DRAWN = np.random.default_rng(2711)
WEST, SOUTH, CELL = 713.7, 402.9, 3.1


def draw_grid(low, high):
    heights = DRAWN.uniform(low, high, (17, 23))
    return Grid(heights=heights, west=WEST, south=SOUTH, cell=CELL)


def test_a_place_has_the_height_of_its_nearest_cell():
    grid = draw_grid(0.4, 6.3)
    lines, columns = DRAWN.integers(0, (17, 23), (40, 2)).T
    beside = DRAWN.uniform(-0.49, 0.49, (40, 2)) * CELL
    places = np.column_stack([WEST + CELL * columns, SOUTH + CELL * lines]) + beside
    found = read_heights(grid, "snow.asc")(places)
    assert found == pytest.approx(grid.heights[lines, columns])


def test_height_follows_the_altitude_of_the_ground():
    ground = draw_grid(1710.0, 1960.0)
    place = np.array([[WEST + 4 * CELL, SOUTH + 7 * CELL]])
    (found,) = follow_altitude(ground, 3.27, 1800.0, 0.0031)(place)
    above = ground.heights[7, 4] - 1800.0
    assert found == pytest.approx(3.27 + 0.0031 * above)


@pytest.mark.parametrize("value", [math.nan, -0.3, 0.04, 27.1])
def test_a_hole_and_a_height_that_no_row_is_proposed_for_are_told_by_place(value):
    grid = draw_grid(0.4, 6.3)
    grid.heights[5, 6] = value
    find = read_heights(grid, "snow.asc")
    place = (WEST + 6 * CELL, SOUTH + 5 * CELL)
    with pytest.raises(TerrainError) as refused:
        find(np.array([(WEST, SOUTH), place]))
    told = str(refused.value)
    assert told.startswith("snow.asc: ")
    assert f"{place[0]:.1f}, {place[1]:.1f}" in told
    assert "nan" not in told
    assert ("0.1 to 20 m" in told) is not math.isnan(value)


def test_a_place_beyond_the_grid_has_no_height():
    find = read_heights(draw_grid(0.4, 6.3), "snow.asc")
    with pytest.raises(TerrainError, match="hole or ends"):
        find(np.array([(WEST - 0.6 * CELL, SOUTH)]))
