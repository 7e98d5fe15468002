"""One entry for every method: what it prints of its arithmetic is nothing."""

import warnings

import numpy as np

from netdesign.coupling.solution import FailedSolution
from netdesign.outcome import Outcome
from netdesign.solving import solve
from netdesign.words.message import say


def test_arithmetic_that_overflows_ends_as_an_outcome_without_a_warning(
    a_scene, monkeypatch
):
    def overflow(*_):
        assert not np.isfinite(np.array([1e300]) * 1e300 - np.array([np.inf])).all()
        reason = say("panel.steady_only")
        return FailedSolution(outcome=Outcome.NONFINITE, reason=reason)

    monkeypatch.setattr(solve, "solve_steady", overflow)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert solve.solve_scene(a_scene()).outcome is Outcome.NONFINITE
