"""Honesty of stated errors: what counts as inside, and the report."""

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark import random_scenes
from netdesign.addons.evidence.benchmark.precision import Truth
from netdesign.addons.evidence.benchmark.random_scenes import (
    Attempt,
    attempt_scene,
    list_accepted,
    write_errors,
)

ACCEPTED = next(list_accepted(1))


@pytest.mark.parametrize(
    ("end", "share", "is_inside"),
    [("foot", 0.99, True), ("foot", 1.01, False), ("head", 1.01, False)],
)
def test_each_end_has_to_lie_inside_its_own_error(
    monkeypatch, solved, end, share, is_inside
):
    solution = solved()
    pulls = {
        name: np.array([pull.x, pull.y])
        for name, pull in (("foot", solution.foot), ("head", solution.head))
    }
    error = getattr(solution, end).error
    size = float(np.hypot(*pulls[end]))
    # true pull in the same direction, off by a share of the stated relative error
    pulls[end] *= 1.0 / (1.0 + share * error / size)
    monkeypatch.setattr(random_scenes, "solve_steady", lambda *_: solution)
    monkeypatch.setattr(random_scenes, "solve_truth", lambda *_: Truth(**pulls))
    attempt = attempt_scene(ACCEPTED, seed=1, is_compared=True)
    assert attempt.is_inside is is_inside
    assert attempt.true_error == pytest.approx(share * error / size)
    assert not attempt.reason


def finding(number, true, stated, *, inside=True):
    return Attempt(
        number=number,
        kind="converged",
        true_error=true,
        stated_error=stated,
        is_inside=inside,
        cpu_s=0.1,
    )


@pytest.mark.parametrize(("count", "passes"), [(20, True), (19, False)])
def test_share_that_has_to_be_reached(count, passes):
    findings = [finding(k, 0.001, 0.002) for k in range(count - 1)]
    findings.append(finding(count, 0.006, 0.007))
    document = write_errors(findings, 1, 0.005)
    assert document["share_inside_stated_error"] == 1.0
    assert document["pass"] is passes


def test_what_was_not_compared_never_passes():
    lost = [Attempt(number=k, kind="failed", reason="diverged") for k in range(3)]
    assert write_errors(lost, 1, 0.005)["pass"] is False
    few = [finding(k, 0.001, 0.002) for k in range(2)]
    assert write_errors([*few, *lost], 1, 0.005)["pass"] is False
    assert write_errors([], 1, 0.005)["pass"] is False


def test_what_the_model_excludes_counts_neither_way():
    refused = [
        Attempt(number=k, kind="refused while solving", reason="touches")
        for k in range(9)
    ]
    good = [finding(k, 0.001, 0.002) for k in range(2)]
    document = write_errors([*good, *refused], 1, 0.005)
    assert document["pass"] is True
    assert document["refused_while_solving"] == 9
    assert write_errors(refused, 1, 0.005)["pass"] is False
