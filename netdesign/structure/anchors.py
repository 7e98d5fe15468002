"""Forces of one support on the ground, per anchor.

First: directions of the pulls on an anchor, and their angles to its axis.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from netdesign.numerics.arrays import (
    Floats,
    Mask,
    Number,
    as_mask,
    measure_length,
    measure_turn,
    take_larger,
)
from netdesign.outcome import Outcome, require_positive, require_within
from netdesign.structure.head import (
    FailedSupport,
    HeadForces,
    Vector,
    Ways,
    compute_head_forces,
    hold_head,
)
from netdesign.structure.layout import Point, SupportPoints
from netdesign.structure.members import Member
from netdesign.words.message import say


@dataclass(frozen=True, slots=True, kw_only=True)
class PullRange:
    """Directions of the pulls on one anchor.

    Attributes
    ----------
    least, largest : float
        As `measure_pull` counts them [rad].
    """

    least: float
    largest: float

    @property
    def mean(self) -> float:
        """Middle of the two [rad]."""
        return 0.5 * (self.least + self.largest)

    def find_largest_angle(self, axis: float) -> float:
        """Largest angle between a pull of the range and an axis.

        Parameters
        ----------
        axis : float
            Inclination of the anchor [rad].

        Returns
        -------
        float
            [rad].
        """
        return max(abs(self.least - axis), abs(self.largest - axis))


def measure_pull(x: Number, y: Number, anchor: str) -> Number:
    """Inclination of a pull on an anchor; structure/THEORY.md, eq. (S12).

    Parameters
    ----------
    x, y : float or ndarray
        Force on the ground, X downslope and Y out of it [N].
    anchor : str
        Which of the three it is; it says which way along the slope counts as 0.

    Returns
    -------
    float or ndarray
        Against the slope surface, pi/2 straight out of the ground [rad].
    """
    facing = -1.0 if anchor == Member.DOWNHILL_ANCHOR else 1.0
    return measure_turn(facing * x, y)


def turn_by_splay(inclination: float, splay: float) -> float:
    """Inclination of a guy that leaves the section; structure/THEORY.md, eq. (S12).

    Parameters
    ----------
    inclination : float
        Of the guy's line in the section, 0 to pi [rad].
    splay : float
        beta, between the guy and the section [rad].

    Returns
    -------
    float
        Of the guy in space, against the slope surface [rad].
    """
    rise = math.asin(math.cos(splay) * math.sin(inclination))
    return rise if inclination <= 0.5 * math.pi else math.pi - rise


def find_pull_range(directions: Iterable[float]) -> PullRange | None:
    """Range of the directions of some pulls.

    Parameters
    ----------
    directions : iterable of float
        As `measure_pull` counts them [rad].

    Returns
    -------
    PullRange or None
        None of none.
    """
    ordered = sorted(directions)
    return PullRange(least=ordered[0], largest=ordered[-1]) if ordered else None


def turn_sideways(angle: float, share: float) -> float:
    """Angle between a force and an axis in the section, with a part along the row.

    Theory: structure/THEORY.md, eq. (S14).

    Parameters
    ----------
    angle : float
        Of the part in the section, 0 to pi [rad].
    share : float
        Part along the row over that in the section [-].

    Returns
    -------
    float
        [rad].

    Raises
    ------
    ModelError
        If the share is out of its range.
    """
    require_within("lateral share", share, 0.0, 10.0)
    return math.acos(math.cos(angle) / math.hypot(1.0, share))


NO_FOOT_PULL = FailedSupport(
    outcome=Outcome.NONFINITE, reason=say("support.foot_no_number")
)


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundForce:
    """Force of the structure on the ground at one point, per anchor.

    Attributes
    ----------
    x, y : float
        Parts along the slope (downslope positive) and normal to it (out of the
        ground positive) [N].
    """

    x: float
    y: float

    @property
    def size(self) -> float:
        """Size of the force [N]."""
        return math.hypot(self.x, self.y)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchorForces:
    """Forces of one support on the ground, per anchor [N].

    Attributes
    ----------
    foot_anchor, uphill_anchor, downhill_anchor, post_base : GroundForce
        Force at each point; that of a slack guy is 0.
    head : HeadForces
        Forces in the members at the post head.
    is_foot_shared : bool
        The net's foot and the uphill guy end at the same point.
    """

    foot_anchor: GroundForce
    uphill_anchor: GroundForce
    downhill_anchor: GroundForce
    post_base: GroundForce
    head: HeadForces[float]
    is_foot_shared: bool

    @property
    def head_pull(self) -> Point:
        """Pull of the net on the head: what its members bring to the ground [N]."""
        brought = (self.post_base, self.uphill_anchor, self.downhill_anchor)
        return sum(force.x for force in brought), sum(force.y for force in brought)

    @property
    def member_forces(self) -> dict[str, float]:
        """Characteristic force that each member must resist, by its name [N].

        One anchor for net and uphill guy takes the sum of both sizes, which is
        never less than their resultant. Theory: structure/THEORY.md, eq. (S7).
        """
        return _list_forces(
            self.head,
            foot=self.foot_anchor.size,
            out_of_ground=self.post_base.y,
            is_foot_shared=self.is_foot_shared,
        )


def compute_member_forces(
    ways: Ways,
    *,
    foot_pull_per_m: Vector[Floats],
    head_pull_per_m: Vector[Floats],
    post_spacing: float,
    is_foot_shared: bool,
) -> tuple[dict[str, Floats], Mask]:
    """Forces of many supports under many pulls, each as by `compute_anchor_forces`.

    Parameters
    ----------
    ways : tuple of tuple of ndarray
        Of the members at each head.
    foot_pull_per_m, head_pull_per_m : tuple of ndarray, shape (2,)
        As there, finite, of shapes that go together with the ways' [N/m].
    post_spacing, is_foot_shared : float, bool
        As there, of all supports [m].

    Returns
    -------
    dict of str to ndarray, ndarray of bool
        Forces by member [N], each of the shape that its parts have together; of use
        only where the second says that the head is held.

    Verified by
    -----------
    tests/structure/test_many_forces.py
    """
    held = hold_head(_scale(head_pull_per_m, post_spacing), *ways)
    of_members = _list_forces(
        held,
        foot=measure_length(*_scale(foot_pull_per_m, post_spacing)),
        out_of_ground=held.post_compression * ways[0][1],
        is_foot_shared=is_foot_shared,
    )
    return of_members, as_mask(held.is_held)


def _list_forces(
    head: HeadForces[Number],
    *,
    foot: Number,
    out_of_ground: Number,
    is_foot_shared: bool,
) -> dict[str, Number]:
    """Forces by (S7), (S8): an anchor resists its guy's, a base what presses it."""
    uphill, downhill = head.guy_demands
    on_foot = foot + uphill if is_foot_shared else foot
    return {
        Member.FOOT_ANCHOR: on_foot,
        Member.UPHILL_GUY: uphill,
        Member.UPHILL_ANCHOR: on_foot if is_foot_shared else uphill,
        Member.DOWNHILL_GUY: downhill,
        Member.DOWNHILL_ANCHOR: downhill,
        Member.POST: head.post_compression,
        Member.POST_BASE: take_larger(-out_of_ground, 0.0),
        Member.POST_FOOT: head.post_tension,
    }


