"""Random scenes: what converged, was refused or failed; honesty of stated errors."""

import warnings

import numpy as np
import pytest

from netdesign.addons.evidence.benchmark import random_scenes
from netdesign.addons.evidence.benchmark.precision import Truth
from netdesign.addons.evidence.benchmark.random_scenes import (
    Attempt,
    attempt_scene,
    list_accepted,
    write_errors,
    write_stress,
)
from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import Outcome

SEED = 2
ACCEPTED = next(list_accepted(SEED))


def attempt_with(monkeypatch, solve) -> Attempt:
    monkeypatch.setattr(random_scenes, "solve_steady", solve)
    return attempt_scene(ACCEPTED, seed=SEED)


def fail_with(outcome: Outcome):
    return lambda *_: FailedSolution(outcome=outcome, reason="told why")


@pytest.mark.parametrize("outcome", [o for o in Outcome if o is not Outcome.CONVERGED])
def test_only_what_the_model_excludes_is_refused(monkeypatch, outcome):
    attempt = attempt_with(monkeypatch, fail_with(outcome))
    is_refused = outcome in (Outcome.OUT_OF_VALIDITY, Outcome.NO_EQUILIBRIUM)
    assert attempt.kind == ("refused while solving" if is_refused else "failed")
    assert str(attempt.reason) == f"{outcome.value}: told why"


def test_a_bug_is_a_failure(monkeypatch):
    attempt = attempt_with(monkeypatch, lambda *_: 1 / 0)
    assert attempt.kind == "failed"
    assert "ZeroDivisionError" in str(attempt.reason)


def test_a_warning_is_a_failure(monkeypatch):
    def overflow(*_):
        return np.array([1e308]) * 10.0

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        attempt = attempt_with(monkeypatch, overflow)
    assert attempt.kind == "failed"
    assert "overflow" in str(attempt.reason)


@pytest.mark.parametrize(
    ("balance", "kind"), [(1e-8, "converged"), (2e-8, "failed"), (np.nan, "failed")]
)
def test_a_poor_balance_is_a_failure(monkeypatch, solved, balance, kind):
    class Poor:
        """A solution but for its balance."""

        def __getattr__(self, name):
            return getattr(solved(), name)

        @property
        def balance(self):
            return type("Balance", (), {"relative_residual": balance})

    assert attempt_with(monkeypatch, lambda *_: Poor()).kind == kind


ATTEMPTS = [
    Attempt(number=0, kind="converged", cpu_s=0.5, linear_solves=20, balance=1e-10,
            stated_error=0.004),
    Attempt(number=1, kind="converged", cpu_s=0.1, linear_solves=30, balance=3e-9,
            stated_error=0.006),
    Attempt(number=2, kind="refused before", reason="net height = 2.5 m is low"),
    Attempt(number=3, kind="refused before", reason="net height = 1e-3 m is low"),
    Attempt(number=4, kind="refused while solving", reason="out_of_validity: 6% pull",
            cpu_s=2.0),
]  # fmt: skip


def test_one_failure_fails_the_whole():
    failed = Attempt(number=5, kind="failed", reason="diverged", tables={"slope": {}})
    document = write_stress([*ATTEMPTS, failed], 7)
    assert document["pass"] is False
    assert document["failures"] == [
        {"scene": 5, "reason": "diverged", "tables": {"slope": {}}}
    ]


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
    attempt = attempt_scene(ACCEPTED, seed=SEED, is_compared=True)
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
