"""Rows of the benchmark: measured, not invented."""

from dataclasses import replace

import pytest

from netdesign.addons.evidence.benchmark.precision import (
    Row,
    measure_steady,
    summarise,
)
from netdesign.addons.evidence.benchmark.scenes import load_scenes
from netdesign.addons.evidence.measurements import fit_order, share, summarise_times

LEAST = {"finest": 2, "repeats": 1}


@pytest.fixture(scope="module")
def rows():
    scenes = load_scenes(("rough-ground",))
    return measure_steady("rough-ground", scenes["rough-ground"], **LEAST)


def test_finer_meshes_err_less(rows):
    """Each row is solved anew: none is a copy of the one before."""
    coarse, fine = rows
    assert fine.elements > coarse.elements
    assert fine.error < coarse.error
    assert fine.linear_solves > 0


def a_row(**changed) -> Row:
    row = Row(
        scene="a",
        method="steady",
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
    """Time ~ N^1.5, error ~ h^2 = N^-1."""
    rows = [
        a_row(
            elements=place,
            degrees_of_freedom=unknowns,
            wall_s=unknowns**1.5,
            error=1.0 / unknowns,
        )
        for place, unknowns in enumerate((100, 400, 1600))
    ]
    summary = summarise([*rows, a_row(method="transient", wall_s=1e9)])
    assert summary["cost_order"] == pytest.approx(1.5)
    assert summary["worst_cost_order"] == pytest.approx(1.5)
    assert summary["error_order"] == pytest.approx(2.0)


def test_statistics():
    assert summarise_times([float(k) for k in range(1, 22)]) == {
        "median_s": pytest.approx(11.0),
        "p95_s": pytest.approx(20.0),
    }
    assert summarise_times([1.0]) == {"median_s": None, "p95_s": None}
    assert fit_order([1.0, 10.0, 100.0], [2.0, 200.0, 20000.0]) == pytest.approx(2.0)
    assert share([True, False, True, True]) == 0.75
    assert share([]) is None
