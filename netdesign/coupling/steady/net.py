"""The net at rest under the forces of the snow, and how much of it lies in the snow.

Theory: coupling/THEORY.md, sections 1 and 2. Dimensionless: lengths in snow
thicknesses d, forces per metre of width in rho g d^2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from netdesign.cable.funicular import (
    CableParts,
    Funicular,
    find_part_lengths,
    share_uniform_load,
    solve_funicular,
)
from netdesign.cable.net import compute_parabola_sag
from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, SolveError
from netdesign.snow.element import find_once
from netdesign.snow.law import FlowProblem
from netdesign.snow.mesh import MeshTemplate
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SteadyProblem:
    """One scene on one mesh, dimensionless.

    Attributes
    ----------
    snow : FlowProblem
        Creep, ground and friction.
    template : MeshTemplate
        Reference mesh.
    head : ndarray, shape (2,)
        Position of the net's head.
    length, slack : float
        Unstressed, of the whole net; what of it exceeds the chord, over the chord.
    stiffness : float
        ES, the force of a strain of 1 [rho g d^2].
    """

    snow: FlowProblem
    template: MeshTemplate
    head: Floats
    length: float
    slack: float
    stiffness: float

    @property
    def is_layered(self) -> bool:
        """The snow has layers."""
        return len(self.snow.layers) > 1

    @property
    def has_freeboard(self) -> bool:
        """The head stands above the snow: the net's top segment hangs free."""
        return _stands_out(float(self.head[1]))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NetEquilibrium:
    """The net under given forces, and how much of it lies in each layer of snow.

    Attributes
    ----------
    cable : Funicular
        Its equilibrium.
    parts : ndarray, shape (n_parts,)
        Unstressed lengths of the net in each layer, from the ground up, then of its
        free top, if it has one.
    forces : ndarray, shape (2, n_nodes)
        As the cable takes them; those of a free end, 0, are the last two.
    lengths : ndarray, shape (n_elements,)
        Unstressed.
    """

    cable: Funicular
    parts: Floats
    forces: Floats
    lengths: Floats


def guess_pressure(problem: FlowProblem, aspect: float) -> float:
    """Mean pressure on the net of the snow that its base does not hold.

    Drag of a sliding ground and creep along X balance over a length that goes with the
    slip length to the power 1 / (n + 1); coupling/THEORY.md, eq. (K0a).

    Parameters
    ----------
    problem : FlowProblem
        Gravity and ground.
    aspect : float
        Upslope length over thickness [-].

    Returns
    -------
    float
        [rho g d].
    """
    felt = math.pow(problem.slip_ratio, 1.0 / (problem.exponent + 1.0))
    length = {"free": aspect, "no-slip": 1.0, "sliding": 1.0 + felt}[problem.ground]
    return max(0.05, problem.gravity[0]) * min(aspect, length)


# The net under forces on its nodes in the snow, from guesses of the pull near its foot
# and of the lengths of its parts.
Hang = Callable[[Floats, Floats, Floats], NetEquilibrium]


def start_net(problem: SteadyProblem, hang: Hang | None = None) -> NetEquilibrium:
    """The net under a uniform pressure of about the right size.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    hang : callable, optional
        By default ``hang_net``.

    Raises
    ------
    SolveError
        If nothing holds the net.
    """
    chord = math.hypot(*problem.head)
    along = problem.head / chord
    outward = np.array([along[1], -along[0]])
    pressure = guess_pressure(problem.snow, problem.template.aspect)
    sag = compute_parabola_sag(pressure, chord, problem.stiffness, problem.slack)
    pull = pressure * chord * (chord / (8.0 * sag) * along + outward / 2.0)
    rises = _cut(problem).rises
    per_height = problem.length / rises.sum()
    heights = np.diff(problem.template.net_fractions[::2])
    shares = pressure * per_height * share_uniform_load(heights)
    on_net = outward[:, None] * shares
    hang = hang or partial(hang_net, problem)
    return hang(on_net, pull, rises * per_height)


def find_contact_curve(problem: SteadyProblem, net: NetEquilibrium) -> Floats:
    """Net nodes that lie in the snow.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    net : NetEquilibrium
        The net.

    Returns
    -------
    ndarray, shape (2, n_net)
        Foot to head [thickness].
    """
    return net.cable.curve[:, : problem.template.net.size]


