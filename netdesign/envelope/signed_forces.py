"""Signed forces of a case, which a search follows in place of the members' forces.

The forces of guy and post have a kink where a guy goes slack, and a model of them would
need many cases. The forces that the post and one guy need for equilibrium, tension
positive and compression negative, have no kink. A guy carries its signed tension where
that is positive, the post the larger of its two signed compressions: bounds of the
signed forces bound the members. Theory: structure/THEORY.md, eq. (S2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Generic

import numpy as np

from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats, Number
from netdesign.structure.head import Vector, resolve_signed
from netdesign.structure.layout import (
    Point,
    SupportLayout,
    SupportPoints,
    place_support,
)
from netdesign.structure.members import CARRYING_MEMBERS, Member, name_in_panel


@dataclass(frozen=True, slots=True, kw_only=True)
class Ends(Generic[Number]):
    """Points of a support, or of many of shape (n, 1) [m]."""

    head: Vector[Number]
    base: Vector[Number]
    uphill: Vector[Number]
    downhill: Vector[Number]


def take_ends(points: SupportPoints) -> Ends[float]:
    """Points of a support without what is on the ground alone."""
    return Ends(
        head=points.head,
        base=points.post_base,
        uphill=points.uphill_anchor,
        downhill=points.downhill_anchor,
    )


def spread_ends(layouts: Sequence[SupportLayout], head: Point) -> Ends[Floats]:
    """Points of some layouts under one head."""
    places = [place_support(layout, head) for layout in layouts]

    def gather(points: Iterable[Point]) -> Vector[Floats]:
        x, y = np.array(list(points)).T[:, :, None]
        return x, y

    return Ends(
        head=gather(place.head for place in places),
        base=gather(place.post_base for place in places),
        uphill=gather(place.uphill_anchor for place in places),
        downhill=gather(place.downhill_anchor for place in places),
    )


_NET = "signed foot"
_SHARED = "signed foot and uphill guy"
_POST = ("signed post with uphill guy", "signed post with downhill guy")
_BASE = ("signed post base with uphill guy", "signed post base with downhill guy")
_UPHILL, _DOWNHILL = "signed uphill guy", "signed downhill guy"
_IN_PANEL = {name_in_panel(member): member for member in CARRYING_MEMBERS}


def read_signed(
    result: CaseResult, layouts: Sequence[SupportLayout]
) -> dict[str, float] | None:
    """Signed forces of a converged case by name [N]; None where a guy holds nothing.

    A guy along the post holds nothing sideways: there the members themselves have to
    be searched. Those by the panel between posts stand behind those of the section.
    Each is the largest on any of the layouts.
    """
    solution, anchors = result.solution, result.anchors
    if solution is None or anchors is None:
        return None
    width, head = layouts[0].post_spacing, solution.head_point
    panels = result.panel.variants if isinstance(result.panel, PanelForces) else ()
    pulls = [
        (solution.head.x * width, solution.head.y * width),
        *(panel.solution.head for panel in panels),
    ]
    feet = [anchors.foot_anchor.size, *map(_find_foot, panels)]
    first = take_ends(place_support(layouts[0], head))
    states = [
        _find_signed(pull, foot, first) for pull, foot in zip(pulls, feet, strict=True)
    ]
    if others := layouts[1:]:
        x, y = np.array(pulls).T
        on_others = _find_signed((x, y), np.array(feet), spread_ends(others, head))
        states = _take_largest(states, on_others)
    section, *beside = states
    return section and section | _name_largest(state or {} for state in beside)


def _find_foot(panel: PanelForces) -> float:
    """Force on the more loaded foot anchor of a panel [N]."""
    return max(panel.anchors.foot_anchor.size, math.hypot(*panel.solution.mid_foot))


_Signed = dict[str, float] | None


def _take_largest(
    states: Sequence[_Signed], on_others: dict[str, Floats] | None
) -> list[_Signed]:
    """Signed forces by state, or those on other layouts where they are larger."""
    if on_others is None:
        return [None for _ in states]
    most = {name: values.max(axis=0).tolist() for name, values in on_others.items()}
    return [
        state and {name: max(value, most[name][place]) for name, value in state.items()}
        for place, state in enumerate(states)
    ]


def read_signed_errors(
    result: CaseResult, layouts: Sequence[SupportLayout]
) -> dict[str, float] | None:
    """Numerical errors of the forces that ``read_signed`` gives [N]."""
    solution = result.solution
    if solution is None or result.anchors is None:
        return None
    head, width = solution.head_point, layouts[0].post_spacing
    errors = _find_largest_errors(
        solution.foot.error * width, solution.head.error * width, layouts, head
    )
    if errors is None or not isinstance(result.panel, PanelForces):
        return errors
    pulls = [(panel.foot.error, panel.head.error) for panel in result.panel.variants]
    foot, pull = (width * max(ends) for ends in zip(*pulls, strict=True))
    beside = _find_largest_errors(foot, pull, layouts, head) or {}
    return errors | {name_in_panel(name): error for name, error in beside.items()}


def _find_largest_errors(
    foot: float, pull: float, layouts: Sequence[SupportLayout], head: Point
) -> dict[str, float] | None:
    """Errors of signed forces on the layout where each is largest [N]."""
    errors = _find_errors(foot, pull, take_ends(place_support(layouts[0], head)))
    if errors is None or len(layouts) < 2:
        return errors
    ends = spread_ends(layouts[1:], head)
    others = _find_errors(np.array([foot]), np.array([pull]), ends)
    if others is None:
        return None
    return {name: max(own, float(others[name].max())) for name, own in errors.items()}


def _name_largest(panels: Iterable[dict[str, float]]) -> dict[str, float]:
    """Largest values of some panels, by their names beside those of the section."""
    largest: dict[str, float] = {}
    for values in panels:
        for name, value in values.items():
            before = largest.get(name_in_panel(name), -math.inf)
            largest[name_in_panel(name)] = max(before, value)
    return largest


def _find_errors(
    foot: Number, head: Number, ends: Ends[Number]
) -> dict[str, Number] | None:
    """Errors of signed forces from those of the forces behind them [N].

    They are linear in these: what an error of each component causes is added, as in
    the bands of the members.
    """
    none = 0.0 * head
    sizes: dict[str, Number] = {}
    for pull, at_foot in (
        ((head, none), none),
        ((none, head), none),
        ((none, none), foot),
    ):
        caused = _find_signed(pull, at_foot, ends)
        if caused is None:
            return None
        sizes = {name: sizes.get(name, none) + abs(caused[name]) for name in caused}
    return sizes


def _find_signed(
    pull: Vector[Number], foot: Number, ends: Ends[Number]
) -> dict[str, Number] | None:
    """Signed forces under a pull on the head and a force on the foot anchor [N]."""
    pairs = [
        resolve_signed(pull, ends.head, ends.base, anchor)
        for anchor in (ends.uphill, ends.downhill)
    ]
    if pairs[0] is None or pairs[1] is None:
        return None
    (post_up, uphill), (post_down, downhill) = pairs[0], pairs[1]
    across = ends.head[1] / _length(ends.head, ends.base)
    return {
        _NET: foot + 0.0 * uphill,
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


def _length(start: Vector[Number], end: Vector[Number]) -> Number:
    x, y = start[0] - end[0], start[1] - end[1]
    length: Number = (x * x + y * y) ** 0.5
    return length
