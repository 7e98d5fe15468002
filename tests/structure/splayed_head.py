"""Head of splayed guys under a load along the row, in full: (S15) and (S16).

The program counts with the bounds (S17) and (S18); these forces are what they bound.
"""

import math
from dataclasses import dataclass

from netdesign.outcome import Outcome
from netdesign.structure.head import (
    FailedSupport,
    compute_head_forces,
    cross,
    list_directions,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class SplayedHead:
    """Forces at a head of two splayed guys on each side; the more loaded guy's [N].

    ``is_one_sided``: one guy of each side is slack, both others share the load.
    """

    post_compression: float
    post_tension: float
    uphill_guy_tension: float
    downhill_guy_tension: float
    is_one_sided: bool


def compute_splayed_head(pull, points, *, sideways, splay):
    """Forces under a pull in the section and a load ``sideways`` on the head [N]."""
    flat = compute_head_forces(pull, points)
    if isinstance(flat, FailedSupport):
        return flat
    held = sideways / math.tan(splay)
    tension = flat.uphill_guy_tension + flat.downhill_guy_tension  # one is 0
    if tension >= held:
        larger = 0.5 * (tension + held) / math.cos(splay)
        is_uphill = flat.uphill_guy_tension > 0.0
        return SplayedHead(
            post_compression=flat.post_compression,
            post_tension=flat.post_tension,
            uphill_guy_tension=larger if is_uphill else 0.0,
            downhill_guy_tension=0.0 if is_uphill else larger,
            is_one_sided=False,
        )
    return _share_on_loaded_side(pull, points, held, splay)


def _share_on_loaded_side(pull, points, held, splay):
    """Eq. (S16): one guy uphill, one downhill and the post, all in force."""
    post, uphill, downhill = list_directions(points)
    above, below = cross(uphill, post), cross(downhill, post)
    if not above * below < 0.0:
        return _fail()
    in_uphill = (-cross(pull, post) - held * below) / (above - below)
    in_downhill = held - in_uphill
    compression = (
        _dot(pull, post)
        + in_uphill * _dot(uphill, post)
        + in_downhill * _dot(downhill, post)
    )
    if min(in_uphill, in_downhill) < 0.0:
        return _fail()
    return SplayedHead(
        post_compression=max(compression, 0.0),
        post_tension=max(-compression, 0.0),
        uphill_guy_tension=in_uphill / math.cos(splay),
        downhill_guy_tension=in_downhill / math.cos(splay),
        is_one_sided=True,
    )


def _fail():
    return FailedSupport(outcome=Outcome.NO_EQUILIBRIUM, reason="")


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1]
