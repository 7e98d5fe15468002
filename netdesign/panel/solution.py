"""Result of a panel: forces on its supports and ropes, or a reason."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome
from netdesign.panel.inputs import Panel
from netdesign.structure.layout import Point
from netdesign.words.message import Message


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RopeForces:
    """A border rope under load.

    Attributes
    ----------
    along : float
        H, the same over its span [N].
    tension : float
        T, at the support where it is largest [N].
    mid_displacement : tuple of float, shape (2,)
        (x, y) in mid-panel, from the straight line between the supports [m].
    tensions : ndarray, shape (24,)
        Tension at ``ROPE_POINTS``, from mid-panel to the post [N].
    """

    along: float
    tension: float
    mid_displacement: Point
    tensions: Floats


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelBalance:
    """Forces and moments that are missing, over the load (and the chord).

    Attributes
    ----------
    force : float
        Of the load on feet and heads [-].
    moment_in_section : float
        Of the strips about the foot's line [-].
    moment_along_row : float
        Of half the panel about the post's section [-].
    """

    force: float
    moment_in_section: float
    moment_along_row: float

    @property
    def largest(self) -> float:
        """Largest of the three [-]."""
        return max(self.force, self.moment_in_section, self.moment_along_row)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PanelSolution:
    """A panel between equal ones, at rest; its balance was checked. SI units.

    Attributes
    ----------
    panel : Panel
        What was solved.
    foot, mid_foot, head : tuple of float, shape (2,)
        (x, y) of the force on the foot anchor beside a post, on that in mid-panel (0
        without one) and on a post head [N].
    lower, upper : RopeForces
        The two ropes.
    stations : ndarray, shape (K + 1,)
        z of the strips: those that were solved for, and mid-panel [m].
    curves : ndarray, shape (K + 1, 2, 2 n + 1)
        Their nodes in the axes of the section [m].
    balance : PanelBalance
        What is missing in it.
    steps : int
        Of Newton's method.
    """

    panel: Panel
    foot: Point
    mid_foot: Point
    head: Point
    lower: RopeForces
    upper: RopeForces
    stations: Floats
    curves: Floats
    balance: PanelBalance
    steps: int

    @property
    def outcome(self) -> Outcome:
        """Always converged: anything else is a ``FailedPanel``."""
        return Outcome.CONVERGED


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedPanel:
    """A panel that gave no number that may be used."""

    outcome: Outcome
    reason: Message
