"""Velocity and stress of the snowpack at one instant, against a net at rest.

The stress, not the velocity, is iterated. The creep law gives the strain rate as a
*polynomial* of the stress. So Newton's method on the complementary energy needs fewer
steps than the usual one, whose viscosity is unbounded where the snow hardly deforms.
Every full step is in equilibrium exactly (N10). Theory: snow/THEORY.md, section 2.
Last: a flow on one mesh as the start of that on another.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import Outcome
from netdesign.snow.contact import Contact, FlowState, change_some, rest, update_contact
from netdesign.snow.element import interpolate_reference
from netdesign.snow.flow_step import take_step
from netdesign.snow.kernel import SingularError
from netdesign.snow.law import (
    FlowProblem,
    Material,
    sample_material,
    squared_invariant,
)
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import PlacedMesh

# Error that a Newton step leaves, (N16): a share of the step where contacts still
# change, else a multiple of its square (measured on random scenes: 95 % stay below).
LINEAR_PART, SQUARE_FACTOR = 0.05, 50.0
# After so many steps only some contacts change, after twice as many one at a time.
PATIENCE = 12
# Weight of an error of the stress that the forces on the net do not feel: it sits in
# the few small triangles at the net's ends.
FIELD_WEIGHT = 0.05


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FlowResult:
    """End of a flow solve.

    Attributes
    ----------
    outcome : Outcome
        Converged, or why not.
    state : FlowState
        Usable only if converged.
    linear_solves : int
        Taken.
    change : float
        Relative error that the last step left, (N16) [-].
    """

    outcome: Outcome
    state: FlowState
    linear_solves: int
    change: float


def solve_flow(
    problem: FlowProblem,
    mesh: PlacedMesh,
    start: FlowState | None = None,
    *,
    tolerance: float,
    max_iterations: int = 40,
) -> FlowResult:
    """Stress and velocity in equilibrium with gravity, ground and net.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.
    start : FlowState, optional
        State on a neighbouring placement of the same template.
    tolerance : float
        Largest relative error that the last step may leave [-]: in the sum of the
        forces on the net from its foot to any node, or 20 times that in the stress.
    max_iterations : int
        Newton steps allowed.

    Returns
    -------
    FlowResult
        With outcome converged, max_iterations or nonfinite; never raises for a
        failed iteration.

    Verified by
    -----------
    tests/snow/test_flow.py, tests/verification/test_slab.py
    """
    material = sample_material(problem, mesh.template)
    state = _solve_linear_creep(problem, mesh) if start is None else start
    solves = 1 if start is None else 0
    outcome, change = Outcome.MAX_ITERATIONS, np.inf
    contact = state.contact
    if state.unknowns.any():
        contact = update_contact(problem, mesh, contact, state.unknowns, state.reaction)
    for iteration in range(max_iterations):
        before = state
        try:
            state = take_step(problem, material, mesh, before, contact)
        except SingularError:
            outcome = Outcome.NONFINITE
            break
        solves += 1
        change = _estimate_left(problem, material, mesh, before, state, tolerance)
        if not np.isfinite(change):
            outcome = Outcome.NONFINITE
            break
        contact = update_contact(problem, mesh, contact, state.unknowns, state.reaction)
        if change < tolerance and contact.equals(state.contact):
            outcome = Outcome.CONVERGED
            break
        if iteration >= PATIENCE:
            contact = change_some(
                state.contact, contact, only_first=iteration >= 2 * PATIENCE
            )
    return FlowResult(outcome=outcome, state=state, linear_solves=solves, change=change)


def compute_weight(problem: FlowProblem, mesh: PlacedMesh) -> Floats:
    """Weight of the snow on the mesh, and load on its end.

    Parameters
    ----------
    problem : FlowProblem
        Creep, ground and friction.
    mesh : PlacedMesh
        Mesh against the net's curve.

    Returns
    -------
    ndarray, shape (2,)
        In the slope's axes [rho g d^2].
    """
    material = sample_material(problem, mesh.template)
    weight = np.array(problem.gravity) * float((mesh.weights * material.density).sum())
    return np.asarray(weight + np.array([problem.end_load, 0.0]))


def _estimate_left(
    problem: FlowProblem,
    material: Material,
    mesh: PlacedMesh,
    before: FlowState,
    state: FlowState,
    tolerance: float,
) -> float:
    """Relative error that a step leaves, eq. (N16); of the forces alone if too much."""
    sums = _sum_along_net(mesh, state.reaction)
    moved = sums - _sum_along_net(mesh, before.reaction)
    force = _left(float(np.hypot(*moved).max() / np.hypot(*sums).max()))
    if force >= tolerance:
        return force
    size = _stress_norm(problem, material, mesh, state.stress)
    field = _stress_norm(problem, material, mesh, state.stress - before.stress) / size
    return float(np.maximum(force, FIELD_WEIGHT * _left(field)))


def _left(change: float) -> float:
    """Relative error that a step of this relative size leaves."""
    return float(np.minimum(change, LINEAR_PART * change + SQUARE_FACTOR * change**2))


def _sum_along_net(mesh: PlacedMesh, reaction: Floats) -> Floats:
    """Sums of the net's forces from the foot to each node, shape (2, n_net)."""
    return np.cumsum(mesh.net_in_slope_axes(reaction), axis=1)


