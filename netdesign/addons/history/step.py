"""Equations of one step of the moving snow: what the net's nodes feel of it.

Midpoints between the net's vertices move with their mean, so that what the snow does to
the net acts at vertices only. Theory: coupling/THEORY.md, section 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from netdesign.addons.history.body import SnowBody, build_material
from netdesign.addons.history.snow import (
    BodyLoad,
    CompiledSnow,
    PlainSnow,
    SnowIterate,
    prepare_snow,
)
from netdesign.addons.history.state import TransientProblem, TransientState
from netdesign.numerics.arrays import Floats, Ints, Mask, freeze, gather
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.element import reference_element
from netdesign.snow.kernel import SingularError
from netdesign.snow.mesh import MeshTemplate
from netdesign.snow.placed_mesh import build_placed_mesh
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """Displacement of a step as a function of its end velocity: offset + rate v.

    Attributes
    ----------
    offset : ndarray, shape (2, n_vertices)
        [thickness].
    rate : float
        [time scale].
    guess : ndarray, shape (2, n_vertices)
        Displacement at which equilibrium is assembled [thickness].
    """

    offset: Floats
    rate: float
    guess: Floats

    @classmethod
    def of_step(cls, state: TransientState, step: float) -> Motion:
        """Motion of second order from two steps, (K6); of first order for the first.

        Parameters
        ----------
        state : TransientState
            At the step's start.
        step : float
            Duration [time scale].
        """
        if state.step == 0.0:
            still = np.zeros_like(state.moved)
            return cls(offset=still, rate=step, guess=still)
        growth = step / state.step
        return cls(
            offset=growth**2 / (1.0 + 2.0 * growth) * state.moved,
            rate=(1.0 + growth) / (1.0 + 2.0 * growth) * step,
            guess=growth * state.moved,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StepEquations:
    """The step's equations, but for stress and net.

    Attributes
    ----------
    problem : TransientProblem
        What stays the same.
    snow : CompiledSnow or PlainSnow
        Where equilibrium is assembled.
    load : BodyLoad
        Laws and weight there.
    template : MeshTemplate
        Reference mesh.
    carried : ndarray of int, shape (n,)
        Vertices that are nodes of the net.
    top_axis : ndarray, shape (2,), or None
        Way of an upper corner that slips over the net's head [-]; None where it is a
        node of the net.
    top_slips : bool
        It slips.
    motion : Motion
        From velocities to displacements.
    nodes : ndarray, shape (2, n)
        The net's nodes moved by the offset.
    """

    problem: TransientProblem
    snow: CompiledSnow | PlainSnow
    load: BodyLoad
    template: MeshTemplate
    carried: Ints
    top_axis: Floats | None
    top_slips: bool
    motion: Motion
    nodes: Floats

    @property
    def weight_size(self) -> float:
        """Size of the whole weight."""
        return float(np.hypot(*self.load.weight.reshape(-1, 2).sum(axis=0)))

    def place_net(self, unknowns: Floats) -> Floats:
        """Net nodes as the velocities carry them.

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            Velocities at the step's end [velocity scale].

        Returns
        -------
        ndarray, shape (2, n)
            [thickness].
        """
        velocities = self.split(unknowns)[:, self.carried]
        return np.asarray(self.nodes + self.motion.rate * velocities)

    def split(self, unknowns: Floats) -> Floats:
        """Velocities or forces of all nodes, shape (2, n_nodes).

        Parameters
        ----------
        unknowns : ndarray, shape (n_dofs,)
            X and Y of each node [velocity or force scale].
        """
        return unknowns[: self.load.weight.size].reshape(-1, 2).T

    def hold(self, velocity: Floats) -> Floats:
        """Velocities as unknowns, 0 where held.

        Parameters
        ----------
        velocity : ndarray, shape (2, n_nodes)
            Any unit.

        Returns
        -------
        ndarray, shape (n_dofs,)
            In that unit; pressures are 0.
        """
        template, top = self.template, self.template.net[-1]
        vertices = np.zeros((2, template.net.size // 2 + 1))
        vertices[:, 1 : 1 + self.carried.size] = velocity[:, self.carried]
        if self.top_slips and self.top_axis is not None:
            vertices[:, -1] = self.top_axis * (self.top_axis @ velocity[:, top])
        held = velocity.copy()
        held[:, template.net] = vertices @ _spread(template.net.size).T
        is_mixed = self.problem.snow.element == "mixed"
        unknowns = np.zeros(held.size + is_mixed * template.n_vertices)
        unknowns[: held.size] = held.T.ravel()
        return unknowns

    def pull_vertices(self, forces: Floats) -> Floats:
        """Forces at the net's vertices, with those of the midpoints between them.

        Parameters
        ----------
        forces : ndarray, shape (2 n_nodes,)
            On all nodes, any unit.

        Returns
        -------
        ndarray, shape (2, n_net_vertices)
            In that unit, foot to head.
        """
        net = self.template.net
        return np.asarray(self.split(forces)[:, net] @ _spread(net.size))

    def span(self) -> tuple[Floats, Floats]:
        """Velocities of the net's nodes by its unknowns, and sums of forces that count.

        Returns
        -------
        ndarray, ndarray, shape (2 n_net, 2 n or 2 n + 1)
            Unknowns are X, then Y of the nodes, then the way of a corner that slips;
            over the head it slips against friction (N14).
        """
        spread, count = _spread(self.template.net.size), self.carried.size
        slips = self.top_slips and self.top_axis is not None
        moves = np.zeros((2, spread.shape[0], 2 * count + slips))
        moves[0, :, :count] = moves[1, :, count : 2 * count] = spread[:, 1 : 1 + count]
        forces = moves.copy()
        if slips and self.top_axis is not None:
            x, y = self.top_axis
            moves[:, :, -1] = np.outer((x, y), spread[:, -1])
            against = self.problem.snow.friction * np.array([y, -x])
            forces[:, :, -1] = np.outer(self.top_axis - against, spread[:, -1])
        flat = (-1, moves.shape[2])
        return (
            moves.transpose(1, 0, 2).reshape(flat),
            forces.transpose(1, 0, 2).reshape(flat),
        )


@lru_cache(maxsize=32)
def _spread(count: int) -> Floats:
    """Shares of the net's vertices in the ways of all its nodes, (count, n)."""
    spread = np.zeros((count, count // 2 + 1))
    vertices = np.arange(count // 2 + 1)
    spread[2 * vertices, vertices] = 1.0
    spread[2 * vertices[1:] - 1, vertices[1:]] = 0.5
    spread[2 * vertices[1:] - 1, vertices[:-1]] = 0.5
    return freeze(spread)


class NetAnswer(NamedTuple):
    """Change of the net's unknowns, and its derivative by the forces on its nodes.

    Attributes
    ----------
    change : ndarray, shape (m,)
        Under the forces of the last iteration [velocity scale].
    per_force : ndarray, shape (m, 2 n)
        Per unit force on each node, X of all, then Y of all.
    answer : callable
        Gives the next iterate, under more forces (2 n,) than those of the last one, in
        that order [force scale].
    """

    change: Floats
    per_force: Floats
    answer: Callable[[Floats], SnowIterate]


def assemble_step(
    problem: TransientProblem, state: TransientState, step: float
) -> StepEquations:
    """Equations of a step.

    Parameters
    ----------
    problem : TransientProblem
        What stays the same.
    state : TransientState
        At the step's start.
    step : float
        Duration [time scale].

    Raises
    ------
    SolveError
        If the mesh folds over where equilibrium is to be assembled.
    """
    body, template = state.body, state.body.topology.template
    motion = Motion.of_step(state, step)
    vertices = body.vertices + motion.guess
    top_axis = None
    if state.top != "on-net":
        last = problem.head - vertices[:, body.topology.net[-2]]
        top_axis = last / np.hypot(*last)
    load = _describe_load(problem, replace(body, vertices=vertices))
    return StepEquations(
        problem=problem,
        snow=_place_snow(load, template, vertices),
        load=load,
        template=template,
        carried=state.carried,
        top_axis=top_axis,
        top_slips=state.top == "slipping",
        motion=motion,
        nodes=(body.vertices + motion.offset)[:, state.carried],
    )


def _describe_load(problem: TransientProblem, body: SnowBody) -> BodyLoad:
    snow, template = problem.snow, body.topology.template
    material = build_material(problem.settling, snow, body)
    fluidity = np.broadcast_to(material.fluidity_ratio, (body.mass.size, 3))
    bottom = fluidity[body.topology.bottom, 0]
    if snow.ground != "sliding" and problem.base_drag > 0.0:
        bottom = np.full_like(bottom, 1.0 / problem.base_drag)
        snow = replace(snow, ground="sliding", slip_ratio=1.0, slip_exponent=1.0)
    return BodyLoad(
        snow=snow,
        material=material,
        bottom=bottom,
        weight=_nodal_weight(problem, body),
        inner=_free_inner(template, holds=problem.snow.ground == "no-slip"),
    )


def _place_snow(
    load: BodyLoad, template: MeshTemplate, vertices: Floats
) -> CompiledSnow | PlainSnow:
    """The snow on placed vertices, by the core if it can."""
    middles = vertices[:, template.edges].mean(axis=1)
    nodes = np.concatenate([vertices, middles], axis=1)
    snow: CompiledSnow | PlainSnow | None = prepare_snow(load, template, nodes)
    if snow is None:
        mesh = build_placed_mesh(template, nodes, load.snow.element)
        axes = np.zeros_like(nodes)
        axes[0] = 1.0
        snow = PlainSnow(load=load, mesh=replace(mesh, axes=axes))
    if not snow.is_valid:
        raise SolveError(Outcome.OUT_OF_VALIDITY, say("history.mesh_folds_in_step"))
    return snow


def condense_step(
    equations: StepEquations, iterate: SnowIterate, forces: Floats
) -> NetAnswer:
    """Newton step of the snow under net forces, and its change per force.

    Parameters
    ----------
    equations : StepEquations
        Of the step.
    iterate : SnowIterate
        The last one.
    forces : ndarray, shape (2, n)
        Of the net on its nodes [rho g d^2].

    Raises
    ------
    SolveError
        If nothing holds the snow.
    """
    moves, sums = equations.span()
    try:
        condensed = equations.snow.condense(iterate)
        inverse = np.linalg.inv(sums.T @ condensed.root @ moves)
    except (SingularError, np.linalg.LinAlgError):
        raise SolveError(Outcome.NONFINITE, say("history.nothing_holds")) from None
    push = sums.T @ condensed.missing
    push[: forces.size] += forces.ravel()
    per_force = np.asarray(inverse[:, : forces.size], dtype=np.float64)
    change = inverse @ push

    def answer(more: Floats) -> SnowIterate:
        return condensed.answer(moves @ (change + per_force @ more))

    return NetAnswer(change, per_force, answer)


def _nodal_weight(problem: TransientProblem, body: SnowBody) -> Floats:
    """Weight of the mass that each triangle has kept, shape (2 n_nodes,)."""
    shape, _, point_weights = reference_element()
    shares, template = 2.0 * point_weights @ shape, body.topology.template
    nodal = gather(
        template.triangles.T, np.outer(body.mass, shares), template.nodes.shape[1]
    )
    return np.outer(nodal, problem.snow.gravity).ravel()


@lru_cache(maxsize=32)
def _free_inner(template: MeshTemplate, *, holds: bool) -> Mask:
    """Velocities off the net that the ground leaves free; ``holds``: without slip."""
    free = np.ones((template.nodes.shape[1], 2), dtype=bool)
    free[template.ground, 1] = False
    free[template.ground, 0] = not holds
    free[template.net] = False
    return free.ravel()
