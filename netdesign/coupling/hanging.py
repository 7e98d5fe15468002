"""The net at rest under the forces of the snow, and how much of it lies in the snow.

Theory: coupling/THEORY.md, sections 1 and 2. Dimensionless: lengths in snow
thicknesses d, forces per metre of width in rho g d^2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from netdesign.cable.closed_form import compute_parabola_sag
from netdesign.cable.funicular import Funicular, solve_funicular
from netdesign.coupling.start import guess_pressure
from netdesign.errors import SolveError
from netdesign.outcome import Outcome
from netdesign.snow.law import FlowLaw
from netdesign.snow.mesh import MeshTemplate

Floats = NDArray[np.float64]

_CONTACT_ROUNDS = 30
_SURFACE_TOLERANCE = 1e-10


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SteadyProblem:
    """One scene on one mesh, dimensionless.

    Attributes
    ----------
    law : FlowLaw
        Creep, ground and friction.
    template : MeshTemplate
        Reference mesh.
    head : ndarray, shape (2,)
        Position of the net's head.
    length, slack : float
        Unstressed, of the whole net; what of it exceeds the chord, over the chord.
    stiffness : float
        ES, the force of a strain of 1.
    """

    law: FlowLaw
    template: MeshTemplate
    head: Floats
    length: float
    slack: float
    stiffness: float

    @property
    def has_freeboard(self) -> bool:
        """The head stands above the snow: the net's top segment hangs free."""
        return bool(self.head[1] > 1.0 + 1e-9)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hanging:
    """The net under given forces, and how much of it lies in the snow.

    Attributes
    ----------
    cable : Funicular
        Its equilibrium.
    contact_length : float
        Unstressed, of the part in the snow.
    forces : ndarray, shape (2, n_nodes)
        As the cable takes them; those of a free end, 0, are the last two.
    lengths : ndarray, shape (n_elements,)
        Unstressed.
    """

    cable: Funicular
    contact_length: float
    forces: Floats
    lengths: Floats


def start_hanging(problem: SteadyProblem) -> Hanging:
    """The net under a uniform pressure of about the right size.

    Raises
    ------
    SolveError
        If nothing holds the net.
    """
    chord = float(np.hypot(*problem.head))
    along = problem.head / chord
    outward = np.array([along[1], -along[0]])
    pressure = guess_pressure(problem.law, problem.template.aspect)
    sag = compute_parabola_sag(pressure, chord, problem.stiffness, problem.slack)
    pull = pressure * chord * (chord / (8.0 * sag) * along + outward / 2.0)
    contact = problem.length / float(problem.head[1])
    lengths = np.diff(problem.template.net_fractions[::2]) * contact
    shares = np.zeros(2 * lengths.size + 1)
    shares[1::2] = 4.0 / 6.0 * lengths
    shares[:-1:2] += lengths / 6.0
    shares[2::2] += lengths / 6.0
    return _hang(problem, pressure * np.outer(outward, shares), pull, contact)


def hang_again(problem: SteadyProblem, hanging: Hanging, on_net: Floats) -> Hanging:
    """The net under other forces on the nodes in the snow, shape (2, n_net).

    Raises
    ------
    SolveError
        If nothing holds the net, or its contact with the snow's surface is not found.
    """
    return _hang(problem, on_net, hanging.cable.pull, hanging.contact_length)


def find_contact_curve(problem: SteadyProblem, hanging: Hanging) -> Floats:
    """Net nodes that lie in the snow, shape (2, n_net)."""
    return hanging.cable.curve[:, : problem.template.net.size]


def _hang(
    problem: SteadyProblem, forces: Floats, pull: Floats, contact_length: float
) -> Hanging:
    """Net under nodal forces; its contact with the snow ends at the snow's surface."""
    if not problem.has_freeboard:
        lengths = np.diff(problem.template.net_fractions[::2]) * problem.length
        cable = _solve_cable(problem, forces, lengths, pull)
        return Hanging(
            cable=cable, contact_length=problem.length, forces=forces, lengths=lengths
        )
    loose = np.concatenate([forces, np.zeros((2, 2))], axis=1)
    before: tuple[float, float] | None = None
    for _ in range(_CONTACT_ROUNDS):
        free_length = problem.length - contact_length
        lengths = np.diff(problem.template.net_fractions[::2]) * contact_length
        lengths = np.append(lengths, free_length)
        cable = _solve_cable(problem, loose, lengths, pull)
        pull = cable.pull
        too_high = float(cable.curve[1, -3]) - 1.0
        if abs(too_high) < _SURFACE_TOLERANCE:
            return Hanging(
                cable=cable,
                contact_length=contact_length,
                forces=loose,
                lengths=lengths,
            )
        rise = float(cable.curve[1, -1] - cable.curve[1, -3]) / free_length
        if before is not None and contact_length != before[0]:
            rise = (too_high - before[1]) / (contact_length - before[0])
        before = (contact_length, too_high)
        contact_length -= too_high / rise
        if not 0.0 < contact_length < problem.length:
            break
    raise SolveError(
        Outcome.NO_EQUILIBRIUM, "the net's contact with the snow surface was not found"
    )


def _solve_cable(
    problem: SteadyProblem, forces: Floats, lengths: Floats, pull: Floats
) -> Funicular:
    cable = solve_funicular(forces, lengths, problem.stiffness, problem.head, pull)
    if cable.outcome is not Outcome.CONVERGED:
        raise SolveError(cable.outcome)
    return cable
