"""Values that a solve returns."""

from dataclasses import FrozenInstanceError

import pytest

from netdesign.coupling.solution import EndPull, FailedSolution
from netdesign.outcome import Outcome


def test_size_of_a_pull():
    assert EndPull(x=-3.0, y=4.0, error=0.1).size == pytest.approx(5.0, rel=1e-15)


def test_values_are_frozen(solved):
    with pytest.raises(FrozenInstanceError):
        solved().foot.x = 0.0


def test_outcomes(solved):
    assert solved().outcome is Outcome.CONVERGED
    failed = FailedSolution(outcome=Outcome.NONFINITE, reason="because")
    assert not hasattr(failed, "foot")


def test_cost_has_no_clock(solved):
    cost = solved().cost
    assert cost.degrees_of_freedom == 2 * solved().mesh_nodes.shape[1]
    assert min(cost.linear_solves, cost.rounds, cost.elements) > 0
    assert set(cost.__slots__) == {
        "linear_solves",
        "rounds",
        "elements",
        "degrees_of_freedom",
        "skipped",
    }
