"""Drawn untidy states of the flow, and what compares arrays."""

from contextlib import suppress
from dataclasses import replace

import numpy as np

from netdesign.addons.evidence.benchmark.scenes import build_tables, draw_scene
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.steady.compiled import prepare_rounds
from netdesign.coupling.steady.net import SteadyProblem, cut_net
from netdesign.outcome import ModelError
from netdesign.snow.contact import Contact, FlowState, may_lift, start_contact
from netdesign.snow.mesh import build_template, place_nodes
from netdesign.snow.placed_mesh import build_placed_mesh

NUMBERS = range(24)
CLOSE = 1e-10  # relative to the largest entry


def draw_accepted(count):
    """The first random scenes that the model does not refuse."""
    scenes = []
    for number in range(3 * count):
        with suppress(ModelError):
            scenes.append(build_tables(draw_scene(77, number)))
    return scenes[:count]


ACCEPTED = draw_accepted(24)


def draw_case(number):
    """Problem, mesh and state that no solver would call tidy."""
    rng = np.random.default_rng([2411, number])
    scene = ACCEPTED[number]
    problem = replace(scene.steady_flow_problem, element="velocity")
    size = SolverSettings().levels[number % 2]
    template = build_template(scene.modelled_aspect, size, scene.layer_tops)
    height = template.net_fractions
    bulge = rng.uniform(0.02, 0.15) * np.sin(np.pi * height)
    curve = np.array([height * np.tan(scene.net.inclination) + bulge, height])
    mesh = build_placed_mesh(template, place_nodes(template, curve))
    stress = rng.normal(size=(*mesh.weights.shape, 3)) * rng.choice([0.01, 0.3, 2.0])
    shear = None
    if problem.ground == "sliding":
        shear = rng.normal(size=mesh.base_weights.shape) * 0.3
    state = FlowState(
        unknowns=np.zeros(mesh.n_dofs),
        reaction=rng.normal(size=mesh.n_dofs),
        stress=stress,
        base_shear=shear,
        contact=draw_contact(rng, problem, mesh),
    )
    return problem, mesh, state


def draw_contact(rng, problem, mesh):
    """Stick, slip and loss of contact at random nodes of what may lose it."""
    held = start_contact(mesh)
    sign = rng.integers(-1, 2, held.sign.size)
    is_open = np.zeros(sign.size, dtype=bool)
    if problem.net_contact == "one-sided":
        is_open = rng.random(sign.size) < 0.2
    is_lifted = np.zeros(held.is_lifted.size, dtype=bool)
    if problem.ground_contact == "one-sided":
        is_lifted = (rng.random(is_lifted.size) < 0.4) & may_lift(mesh.template)
    if np.isinf(problem.friction):
        sign[:] = 0
    return Contact(
        sign=sign,
        is_pressed=(rng.random(sign.size) < 0.8) & ~is_open,
        is_open=is_open,
        is_lifted=is_lifted,
    )


class FlowInCore:
    """Flow on a drawn mesh that the compiled core takes in a round, some net beside it.

    Attributes
    ----------
    state : FlowState
        After the last step.
    change : float
        Error that it left.
    root : ndarray
        Forces on the net per velocity of its nodes, about that state.
    """

    def __init__(self, problem, mesh, state, *, tolerance, max_iterations):
        curve = mesh.nodes[:, mesh.template.net]
        net = SteadyProblem(
            snow=problem,
            template=mesh.template,
            head=curve[:, -1],
            length=1.2 * np.hypot(*curve[:, -1]),
            slack=0.2,
            stiffness=1e3,
        )
        settings = SolverSettings(max_iterations=max_iterations)
        core = prepare_rounds(net, settings, still=0.0)
        parts = cut_net(mesh.template, 1.0).rises
        results = core._lay_out(np.ones(2), parts)
        core.play(curve, state, tolerance, results)
        self.state, self.change = core.view_state(results), core.argument.effort.change
        self.root = core._condense(results)


def assert_alike(found, expected, close=CLOSE):
    assert np.isfinite(expected).all()
    np.testing.assert_allclose(found, expected, atol=close * np.abs(expected).max())
