"""``netdesign bench`` on the command line."""

import json

import pytest
from click.testing import CliRunner

from netdesign.addons.evidence.benchmark import precision, random_scenes
from netdesign.addons.evidence.benchmark.random_scenes import Attempt
from netdesign.addons.evidence.command import bench
from netdesign.outcome import OutputError


def run(*arguments):
    return CliRunner().invoke(bench, arguments)


def test_rows_and_plot(monkeypatch, tmp_path):
    monkeypatch.setattr(precision, "QUICK", {"finest": 1, "repeats": 1})
    plot = tmp_path / "plot.svg"
    result = run("--quick", "--scenes", "rough-steep", "--json", "--plot", str(plot))
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert [row["path"] for row in document["rows"]] == ["fast"]
    assert plot.read_text(encoding="utf-8").startswith("<svg")
    again = run("--quick", "--scenes", "rough-steep", "--plot", str(plot))
    assert isinstance(again.exception, OutputError)


@pytest.mark.parametrize(
    ("kind", "exit_code"), [("converged", 0), ("refused before", 0), ("failed", 1)]
)
def test_a_failure_decides_the_exit_code(monkeypatch, kind, exit_code):
    monkeypatch.setattr(
        random_scenes,
        "attempt_scenes",
        lambda *_, **__: [Attempt(number=0, kind=kind, reason="why", balance=0.0)],
    )
    result = run("--stress", "1", "--json")
    assert result.exit_code == exit_code
    assert json.loads(result.stdout)["schema"] == "netdesign.stress/1"
    assert run("--stress", "1").exit_code == exit_code
