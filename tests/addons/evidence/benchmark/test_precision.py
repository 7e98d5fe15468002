"""Rows of the benchmark: measured, not invented."""

from dataclasses import replace

import pytest

from netdesign.addons.evidence.benchmark.precision import (
    Row,
    measure_steady,
    summarise,
)
from netdesign.addons.evidence.benchmark.scenes import load_scenes
from netdesign.addons.evidence.runner import fit_order, share, summarise_times

LEAST = {"finest": 2, "repeats": 1}


@pytest.fixture(scope="module")
def rows():
    scenes = load_scenes(("rough-ground",))
    return measure_steady("rough-ground", scenes["rough-ground"], **LEAST)


def test_paths_err_alike(rows):
    for fast, plain in zip(rows[:4:2], rows[1:4:2], strict=True):
        assert plain.error == pytest.approx(fast.error, rel=1e-5)
        assert plain.linear_solves == fast.linear_solves > 0


def a_row(**changed) -> Row:
    row = Row(
        scene="a",
        method="steady",
        path="fast",
        elements=1,
        degrees_of_freedom=100,
        wall_s=0.01,
        error=0.01,
        stated_error=0.02,
        linear_solves=1,
        rounds=1,
        peak_mb=1.0,
    )
    return replace(row, **changed)


def test_summary_of_known_rows():
    """Time ~ N^1.5, error ~ h^2 = N^-1, the reference path 10, 20, 40 times slower."""
    rows = []
    for place, ratio in enumerate((10.0, 20.0, 40.0)):
        unknowns = 100 * 4**place
        fast = a_row(
            elements=place,
            degrees_of_freedom=unknowns,
            wall_s=unknowns**1.5,
            error=1.0 / unknowns,
        )
        rows += [fast, replace(fast, path="reference", wall_s=ratio * fast.wall_s)]
    found = summarise([*rows, a_row(method="transient", wall_s=1e9)])
    assert found["times_faster"] == pytest.approx(20.0)
    assert found["least_times_faster"] == pytest.approx(10.0)
    assert found["most_times_faster"] == pytest.approx(40.0)
    assert found["cost_order"] == pytest.approx(1.5)
    assert found["worst_cost_order"] == pytest.approx(1.5)
    assert found["error_order"] == pytest.approx(2.0)


def test_statistics():
    assert summarise_times([float(k) for k in range(1, 22)]) == {
        "median_s": pytest.approx(11.0),
        "p95_s": pytest.approx(20.0),
    }
    assert summarise_times([1.0]) == {"median_s": None, "p95_s": None}
    assert fit_order([1.0, 10.0, 100.0], [2.0, 200.0, 20000.0]) == pytest.approx(2.0)
    assert share([True, False, True, True]) == 0.75
    assert share([]) is None