def _solve_linear_creep(problem: FlowProblem, mesh: PlacedMesh) -> FlowState:
    """Linear creep of snow held everywhere: a start that needs no guess."""
    at_rest, linear = rest(problem, mesh), make_linear(problem)
    material = sample_material(linear, mesh.template)
    return take_step(linear, material, mesh, at_rest, at_rest.contact)


def make_linear(problem: FlowProblem) -> FlowProblem:
    """The problem with linear creep, whose layers share the stress about as given.

    Layers that deform together carry stresses as their fluidities to the power -1/n.
    """
    layers = tuple(
        replace(layer, fluidity_ratio=layer.fluidity_ratio ** (1.0 / problem.exponent))
        for layer in problem.layers
    )
    return replace(problem, exponent=1.0, slip_exponent=None, layers=layers)


def _stress_norm(
    problem: FlowProblem, material: Material, mesh: PlacedMesh, stress: Floats
) -> float:
    size = squared_invariant(problem, material, stress)
    return float(np.sqrt((mesh.weights * size).sum()))


# Added between layers, more than any distance in one [thickness].
_FAR_APART = 1e4
# Points whose distances from all others are in the processor's cache. A tree of points
# finds the nearest sooner, but is imported for as long as twenty meshes take.
_AT_ONCE = 256


def transfer_state(
    state: FlowState, source: MeshTemplate, target: MeshTemplate
) -> FlowState:
    """State carried to another mesh: a guess, in equilibrium with nothing.

    Stresses are those of the nearest quadrature point, contacts those of the nearest
    support node, both in the coordinates of what was triangulated; velocities and
    reactions are 0 and take the first step to be right.

    Parameters
    ----------
    state : FlowState
        On the old mesh.
    source, target : MeshTemplate
        Of the old and of the new mesh, both of the same snowpack.
    """
    source, target = source.origin, target.origin
    points = _nearest_points(source, target)
    per_triangle, rows = state.stress.shape[1:]
    stress = state.stress.reshape(-1, rows)[points]
    n_dofs = 2 * target.nodes.shape[1] + (target.n_vertices if rows > 3 else 0)
    on_net, on_ground = _nearest_nodes(source, target)
    base_shear = None
    if state.base_shear is not None:
        base_shear = _resample_base(state.base_shear, source, target)
    contact = state.contact
    return FlowState(
        unknowns=np.zeros(n_dofs),
        reaction=np.zeros(n_dofs),
        stress=stress.reshape(-1, per_triangle, rows),
        base_shear=base_shear,
        contact=Contact(
            sign=contact.sign[on_net],
            is_pressed=contact.is_pressed[on_net],
            is_open=contact.is_open[on_net],
            is_lifted=contact.is_lifted[on_ground],
        ),
    )


@lru_cache(maxsize=256)
def _nearest_points(source: MeshTemplate, target: MeshTemplate) -> Ints:
    sources, wanted = _list_points(source), _list_points(target)
    layers, own = sources[:, 1] // _FAR_APART, wanted[:, 1] // _FAR_APART
    nearest = np.empty(own.size, dtype=np.int64)
    for layer in range(len(source.interfaces) + 1):
        there, here = np.flatnonzero(layers == layer), np.flatnonzero(own == layer)
        for k in range(0, here.size, _AT_ONCE):
            piece = here[k : k + _AT_ONCE]
            nearest[piece] = there[_find_nearest(sources[there], wanted[piece])]
    return nearest


def _find_nearest(sources: Floats, wanted: Floats) -> Ints:
    """Nearest of some points (n, 2) to each of some others."""
    (x_known, y_known), (x, y) = sources.T, wanted.T[..., None]
    distance, across = x - x_known, y - y_known
    distance *= distance
    across *= across
    distance += across
    return np.asarray(distance.argmin(axis=1), dtype=np.int64)


@lru_cache(maxsize=256)
def _nearest_nodes(source: MeshTemplate, target: MeshTemplate) -> tuple[Ints, Ints]:
    """Nearest nodes on the net and on the ground, those of the foot left out."""
    on_ground = (mesh.nodes[0, mesh.ground[1:]] for mesh in (source, target))
    return (
        _nearest(source.net_fractions[1:], target.net_fractions[1:]),
        _nearest(*on_ground),
    )


def _list_points(template: MeshTemplate) -> Floats:
    """Reference coordinates (n, 2) of all quadrature points, layers far apart.

    Stress jumps from layer to layer: none is nearest to a point of another.
    """
    points = interpolate_reference(template).reshape(2, -1).T
    if not template.interfaces:
        return points
    layer = np.searchsorted(template.interfaces, points[:, 1])
    return points + np.outer(layer, [0.0, _FAR_APART])


def _nearest(sources: Floats, wanted: Floats) -> Ints:
    return np.asarray(np.abs(wanted[:, None] - sources[None]).argmin(axis=1))


def _resample_base(shear: Floats, source: MeshTemplate, target: MeshTemplate) -> Floats:
    """Mean shear of the edges, at the nearest edge's."""
    middles = [
        template.nodes[0, template.ground[1::2]] for template in (source, target)
    ]
    return np.asarray(shear[_nearest(*middles)])
