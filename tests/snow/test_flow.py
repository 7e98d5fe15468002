"""Flow of one instant: its law, its equilibrium, contact with net and ground."""

from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS, Scene, SolverSettings
from netdesign.coupling.steady.solve import solve_steady
from netdesign.outcome import Outcome
from netdesign.snow import flow, kernel
from netdesign.snow.contact import free_unknowns, start_contact
from netdesign.snow.flow import solve_flow
from netdesign.snow.flow_step import compute_residual, remove_rounding
from netdesign.snow.law import (
    STRESS_FLOOR,
    Material,
)
from netdesign.snow.placed_mesh import build_placed_mesh
from tests.each import each

TIGHT = 1e-9

GROUNDS = [("free", 0.0), ("sliding", 0.5), ("no-slip", 0.0)]


def material(law):
    layer = law.layers[0]
    return Material(layer.bulk_ratio, layer.fluidity_ratio, layer.density)


def solve(law, mesh, start=None):
    result = solve_flow(law, mesh, start, tolerance=TIGHT, max_iterations=60)
    assert result.outcome is Outcome.CONVERGED
    return result.state


def forces_on_net(mesh, state):
    """Normal and tangential nodal forces of the snow on the net above its foot."""
    above_foot = mesh.template.net[1:]
    return -state.reaction[2 * above_foot], -state.reaction[2 * above_foot + 1]


def slip_velocity(mesh, state):
    return state.unknowns[2 * mesh.template.net[1:] + 1]


@pytest.fixture
def inclined(a_mesh):
    return a_mesh(inclination_deg=30.0, sag=0.08)


# --- law ---------------------------------------------------------------------


@pytest.mark.parametrize("exponent", [1.0, 3.0])
def test_converged_stress_and_velocity_obey_the_law(inclined, a_flow_problem, exponent):
    law = a_flow_problem(exponent=exponent)
    state = solve(law, inclined)
    compliance = np.linalg.inv(material(law).stiffness)
    squared = ((state.stress @ compliance) * state.stress).sum(axis=-1)
    squared += STRESS_FLOOR**2
    expected = squared[..., None] ** ((exponent - 1) / 2) * (state.stress @ compliance)
    found = kernel.compute_strain(inclined, state.unknowns)
    scale = np.sqrt((inclined.weights[..., None] * expected**2).sum())
    missing = np.sqrt((inclined.weights[..., None] * (found - expected) ** 2).sum())
    assert missing <= 1e-7 * scale  # stresses to TIGHT, strain rates n times worse


# --- equilibrium -------------------------------------------------------------


@pytest.mark.parametrize(("ground", "slip_ratio"), GROUNDS)
def test_equilibrium_where_nothing_holds(inclined, a_flow_problem, ground, slip_ratio):
    law = a_flow_problem(ground=ground, slip_ratio=slip_ratio)
    state = solve(law, inclined)
    residual = compute_residual(law, inclined, state)
    free = free_unknowns(law, inclined, start_contact(inclined))
    free[2 * inclined.template.net + 1] = False
    np.testing.assert_allclose(residual[free], 0.0, atol=1e-11)
    np.testing.assert_allclose(residual, state.reaction, atol=1e-8)


# --- contact -----------------------------------------------------------------


@each("friction", [0.05, 0.15, 0.4])
@each("inclination", [0.0, 30.0])
def test_coulomb(a_mesh, a_flow_problem, inclination, friction):
    """(N14): at the limit and along the slip where it slips, below it elsewhere."""
    mesh = a_mesh(inclination_deg=inclination, sag=0.08)
    state = solve(a_flow_problem(friction=friction), mesh)
    normal, shear = forces_on_net(mesh, state)
    velocity = slip_velocity(mesh, state)
    slips = state.contact.sign != 0
    pressed = normal > 0.0
    limit = friction * np.maximum(normal, 0.0)
    np.testing.assert_allclose(velocity[~slips], 0.0, atol=0.0)
    on = slips & pressed
    np.testing.assert_allclose(
        shear[on], (limit * np.sign(velocity))[on], atol=1e-10 * normal.max()
    )
    assert (np.abs(shear) <= limit + 1e-9 * normal.max()).all()


# --- iteration ---------------------------------------------------------------


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3, 1.0])
def test_result_does_not_depend_on_the_start(inclined, a_flow_problem, friction):
    law = a_flow_problem(friction=friction)
    cold = solve(law, inclined)
    other = replace(law, friction=1.0 - friction, exponent=1.5, gravity=(1.0, 0.0))
    warm = solve(law, inclined, solve(other, inclined))
    scale = np.abs(cold.stress).max()
    np.testing.assert_allclose(warm.stress, cold.stress, atol=1e-7 * scale)
    np.testing.assert_array_equal(warm.contact.sign, cold.contact.sign)