def locate_nodes(template: MeshTemplate, net: NetEquilibrium) -> Floats:
    """Unstressed length below each net node, over that in the snow.

    Parameters
    ----------
    template : MeshTemplate
        Reference mesh.
    net : NetEquilibrium
        The net.

    Returns
    -------
    ndarray, shape (n_net,)
        0 at the foot, 1 at the snow's surface [-].
    """
    if not template.interfaces:
        return template.net_fractions
    marks = np.array([0.0, *template.interfaces, 1.0])
    below = np.append(0.0, np.cumsum(net.parts[: marks.size - 1]))
    return np.asarray(np.interp(template.net_fractions, marks, below / below[-1]))


@find_once
def cut_net(template: MeshTemplate, top: float) -> CableParts:
    """Parts of a net of some height.

    Parameters
    ----------
    template : MeshTemplate
        Of the snow.
    top : float
        Height of the net's head [thickness].
    """
    free = [top] if _stands_out(top) else []
    marks = np.array([0.0, *template.interfaces, 1.0, *free])
    elements = np.array([*template.net_fractions[::2], *free])
    part = np.searchsorted(marks, (elements[1:] + elements[:-1]) / 2.0) - 1
    heights = np.diff(marks)
    return CableParts(
        shares=np.diff(elements) / heights[part],
        part=part,
        firsts=np.searchsorted(part, np.arange(heights.size)),
        rises=np.diff([*marks[:-1], top]),
    )


def _stands_out(top: float) -> bool:
    """The net's head stands above the snow."""
    return top > 1.0 + 1e-9


def _cut(problem: SteadyProblem) -> CableParts:
    return cut_net(problem.template, float(problem.head[1]))


def hang_net(
    problem: SteadyProblem, on_net: Floats, pull: Floats, parts: Floats
) -> NetEquilibrium:
    """The net under nodal forces; its parts end where the layers and the snow end.

    Parameters
    ----------
    problem : SteadyProblem
        Scene on a mesh, dimensionless.
    on_net : ndarray, shape (2, n_net)
        Forces on the nodes in the snow, foot to head [rho g d^2].
    pull : ndarray, shape (2,)
        Guess of the tension near the foot [rho g d^2].
    parts : ndarray, shape (n_parts,)
        Guess of the lengths of its parts [thickness].

    Raises
    ------
    SolveError
        If nothing holds the net, or its contact with the snow's surface is not found.
    """
    forces = on_net
    if problem.has_freeboard:
        forces = np.concatenate([forces, np.zeros((2, 2))], axis=1)
    if parts.size > 1:
        parts = _find_parts(problem, forces, pull, parts)
    lengths = _lengthen(problem, parts)
    cable = _solve_cable(problem, forces, lengths, pull)
    return NetEquilibrium(cable=cable, parts=parts, forces=forces, lengths=lengths)


def _find_parts(
    problem: SteadyProblem, forces: Floats, pull: Floats, parts: Floats
) -> Floats:
    """Lengths of the parts, from the pull of the last round or of the last lengths."""
    cut, head_x = _cut(problem), float(problem.head[0])
    cable = (cut, forces, head_x, problem.length, problem.stiffness)
    lengths = find_part_lengths(*cable, pull)
    if lengths is None:
        hung = _solve_cable(problem, forces, _lengthen(problem, parts), pull)
        lengths = find_part_lengths(*cable, hung.pull)
    if lengths is None:
        raise SolveError(Outcome.NO_EQUILIBRIUM, say("steady.contact_not_found"))
    return lengths


def _lengthen(problem: SteadyProblem, parts: Floats) -> Floats:
    """Unstressed lengths of the elements from those of the parts."""
    cut = _cut(problem)
    return np.asarray(cut.shares * parts[cut.part])


def _solve_cable(
    problem: SteadyProblem, forces: Floats, lengths: Floats, pull: Floats
) -> Funicular:
    cable = solve_funicular(forces, lengths, problem.stiffness, problem.head, pull)
    if cable.outcome is not Outcome.CONVERGED:
        raise SolveError(cable.outcome)
    return cable