def compute_anchor_forces(
    points: SupportPoints,
    *,
    foot_pull_per_m: Point,
    head_pull_per_m: Point,
    post_spacing: float,
) -> AnchorForces | FailedSupport:
    """Find the forces on the ground from the pulls of the net's two ends.

    Theory: structure/THEORY.md, eqs. (S5) and (S6).

    Parameters
    ----------
    points : SupportPoints
        Geometry of the support [m].
    foot_pull_per_m, head_pull_per_m : tuple of float, shape (2,)
        Force of the net on its foot anchor and on the post head, (x, y), X
        downslope, Y normal to the slope, per metre of net [N/m].
    post_spacing : float
        Width of net that one support carries [m].

    Returns
    -------
    AnchorForces or FailedSupport
        Forces on the ground, per anchor [N], or why the support cannot stand.

    Raises
    ------
    ModelError
        If the post spacing is not a finite number above 0.

    Verified by
    -----------
    verification/test_head_equilibrium.py
    """
    require_positive("post spacing", post_spacing, "m")
    foot = _scale(foot_pull_per_m, post_spacing)
    if not (math.isfinite(foot[0]) and math.isfinite(foot[1])):
        return NO_FOOT_PULL
    head = compute_head_forces(_scale(head_pull_per_m, post_spacing), points)
    if isinstance(head, FailedSupport):
        return head
    thrusts = (
        (points.post_base, head.post_compression - head.post_tension),
        (points.uphill_anchor, -head.uphill_guy_tension),
        (points.downhill_anchor, -head.downhill_guy_tension),
    )
    base, uphill, downhill = (
        _force_from_head(points.head, place, thrust) for place, thrust in thrusts
    )
    return AnchorForces(
        foot_anchor=GroundForce(x=foot[0], y=foot[1]),
        uphill_anchor=uphill,
        downhill_anchor=downhill,
        post_base=base,
        head=head,
        is_foot_shared=points.is_foot_shared,
    )


def _force_from_head(head: Point, place: Point, thrust: float) -> GroundForce:
    """Force of a member on ``place``; ``thrust`` [N] pushes it away from the head."""
    if thrust == 0.0:  # also where a slack guy has no length
        return GroundForce(x=0.0, y=0.0)
    x, y = place[0] - head[0], place[1] - head[1]
    length = math.hypot(x, y)
    return GroundForce(x=thrust * x / length, y=thrust * y / length)


def _scale(pull_per_m: Vector[Number], width: float) -> Vector[Number]:
    return (pull_per_m[0] * width, pull_per_m[1] * width)
