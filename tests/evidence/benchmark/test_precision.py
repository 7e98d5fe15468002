"""Rows of the benchmark: measured, not invented."""

import json
from dataclasses import replace

import pytest

from netdesign.coupling.solution import FailedSolution
from netdesign.evidence.benchmark import precision
from netdesign.evidence.benchmark.precision import (
    Row,
    measure_steady,
    summarise,
    time_accuracies,
    write_bench,
)
from netdesign.evidence.benchmark.scenes import HISTORY_SCENES, SCENES, load_scenes
from netdesign.evidence.runner import fit_order, share, summarise_times
from netdesign.outcome import ModelError, Outcome, SolveError

LEAST = {"finest": 2, "repeats": 1}
# Keys that scripts rely on.
KEYS = {
    *("scene", "method", "path", "elements", "degrees_of_freedom", "wall_s", "error"),
    *("linear_solves", "peak_mb"),
}


@pytest.fixture(scope="module")
def rows():
    scenes = load_scenes(("rough-ground",))
    return measure_steady("rough-ground", scenes["rough-ground"], **LEAST)


def test_both_paths_on_every_mesh(rows):
    assert [row.path for row in rows] == ["fast", "reference"] * 2
    assert rows[0].elements == rows[1].elements < rows[2].elements


def test_paths_err_alike(rows):
    for fast, plain in zip(rows[:4:2], rows[1:4:2], strict=True):
        assert plain.error == pytest.approx(fast.error, rel=1e-5)
        assert plain.linear_solves == fast.linear_solves > 0


def test_what_is_measured(rows):
    for row in rows:
        assert row.wall_s > 0.0
        assert 0.0 < row.error < 0.02
        # a double of 8 bytes for each gradient of a shape function at least:
        # 3 points, 2 directions, 6 nodes
        assert row.peak_mb > row.elements * 3 * 2 * 6 * 8 / 1e6


def test_document(rows):
    document = json.loads(json.dumps(write_bench(rows, []), allow_nan=False))
    assert document["schema"] == "netdesign.bench/1"
    assert len(document["rows"]) == len(rows)
    assert all(row.keys() >= KEYS for row in document["rows"])


def test_accuracies_are_timed_to_the_mesh_that_states_them(monkeypatch):
    scenes, asked = load_scenes(("paper-30", "smooth-net")).values(), []

    def note(scene, settings):
        asked.append((scene, settings.accuracy))

    monkeypatch.setattr(precision, "solve_steady", note)
    shown = time_accuracies(scenes, repeats=2)
    accuracies = [one["accuracy"] for one in shown]
    assert accuracies == sorted(accuracies, reverse=True)
    assert asked == [(k, a) for a in accuracies for k in scenes for _ in range(2)]
    assert all(0.0 < one["median_s"] <= one["p95_s"] for one in shown)


def test_a_failed_solve_is_no_row(monkeypatch):
    failed = FailedSolution(outcome=Outcome.DIVERGED, reason="why")
    monkeypatch.setattr(precision, "solve_steady", lambda *_, **__: failed)
    with pytest.raises(SolveError, match="why"):
        measure_steady("x", load_scenes(("paper-0",))["paper-0"], **LEAST)


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


def test_summary_of_too_few_rows():
    found = summarise([a_row()])
    assert found["times_faster"] is found["cost_order"] is found["error_order"] is None


def test_statistics():
    assert summarise_times([float(k) for k in range(1, 22)]) == {
        "median_s": pytest.approx(11.0),
        "p95_s": pytest.approx(20.0),
    }
    assert summarise_times([1.0]) == {"median_s": None, "p95_s": None}
    assert fit_order([1.0, 10.0, 100.0], [2.0, 200.0, 20000.0]) == pytest.approx(2.0)
    assert share([True, False, True, True]) == 0.75
    assert share([]) is None


def test_named_scenes_span_the_ranges():
    scenes = load_scenes()
    assert len(scenes) >= 12
    assert set(HISTORY_SCENES) <= set(scenes)
    grounds = {tables["ground"]["law"] for tables in SCENES.values()}
    assert grounds == {"free", "no-slip", "sliding"}
    ends = [("slope", "angle_deg", 28, 55), ("net", "friction_deg", 0, 45)]
    for table, key, low, high in [*ends, ("net", "inclination_deg", 0, 40)]:
        values = [tables[table][key] for tables in SCENES.values()]
        assert (min(values), max(values)) == (low, high)
    assert max(tables["net"]["slack"] for tables in SCENES.values()) >= 0.15


def test_unknown_scenes_are_named():
    with pytest.raises(ModelError, match=r"no-such.*accepted are dense-firn"):
        load_scenes(("paper-0", "no-such"))
