"""``netdesign bench`` on the command line."""

import json

import pytest
from click.testing import CliRunner

from netdesign.commands.bench import bench
from netdesign.evidence.benchmark import envelope, precision, stress
from netdesign.evidence.benchmark.precision import Effort
from netdesign.evidence.benchmark.stress import Attempt
from netdesign.outcome import ModelError, OutputError


def run(*arguments):
    return CliRunner().invoke(bench, arguments)


def test_rows_and_plot(monkeypatch, tmp_path):
    monkeypatch.setattr(precision, "QUICK", Effort(finest=1, repeats=1))
    plot = tmp_path / "plot.svg"
    result = run("--quick", "--scenes", "rough-steep", "--json", "--plot", str(plot))
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert [row["path"] for row in document["rows"]] == ["fast", "reference"]
    assert plot.read_text(encoding="utf-8").startswith("<svg")
    again = run("--quick", "--scenes", "rough-steep", "--plot", str(plot))
    assert isinstance(again.exception, OutputError)


def test_unknown_scene():
    assert isinstance(run("--scenes", "no-such").exception, ModelError)


@pytest.mark.parametrize(
    ("kind", "exit_code"), [("converged", 0), ("refused before", 0), ("failed", 1)]
)
def test_a_failure_decides_the_exit_code(monkeypatch, kind, exit_code):
    monkeypatch.setattr(
        stress,
        "run_stress",
        lambda *_, **__: [Attempt(number=0, kind=kind, reason="why", balance=0.0)],
    )
    result = run("--stress", "1", "--json")
    assert result.exit_code == exit_code
    assert json.loads(result.stdout)["schema"] == "netdesign.stress/1"
    assert run("--stress", "1").exit_code == exit_code


ROW = {"what": "one row", "reach": "<= 1 s", "reached": False, "wall_s": 1.5,
       "points": [{"rows": 2}, {"rows": 7}]}  # fmt: skip


@pytest.fixture
def sizes(monkeypatch):
    """Sizes that were asked for; every figure is missed."""
    asked = []

    def measure(size, on_row):
        asked.append(size)
        on_row(dict(ROW))
        return {"schema": envelope.SCHEMA, "pass": False, "rows": [dict(ROW)]}

    monkeypatch.setattr(envelope, "run_envelope_bench", measure)
    return asked


def test_envelope_prints_every_figure_of_its_document(sizes):
    printed = run("--envelope", "--json")
    assert json.loads(printed.stdout)["rows"] == [ROW]
    shown = run("--envelope")
    assert [line.split() for line in shown.stdout.splitlines()] == [
        ["one", "row"],
        ["<=", "1", "s:", "NOT", "reached"],
        ["wall", "time", "[s]", "1.5"],
        *(["points"], ["rows"], ["2"], ["7"]),
    ]
    assert (printed.exit_code, shown.exit_code) == (1, 1)


def test_envelope_in_short_and_at_length(sizes):
    assert run("--envelope", "--quick").exit_code == 0
    run("--envelope", "--missed", "200")
    assert sizes[0] == envelope.QUICK
    assert sizes[1] == envelope.BenchSize(missed_scenes=200)
    assert run("--envelope", "--stress", "2").exit_code == 2
    assert run("--envelope", "--plot", "x.svg").exit_code == 2


def test_errors_of_one_scene():
    result = run("--errors", "1", "--seed", "1", "--accuracy", "0.05", "--json")
    document = json.loads(result.stdout)
    assert document["compared"] == 1
    assert result.exit_code == (0 if document["pass"] else 1)


@pytest.mark.parametrize(
    "arguments",
    [
        ["--stress", "1", "--errors", "1"],
        ["--stress", "1", "--quick"],
        ["--errors", "1", "--plot", "x.svg"],
        ["--stress", "0"],
        ["--jobs", "0"],
    ],
)
def test_usage(arguments):
    assert run(*arguments).exit_code == 2
