"""A step's snow against the readable forms: midpoints on the net folded away."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse

from netdesign.addons.history.settings import TRANSIENT_LEVELS
from netdesign.addons.history.snow import PlainSnow, SnowIterate, take_linear
from netdesign.addons.history.step import assemble_step, condense_step
from netdesign.core.sources import SWITCH, SWITCHED_OFF
from netdesign.snow import forms
from netdesign.snow.law import linearise_creep
from tests.addons.history.starts import begin

STEP = 1e-3
GROUNDS = ["free", "no-slip"]


def start_with(scene, top="held", level=0):
    problem, state = begin(scene, size=TRANSIENT_LEVELS[level])
    return problem, replace(state, top=top)


def fold(template, size):
    """All velocities from those of the nodes that have their own."""
    matrix = sparse.identity(size, format="lil")
    net = template.net
    for below, middle, above in zip(net[:-2:2], net[1::2], net[2::2], strict=True):
        for axis in range(2):
            matrix[2 * middle + axis, 2 * middle + axis] = 0.0
            matrix[2 * middle + axis, 2 * below + axis] = 0.5
            matrix[2 * middle + axis, 2 * above + axis] = 0.5
    return matrix.tocsr()


def solve_forms(snow, carried, forces):
    """Linear creep under forces on the net's nodes, by the forms and a dense solve."""
    mesh, load = snow.mesh, snow.load
    template, problem = mesh.template, load.snow
    linear = linearise_creep(
        take_linear(problem), load.material, np.zeros((*mesh.weights.shape, 3))
    )
    folding = fold(template, mesh.n_dofs)
    matrix = folding.T @ forms.assemble_tangent_form(mesh, linear.modulus) @ folding
    density = np.ones_like(mesh.weights)
    push = folding.T @ forms.assemble_gravity_form(mesh, problem.gravity, density)
    push[2 * carried] += forces[0]
    push[2 * carried + 1] += forces[1]
    free = np.ones(mesh.n_dofs, dtype=bool)
    free[2 * template.ground + 1] = False
    if problem.ground == "no-slip":
        free[2 * template.ground] = False
    for node in np.setdiff1d(template.net, carried):
        free[[2 * node, 2 * node + 1]] = False
    unknowns = np.zeros(mesh.n_dofs)
    inner = matrix[free][:, free].toarray()
    unknowns[free] = np.linalg.solve(inner, push[free])
    return folding @ unknowns


def answer(problem, state, forces):
    """The first iterate under forces, and the equations."""
    equations = assemble_step(problem, state, STEP)
    rest = SnowIterate(np.zeros(2 * state.velocity.shape[1]), None, None)
    found = condense_step(equations, rest, forces).answer(np.zeros(forces.size))
    return equations, found


@pytest.fixture(params=["C", SWITCHED_OFF])
def core(request, monkeypatch):
    monkeypatch.setenv(SWITCH, request.param)


@pytest.mark.parametrize("ground", GROUNDS)
@pytest.mark.parametrize("top", ["held", "on-net"])
@pytest.mark.parametrize("level", [0, 1])
def test_snow_answers_forces_as_the_forms_do(
    a_scene, monkeypatch, core, ground, top, level
):
    scene = a_scene(ground=ground, inclination_deg=20.0)
    problem, state = start_with(scene, top, level)
    forces = np.random.default_rng(level).normal(
        scale=0.1, size=(2, state.carried.size)
    )
    _, found = answer(problem, state, forces)
    monkeypatch.setenv(SWITCH, SWITCHED_OFF)
    snow = assemble_step(problem, state, STEP).snow
    assert isinstance(snow, PlainSnow)
    expected = solve_forms(snow, state.carried, forces)
    np.testing.assert_allclose(
        found.unknowns, expected, atol=1e-9 * np.abs(expected).max()
    )


@pytest.mark.parametrize("friction_deg", [0.0, 5.0, 30.0])
def test_a_corner_that_slips_keeps_to_the_nets_line_and_to_friction(
    a_scene, core, friction_deg
):
    """Along its last segment, with a shear of tan(phi) times the pressure (N14)."""
    scene = a_scene(inclination_deg=30.0, friction_deg=friction_deg)
    problem, state = start_with(scene, "slipping")
    equations, found = answer(problem, state, np.zeros((2, state.carried.size)))
    velocity = equations.split(found.unknowns)[:, equations.template.net[-1]]
    x, y = equations.top_axis
    assert np.hypot(*velocity) > 0.0
    assert y * velocity[0] - x * velocity[1] == pytest.approx(0.0, abs=1e-12)
    force = -equations.pull_vertices(found.imbalance)[:, -1]
    pressure, shear = y * force[0] - x * force[1], x * force[0] + y * force[1]
    size = np.abs(found.imbalance).max()
    assert shear == pytest.approx(problem.snow.friction * pressure, abs=1e-9 * size)
