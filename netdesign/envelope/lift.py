"""Tension of a post between the cases of a search, and what it brings to the members.

A post pulls only where the net pulls its head away from the slope: structure/THEORY.md,
(S4a). So that direction is bounded first, which tells nearly always that none does.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats
from netdesign.search.maxima import SearchSettings
from netdesign.search.surrogate import Point, fit_surrogate, supports_model
from netdesign.search.upper_bound import NOISE, bound_quantities, build_lattice
from netdesign.structure.head import resolve_loose
from netdesign.structure.layout import SupportLayout, place_support
from netdesign.structure.members import Member, name_in_panel

# Tension of a post, by the section and by the panel between posts.
POST_PULLS: tuple[str, ...] = (Member.POST_FOOT, name_in_panel(Member.POST_FOOT))
# Members that each of the forces of `_measure` loads; the last one of a shared anchor.
_LIFTED = (
    (Member.POST_FOOT,),
    (Member.DOWNHILL_GUY, Member.DOWNHILL_ANCHOR),
    (Member.UPHILL_GUY, Member.UPHILL_ANCHOR),
    (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR),
)


def bound_lifted(
    layout: SupportLayout | None,
    points: Sequence[Point],
    results: Sequence[CaseResult],
    settings: SearchSettings,
) -> Mapping[str, float]:
    """Upper bounds of foot and guys where some post may pull, by name [N].

    Parameters
    ----------
    layout : SupportLayout or None
        Support of the net; without one there is no post.
    points, results : sequence of Point, of CaseResult
        Of a search: shares of the ranges, and what was solved there.
    settings : SearchSettings
        Of that search.

    Returns
    -------
    mapping of str to float
        Empty where no post pulls anywhere in the ranges, and where too few cases were
        solved for any bound.

    Verified by
    -----------
    tests/envelope/test_lift.py
    """
    solved = [
        (point, one)
        for point, one in zip(points, results, strict=True)
        if one.anchors is not None
    ]
    places = np.array([point for point, _ in solved])
    if layout is None or not solved or not supports_model(places):
        return {}
    values = np.array([_measure(layout, one) for _, one in solved])
    tolerance = np.full(values.shape[1], settings.gap * np.abs(values[:, 1:]).max())
    tolerance[0] = settings.gap  # of a sine
    bound = partial(
        bound_quantities,
        fit_surrogate(places, values, NOISE * tolerance),
        values,
        best=np.maximum(values.max(axis=0), 0.0),
        tolerance=tolerance,
        deciding=(),
        lattice=build_lattice(places.shape[1]),
        certainty=settings.certainty,
        inflations=(),
    )
    if not bound(watched=(0,)).upper[0] > 0.0:
        return {}
    upper = bound(watched=range(values.shape[1])).upper.tolist()[1:]
    found = {
        str(one): force
        for members, force in zip(_LIFTED, upper, strict=False)
        for one in members
    }
    return found | {name_in_panel(one): force for one, force in found.items()}


def _measure(layout: SupportLayout, result: CaseResult) -> Floats:
    """Sine of the pull on the head out of the slope, and forces that follow it [N].

    The largest of section and panels: the lift, (S4a), and the guys without the post,
    (S4b); where net and guy share an anchor, what both bring there.
    """
    if result.anchors is None or result.solution is None:
        raise ValueError("a case without a support")
    points = place_support(layout, result.solution.head_point)
    panels = result.panel.variants if isinstance(result.panel, PanelForces) else ()
    found = []
    for anchors in (result.anchors, *(one.anchors for one in panels)):
        x, y = anchors.head_pull
        uphill, downhill = resolve_loose((x, y), points)
        lift = y * points.post_length / points.head[1]
        forces = [y / (math.hypot(x, y) or 1.0), lift, downhill, uphill]
        shared = [anchors.foot_anchor.size + uphill] if layout.is_foot_shared else []
        found.append(forces + shared)
    largest: Floats = np.array(found).max(axis=0)
    return largest
