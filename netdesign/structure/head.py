"""Equilibrium of the post head: who pushes, who pulls, who is slack."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from itertools import chain
from typing import ClassVar

from netdesign.guards import require_within
from netdesign.outcome import Outcome
from netdesign.structure.layout import Point, SupportPoints
from netdesign.words.message import Message, say

# A guy nearer to the post's line than this holds nothing sideways. Choice of this
# program: it bounds the forces at 57 times the pull, and so their rounding error.
MIN_GUY_ANGLE = math.radians(1.0)

_ROUNDING = 64 * sys.float_info.epsilon  # relative to the pull


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadForces:
    """Forces in the members that hold one post head; none has the wrong sign.

    Attributes
    ----------
    post_compression, uphill_guy_tension, downhill_guy_tension : float
        Size of each member's force, at least 0; a slack guy has 0 [N].
    reason : Message
        Which members carry.
    """

    post_compression: float
    uphill_guy_tension: float = 0.0
    downhill_guy_tension: float = 0.0
    reason: Message
    outcome: ClassVar[Outcome] = Outcome.CONVERGED

    def __post_init__(self) -> None:
        """Refuse a strut that pulls, a rope that pushes, and what is no number."""
        require_within("post compression", self.post_compression, 0.0, math.inf)
        require_within("uphill guy tension", self.uphill_guy_tension, 0.0, math.inf)
        require_within("downhill guy tension", self.downhill_guy_tension, 0.0, math.inf)


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedSupport:
    """A support that cannot hold its net: an outcome and a reason, no forces."""

    outcome: Outcome
    reason: Message


def compute_head_forces(
    pull: Point, points: SupportPoints
) -> HeadForces | FailedSupport:
    """Find the forces in post and guys that hold the net's pull on the head.

    The post only pushes and a guy only pulls. The post works with the uphill guy;
    where that would have to push, it is slack and the downhill guy takes its place.
    Theory: structure/THEORY.md, eqs. (S1) to (S4).

    Parameters
    ----------
    pull : tuple of float, shape (2,)
        Force of the net on the head, (x, y), X downslope, Y normal [N].
    points : SupportPoints
        Head, post base and anchors [m].

    Returns
    -------
    HeadForces or FailedSupport
        Forces at least 0 [N], or why no pair of members can hold the pull.

    Verified by
    -----------
    verification/test_head_equilibrium.py
    """
    if not _is_finite(pull, points):
        return FailedSupport(
            outcome=Outcome.NONFINITE,
            reason=say("support.head_no_number"),
        )
    post = _direction(points.head, points.post_base)
    if post == (0.0, 0.0):
        return FailedSupport(
            outcome=Outcome.OUT_OF_VALIDITY,
            reason=say("support.no_length"),
        )
    if abs(_cross(pull, post)) <= _ROUNDING * math.hypot(*pull):
        return _carry_by_post_alone(pull, post)
    return _carry_by_pair(pull, post, points)


def resolve_signed(
    pull: Point, head: Point, post_base: Point, anchor: Point
) -> tuple[float, float] | None:
    """Find what post and one guy would need to hold a pull, signs allowed.

    The members' forces are ``max(0, tension)`` of each guy, and of the two pairs the
    larger compression. Theory: structure/THEORY.md, eq. (S2).

    Parameters
    ----------
    pull : tuple of float, shape (2,)
        Force of the net on the head, (x, y) [N].
    head, post_base, anchor : tuple of float, shape (2,)
        Points of the support [m].

    Returns
    -------
    tuple of float or None
        Compression of the post, tension of the guy [N]; None where the guy lies
        along the post.

    Verified by
    -----------
    tests/envelope/test_signed.py
    """
    post, guy = _direction(head, post_base), _direction(head, anchor)
    sine = _cross(post, guy)
    if abs(sine) < math.sin(MIN_GUY_ANGLE):
        return None
    return _cross(pull, guy) / sine, _cross(pull, post) / sine


def _carry_by_post_alone(pull: Point, post: Point) -> HeadForces | FailedSupport:
    """Eq. (S3): the pull has no part across the post, both guys are slack."""
    compression = pull[0] * post[0] + pull[1] * post[1]
    if compression < 0.0:
        return FailedSupport(
            outcome=Outcome.NO_EQUILIBRIUM,
            reason=say("support.post_in_tension"),
        )
    return HeadForces(post_compression=compression, reason=say("support.post_alone"))


def _carry_by_pair(
    pull: Point, post: Point, points: SupportPoints
) -> HeadForces | FailedSupport:
    """Try the post with the uphill guy, else with the downhill guy."""
    uphill = _resolve(pull, post, _direction(points.head, points.uphill_anchor))
    if not isinstance(uphill, Message):
        return HeadForces(
            post_compression=uphill[0],
            uphill_guy_tension=uphill[1],
            reason=say("support.post_and_uphill"),
        )
    downhill = _resolve(pull, post, _direction(points.head, points.downhill_anchor))
    if not isinstance(downhill, Message):
        return HeadForces(
            post_compression=downhill[0],
            downhill_guy_tension=downhill[1],
            reason=say("support.post_and_downhill"),
        )
    return FailedSupport(
        outcome=Outcome.NO_EQUILIBRIUM,
        reason=say("support.no_equilibrium", uphill=uphill, downhill=downhill),
    )


def _resolve(pull: Point, post: Point, guy: Point) -> tuple[float, float] | Message:
    """Eq. (S2): compression of the post and tension of the guy, or why not."""
    sine = _cross(post, guy)
    if abs(sine) < math.sin(MIN_GUY_ANGLE):
        return say("support.guy_along_post")
    compression = _cross(pull, guy) / sine
    tension = _cross(pull, post) / sine
    if tension < 0.0:
        return say("support.guy_pushes")
    # A pull along the guy's own line leaves a post force of rounding size.
    if compression < -_ROUNDING * math.hypot(*pull) / abs(sine):
        return say("support.post_pulls")
    return max(compression, 0.0), tension


def _cross(a: Point, b: Point) -> float:
    """Moment of ``b`` about the tail of ``a``, positive from X towards Y."""
    return a[0] * b[1] - a[1] * b[0]


def _direction(start: Point, end: Point) -> Point:
    """Unit vector from ``start`` to ``end``; (0, 0) where they coincide."""
    x, y = end[0] - start[0], end[1] - start[1]
    length = math.hypot(x, y)
    return (x / length, y / length) if length > 0.0 else (0.0, 0.0)


def _is_finite(pull: Point, points: SupportPoints) -> bool:
    places = (points.post_base, points.uphill_anchor, points.downhill_anchor)
    return all(map(math.isfinite, chain(pull, points.head, *places)))
