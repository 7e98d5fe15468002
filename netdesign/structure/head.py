"""Equilibrium of the post head: forces in the guys and in the post."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from itertools import chain
from typing import Generic, TypeAlias

from netdesign.numerics.arrays import (
    Floats,
    Number,
    Truth,
    as_mask,
    choose,
    find_none,
    measure_length,
    take_larger,
)
from netdesign.outcome import Outcome, require_within
from netdesign.structure.layout import Point, SupportPoints
from netdesign.words.message import Message, say

# A guy nearer to the post's line than this holds nothing sideways. Choice of this
# program: it bounds the forces at 57 times the pull, and so their rounding error.
MIN_GUY_ANGLE = math.radians(1.0)

Vector: TypeAlias = tuple[Number, Number]
# Unit vectors from the head along post, uphill and downhill guy, of many supports.
Ways: TypeAlias = tuple[Vector[Floats], Vector[Floats], Vector[Floats]]
_SIZES = (
    *("post_compression", "post_tension"),
    *("uphill_guy_tension", "downhill_guy_tension"),
)
_ROUNDING = 64 * sys.float_info.epsilon  # relative to the pull


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadForces(Generic[Number]):
    """Forces in the members that hold a post head, or each of many [N].

    Attributes
    ----------
    post_compression, uphill_guy_tension, downhill_guy_tension : float or ndarray
        Size of each member's force, at least 0; a slack guy has 0.
    post_tension : float or ndarray
        Pull of the post on its foot, at least 0; 0 where it is pressed.
    loose_uphill, loose_downhill : float or ndarray
        Tension of each guy at most, should the foot of a pulling post give way.
    is_held : bool or ndarray
        Some members can hold the head; else the forces are of no use.
    is_uphill_along, is_downhill_along : bool or ndarray
        That guy lies along the post.
    """

    post_compression: Number
    post_tension: Number
    uphill_guy_tension: Number
    downhill_guy_tension: Number
    loose_uphill: Number
    loose_downhill: Number
    is_held: Truth
    is_uphill_along: Truth
    is_downhill_along: Truth

    @property
    def guy_demands(self) -> tuple[Number, Number]:
        """Largest tension of uphill and downhill guy, whatever the foot does [N]."""
        return (
            take_larger(self.uphill_guy_tension, self.loose_uphill),
            take_larger(self.downhill_guy_tension, self.loose_downhill),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedSupport:
    """A support that cannot hold its net: an outcome and a reason, no forces."""

    outcome: Outcome
    reason: Message


def compute_head_forces(
    pull: Point, points: SupportPoints
) -> HeadForces[float] | FailedSupport:
    """Find the forces in post and guys that hold the net's pull on the head.

    A guy only pulls. The post works with the uphill guy; where that would have to push,
    it is slack and the downhill guy takes its place. A post that would be in tension
    pulls on its foot. Theory: structure/THEORY.md, eqs. (S1) to (S4b).

    Parameters
    ----------
    pull : tuple of float, shape (2,)
        Force of the net on the head, (x, y), X downslope, Y normal [N].
    points : SupportPoints
        Head, post base and anchors [m].

    Returns
    -------
    HeadForces or FailedSupport
        Forces at least 0 [N], or why no guy holds the head sideways.

    Raises
    ------
    ModelError
        If a force is too large for a number.

    Verified by
    -----------
    verification/test_head_equilibrium.py
    """
    if not _is_finite(pull, points):
        return FailedSupport(
            outcome=Outcome.NONFINITE,
            reason=say("support.head_no_number"),
        )
    post, uphill, downhill = list_directions(points)
    if post == (0.0, 0.0):
        return FailedSupport(
            outcome=Outcome.OUT_OF_VALIDITY,
            reason=say("support.no_length"),
        )
    held = hold_head(pull, post, uphill, downhill)
    if not held.is_held:
        return FailedSupport(outcome=Outcome.NO_EQUILIBRIUM, reason=_explain(held))
    for size in _SIZES:
        require_within(size, getattr(held, size), 0.0, math.inf)
    return held


def hold_head(
    pull: Vector[Number],
    post: Vector[Number],
    uphill: Vector[Number],
    downhill: Vector[Number],
) -> HeadForces[Number]:
    """Forces in post and guys that hold the pull on a head, or on each of many.

    Theory: structure/THEORY.md, eqs. (S2) to (S4b).

    Parameters
    ----------
    pull : tuple of float or ndarray, shape (2,)
        Force of the net on the head, finite [N].
    post, uphill, downhill : tuple of float or ndarray, shape (2,)
        Unit vectors from the head to post base and anchors; (0, 0) for a guy of no
        length. The post has one.

    Verified by
    -----------
    tests/structure/test_many_forces.py
    """
    across = cross(pull, post)
    size = measure_length(*pull)
    is_alone = abs(across) <= _ROUNDING * size
    along = pull[0] * post[0] + pull[1] * post[1]
    up = _resolve(pull, post, uphill)
    down = _resolve(pull, post, downhill)
    none = 0.0 * size
    by_up = find_none(is_alone, find_none(up.holds))
    by_down = find_none(is_alone, up.holds, find_none(down.holds))
    is_lifted = find_none(is_alone, by_up, by_down)
    by_up = by_up | is_lifted & up.can_pull & find_none(_pulls_more(down, up))
    by_down = by_down | is_lifted & down.can_pull & find_none(by_up)
    of_pair = choose(by_up, up.in_post, choose(by_down, down.in_post, none))
    in_post = choose(is_alone, along, of_pair)
    loose_uphill = loose_downhill = none
    is_lifted = in_post < 0.0
    if as_mask(is_lifted).any():
        guys = _hold_without_post(pull, (uphill, downhill), (up, down))
        loose_uphill, loose_downhill = (choose(is_lifted, guy, none) for guy in guys)
    return HeadForces(
        post_compression=take_larger(in_post, 0.0),
        post_tension=take_larger(0.0 - in_post, 0.0),  # never -0
        uphill_guy_tension=choose(by_up, up.tension, none),
        downhill_guy_tension=choose(by_down, down.tension, none),
        loose_uphill=loose_uphill,
        loose_downhill=loose_downhill,
        is_held=is_alone | by_up | by_down,
        is_uphill_along=up.is_along,
        is_downhill_along=down.is_along,
    )


def _pulls_more(first: _Pair[Number], second: _Pair[Number]) -> Truth:
    """The post pulls more beside the first guy than beside the second."""
    return first.can_pull & (first.in_post < second.in_post)


def _hold_without_post(
    pull: Vector[Number],
    guys: tuple[Vector[Number], Vector[Number]],
    pairs: tuple[_Pair[Number], _Pair[Number]],
) -> tuple[Number, Number]:
    """Largest tensions of both guys while the post pulls less and less, (S4b).

    Those of the two alone; where one of them would have to push, of each with the post.
    """
    up, down = share_between_guys(pull, *guys)
    hold, none = (up >= 0.0) & (down >= 0.0), 0.0 * up
    by_up, by_down = (choose(pair.can_pull, pair.tension, none) for pair in pairs)
    return choose(hold, up, by_up), choose(hold, down, by_down)


def share_between_guys(
    pull: Vector[Number], uphill: Vector[Number], downhill: Vector[Number]
) -> Vector[Number]:
    """Find what both guys would need to hold a pull without their post, signs allowed.

    No guy of a lifted head carries more, beside what `resolve_signed` gives. Where both
    lie along one line each may have all of it. Theory: structure/THEORY.md, eq. (S4b).

    Parameters
    ----------
    pull : tuple of float or ndarray, shape (2,)
        Force of the net on the head, (x, y) [N].
    uphill, downhill : tuple of float or ndarray, shape (2,)
        Unit vectors from the head to the anchors.

    Returns
    -------
    tuple of float or ndarray
        Tension of uphill and downhill guy [N].

    Verified by
    -----------
    tests/envelope/test_lift.py
    """
    sine, size = cross(uphill, downhill), measure_length(*pull)
    is_one_line = abs(sine) < math.sin(MIN_GUY_ANGLE)
    divisor = sine + is_one_line
    up, down = -cross(pull, downhill) / divisor, cross(pull, uphill) / divisor
    return choose(is_one_line, size, up), choose(is_one_line, size, down)


def resolve_signed(
    pull: Vector[Number], post: Vector[Number], guy: Vector[Number]
) -> Vector[Number]:
    """Find what post and one guy would need to hold a pull, signs allowed.

    The members' forces are ``max(0, tension)`` of each guy, and of the two pairs the
    larger compression; a post that it leaves negative pulls. Theory:
    structure/THEORY.md, eq. (S2).

    Parameters
    ----------
    pull : tuple of float or ndarray, shape (2,)
        Force of the net on the head, (x, y) [N].
    post, guy : tuple of float or ndarray, shape (2,)
        Unit vectors from the head to post base and anchor.

    Returns
    -------
    tuple of float or ndarray
        Compression of the post, tension of the guy [N]; no numbers where the guy lies
        along the post.

    Verified by
    -----------
    tests/envelope/test_signed.py
    """
    pair = _resolve(pull, post, guy)
    compression, tension = pair.signed_compression, pair.tension
    return (
        choose(pair.is_along, math.nan * compression, compression),
        choose(pair.is_along, math.nan * tension, tension),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Pair(Generic[Number]):
    """Post and one guy under a pull, signs allowed; eqs. (S2) and (S4).

    ``is_along``: the guy lies along the post, and the forces say nothing. ``can_pull``:
    the guy pulls, whatever the post does. ``holds``: the post is pressed, too.
    ``in_post`` is the signed compression without what is rounding of none.
    """

    signed_compression: Number
    in_post: Number
    tension: Number
    is_along: Truth
    can_pull: Truth
    holds: Truth


def _resolve(
    pull: Vector[Number], post: Vector[Number], guy: Vector[Number]
) -> _Pair[Number]:
    sine = cross(post, guy)
    is_along = abs(sine) < math.sin(MIN_GUY_ANGLE)
    divisor = sine + is_along  # never 0; the forces are of no use where it is along
    compression = cross(pull, guy) / divisor
    tension = cross(pull, post) / divisor
    # A pull along the guy's own line leaves a post force of rounding size.
    rounding = _ROUNDING * measure_length(*pull) / abs(divisor)
    is_slack = find_none(tension >= 0.0)  # also what is no number
    is_pressed = compression >= -rounding
    return _Pair(
        signed_compression=compression,
        in_post=choose(is_pressed, take_larger(compression, 0.0), compression),
        tension=tension,
        is_along=is_along,
        can_pull=find_none(is_along, is_slack),
        holds=find_none(is_along, is_slack, find_none(is_pressed)),
    )


def _explain(held: HeadForces[float]) -> Message:
    """Reason why nothing holds a head."""
    uphill, downhill = (
        say("support.guy_along_post" if is_along else "support.guy_pushes")
        for is_along in (held.is_uphill_along, held.is_downhill_along)
    )
    return say("support.no_equilibrium", uphill=uphill, downhill=downhill)


def cross(a: Vector[Number], b: Vector[Number]) -> Number:
    """Moment of ``b`` about the tail of ``a``, positive from X towards Y."""
    return a[0] * b[1] - a[1] * b[0]


def find_direction(start: Vector[Number], end: Vector[Number]) -> Vector[Number]:
    """Unit vector from ``start`` to ``end``; (0, 0) where they coincide."""
    x, y = end[0] - start[0], end[1] - start[1]
    length = measure_length(x, y)
    divisor = length + (length == 0.0)
    return x / divisor, y / divisor


def list_directions(points: SupportPoints) -> tuple[Point, Point, Point]:
    """Unit vectors from the head along post, uphill and downhill guy, as a section.

    That of a member without a length is (0, 0).
    """
    ends = (points.post_base, points.uphill_anchor, points.downhill_anchor)
    post, uphill, downhill = (find_direction(points.head, end) for end in ends)
    return post, uphill, downhill


def _is_finite(pull: Point, points: SupportPoints) -> bool:
    places = (points.post_base, points.uphill_anchor, points.downhill_anchor)
    return all(map(math.isfinite, chain(pull, points.head, *places)))
