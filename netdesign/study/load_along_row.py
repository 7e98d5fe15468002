"""Load along the row at a post head: what holds it, and what it adds to each member.

Theory: structure/THEORY.md, (S15) to (S18), (S24) to (S26). The
bounds take the largest forces over all cases, each in its own case, so that whoever has
the report can work them out again.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.extremes import Extreme, describe_gap
from netdesign.envelope.ranges import Interval
from netdesign.envelope.row_pulls import HeadPulls
from netdesign.guideline.floor import HeadSpan
from netdesign.site.model import NetRow, RowEnd
from netdesign.structure.head import (
    FailedSupport,
    HeadForces,
    compute_head_forces,
)
from netdesign.structure.layout import Point, SupportPoints, place_support
from netdesign.structure.members import GUYS, Member, RopeForce, name_in_panel
from netdesign.structure.splay import (
    EndHead,
    hold_end_guy,
    is_held_sideways,
    share_with_end_guy,
    weigh_splay,
)
from netdesign.study.case_records import EndGuyRecord, HeldSidewaysRecord
from netdesign.study.row_to_check import RowToCheck
from netdesign.units import (
    degree_from_radian,
    kilonewton_from_newton,
)
from netdesign.words.message import Message, say

GUYS_BY_PANEL: Sequence[str] = tuple(map(name_in_panel, GUYS))


def find_held_sideways(
    task: RowToCheck, heads: HeadPulls, floor: HeadSpan | None
) -> HeldSidewaysRecord | Message:
    """Load along the row at its heads over the solved cases, or why it is not held.

    Parameters
    ----------
    task : RowToCheck
        Row with its guys, cases and largest forces; the profile gives the share of the
        load.
    heads : HeadPulls
        States of all its cases.
    floor : HeadSpan or None
        What the guideline's load brings at the head; None without a floor.
    """
    row, results = task.row, task.solved.results
    value, splay = task.standard.find(LATERAL_SHARE), find_splay(row)
    if value is None:
        return say("ends.no_lateral_load", value=LATERAL_SHARE)
    if isinstance(splay, Message):
        return splay
    if not heads.count:
        return describe_gap(results) or say("check.no_case_solved")
    places = _place_heads(row, heads)
    states = (heads.pulls, places, heads.places)
    if not is_held_sideways(*states, share=value.value, splay=splay):
        pairs = zip(heads.pulls.T.tolist(), heads.places.tolist(), strict=True)
        held = (compute_head_forces((x, y), places[k]) for (x, y), k in pairs)
        reasons = (head.reason for head in held if isinstance(head, FailedSupport))
        return next(reasons, say("support.not_held_sideways"))
    return _record(task, heads, floor, (value.value, splay))


def _record(
    task: RowToCheck,
    heads: HeadPulls,
    floor: HeadSpan | None,
    load: tuple[float, float],
) -> HeldSidewaysRecord:
    extremes, (share, splay) = task.solved.extremes, load
    hidden = {
        member: find_hidden(member, extremes)
        for member in (*GUYS, Member.POST)
        if member in extremes
    }
    pull = heads.bound_size(sum(hidden.values()))
    return HeldSidewaysRecord(
        share=share,
        splay_deg=degree_from_radian(splay),
        pull_low_kN=kilonewton_from_newton(pull.low),
        pull_kN=kilonewton_from_newton(pull.value),
        pull_high_kN=kilonewton_from_newton(pull.high),
        floor_pull_kN=kilonewton_from_newton(floor.pull if floor else 0.0),
        **weigh_places(_place_heads(task.row, heads)),
    )


def weigh_places(places: Iterable[SupportPoints]) -> dict[str, float]:
    """Largest weights of the load along the row in both guys and the post [-].

    By the fields of the record.
    """
    weights = [weight for weight in map(weigh_splay, places) if weight is not None]
    return {
        "uphill_part": max(float(weight.largest_uphill) for weight in weights),
        "downhill_part": max(float(weight.largest_downhill) for weight in weights),
        "post_part": max(float(weight.post) for weight in weights),
    }


_INCLINATIONS = 8  # parts of their range: what the guy brings changes smoothly


def find_end_guy(
    task: RowToCheck,
    end: RowEnd,
    heads: HeadPulls,
    pulls: Sequence[tuple[int, Point]],
    along: float,
) -> EndGuyRecord | Message:
    """Forces that the end guy brings to the end's support, or why nothing holds them.

    Parameters
    ----------
    task : RowToCheck
        Row with its cases and largest forces.
    end : RowEnd
        Of the row.
    heads : HeadPulls
        States of all its cases.
    pulls : sequence of tuple of int, tuple of float
        On the head at the end, with the guideline's load, by their inclination [N].
    along : float
        H, largest pull of the ridge rope along the row [N].
    """
    row, span = task.row, task.site.ranges["inclination"]
    places = place_over(row, span)
    held = [hold_end_guy(place) for place in places]
    failed = [support for support in held if isinstance(support, FailedSupport)]
    if failed:
        return failed[0].reason
    forces = [support for support in held if isinstance(support, HeadForces)]
    posts = [head.post_compression for head in forces]
    upright = [place.head[1] / place.post_length for place in places]
    tensions = _share_end(task, end, heads, pulls, along)
    if isinstance(tensions, Message):
        return tensions
    return EndGuyRecord(
        post_part=max(posts),
        base_part=max(a * b for a, b in zip(posts, upright, strict=True)),
        uphill_part=max(head.uphill_guy_tension for head in forces),
        downhill_part=max(head.downhill_guy_tension for head in forces),
        uphill_guy_kN=tensions and kilonewton_from_newton(tensions[0]),
        downhill_guy_kN=tensions and kilonewton_from_newton(tensions[1]),
    )


def place_over(row: NetRow, span: Interval) -> list[SupportPoints]:
    """Supports of the row at inclinations of its net from end to end [m]."""
    step = (span.high - span.low) / _INCLINATIONS
    tried = {span.low + part * step for part in range(_INCLINATIONS)} | {span.high}
    return [place_row(row, inclination) for inclination in sorted(tried)]


def _share_end(
    task: RowToCheck,
    end: RowEnd,
    states: HeadPulls,
    pulls: Sequence[tuple[int, Point]],
    along: float,
) -> tuple[float, float] | Message | None:
    """Largest tensions of an outer guy uphill and downhill by the linear truss [N].

    Of all states, with what may hide in the pulls of guys and ridge rope. None of one
    guy on a side, or without a panel.
    """
    row, splay = task.row, task.row.guys.splay
    if row.guys.count < 2 or splay is None:
        return None
    if not states.has_panels:
        return None
    keys = (*GUYS, *GUYS_BY_PANEL, RopeForce.UPPER_ALONG)
    solved = task.solved.extremes
    extremes = [solved[key] for key in keys if key in solved]
    hidden = 1.0 + max(
        (
            extreme.hidden / extreme.force.high
            for extreme in extremes
            if extreme.force.high > 0.0
        ),
        default=0.0,
    )
    places = _place_heads(row, states)
    heads = [
        EndHead(points=places[k], pull=(hidden * x, hidden * y), along=along)
        for k, (x, y) in pulls
    ]
    ways = end.stiffnesses
    tensions = share_with_end_guy(heads, splay=splay, guy=end.guy, stiffness=ways)
    if tensions is None:
        return say("support.not_held_sideways")
    outer = tensions.reshape(-1, tensions.shape[-1]).max(axis=0)
    return float(outer[0]), float(outer[2])


def _place_heads(row: NetRow, heads: HeadPulls) -> list[SupportPoints]:
    """Points of a support of the row at each inclination of its cases [m]."""
    return [place_row(row, angle) for angle in heads.inclinations]


def place_row(row: NetRow, inclination: float) -> SupportPoints:
    """Points of a support of the row at an inclination of its net [m]."""
    height = row.net_height
    return place_support(row.layout, (height * math.tan(inclination), height))


def find_tilt(row: NetRow, inclinations: Iterable[float]) -> float:
    """Largest tangent of the post's tilt at some inclinations of the net [-]."""
    places = [place_row(row, inclination) for inclination in inclinations]
    tilts = [(place.head[0] - place.post_base[0]) / place.head[1] for place in places]
    return max(map(math.fabs, tilts), default=0.0)


def find_hidden(member: str, extremes: Mapping[str, Extreme]) -> float:
    """Part of a member's force that may hide, by section or panel [N]."""
    names = (member, name_in_panel(member))
    return max(extremes[name].hidden for name in names if name in extremes)


def find_splay(row: NetRow) -> float | Message:
    """Splay of the guys that hold a load along the row [rad], or why none holds it."""
    if row.guys.count < 2:
        return say("sideways.one_guy")
    if row.layout.is_foot_shared and row.guys.splay is not None:
        return say("sideways.at_foot")
    return say("sideways.no_splay") if row.guys.splay is None else row.guys.splay
