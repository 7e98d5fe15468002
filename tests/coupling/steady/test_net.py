"""The net under the forces of the snow, with and without a free top."""

import numpy as np
import pytest

from netdesign.coupling.scene import MESH_LEVELS
from netdesign.coupling.steady.net import (
    SteadyProblem,
    find_contact_curve,
    hang_net,
    locate_nodes,
    start_net,
)
from netdesign.snow.mesh import build_template


@pytest.fixture
def build_problem(a_flow_problem):
    def build(height, interfaces=()):
        return SteadyProblem(
            snow=a_flow_problem(),
            template=build_template(5.0, MESH_LEVELS[0], interfaces),
            head=np.array([0.5, height]),
            length=1.05 * float(np.hypot(0.5, height)),
            slack=0.05,
            stiffness=500.0,
        )

    return build


@pytest.mark.parametrize("height", [1.0, 1.001, 1.3])
def test_contact_ends_where_the_snow_ends(build_problem, height):
    problem = build_problem(height)
    net = start_net(problem)
    curve = find_contact_curve(problem, net)
    assert curve.shape == (2, problem.template.net.size)
    assert curve[:, 0] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert curve[1, -1] == pytest.approx(1.0, abs=1e-9)
    assert net.cable.curve[:, -1] == pytest.approx(problem.head, abs=1e-9)
    assert net.parts.size == 1 + problem.has_freeboard
    assert net.lengths.sum() == pytest.approx(problem.length, rel=1e-12)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("height", [1.0, 1.27])
def test_layers_end_at_their_heights_on_the_net(build_problem, height, seed):
    """However far it bulges: a node lies there, spaced as the template has them."""
    rng = np.random.default_rng(seed)
    tops = tuple(np.sort(rng.uniform(0.1, 0.9, rng.integers(1, 4))).tolist())
    problem = build_problem(height, tops)
    first = start_net(problem)
    forces = first.forces[:, : problem.template.net.size]
    spread = forces * rng.uniform(0.2, 1.8, forces.shape)
    net = hang_net(problem, spread, first.cable.pull, first.parts)
    curve = find_contact_curve(problem, net)
    fractions = problem.template.net_fractions
    for top in (*tops, 1.0):
        node = np.abs(fractions - top).argmin()
        assert curve[1, node] == pytest.approx(top, abs=1e-9)
    places = locate_nodes(problem.template, net)
    for low, high in zip((0.0, *tops), (*tops, 1.0), strict=True):
        inside = (fractions > low - 1e-9) & (fractions < high + 1e-9)
        spacing = np.diff(places[inside]) / np.diff(fractions[inside])
        np.testing.assert_allclose(spacing, spacing[0], rtol=1e-8)
    assert net.lengths.sum() == pytest.approx(problem.length, rel=1e-11)


@pytest.mark.parametrize("height", [1.0, 1.3])
def test_the_net_holds_the_forces_in_its_ends_alone(build_problem, height):
    problem = build_problem(height)
    first = start_net(problem)
    on_net = 2.0 * first.forces[:, : problem.template.net.size]
    cable = hang_net(problem, on_net, first.cable.pull, first.parts).cable
    held = cable.foot_pull + cable.head_pull
    assert held == pytest.approx(on_net.sum(axis=1), rel=1e-9)
