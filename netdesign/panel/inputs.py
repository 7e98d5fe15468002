"""Inputs of a panel: its ropes, and how its net is cut."""

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
