"""Smooth quantities behind member forces that have kinks.

Where a guy goes slack its force and that of the post have a kink, which a model of
the forces would pay for with many cases. The forces that post and one guy would need,
signs allowed, have none: a guy carries the signed tension where that is positive, and
the post the larger of its two signed compressions. So these are what is searched, and
what the members can carry at most follows. Theory: structure/THEORY.md, eq. (S2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.structure.head import resolve_signed
from netdesign.structure.layout import (
    Point,
    SupportLayout,
    SupportPoints,
    place_support,
)
from netdesign.structure.members import CARRYING_MEMBERS, Member, name_in_panel

_NET = "signed foot"
_SHARED = "signed foot and uphill guy"
_POST = ("signed post with uphill guy", "signed post with downhill guy")
_BASE = ("signed post base with uphill guy", "signed post base with downhill guy")
_UPHILL, _DOWNHILL = "signed uphill guy", "signed downhill guy"
_IN_PANEL = {name_in_panel(member): member for member in CARRYING_MEMBERS}


def read_signed(result: CaseResult, layout: SupportLayout) -> dict[str, float] | None:
    """Signed forces of a converged case by name [N]; None where a guy holds nothing.

    A guy along the post holds nothing sideways: there the members themselves have to
    be searched. Those by the panel between posts stand behind those of the section.
    """
    solution, anchors = result.solution, result.anchors
    if solution is None or anchors is None:
        return None
    width = layout.post_spacing
    pull = (solution.head.x * width, solution.head.y * width)
    points = place_support(layout, solution.head_point)
    found = _find_signed(pull, anchors.foot_anchor.size, points)
    if found is None or not isinstance(result.panel, PanelForces):
        return found
    beside = (_find_signed_in_panel(one, points) for one in result.panel.variants)
    return found | _name_largest(beside)


def read_signed_errors(
    result: CaseResult, layout: SupportLayout
) -> dict[str, float] | None:
    """Numerical errors of the forces that ``read_signed`` gives [N]."""
    solution = result.solution
    if solution is None or result.anchors is None:
        return None
    points = place_support(layout, solution.head_point)
    width = layout.post_spacing
    found = _find_errors(
        solution.foot.error * width, solution.head.error * width, points
    )
    if found is None or not isinstance(result.panel, PanelForces):
        return found
    pulls = [(one.foot.error, one.head.error) for one in result.panel.variants]
    foot, head = (width * max(errors) for errors in zip(*pulls, strict=True))
    beside = _find_errors(foot, head, points) or {}
    return found | {name_in_panel(name): error for name, error in beside.items()}


def _find_signed_in_panel(
    panel: PanelForces, points: SupportPoints
) -> dict[str, float]:
    """Signed forces by one panel between posts [N]."""
    foot = max(panel.anchors.foot_anchor.size, math.hypot(*panel.solution.mid_foot))
    return _find_signed(panel.solution.head, foot, points) or {}


def _name_largest(found: Iterable[dict[str, float]]) -> dict[str, float]:
    """Largest values of some panels, by their names beside those of the section."""
    largest: dict[str, float] = {}
    for values in found:
        for name, value in values.items():
            known = largest.get(name_in_panel(name), -math.inf)
            largest[name_in_panel(name)] = max(known, value)
    return largest


def _find_errors(
    foot: float, head: float, points: SupportPoints
) -> dict[str, float] | None:
    """Errors of signed forces from those of the forces behind them [N].

    They are linear in these: what an error of each component causes is added, as in
    the bands of the members.
    """
    sizes: dict[str, float] = {}
    for pull, at_foot in (((head, 0.0), 0.0), ((0.0, head), 0.0), ((0.0, 0.0), foot)):
        caused = _find_signed(pull, at_foot, points)
        if caused is None:
            return None
        sizes = {name: sizes.get(name, 0.0) + abs(caused[name]) for name in caused}
    return sizes


def _find_signed(
    pull: Point, foot: float, points: SupportPoints
) -> dict[str, float] | None:
    """Signed forces under a pull on the head and a force on the foot anchor [N]."""
    pairs = [
        resolve_signed(pull, points.head, points.post_base, anchor)
        for anchor in (points.uphill_anchor, points.downhill_anchor)
    ]
    if pairs[0] is None or pairs[1] is None:
        return None
    (post_up, uphill), (post_down, downhill) = pairs[0], pairs[1]
    across = points.head[1] / _length(points.head, points.post_base)
    return {
        _NET: foot,
        _SHARED: foot + uphill,
        _UPHILL: uphill,
        _DOWNHILL: downhill,
        _POST[0]: post_up,
        _POST[1]: post_down,
        _BASE[0]: across * post_up,
        _BASE[1]: across * post_down,
    }


def name_sources(member: str, *, is_shared: bool) -> tuple[str, ...]:
    """Signed forces of which a member carries the largest, or 0; () if of none."""
    if member in _IN_PANEL:
        behind = name_sources(_IN_PANEL[member], is_shared=is_shared)
        return tuple(map(name_in_panel, behind))
    sources: dict[str, tuple[str, ...]] = {
        Member.FOOT_ANCHOR: (_NET,),
        Member.UPHILL_GUY: (_UPHILL,),
        Member.UPHILL_ANCHOR: (_UPHILL,),
        Member.DOWNHILL_GUY: (_DOWNHILL,),
        Member.DOWNHILL_ANCHOR: (_DOWNHILL,),
        Member.POST: _POST,
        Member.POST_BASE: _BASE,
    }
    if is_shared and member in (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR):
        return (_NET, _SHARED)
    return sources.get(member, ())


def choose_watched(
    members: Sequence[str], signed: Sequence[str], *, is_shared: bool
) -> tuple[str, ...]:
    """Quantities that a search has to bound, so that every member is bounded."""
    if not signed:
        return tuple(members)
    watched: dict[str, None] = {}
    for member in members:
        sources = name_sources(member, is_shared=is_shared)
        watched |= dict.fromkeys(sources or (member,))
    return tuple(watched)


def _length(one: tuple[float, float], other: tuple[float, float]) -> float:
    x, y = one[0] - other[0], one[1] - other[1]
    return float((x * x + y * y) ** 0.5)