# --- rounding ----------------------------------------------------------------


@pytest.mark.parametrize(("ground", "slip_ratio"), GROUNDS)
@pytest.mark.parametrize(
    ("element", "bulk_ratio"), [("velocity", 1.8), ("mixed", 99.0)]
)
def test_last_correction_gives_the_balance_back(
    a_flow_problem, inclined, ground, slip_ratio, element, bulk_ratio
):
    """(N17), with stresses as badly rounded as if velocities were 1e8 times larger."""
    law = a_flow_problem(
        ground=ground, slip_ratio=slip_ratio, bulk_ratio=bulk_ratio, friction=0.3
    )
    law = replace(law, element=element)
    mesh = build_placed_mesh(inclined.template, inclined.nodes, element)
    state = solve(law, mesh)
    noise = np.random.default_rng(7).uniform(-1e-8, 1e-8, state.stress.shape)
    rounded = replace(state, stress=state.stress * (1.0 + noise))
    free = free_unknowns(law, mesh, state.contact)
    free[2 * mesh.template.net + 1] = False  # friction acts there
    free[mesh.n_velocities :] = False

    def lost(of):
        return np.abs(compute_residual(law, mesh, of)[free]).max()

    assert lost(rounded) > 1e-10
    assert lost(remove_rounding(law, mesh, rounded)) < 1e-13


def test_iteration_cap(inclined, a_flow_problem):
    result = solve_flow(a_flow_problem(), inclined, tolerance=TIGHT, max_iterations=3)
    assert result.outcome is Outcome.MAX_ITERATIONS
    assert result.linear_solves == 4  # the start and three steps
    assert result.change > TIGHT


def test_nonfinite_step(inclined, a_flow_problem, monkeypatch):
    start = solve(a_flow_problem(), inclined)
    spoilt = replace(start, reaction=np.full(inclined.n_dofs, np.nan))
    monkeypatch.setattr(flow, "take_step", lambda *_: spoilt)
    result = solve_flow(a_flow_problem(), inclined, start, tolerance=TIGHT)
    assert (result.outcome, result.linear_solves) == (Outcome.NONFINITE, 1)


@pytest.mark.parametrize(("ground", "slip_ratio"), GROUNDS)
def test_velocities_on_net_and_ground(inclined, a_flow_problem, ground, slip_ratio):
    law = a_flow_problem(ground=ground, slip_ratio=slip_ratio)
    velocity = inclined.to_slope_axes(solve(law, inclined).unknowns)
    template = inclined.template
    assert np.abs(velocity[1, template.ground]).max() == 0.0
    if ground == "no-slip":
        assert np.abs(velocity[0, template.ground]).max() == 0.0
    else:
        assert velocity[0, template.ground[-1]] > 0.0
    normal = (velocity[:, template.net] * inclined.net_normal).sum(axis=0)
    np.testing.assert_allclose(normal, 0.0, atol=1e-16)


@pytest.mark.parametrize(("ground", "slip_length_m"), [("free", 0.0), ("no-slip", 0.0)])
@pytest.mark.parametrize("friction_deg", [5.0, 30.0])
def test_halving_the_stress_floor_moves_no_end_force(
    a_scene, monkeypatch, ground, slip_length_m, friction_deg
):
    """Less than 1e-5 of it, as the constant's comment says."""
    scene = a_scene(inclination_deg=30.0, friction_deg=friction_deg, ground=ground)
    settings = SolverSettings(
        accuracy=0.1,
        stress_tolerance=1e-8,
        shape_tolerance=1e-7,
        levels=MESH_LEVELS[1:3],
    )
    original = Scene.flow_problem.fget
    pulls = []
    for factor in (1.0, 0.5):
        floor = STRESS_FLOOR * factor
        monkeypatch.setattr(
            Scene,
            "flow_problem",
            property(lambda s, f=floor: replace(original(s), stress_floor=f)),
        )
        solution = solve_steady(scene, settings, on_failure="raise")
        pulls.append(
            [solution.foot.x, solution.foot.y, solution.head.x, solution.head.y]
        )
    tension = np.hypot(*pulls[0][:2])
    np.testing.assert_allclose(pulls[1], pulls[0], atol=1e-5 * tension)


@pytest.mark.parametrize("fault", [np.nan, np.inf])
def test_nonfinite_load(inclined, a_flow_problem, fault):
    law = replace(a_flow_problem(), gravity=(fault, -1.0))
    with np.errstate(invalid="ignore"):
        result = solve_flow(law, inclined, tolerance=TIGHT)
    assert result.outcome is Outcome.NONFINITE
