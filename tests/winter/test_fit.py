"""Fit to measured forces: what it finds again, what it refuses, what its bands hold."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.winter.fit import fit_season, list_unconstrained
from netdesign.winter.fit_inputs import (
    Noise,
    list_parameters,
    show_value,
    vary_day,
    vary_row,
)
from netdesign.winter.gauss_newton import FAR
from tests.winter.made_up_readings import (
    a_task,
    measure_errors,
    name_design,
    read_forces,
    solve_truth,
    stand_in,
)

SPRING = (139, 146, 153, 161, 169)
SEASON = (90, 100, 113, 127, 161)
WINTER = (92, 99, 106, 113, 120, 127, 134, 141, 148, 155, 162, 169, 176)
NINETY = 1.6449  # deviations within which 90 % of a normal distribution lie
SURVEYED = ("height_factor", "slack", "friction_angle")


def values_of(fitted):
    names = [one.name for one in fitted.parameters]
    return dict(zip(names, map(float, fitted.fit.posterior.values), strict=True))


def assert_recovered(task, places):
    """Slip length and density of own data without noise, both within 1 %."""
    design = name_design(task)
    truth = {"slip_length": design["slip_length"] + 0.53, "density_factor": 0.057}
    forces = solve_truth(task, truth)
    fitted = fit_season(read_forces(task, forces, places))
    found = values_of(fitted)
    assert fitted.ending == "fitted"
    assert set(found) == set(truth)
    for name, value in truth.items():
        assert show_value(name, found[name]) == pytest.approx(
            show_value(name, value), rel=0.01
        )
    (foot,) = (one for one in fitted.forces if one.member == "foot_anchor")
    true = forces[task.governing]["foot_anchor"]
    assert foot.after.value == pytest.approx(true, rel=1e-3)
    assert foot.deviation_after < 0.01 * foot.deviation_before
    assert foot.before.value < true


def test_own_data_of_uniform_snow_give_slip_length_and_density_again():
    assert_recovered(a_task(SPRING, layered=False, known=SURVEYED), SPRING)


@pytest.mark.slow
def test_own_data_of_layers_give_slip_length_and_density_again():
    """Run by ``pytest -m slow tests/winter/test_fit.py``."""
    assert_recovered(a_task(WINTER, layered=True, meshes=3, known=SURVEYED), WINTER)


def assert_uniform_refused(places, meshes, share, known=()):
    """Layers fitted by uniform snow miss by more than three times the noise."""
    noise = Noise(reading=share, cell=0.0, rope=0.0)
    layered = a_task(places, layered=True, meshes=meshes, noise=noise)
    forces = solve_truth(layered, {})
    uniform = a_task(places, layered=False, meshes=meshes, noise=noise, known=known)
    fitted = fit_season(read_forces(uniform, forces, places))
    assert fitted.ending == "misfit"
    assert fitted.rms > 3.0 * noise.reading
    assert fitted.misfit > 3.0
    assert fitted.forces
    assert all(one.after is None for one in fitted.forces)


def test_layers_fitted_by_uniform_snow_are_refused():
    assert_uniform_refused(SEASON, 2, 0.04, known=("friction_angle",))


@pytest.mark.slow
def test_layers_of_a_whole_season_fitted_by_uniform_snow_are_refused():
    """Every parameter is free; run by ``pytest -m slow tests/winter/test_fit.py``."""
    assert_uniform_refused(WINTER, 3, 0.03)


@pytest.fixture(scope="module")
def replaced():
    """A chain of uniform snow on seven days, replaced by parabolas through it."""
    return stand_in(a_task(SPRING, layered=False, noise=Noise()))


def assert_normal(errors):
    """Errors over their deviations are those of a normal distribution.

    Of 200 the share has a standard error of 2 %, the root mean square one of 5 %.
    """
    assert errors.size >= 185
    assert 0.85 <= np.mean(np.abs(errors) <= NINETY) <= 0.95
    assert 0.85 <= math.sqrt(np.mean(errors**2)) <= 1.15


def test_bands_hold_the_force_as_often_as_they_say(replaced):
    """200 seasons of a stand-in for the chain: truth by the priors, default noise.

    The stand-in has the chain's own forces as designed and one deviation of the prior
    to each side, of each parameter for itself. The chain itself is below, slow.
    """
    assert_normal(measure_errors(replaced, SPRING, 200))


@pytest.mark.slow
def test_bands_of_the_chain_itself_hold_the_force_as_often_as_they_say():
    """200 seasons by full solves: ``pytest -m slow -k of_the_chain tests/winter``.

    2 minutes of processor. Seen: 179 of 196 fits (91 %), errors 0.96 times their
    deviations; from seeds 8000 and 9000 on 178 of 193 and 172 of 199. Fewer tell
    little: of the first 77 fits 74 hold.
    """
    task = a_task(SPRING, layered=False, noise=Noise())
    assert_normal(measure_errors(task, SPRING, 200))


def test_the_force_is_known_and_its_parameters_are_not(replaced):
    forces = solve_truth(replaced, {})
    fitted = fit_season(read_forces(replaced, forces, SPRING))
    assert {"density_factor", "friction_angle"} <= set(list_unconstrained(fitted))
    foot = fitted.forces[0]
    assert 0.3 < foot.deviation_before < 0.45
    assert foot.deviation_after < 0.25 * foot.deviation_before
    assert fitted.misfit < 1e-3


def test_a_wrong_cell_is_refused(replaced):
    """One cell of two shows half the force: no parameter has that."""
    forces = solve_truth(replaced, {})
    halved = {k: one | {"post": one["post"] / 2.1} for k, one in forces.items()}
    quiet = replace(replaced, noise=Noise(reading=0.03, cell=0.02, rope=2.0))
    fitted = fit_season(read_forces(quiet, halved, SPRING))
    assert fitted.ending in ("misfit", "far")
    assert all(one.after is None for one in fitted.forces)


def test_forces_that_ask_for_the_impossible_are_refused(replaced):
    """Nine times the force fits no parameters within three deviations of the priors."""
    forces = solve_truth(replaced, {})
    far = {k: {m: 9.1 * f for m, f in one.items()} for k, one in forces.items()}
    fitted = fit_season(read_forces(replaced, far, SPRING))
    assert fitted.ending in ("misfit", "far")


def test_few_readings_are_not_fitted(replaced):
    forces = solve_truth(replaced, {})
    fitted = fit_season(read_forces(replaced, forces, SPRING[:4]))
    assert (fitted.ending, fitted.fit, fitted.forces) == ("few", None, ())


def test_a_day_that_the_model_cannot_solve_is_left_out(replaced):
    failed = replace(replaced.days[139], ending="failed")
    task = replace(replaced, days=replaced.days | {139: failed})
    forces = solve_truth(replaced, {})
    fitted = fit_season(read_forces(task, forces, SPRING))
    assert fitted.left_out == (139,)
    assert fitted.ending == "few"


def test_layers_are_scaled_and_not_joined_anew():
    task = a_task(SEASON, layered=True)
    day = task.days[113]
    taller = vary_day(
        day, task.row, {"height_factor": math.log(1.07), "density_factor": -0.04}
    )
    assert taller.thickness == pytest.approx(1.07 * day.thickness)
    assert len(taller.layers) == len(day.layers)
    for before, after in zip(day.layers, taller.layers, strict=True):
        assert after.thickness == pytest.approx(1.07 * before.thickness)
        lighter = before.density * math.exp(-0.04)
        assert after.density == pytest.approx(max(lighter, 100.0))


def test_parameters_are_those_that_the_row_has():
    task = a_task(SPRING, layered=False)
    row = task.row
    names = [one.name for one in list_parameters(row, ("slack",), 2.9)]
    assert names == ["slip_length", "density_factor", "height_factor", "friction_angle"]
    ground = replace(row.scene.ground, kind="no-slip", slip_length=0.0)
    stuck = replace(row, scene=replace(row.scene, ground=ground))
    by_name = {one.name: one for one in list_parameters(stuck, (), 2.9)}
    assert "slip_length" not in by_name
    low, high = by_name["slack"].ends
    assert low == 0.0
    assert high == pytest.approx(0.03 + FAR * 0.015)
    assert by_name["height_factor"].ends[1] == pytest.approx(math.log(3.0 / 2.9))


def test_a_row_takes_its_parameters():
    task = a_task(SPRING, layered=False)
    values = {"slip_length": math.log(7.3), "slack": 0.041, "friction_angle": 0.61}
    scene = vary_row(task.row, values).scene
    assert scene.ground.slip_length == pytest.approx(7.3)
    assert (scene.net.slack, scene.net.friction_angle) == (0.041, 0.61)
    assert np.isclose(vary_row(task.row, {}).scene.net.slack, 0.03)
