"""Histories: steps in balance, mass kept, plateau, starts, what ends a run early."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.addons.history import transient
from netdesign.addons.history.moments import select_counted
from netdesign.addons.history.settings import TRANSIENT_LEVELS, TransientSettings
from netdesign.addons.history.transient import run_history, solve_transient
from netdesign.coupling.solution import FailedSolution, Solution
from netdesign.outcome import Outcome, SolveError

COARSE = TRANSIENT_LEVELS[0]
SHORT = 0.02  # creep time in which a sagged net comes to rest


def run(scene, horizon=SHORT, **options):
    return run_history(scene, COARSE, TransientSettings(**options), horizon)


def sizes(moments, end):
    return np.array([np.hypot(*getattr(moment, end)) for moment in moments])


@pytest.mark.parametrize("densifies", [False, True])
def test_mass_is_kept(a_scene, densifies):
    """What crosses the net's line while its nodes are spread anew is counted."""
    masses = []
    history = run_history(
        a_scene(),
        COARSE,
        TransientSettings(densifies=densifies),
        SHORT,
        on_state=lambda state: masses.append(float(state.body.mass.sum())),
    )
    np.testing.assert_allclose(masses, masses[0], rtol=1e-4)
    assert masses[-1] / (1.0 - history.fallen) == pytest.approx(masses[0], rel=1e-12)


@pytest.mark.long
@pytest.mark.parametrize(
    "friction_deg", [pytest.param(15.0, marks=pytest.mark.slow), 30.0]
)
def test_stated_error_holds_on_a_finer_mesh_with_finer_steps(a_scene, friction_deg):
    """Coarse steps on the coarse mesh: the difference shows space and time."""
    scene = a_scene(inclination_deg=30.0, friction_deg=friction_deg)
    settings = TransientSettings(
        start="straight", stops_at_plateau=True, levels=TRANSIENT_LEVELS[:2]
    )
    stated = solve_transient(scene, settings)
    fine = run_history(
        scene, TRANSIENT_LEVELS[2], replace(settings, accuracy=2e-3), 5.0
    )
    for end in ("foot", "head"):
        pull = getattr(stated, end)
        assert pull.error < 0.04 * pull.size
        true = sizes(fine.moments, end).max() * scene.force_scale
        assert abs(pull.size - true) < pull.error


def solve(scene, **options) -> Solution:
    options = {"horizon": 86400.0, "accuracy": 0.1, **options}
    settings = TransientSettings(**options)
    solution = solve_transient(scene, settings)
    assert isinstance(solution, Solution)
    return solution


def test_solution_keeps_the_largest_pull_and_the_plateau(a_scene):
    solution = solve(a_scene(inclination_deg=30.0))
    history = solution.history
    counted = select_counted(history.moments, history.plateau, is_guessed=False)
    assert 0 < len(counted) < len(history.moments)
    assert solution.method == "transient"
    for end in ("foot", "head"):
        pull = getattr(solution, end)
        assert pull.size == pytest.approx(sizes(counted, end).max(), rel=1e-12)
    largest = max(moment.tension_max for moment in counted)
    assert solution.tension_max == pytest.approx(largest, rel=1e-12)
    assert solution.history.plateau.reached
    assert solution.balance.relative_residual < 1e-8


def test_step_that_fails_later_ends_the_history_there(a_scene, monkeypatch):
    """The last good moment stands, and the plateau is not claimed."""
    taken = []

    def fail_late(*arguments, **options):
        if len(taken) >= 4:
            raise SolveError(Outcome.NONFINITE, "broken on purpose")
        taken.append(1)
        return advance(*arguments, **options)

    advance = transient.advance
    monkeypatch.setattr(transient, "advance", fail_late)
    history = run(a_scene())
    assert len(history.moments) <= 4
    assert "broken on purpose" in str(history.ended)
    assert not history.plateau.reached


def test_too_few_steps_are_said(a_scene):
    solution = solve(a_scene(), max_steps=5)
    assert "5 steps were not enough" in str(solution.history.ended)
    assert not solution.history.plateau.reached


def test_first_step_that_fails_is_a_failure(a_scene, monkeypatch):
    def fail(*_, **__):
        raise SolveError(Outcome.NO_EQUILIBRIUM, "nothing holds")

    monkeypatch.setattr(transient, "advance", fail)
    result = solve_transient(a_scene())
    assert isinstance(result, FailedSolution)
    assert result.outcome is Outcome.NO_EQUILIBRIUM
    assert str(result.reason).startswith("first step: ")
    assert "nothing holds" in str(result.reason)
