"""Grids as offices have them, and grids that are none."""

import numpy as np
import pytest

from netdesign.addons.terrain.grid import read_grid
from netdesign.outcome import TerrainError
from tests.each import each

HEAD = b"ncols 3\nnrows 4\nxllcorner 700.5\nyllcorner 200.25\ncellsize 0.5\n"
CELLS = b"1 2 3\n4 5 6\n7 8 9\n10 11 12\n"


@pytest.fixture
def parse_grid(tmp_path):
    """Grid of the bytes of an ASCII file."""

    def parse(content):
        path = tmp_path / "grid.asc"
        path.write_bytes(content)
        return read_grid(path)

    return parse


def test_lines_go_from_north_to_south_and_corners_are_no_middles(parse_grid):
    grid = parse_grid(HEAD + b"NODATA_value -9999\n" + CELLS)
    assert grid.heights.tolist() == [[10, 11, 12], [7, 8, 9], [4, 5, 6], [1, 2, 3]]
    assert (grid.west, grid.south, grid.cell) == (700.75, 200.5, 0.5)


HOLED = HEAD + CELLS.replace(b"5", b"%s")


@each(
    "content",
    [
        HOLED % b"nan",
        HOLED % b"-9999",
        HEAD + b"NODATA_value nan\n" + CELLS.replace(b"5", b"nan"),
        HEAD + b"NODATA_value null\n" + CELLS.replace(b"5", b"null"),
        HEAD + b"NODATA_value -9999\n" + CELLS.replace(b"5", b"-9999.0"),
        HEAD + b"NODATA_value -3.402823e+38\n" + CELLS.replace(b"5", b"-3.402823e+38"),
        b"\xef\xbb\xbf" + HOLED % b"nan" + b"\x1a",
        HEAD.replace(b"cellsize 0.5", b"dx 0.5\ndy 0.5") + CELLS.replace(b"5", b"nan"),
        HEAD.replace(b"\n", b"\n ") + CELLS.replace(b"5", b"nan"),
        HEAD.replace(b".", b",") + CELLS.replace(b"5", b"nan"),
    ],
)
def test_cells_without_data_and_headers_as_other_programs_have_them(
    parse_grid, content
):
    grid = parse_grid(content)
    assert np.argwhere(np.isnan(grid.heights)).tolist() == [[2, 1]]
    assert (grid.west, grid.south, grid.cell) == (700.75, 200.5, 0.5)
    assert grid.heights[0].tolist() == [10.0, 11.0, 12.0]


@each(
    "content, said",
    [
        (b"", "no ESRI ASCII grid"),
        (CELLS, "no ESRI ASCII grid"),
        (HEAD.replace(b"cellsize 0.5\n", b"") + CELLS, "grid.asc: "),
        (
            HEAD.replace(b"xllcorner 700.5\n", b"").replace(b"yllcorner 200.25\n", b"")
            + CELLS,
            "where its cells lie",
        ),
        (HEAD.replace(b"llcorner", b"ulcorner") + CELLS, "where its cells lie"),
        (HEAD.replace(b"xllcorner", b"xllcenter") + CELLS, "where its cells lie"),
        (HEAD.replace(b"ncols 3", b"ncols nan") + CELLS, "grid.asc: "),
        (HEAD.replace(b"ncols 3", b"ncols 9000000") + CELLS, "16000000 cells"),
        (HEAD.replace(b"ncols 3", b"ncols -3") + CELLS, "grid.asc: "),
        (HEAD.replace(b"ncols 3", b"ncols 4") + CELLS, "12 heights"),
        (HEAD.replace(b"ncols 3", b"ncols 400") + CELLS, "12 heights"),
        (HEAD.replace(b"nrows 4", b"nrows 3") + CELLS, "12 heights"),
        (HEAD + CELLS + b"13", "13 heights"),
        (HEAD + CELLS.replace(b"5", b"1e308"), "height of 1e+308 m"),
        (HEAD + CELLS.replace(b"5", b"inf"), "a height is no number"),
        (HEAD + CELLS.replace(b"5", b"five"), "a height is no number"),
        (HEAD + CELLS.replace(b" ", b","), "4 heights"),
        (HEAD + CELLS.replace(b"5", b"-32768"), "a height of -32768 m"),
        (HEAD.replace(b"0.5", b"0") + CELLS, "a cell of 0 m"),
        (HEAD.replace(b"cellsize 0.5", b"cellsize 1e4") + CELLS, "a cell of 10000 m"),
        (HEAD.replace(b"cellsize 0.5", b"dx 0.5\ndy 0.6") + CELLS, "0.5 x 0.6 m"),
        (
            b"ncols 3\nnrows 4\nxllcorner 9.5\nyllcorner 46.9\ncellsize 0.0001\n"
            + CELLS,
            "degrees",
        ),
    ],
)
def test_what_is_no_grid_is_refused_in_words(parse_grid, content, said):
    with pytest.raises(TerrainError) as caught:
        parse_grid(content)
    assert said in str(caught.value)
