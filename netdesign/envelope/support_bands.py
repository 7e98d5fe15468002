"""Forces on a support from the pulls on its ends, with the band of the pulls' error."""

from __future__ import annotations

import math
from collections.abc import Iterator

from netdesign.checks.result import Band
from netdesign.coupling.solution import EndPull
from netdesign.structure.anchors import (
    NO_FOOT_PULL,
    AnchorForces,
    compute_anchor_forces,
)
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportPoints

_STILL = (0.0, 0.0)
# Shares of its error by which a pull is moved: each component down and up.
_MOVES = (((-1.0, 0.0), (1.0, 0.0)), ((0.0, -1.0), (0.0, 1.0)))

_Forces = dict[str, float] | FailedSupport


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
    anchors = _find_forces(points, width, _move(foot, _STILL), _move(head, _STILL))
    if isinstance(anchors, FailedSupport):
        return anchors
    values = anchors.member_forces
    spread = dict.fromkeys(values, 0.0)
    for pair in _list_moved(anchors, points, width, (foot, head)):
        change = dict.fromkeys(values, 0.0)
        for moved in pair:
            if isinstance(moved, FailedSupport):
                return moved
            for member, force in moved.items():
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


def _list_moved(
    anchors: AnchorForces,
    points: SupportPoints,
    width: float,
    pulls: tuple[EndPull, EndPull],
) -> Iterator[tuple[_Forces, _Forces]]:
    """Member forces with one component moved down, and up, by the pull's error.

    The members at the head do not feel the foot's pull.
    """
    foot, head = pulls
    for down, up in _MOVES:
        lower, upper = _move(foot, down), _move(foot, up)
        yield _change_foot(anchors, width, lower), _change_foot(anchors, width, upper)
    still = _move(foot, _STILL)
    for down, up in _MOVES:
        lower, upper = _move(head, down), _move(head, up)
        yield (
            _list_forces(_find_forces(points, width, still, lower)),
            _list_forces(_find_forces(points, width, still, upper)),
        )


def _move(pull: EndPull, shares: Point) -> Point:
    """Pull with its components moved by shares of its error [N/m]."""
    return pull.x + shares[0] * pull.error, pull.y + shares[1] * pull.error


def _change_foot(anchors: AnchorForces, width: float, pull: Point) -> _Forces:
    """Member forces with another pull per metre on the foot [N]."""
    x, y = pull[0] * width, pull[1] * width
    if not (math.isfinite(x) and math.isfinite(y)):
        return NO_FOOT_PULL
    return anchors.list_forces(math.hypot(x, y))


def _list_forces(anchors: AnchorForces | FailedSupport) -> _Forces:
    return anchors if isinstance(anchors, FailedSupport) else anchors.member_forces


def _find_forces(
    points: SupportPoints, width: float, foot: Point, head: Point
) -> AnchorForces | FailedSupport:
    return compute_anchor_forces(
        points, foot_pull_per_m=foot, head_pull_per_m=head, post_spacing=width
    )
