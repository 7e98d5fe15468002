"""Forces on a support from the pulls on its ends, with the band of the pulls' error."""

from __future__ import annotations

from collections.abc import Sequence

from netdesign.checks.result import Band
from netdesign.coupling.solution import EndPull
from netdesign.structure.anchors import AnchorForces, compute_anchor_forces
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportPoints

_STILL = (0.0, 0.0, 0.0, 0.0)


def resolve_pulls(
    points: SupportPoints, width: float, foot: EndPull, head: EndPull
) -> tuple[AnchorForces, dict[str, Band]] | FailedSupport:
    """Forces on a support and its members, each with its band.

    Within one set of working members the forces are linear in the pulls, so moving
    each component by its error, and adding the changes, bounds them.

    Parameters
    ----------
    points : SupportPoints
        Geometry of the support [m].
    width : float
        Width of net that it carries [m].
    foot, head : EndPull
        Of the net, with their errors [N/m].
    """
    anchors = _find_forces(points, width, (foot, head), _STILL)
    if isinstance(anchors, FailedSupport):
        return anchors
    values = anchors.member_forces
    spread = dict.fromkeys(values, 0.0)
    for component in range(4):
        change = dict.fromkeys(values, 0.0)
        for share in (-1.0, 1.0):
            shift = [share if place == component else 0.0 for place in range(4)]
            moved = _find_forces(points, width, (foot, head), shift)
            if isinstance(moved, FailedSupport):
                return moved
            for member, force in moved.member_forces.items():
                change[member] = max(change[member], abs(force - values[member]))
        for member in spread:
            spread[member] += change[member]
    bands = {
        member: spread_out(value, spread[member]) for member, value in values.items()
    }
    return anchors, bands


def spread_out(value: float, error: float) -> Band:
    """Band of a size with its error, in one unit."""
    return Band(low=max(0.0, value - error), value=value, high=value + error)


def _find_forces(
    points: SupportPoints,
    width: float,
    pulls: tuple[EndPull, EndPull],
    shift: Sequence[float],
) -> AnchorForces | FailedSupport:
    """Anchor forces with the end pulls moved by ``shift`` times their error.

    The four shares are for x and y of the foot's pull, x and y of the head's.
    """
    foot, head = pulls
    return compute_anchor_forces(
        points,
        foot_pull_per_m=(
            foot.x + shift[0] * foot.error,
            foot.y + shift[1] * foot.error,
        ),
        head_pull_per_m=(
            head.x + shift[2] * head.error,
            head.y + shift[3] * head.error,
        ),
        post_spacing=width,
    )
