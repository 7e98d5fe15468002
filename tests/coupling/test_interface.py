"""Forces of the snow on net and ground, the corner that both hold, pressures."""

import math
from dataclasses import replace

import numpy as np
import pytest

from netdesign.coupling.interface import Face, compute_support_forces
from netdesign.snow.flow import solve_flow

GROUNDS = [("free", 0.0), ("sliding", 0.5), ("no-slip", 0.0)]


@pytest.fixture(params=GROUNDS, ids=lambda ground: ground[0])
def case(request, a_mesh, a_flow_problem):
    kind, slip_ratio = request.param
    law = a_flow_problem(ground=kind, slip_ratio=slip_ratio, friction=0.3)
    mesh = a_mesh(inclination_deg=20.0, sag=0.08)
    flow = solve_flow(law, mesh, tolerance=1e-9, max_iterations=60)
    return law, mesh, flow.state, compute_support_forces(law, mesh, flow.state)


def test_supports_carry_the_weight(case):
    law, mesh, _, forces = case
    weight = mesh.area * np.array(law.gravity)
    carried = forces.on_net.sum(axis=1) + forces.on_ground
    np.testing.assert_allclose(carried, weight, atol=1e-10)
    assert forces.unbalanced <= 1e-10


def test_corner_is_shared(case):
    """A quarter of the next midpoint; along a ground without reactions all of it."""
    law, mesh, state, forces = case
    quarter = forces.on_net[:, 1] / 4.0
    assert forces.on_net[1, 0] == pytest.approx(quarter[1], rel=1e-14)
    foot = mesh.template.net[0]
    reaction = state.reaction[2 * foot]
    if law.ground == "no-slip":
        assert forces.on_net[0, 0] == pytest.approx(quarter[0], rel=1e-14)
    else:
        assert forces.on_net[0, 0] == pytest.approx(-reaction, rel=1e-6)


def test_uneven_state_is_noticed(case):
    """Stress changed in one triangle: forces stay on nodes that nothing holds."""
    law, mesh, state, _ = case
    stress = state.stress.copy()
    furthest_upslope = int(np.argmin(mesh.nodes[0, mesh.template.triangles[0]]))
    stress[furthest_upslope] += 0.01
    faulty = compute_support_forces(law, mesh, replace(state, stress=stress))
    assert faulty.unbalanced > 1e-5


PRESSURE, SHEAR = 30e3, 6e3  # [Pa]
TILT = math.radians(30.0)


def build_face(*, is_quadratic):
    """Plane face 4 m high under uniform pressure and upward shear, exact forces."""
    along = np.array([math.sin(TILT), math.cos(TILT)])
    normal = np.array([along[1], -along[0]])
    distances = np.linspace(0.0, 4.0, 9)
    shares = np.full(9, 0.5)
    shares[[0, -1]] = 0.25
    if is_quadratic:  # Simpson: 1 4 2 4 2 4 2 4 1 times h / 6 of each edge of 1 m
        shares = np.array([1, 4, 2, 4, 2, 4, 2, 4, 1]) / 6.0
    traction = PRESSURE * normal + SHEAR * along
    return Face(
        points=np.outer(along, distances),
        forces=np.outer(traction, shares),
        is_quadratic=is_quadratic,
    )


@pytest.mark.parametrize("is_quadratic", [True, False])
def test_pressures_are_those_that_made_the_forces(is_quadratic):
    pressures = build_face(is_quadratic=is_quadratic).pressures
    assert pressures == pytest.approx(np.full(9, PRESSURE))
