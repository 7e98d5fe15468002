"""Signed forces of a case, which a search follows in place of the members' forces.

The forces of guy and post have a kink where a guy goes slack, and a model of them would
need many cases. The forces that the post and one guy need for equilibrium, tension
positive and compression negative, have no kink. A guy carries its signed tension where
that is positive, the post the larger of its two signed compressions: bounds of the
signed forces bound the members. Theory: structure/THEORY.md, eq. (S2).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.numerics.arrays import Floats
from netdesign.structure.head import Vector, resolve_signed
from netdesign.structure.layout import (
    Point,
    SupportLayout,
    place_support,
)
from netdesign.structure.members import CARRYING_MEMBERS, Member, name_in_panel


@dataclass(frozen=True, slots=True, kw_only=True)
class Ends:
    """Points of some supports, x and y of shape (n, 1) each [m]."""

    head: Vector[Floats]
    base: Vector[Floats]
    uphill: Vector[Floats]
    downhill: Vector[Floats]


def spread_ends(layouts: Sequence[SupportLayout], head: Point) -> Ends:
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
    pulls = np.array([(solution.head.x * width, solution.head.y * width)])
    feet = np.array([anchors.foot_anchor.size])
    panels = result.panel if isinstance(result.panel, PanelForces) else None
    if panels:
        pulls = np.concatenate([pulls, panels.solved.head])
        feet = np.append(feet, panels.largest_feet)
    signed = _find_signed((pulls[:, 0], pulls[:, 1]), feet, spread_ends(layouts, head))
    if signed is None:
        return None
    largest = {name: values.max(axis=0) for name, values in signed.items()}
    of_section = {name: float(values[0]) for name, values in largest.items()}
    if not panels:
        return of_section
    return of_section | {
        name_in_panel(name): float(values[1:].max()) for name, values in largest.items()
    }


def read_signed_errors(
    result: CaseResult, layouts: Sequence[SupportLayout]
) -> dict[str, float] | None:
    """Numerical errors of the forces that ``read_signed`` gives [N]."""
    solution = result.solution
    if solution is None or result.anchors is None:
        return None
    width, ends = layouts[0].post_spacing, spread_ends(layouts, solution.head_point)
    foot, head = solution.foot.error, solution.head.error
    errors = _find_errors(foot * width, head * width, ends)
    if errors is None or not isinstance(result.panel, PanelForces):
        return errors
    largest = float(result.panel.brought.error.max()) * width
    beside = _find_errors(largest, largest, ends) or {}
    return errors | {name_in_panel(name): error for name, error in beside.items()}


def _find_errors(foot: float, head: float, ends: Ends) -> dict[str, float] | None:
    """Errors of signed forces from those of foot and head on the worst support [N].

    They are linear in these: what an error of each component causes is added, as in
    the bands of the members.
    """
    across, along, at_foot = np.diag((head, head, foot))[:, None]
    caused = _find_signed((across, along), at_foot, ends)
    if caused is None:
        return None
    return {
        name: float(np.abs(each).sum(axis=1).max()) for name, each in caused.items()
    }


def _find_signed(
    pull: Vector[Floats], foot: Floats, ends: Ends
) -> dict[str, Floats] | None:
    """Signed forces under pulls on the head and forces on the foot anchor [N]."""
    pairs = [
        resolve_signed(pull, ends.head, ends.base, anchor)
        for anchor in (ends.uphill, ends.downhill)
    ]
    if pairs[0] is None or pairs[1] is None:
        return None
    (post_up, uphill), (post_down, downhill) = pairs[0], pairs[1]
    reach = np.hypot(ends.head[0] - ends.base[0], ends.head[1] - ends.base[1])
    across = ends.head[1] / reach
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
