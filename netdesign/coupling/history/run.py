"""A whole history on one mesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from netdesign.coupling.history.instant import Instant
from netdesign.coupling.history.state import TransientProblem, TransientState
from netdesign.coupling.moments import (
    Moment,
    Plateau,
    largest_pull,
    select_counted,
)
from netdesign.snow.settling import largest_density
from netdesign.words.message import Message

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Run:
    """A whole history on one mesh, dimensionless.

    Attributes
    ----------
    problem : TransientProblem
        Scene.
    moments : tuple of Moment
        After every step.
    plateau : Plateau
        Whether it came to rest.
    state, instant : TransientState, Instant
        At the end.
    fallen : float
        Share of the snow's mass that fell over the head.
    ended : Message or None
        Why the run ended before its horizon; None if it did not.
    linear_solves, rejected : int
        Solves taken; steps that were repeated.
    is_guessed : bool
        The net's first shape was a guess.
    """

    problem: TransientProblem
    moments: tuple[Moment, ...]
    plateau: Plateau
    state: TransientState
    instant: Instant
    fallen: float
    ended: Message | None
    linear_solves: int
    rejected: int
    is_guessed: bool

    @property
    def counted(self) -> Sequence[Moment]:
        """Moments whose pulls are those of the scene's snow on its net."""
        return select_counted(self.moments, self.plateau, is_guessed=self.is_guessed)


def record_moment(
    problem: TransientProblem,
    state: TransientState,
    instant: Instant,
    way: Floats | float,
    strain: float,
    step: float,
) -> tuple[Moment, Floats]:
    """Moment at the end of a step, and the net vertices' ways (n,) until then.

    ``state`` is that after the step, ``way`` and ``strain`` those before it.
    """
    net = state.body.topology.net
    axes = _net_normals(state.body.vertices[:, net])
    across = np.abs((instant.velocity[:, net] * axes).sum(axis=0))
    ways = way + across * step
    tensions = instant.response.sliding.tensions
    ends = np.hypot(*np.array([instant.foot_pull, instant.head_pull]).T)
    moment = Moment(
        time=state.time,
        foot=instant.foot_pull,
        head=instant.head_pull,
        tension_min=float(min(tensions.min(), *ends)),
        tension_max=float(max(tensions.max(), *ends)),
        on_net=instant.on_net,
        max_relative_density=largest_density(problem.settling, state.body),
        way=float(ways.max()),
        speed=float(across.max()),
        strain=strain + instant.creep_rate * step,
        residual=instant.residual,
    )
    return moment, ways


def measure_run(run: Run) -> list[Floats]:
    """Largest pulls that count on foot and head, shape (2,) each."""
    return [
        largest_pull([moment.foot for moment in run.counted]),
        largest_pull([moment.head for moment in run.counted]),
    ]


def _net_normals(points: Floats) -> Floats:
    """Unit normals of a polygon at its points (2, n)."""
    along = np.gradient(points, axis=1)
    return np.asarray(np.array([along[1], -along[0]]) / np.hypot(*along))
