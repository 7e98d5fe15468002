"""Slopes of a fit: those of finer solves, and of the sizes that the theory gives."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.winter.fit import FIT_SETTINGS
from netdesign.winter.fit_inputs import PRIOR_DEVIATIONS, list_parameters
from netdesign.winter.gauss_newton import differentiate
from tests.winter.made_up_readings import GOVERNING, MEMBERS, a_task, solve_truth

# d ln F of the foot, widened by a tenth (winter/THEORY.md, section 5; slack: seen on a
# prototype of the same chain).
EXPECTED = {
    "slip_length": (0.13, 0.20),
    "density_factor": (1.1, 1.3),
    "height_factor": (1.5, 1.9),
    "slack": (-13.0, -9.0),
}


def build_respond(task, names):
    def respond(values):
        forces = solve_truth(task, dict(zip(names, map(float, values), strict=True)))
        return np.log([forces[GOVERNING][member] for member in MEMBERS])

    return respond


def list_slopes(task):
    """Slopes as a fit takes them, one line a member; its parameters."""
    parameters = list_parameters(task.row, (), task.days[GOVERNING].thickness)
    respond = build_respond(task, [one.name for one in parameters])
    means = np.array([one.mean for one in parameters])
    return differentiate(respond, means, respond(means), parameters).slopes, parameters


def test_force_follows_its_parameters_by_the_powers_of_the_theory():
    slopes, parameters = list_slopes(a_task((), layered=True))
    by_name = dict(zip([one.name for one in parameters], slopes[0], strict=True))
    for name, (low, high) in EXPECTED.items():
        assert low <= by_name[name] <= high, name
    assert abs(by_name["friction_angle"]) * PRIOR_DEVIATIONS["friction_angle"] < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("layered", [False, True])
def test_slopes_of_a_fit_are_those_of_finer_solves(layered):
    """Of a force per deviation of the prior 0.002, by slack 0.01: one-sided steps.

    Central differences on four meshes; ``pytest -m slow tests/winter/test_slopes.py``.
    """
    task = a_task((), layered=layered)
    solver = replace(task.solver, settings=FIT_SETTINGS)
    slopes, parameters = list_slopes(replace(task, solver=solver))
    fine = SolverSettings(accuracy=5e-4, levels=MESH_LEVELS[:4])
    solver = replace(task.solver, settings=fine)
    respond = build_respond(
        replace(task, solver=solver), [one.name for one in parameters]
    )
    means = np.array([one.mean for one in parameters])
    for k, one in enumerate(parameters):
        step = np.where(np.arange(means.size) == k, one.step, 0.0)
        central = (respond(means + step) - respond(means - step)) / (2.0 * one.step)
        away = np.abs(slopes[:, k] - central) * one.deviation
        assert away.max() <= (0.01 if one.name == "slack" else 0.002), one.name
