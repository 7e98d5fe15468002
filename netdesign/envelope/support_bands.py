"""Forces on a support from the pulls on its ends, with the band of the pulls' error."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from netdesign.checks.result import Band
from netdesign.coupling.solution import EndPull
from netdesign.numerics.arrays import Floats
from netdesign.structure.anchors import (
    AnchorForces,
    compute_anchor_forces,
    compute_forces_of_pulls,
)
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import SupportPoints

# Shares of its error by which a pull is moved: each component (of foot, then of head)
# alone, down and up. Shape: component that moves, way, component.
_MOVES = np.eye(4)[:, None] * np.array([-1.0, 1.0])[:, None]

Pulls = tuple[EndPull, EndPull]  # on foot and head, with their errors [N/m]
Resolved = tuple[AnchorForces, dict[str, Band]]


def resolve_pulls(
    points: SupportPoints, width: float, pulls: Sequence[Pulls]
) -> list[Resolved] | FailedSupport:
    """Forces on a support and its members, with their bands, under each of some pulls.

    Within one set of working members the forces are linear in the pulls, so moving
    each component by its error, and adding the changes, bounds them.

    Parameters
    ----------
    points : SupportPoints
        Geometry of the support [m].
    width : float
        Width of net that it carries [m].
    pulls : sequence of tuple of EndPull, shape (2,)
        Of the net on foot and head, with their errors [N/m].

    Returns
    -------
    list of (AnchorForces, dict of str to Band), or FailedSupport
        The failure of the first pulls that the support cannot hold, moved or not.
    """
    found = []
    for foot, head in pulls:
        anchors = _resolve(points, width, (foot.x, foot.y, head.x, head.y))
        if isinstance(anchors, FailedSupport):
            return anchors
        found.append(anchors)
    errors = _find_errors(points, width, pulls, [one.member_forces for one in found])
    if isinstance(errors, FailedSupport):
        return errors
    return [
        (anchors, {m: spread_out(x, of[m]) for m, x in anchors.member_forces.items()})
        for anchors, of in zip(found, errors, strict=True)
    ]


def spread_out(value: float, error: float) -> Band:
    """Band of a size with its error, in one unit."""
    return Band(low=max(0.0, value - error), value=value, high=value + error)


def _find_errors(
    points: SupportPoints,
    width: float,
    pulls: Sequence[Pulls],
    values: Sequence[dict[str, float]],
) -> list[dict[str, float]] | FailedSupport:
    """Error of each member under each of the pulls, from their moved ones [N]."""
    still = np.array([(foot.x, foot.y, head.x, head.y) for foot, head in pulls])
    errors = np.array([(foot.error,) * 2 + (head.error,) * 2 for foot, head in pulls])
    with np.errstate(invalid="ignore", over="ignore"):  # of an error that is no number
        moved = still + _MOVES[:, :, None] * errors
        is_sound = np.isfinite(moved * width).all(axis=-1)
    if is_sound.all():
        x, y, along, across = np.moveaxis(moved, -1, 0)
        forces, is_sound = compute_forces_of_pulls(
            points,
            foot_pull_per_m=(x, y),
            head_pull_per_m=(along, across),
            post_spacing=width,
        )
    if not is_sound.all():
        failed = _resolve(points, width, moved[~is_sound][0])
        if isinstance(failed, FailedSupport):
            return failed
        raise ValueError("pulls that one way holds, and not the other")
    changes = {
        member: np.abs(force - [one[member] for one in values]).max(axis=1).sum(axis=0)
        for member, force in forces.items()
    }
    return [
        {member: float(change[k]) for member, change in changes.items()}
        for k in range(len(pulls))
    ]


def _resolve(
    points: SupportPoints, width: float, pulls: Sequence[float] | Floats
) -> AnchorForces | FailedSupport:
    """Forces under (x, y) of foot and head, in one row."""
    x, y, along, across = map(float, pulls)
    return compute_anchor_forces(
        points,
        foot_pull_per_m=(x, y),
        head_pull_per_m=(along, across),
        post_spacing=width,
    )
