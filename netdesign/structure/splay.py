"""Post head under a load along the row: splayed guys, and the guy of the row's end.

The section's equilibrium is that of head.py; the forces by the load along the row are
added here. Theory: structure/THEORY.md, eqs. (S15) to (S19) and (S24) to (S26).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from netdesign.numerics.arrays import Floats, Ints
from netdesign.outcome import require_within
from netdesign.structure.head import (
    FailedSupport,
    HeadForces,
    Vector,
    Ways,
    compute_head_forces,
    cross,
    find_direction,
    hold_head,
    list_directions,
)
from netdesign.structure.layout import (
    Point,
    SupportLayout,
    SupportPoints,
    locate_base,
)

LEAST_SPLAY, MOST_SPLAY = math.radians(5.0), math.radians(60.0)
_FLATTEST = 1e-3  # of an end guy to the row; its anchor then lies far away [rad]

# Downslope, normal to the slope, along the row: positive into the row from its end.
Place = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class EndGuy:
    """Guy that holds the head of a row's first or last post along the row.

    Its anchor lies abreast of the head.

    Attributes
    ----------
    angle : float
        gamma, true angle between the guy and the row [rad].
    """

    angle: float

    @property
    def way(self) -> Place:
        """Unit vector from the head to the anchor; structure/THEORY.md, eq. (S24).

        The guy pulls the head that way, and its anchor the other way.

        Verified by
        -----------
        tests/verification/test_end_guy.py
        """
        return 0.0, -math.sin(self.angle), -math.cos(self.angle)

    def find_anchor(self, points: SupportPoints) -> Place:
        """Point of the anchor on the ground, from the net's foot beside the post [m].

        Parameters
        ----------
        points : SupportPoints
            Of the support at the row's end [m].
        """
        x, y = points.head
        return x, 0.0, -y / math.tan(max(self.angle, _FLATTEST))


@dataclass(frozen=True, slots=True, kw_only=True)
class Guys:
    """Guys on each side of a post, uphill and downhill alike.

    Attributes
    ----------
    count : int
        1 or 2.
    splay : float or None
        beta, between each of two guys and the section [rad]; None if not given.
    are_shared : bool or None
        One anchor holds a guy of each of two neighbouring posts; None if not given.
    """

    count: int = 1
    splay: float | None = None
    are_shared: bool | None = None

    def __post_init__(self) -> None:
        """Refuse what the model does not know."""
        require_within("guys", self.count, 1, 2)
        if self.splay is not None:
            require_within("splay", self.splay, LEAST_SPLAY, MOST_SPLAY, "rad")


@dataclass(frozen=True, slots=True, kw_only=True)
class SplayWeights:
    """Geometry of a head, as the bounds (S17) and (S18) need it.

    Attributes
    ----------
    uphill : float
        kappa, part that the uphill guy takes of what both guys hold together [-].
    post : float
        Compression of the post for each N that both guys hold together [-].
    """

    uphill: float
    post: float

    @property
    def largest_uphill(self) -> float:
        """Largest part of S / sin(beta) in one uphill guy [-]."""
        return max(0.5, self.uphill)

    @property
    def largest_downhill(self) -> float:
        """Largest part of S / sin(beta) in one downhill guy [-]."""
        return max(0.5, 1.0 - self.uphill)


def is_held_sideways(
    pulls: Floats,
    places: Sequence[SupportPoints],
    at: Ints,
    *,
    share: float,
    splay: float,
) -> bool:
    """Whether post and guys hold all of some heads, and `weigh_splay` each.

    Theory: structure/THEORY.md, eqs. (S15) and (S16).

    Parameters
    ----------
    pulls : ndarray, shape (2, n)
        Force of the net on each head in the section [N].
    places : sequence of SupportPoints
        Supports on which the heads stand [m].
    at : ndarray of int, shape (n,)
        Which of these each head is of.
    share : float
        Load on a head along the row, over its pull [-].
    splay : float
        beta [rad].

    Verified by
    -----------
    tests/structure/test_splay.py
    """
    ways = np.array([list_directions(points) for points in places])[at]
    (post, uphill, downhill) = ((way[0], way[1]) for way in ways.transpose(1, 2, 0))
    x, y = pulls
    head = hold_head((x, y), post, uphill, downhill)
    held = share * np.hypot(x, y) / math.tan(splay)
    above, below = cross(uphill, post), cross(downhill, post)
    in_uphill = (-cross((x, y), post) - held * below) / (above - below)
    tension = head.uphill_guy_tension + head.downhill_guy_tension
    is_loaded = (in_uphill >= 0.0) & (held - in_uphill >= 0.0)
    is_between = above * below < 0.0
    return bool((head.is_held & is_between & ((tension >= held) | is_loaded)).all())


def weigh_splay(points: SupportPoints) -> SplayWeights | None:
    """Parts that two guys on one side take; None unless the post stands between them.

    Theory: structure/THEORY.md, eqs. (S17) and (S18).

    Parameters
    ----------
    points : SupportPoints
        Head, post base and anchors, in the section [m].
    """
    post, uphill, downhill = list_directions(points)
    above, below = cross(uphill, post), cross(downhill, post)
    if not above * below < 0.0:
        return None
    share = abs(below) / (abs(above) + abs(below))
    return SplayWeights(
        uphill=share,
        post=share * _dot(uphill, post) + (1 - share) * _dot(downhill, post),
    )


def hold_end_guy(points: SupportPoints) -> HeadForces[float] | FailedSupport:
    """Forces in post and guys that hold the end guy's pull across the row.

    Parameters
    ----------
    points : SupportPoints
        Of the support at the row's end, in the section [m].

    Returns
    -------
    HeadForces or FailedSupport
        For each unit of the part V across the row of all of the ridge rope's pull;
        structure/THEORY.md, (S25).

    Verified by
    -----------
    tests/verification/test_end_guy.py
    """
    return compute_head_forces((0.0, -1.0), points)


@dataclass(frozen=True, slots=True, kw_only=True)
class EndHead:
    """Head at a row's end, pulled by its net and along the row by the ridge rope.

    Attributes
    ----------
    points : SupportPoints
        In the section [m].
    pull : tuple of float, shape (2,)
        Of the net, in the section [N].
    along : float
        H, of the ridge rope along the row [N].
    """

    points: SupportPoints
    pull: Point
    along: float


_ROPES = 5  # outer and inner guy uphill, the two downhill, end guy
_WORKING = np.array(list(product((False, True), repeat=_ROPES)))
_SINGULAR = 1e-12  # determinant of stiffnesses, over their sum, of what stands not
_NO_LENGTH = 1e-9  # of a rope that is slack: its lengthening over the largest [-]


def share_with_end_guy(
    heads: Sequence[EndHead],
    *,
    splay: float,
    guy: EndGuy,
    stiffness: Sequence[Sequence[float]],
) -> Floats | None:
    """Tensions of the ropes at a row's end as a linear truss shares H among them.

    Post, four splayed guys and end guy on a head that moves a little; ropes only pull.
    Of all sets of working ropes one has none that pushes and no slack one that is
    longer. Theory: structure/THEORY.md, eq. (S26).

    Parameters
    ----------
    heads : sequence of EndHead
        States.
    splay : float
        beta [rad].
    guy : EndGuy
        The sixth member.
    stiffness : sequence of float, shape (m, 4)
        EA of uphill guys, downhill guys, end guy and post, each way that they may be
        [N].

    Returns
    -------
    ndarray or None, shape (n, m, 5)
        Of outer and inner uphill guy, outer and inner downhill guy, end guy, by state
        and by stiffness [N]; None where the truss does not stand.

    Verified by
    -----------
    tests/verification/test_end_guy.py
    """
    ways, lengths = _list_ropes([head.points for head in heads], splay, guy)
    loads = np.array([(*head.pull, head.along) for head in heads])
    axial = np.array(stiffness)
    ends = axial[:, [0, 0, 1, 1, 2]] / lengths[:, None]  # (n, m, 5)
    posts = np.array([(*list_directions(head.points)[0], 0.0) for head in heads])
    of_post = axial[:, 3] / np.array([[head.points.post_length] for head in heads])
    frame = of_post[..., None, None] * (posts[:, :, None] * posts[:, None, :])[:, None]
    squares = ways[..., :, None] * ways[..., None, :]  # (n, 5, 3, 3)
    of_ropes = ends[..., None, None] * squares[:, None]
    matrices = frame[:, :, None] + np.einsum("sr,nmrij->nmsij", _WORKING, of_ropes)
    size = np.trace(matrices, axis1=-2, axis2=-1)
    stands = np.linalg.det(matrices / size[..., None, None]) > _SINGULAR
    matrices[~stands] = np.eye(3)
    pulls = np.broadcast_to(loads[:, None, None], matrices.shape[:-1])
    moved = np.linalg.solve(matrices, pulls[..., None])
    longer = -np.einsum("nri,nmsi->nmsr", ways, moved[..., 0])
    small = _NO_LENGTH * np.abs(longer).max(axis=-1, keepdims=True)
    fits = stands & np.where(_WORKING, longer >= -small, longer <= small).all(axis=-1)
    if not fits.any(axis=-1).all():
        return None
    first = fits.argmax(axis=-1)[..., None, None]
    lengthened = np.take_along_axis(longer, first, axis=2)[:, :, 0]
    tensions: Floats = ends * np.maximum(lengthened, 0.0)
    return tensions


def _list_ropes(
    places: Sequence[SupportPoints], splay: float, guy: EndGuy
) -> tuple[Floats, Floats]:
    """Unit vectors from each head along its five ropes, (n, 5, 3); lengths (n, 5) [m].

    The outer guys go towards the row's end, against the pull of the ridge rope.
    """
    ways, lengths = [], []
    for points in places:
        _, *guys = list_directions(points)
        anchors = (points.uphill_anchor, points.downhill_anchor)
        in_section = [math.dist(points.head, anchor) for anchor in anchors]
        flat, out = math.cos(splay), math.sin(splay)
        ways.append(
            [(x * flat, y * flat, side * out) for x, y in guys for side in (-1.0, 1.0)]
        )
        ways[-1].append(guy.way)
        long = [length / flat for length in in_section for _ in range(2)]
        end = math.dist((*points.head, 0.0), guy.find_anchor(points))
        lengths.append([*long, end])
    return np.array(ways), np.array(lengths)


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1]


def find_ways(layouts: Sequence[SupportLayout], heads: Vector[Floats]) -> Ways:
    """Unit vectors from some heads along their members, on each layout.

    Parameters
    ----------
    layouts : sequence of SupportLayout, shape (m,)
        Of the supports.
    heads : tuple of ndarray, shape (2, ..)
        Where each net hangs, from its foot [m].

    Returns
    -------
    tuple of tuple of ndarray, shape (3, 2, m, ..)
        [-].
    """
    bases = np.array([locate_base(layout, *heads) for layout in layouts])
    ground = np.zeros_like(bases)
    uphill, downhill = np.array(
        [(x.uphill_anchor_distance, x.downhill_anchor_distance) for x in layouts]
    ).T.reshape(2, -1, *[1] * heads[0].ndim)
    return (
        find_direction(heads, (bases, ground)),
        find_direction(heads, (ground - uphill, ground)),
        find_direction(heads, (bases + downhill, ground)),
    )
