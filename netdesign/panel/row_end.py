"""Forces on the support at a row's end: half a panel, and both ropes along the row.

Theory: panel/THEORY.md, section 4; structure/THEORY.md, (S1) to (S6) and (S25).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from netdesign.outcome import require_within
from netdesign.panel.inputs import LARGEST_GUY_ANGLE
from netdesign.panel.solve import PanelSolution
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportPoints
from netdesign.structure.splay import hold_end_guy


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
    across : float
        What that guy pulls on the head across the row [N].
    post_compression : float
        Of half a bay and of that guy, whose anchor lies abreast of the head [N].
    """

    support: AnchorForces
    foot: tuple[float, float, float]
    head_along: float
    guy_tension: float
    across: float
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
    held = hold_end_guy(points)
    if isinstance(support, FailedSupport):
        return support
    if isinstance(held, FailedSupport):
        return held
    along = panel.upper.along
    across = along * math.tan(guy_angle)
    post = support.head.post_compression + held.post_compression * across
    return EndForces(
        support=support,
        foot=(support.foot_anchor.x, support.foot_anchor.y, panel.lower.along),
        head_along=along,
        guy_tension=along / math.cos(guy_angle),
        across=across,
        post_compression=post,
    )
