"""Inputs of a panel: its ropes, the cut of its net, and the panels in use.

A row whose panel is not given in full is calculated with a few panels at the ends of
what is built; the worst counts. Which is worst for which member: panel/THEORY.md, 6.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

from netdesign.outcome import require_one_of, require_positive, require_within

# uniform: one length everywhere; upper: to the hanging ridge rope; fitted: to both.
Cut = Literal["uniform", "upper", "fitted"]
CUTS: tuple[Cut, ...] = get_args(Cut)

# A parabola of this sag is 22 % longer than its span: no border rope hangs so low.
LARGEST_SAG = 0.3
# A steeper end guy holds next to nothing along the row.
LARGEST_GUY_ANGLE = math.radians(80.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rope:
    """A border rope that carries the net between its supports.

    Attributes
    ----------
    stiffness : float
        EA, axial: force at unit strain [N].
    sag : float
        s_b, as built and without snow, over the span [-].
    """

    stiffness: float
    sag: float

    def __post_init__(self) -> None:
        """Refuse what no rope has; an infinite stiffness too."""
        require_positive("rope stiffness", self.stiffness, "N")
        require_within("rope sag", self.sag, 0.0, LARGEST_SAG)


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """A rectangular panel of net between two posts.

    Attributes
    ----------
    post_spacing : float
        a, along the contour [m].
    lower, upper : Rope
        At the net's foot, and from post head to post head.
    cut : str
        ``uniform``, ``upper`` or ``fitted``: the net's unstressed length (P4).
    has_mid_anchors : bool
        The lower rope is also anchored half way between the posts.
    """

    post_spacing: float
    lower: Rope
    upper: Rope
    cut: Cut
    has_mid_anchors: bool = False

    def __post_init__(self) -> None:
        """Refuse a spacing that is none, and an unknown cut."""
        require_positive("post spacing", self.post_spacing, "m")
        require_one_of("cut", self.cut, CUTS)


SAGS = (0.08, 0.15)  # of ropes as built, over the span
STIFFNESSES = (3e6, 150e6)  # EA of border ropes [N]
# EA over the breaking force: ropes of strands, then spiral ropes of round wires.
OF_BREAKING = (25.0, 160.0)

Ends = tuple[float, float]  # least and largest value; equal where it is given

# Cut; which end of the sag of ridge rope and lower rope, and of their EA.
_WORST: tuple[tuple[Cut, int, int, int, int], ...] = (
    # for the uphill guy
    ("uniform", 0, 0, 1, 0),
    ("uniform", 0, 1, 0, 0),
    ("uniform", 0, 1, 1, 0),
    ("uniform", 0, 1, 1, 1),
    ("uniform", 1, 1, 0, 0),
    ("uniform", 1, 1, 1, 0),
    ("upper", 0, 0, 1, 0),
    ("upper", 0, 1, 0, 0),
    ("upper", 0, 1, 1, 0),
    ("upper", 0, 1, 1, 1),
    ("fitted", 0, 1, 1, 0),
    # for lower rope and ridge rope along the row
    ("fitted", 1, 0, 1, 1),
    ("fitted", 0, 1, 1, 1),
    # for foot anchor, post and downhill guy
    ("fitted", 1, 1, 1, 1),
)


def find_stiffness(stiffness: float | None, breaking: float | None) -> Ends:
    """Least and largest EA of a border rope [N].

    Parameters
    ----------
    stiffness, breaking : float or None
        EA and breaking force of its type [N]; None where not given.
    """
    if stiffness is not None:
        return stiffness, stiffness
    if breaking is None:
        return STIFFNESSES
    least, largest = STIFFNESSES
    low, high = (min(max(share * breaking, least), largest) for share in OF_BREAKING)
    return low, high


def list_panels(
    post_spacing: float,
    *,
    sags: tuple[float | None, float | None],
    stiffnesses: tuple[Ends, Ends],
    has_mid_anchors: bool,
) -> tuple[Panel, ...]:
    """Panels of which the worst counts, since no input gives the cut of the net.

    Parameters
    ----------
    post_spacing : float
        a [m].
    sags : tuple of float or None, shape (2,)
        Of ridge rope and lower rope, as built, over the span [-].
    stiffnesses : tuple of tuple of float, shape (2, 2)
        Least and largest EA of ridge rope and lower rope [N].
    has_mid_anchors : bool
        Of the lower rope.
    """
    of_sags = [(sag, sag) if sag is not None else SAGS for sag in sags]
    panels = {
        Panel(
            post_spacing=post_spacing,
            upper=Rope(stiffness=stiffnesses[0][stiff], sag=of_sags[0][ridge]),
            lower=Rope(stiffness=stiffnesses[1][soft], sag=of_sags[1][lower]),
            cut=cut,
            has_mid_anchors=has_mid_anchors,
        ): None
        for cut, ridge, lower, stiff, soft in _WORST
    }
    return tuple(panels)
