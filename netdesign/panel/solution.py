"""Result of a panel: forces on its supports and ropes, or a reason; on the end support.

Theory: panel/THEORY.md, section 4; structure/THEORY.md, (S1) to (S6).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.numerics.arrays import Floats
from netdesign.outcome import Outcome, require_within
from netdesign.panel.inputs import LARGEST_GUY_ANGLE, Panel
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportPoints
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


@dataclass(frozen=True, slots=True, kw_only=True)
class EndForces:
    """Forces of the first or last support of a row.

    Attributes
    ----------
    support : AnchorForces
        Forces in the section, of half a bay [N].
    foot : tuple of float, shape (3,)
        Force on the foot anchor: downslope, out of the ground, along the row [N].
    head_along : float
        Pull of the ridge rope on the post head along the row [N].
    guy_tension : float
        Of the end guy that holds the head along the row [N].
    post_compression : float
        Of half a bay and of that guy [N].
    """

    support: AnchorForces
    foot: tuple[float, float, float]
    head_along: float
    guy_tension: float
    post_compression: float

    @property
    def foot_size(self) -> float:
        """Size of the force on the foot anchor [N]."""
        return math.hypot(*self.foot)


def compute_end_forces(
    panel: PanelSolution, points: SupportPoints, guy_angle: float
) -> EndForces | FailedSupport:
    """Forces of the support at a row's end: half a bay, and both ropes, (P7).

    Parameters
    ----------
    panel : PanelSolution
        The last panel.
    points : SupportPoints
        Geometry of the support [m].
    guy_angle : float
        Of the guy that holds the head along the row, to the row [rad].

    Returns
    -------
    EndForces or FailedSupport
        Per anchor [N].

    Raises
    ------
    ModelError
        If the guy is steeper than ``LARGEST_GUY_ANGLE``.

    Verified by
    -----------
    tests/verification/test_panel.py
    """
    require_within("end guy angle", guy_angle, 0.0, LARGEST_GUY_ANGLE, "rad")
    spacing = panel.panel.post_spacing
    support = compute_anchor_forces(
        points,
        foot_pull_per_m=(panel.foot[0] / spacing, panel.foot[1] / spacing),
        head_pull_per_m=(panel.head[0] / spacing, panel.head[1] / spacing),
        post_spacing=spacing / 2.0,
    )
    if isinstance(support, FailedSupport):
        return support
    along = panel.upper.along
    return EndForces(
        support=support,
        foot=(support.foot_anchor.x, support.foot_anchor.y, panel.lower.along),
        head_along=along,
        guy_tension=along / math.cos(guy_angle),
        post_compression=support.head.post_compression + along * math.tan(guy_angle),
    )
