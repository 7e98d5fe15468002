"""Grids as offices have them, and grids that are none."""

import contextlib

import numpy as np
import pytest

from netdesign.outcome import TerrainError
from netdesign.terrain.grid import parse_grid
from tests.each import each

HEAD = b"ncols 3\nnrows 4\nxllcorner 700.5\nyllcorner 200.25\ncellsize 0.5\n"
ROWS = b"1 2 3\n4 5 6\n7 8 9\n10 11 12\n"


def test_lines_go_from_north_to_south_and_corners_are_no_middles():
    grid = parse_grid(HEAD + b"NODATA_value -9999\n" + ROWS)
    assert grid.heights.tolist() == [[10, 11, 12], [7, 8, 9], [4, 5, 6], [1, 2, 3]]
    assert (grid.west, grid.south, grid.cell) == (700.75, 200.5, 0.5)
    assert (grid.east, grid.north) == (701.75, 202.0)


def test_middles_keys_in_capitals_and_crlf_are_read():
    text = HEAD.replace(b"corner", b"center").upper().replace(b"\n", b"\r\n")
    grid = parse_grid(text + ROWS.replace(b"\n", b"\r\n"))
    assert (grid.west, grid.south) == (700.5, 200.25)


def test_cells_without_data_are_not_known():
    grid = parse_grid(HEAD + b"NODATA_value -32767\n" + ROWS.replace(b"5", b"-32767"))
    assert np.argwhere(np.isnan(grid.heights)).tolist() == [[2, 1]]


@each(
    "content, said",
    [
        (b"", "lacks ncols"),
        (ROWS, "lacks ncols"),
        (HEAD.replace(b"cellsize 0.5\n", b"") + ROWS, "lacks cellsize"),
        (HEAD.replace(b"xllcorner 700.5\n", b"") + ROWS, "lacks xllcorner"),
        (HEAD.replace(b"ncols 3", b"ncols 3 3") + ROWS, "ncols 3 3"),
        (HEAD.replace(b"ncols 3", b"ncols nan") + ROWS, "ncols nan"),
        (HEAD.replace(b"ncols 3", b"ncols 1e9") + ROWS, "16000000 cells"),
        (HEAD.replace(b"ncols 3", b"ncols 3.5") + ROWS, "3.5 x 4"),
        (HEAD.replace(b"ncols 3", b"ncols -3") + ROWS, "-3 x 4"),
        (HEAD.replace(b"ncols 3", b"ncols 4") + ROWS, "12 heights"),
        (HEAD.replace(b"ncols 3", b"ncols 400") + ROWS, "12 heights"),
        (HEAD + ROWS + b"13", "13 heights"),
        (HEAD + ROWS.replace(b"5", b"nan"), "height of nan m"),
        (HEAD + ROWS.replace(b"5", b"1e308"), "height of 1e+308 m"),
        (HEAD + ROWS.replace(b"5", b"inf"), "height of inf m"),
        (HEAD + ROWS.replace(b"5", b"five"), "a height is no number"),
        (HEAD + ROWS.replace(b"5", b"5,1"), "a height is no number"),
        (HEAD.replace(b"0.5", b"0") + ROWS, "a cell of 0 m"),
        (HEAD.replace(b"cellsize 0.5", b"cellsize 1e4") + ROWS, "a cell of 10000 m"),
        (HEAD + b"slope 3\n" + ROWS, "slope"),
        (
            b"ncols 3\nnrows 4\nxllcorner 9.5\nyllcorner 46.9\ncellsize 0.0001\n"
            + ROWS,
            "degrees",
        ),
    ],
)
def test_what_is_no_grid_is_refused_in_words(content, said):
    with pytest.raises(TerrainError) as caught:
        parse_grid(content)
    assert said in str(caught.value)


def test_drawn_bytes_are_a_grid_or_refused():
    draw = np.random.default_rng(5)
    whole = HEAD + ROWS
    read = 0
    for _ in range(600):
        cut = bytearray(whole)
        for place in draw.integers(0, len(cut), draw.integers(1, 3)):
            cut[place] = draw.integers(0, 256)
        with contextlib.suppress(TerrainError):
            grid = parse_grid(bytes(cut))
            known = grid.heights[np.isfinite(grid.heights)]
            assert known.size
            assert float(np.abs(known).max()) <= 9000.0
            read += 1
    assert 0 < read < 600
