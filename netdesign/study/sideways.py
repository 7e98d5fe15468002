"""Load along the row at a post head: what holds it, and what it adds to each member.

Theory: structure/THEORY.md, (S15) to (S18). The bounds take the largest forces over all
cases, each in its own case, so that whoever has the report can work them out again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from netdesign.checks import Band, CheckResult, Standard
from netdesign.checks.check import not_proven
from netdesign.checks.schema import LATERAL_SHARE
from netdesign.envelope.extremes import Extreme, describe_gap
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.run import CaseResult
from netdesign.guideline.floor import HeadSpan
from netdesign.outcome import Verdict
from netdesign.site.model import NetRow
from netdesign.structure.head import FailedSupport
from netdesign.structure.layout import Point, SupportPoints, place_support
from netdesign.structure.members import Member, name_in_panel
from netdesign.structure.splay import SplayWeights, compute_splayed_head, weigh_splay
from netdesign.study.records import SidewaysRecord
from netdesign.units import (
    degree_from_radian,
    kilonewton_from_newton,
    kilonewton_if_known,
)
from netdesign.words.message import Message, say

_SIDES: Mapping[str, str] = {
    Member.UPHILL_GUY: "uphill",
    Member.UPHILL_ANCHOR: "uphill",
    Member.DOWNHILL_GUY: "downhill",
    Member.DOWNHILL_ANCHOR: "downhill",
}
GUYS = (Member.UPHILL_GUY, Member.DOWNHILL_GUY)
GUYS_BY_PANEL: Sequence[str] = tuple(map(name_in_panel, GUYS))
_NOTHING = Band(low=0.0, value=0.0, high=0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberLoad:
    """Way from the force of the section to that of one member.

    Attributes
    ----------
    share : float
        Part of the section's force in this member [-].
    added : Band
        Force that the load along the row adds [N].
    pull, rise : float
        Largest pull on a head, which brings it, and what it grows by at most where
        that pull is twice as large; also where nothing is added yet [N].
    sideways : SidewaysRecord or None
        Numbers that ``added`` follows from; None where nothing is added.
    """

    share: float = 1.0
    added: Band = _NOTHING
    pull: float = 0.0
    rise: float = 0.0
    sideways: SidewaysRecord | None = None

    def apply(self, force: Band) -> Band:
        """Force of the member, of a support inside the row [N]."""
        return Band(
            low=self.share * force.low + self.added.low,
            value=self.share * force.value + self.added.value,
            high=self.share * force.high + self.added.high,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Sideways:
    """Load along the row at the heads of a net row.

    Attributes
    ----------
    share : float
        Part of the net's pull on a head that acts along the row [-].
    splay : float
        beta [rad]; 0 where nothing holds the load.
    pull : Band
        Largest pull of the net on a head, of a support inside the row [N].
    least_tension : float
        Least in-plane tension of the guys at work, less what may hide [N].
    uphill, downhill : float
        c of (S17) [-].
    post : float
        w of (S18) [-].
    gap : Message or None
        Why the load is not held; None if it is.
    """

    share: float
    splay: float = 0.0
    pull: Band = _NOTHING
    least_tension: float = 0.0
    uphill: float = 0.0
    downhill: float = 0.0
    post: float = 0.0
    gap: Message | None = None

    def load(self, member: str) -> MemberLoad:
        """Member's force under the load along the row."""
        if self.gap is not None or member == Member.FOOT_ANCHOR:
            return MemberLoad()
        if member in _SIDES:
            is_uphill = _SIDES[member] == "uphill"
            return self._load_guy(self.uphill if is_uphill else self.downhill)
        return self._load_post()

    def _load_guy(self, part: float) -> MemberLoad:
        across = part * self.share / math.sin(self.splay)
        return MemberLoad(
            share=0.5 / math.cos(self.splay),
            added=self.pull.times(across),
            pull=self.pull.value,
            rise=self.pull.high * across,
            sideways=self._record(part, None),
        )

    def _load_post(self) -> MemberLoad:
        held = self.pull.times(self.share / math.tan(self.splay))
        low, value, high = (
            self.post * max(one - self.least_tension, 0.0)
            for one in (held.low, held.value, held.high)
        )
        return MemberLoad(
            added=Band(low=low, value=value, high=high),
            pull=self.pull.value,
            rise=self.post * held.high,  # the guys' least tension does not grow
            sideways=self._record(self.post, self.least_tension) if high else None,
        )

    def _record(self, part: float, tension: float | None) -> SidewaysRecord:
        return SidewaysRecord(
            part=part,
            share=self.share,
            pull_kN=kilonewton_from_newton(self.pull.value),
            splay_deg=degree_from_radian(self.splay),
            least_tension_kN=kilonewton_if_known(tension),
        )


def find_sideways(
    row: NetRow,
    results: Sequence[CaseResult],
    extremes: Mapping[str, Extreme],
    standard: Standard,
    floor: HeadSpan | None = None,
) -> Sideways:
    """Load along the row at the heads of a net row, over its solved cases.

    Parameters
    ----------
    row : NetRow
        With its guys.
    results : sequence of CaseResult
        Of the envelope.
    extremes : mapping of str to Extreme
        Largest forces of the members, with what may hide.
    standard : Standard
        Profile that gives the share of the load.
    floor : HeadSpan or None
        What the guideline's load brings at the head; None without a floor.
    """
    value, splay = standard.find(LATERAL_SHARE), row.guys.splay
    if value is None:
        lack = say("ends.no_lateral_load", value=LATERAL_SHARE)
        return Sideways(share=0.0, gap=lack)
    gap = find_lack(row)
    if gap is not None or splay is None:
        return Sideways(share=value.value, gap=gap)
    heads = [head for one in results for head in _list_heads(row, one)]
    if not heads:
        lack = describe_gap(results) or say("check.no_case_solved")
        return Sideways(share=value.value, gap=lack)
    for head in heads:
        failed = head.fail(value.value, splay)
        if failed is not None:
            return Sideways(share=value.value, gap=failed)
    hidden = {
        member: find_hidden(member, extremes)
        for member in (*GUYS, Member.POST)
        if member in extremes
    }
    weights = [head.weights for head in heads if head.weights is not None]
    in_guys = sum(hidden.get(guy, 0.0) for guy in GUYS)
    return Sideways(
        share=value.value,
        splay=splay,
        pull=_widen(heads, sum(hidden.values()), floor.pull if floor else 0.0),
        least_tension=_find_least_tension(row, heads, in_guys, floor),
        uphill=max(one.largest_uphill for one in weights),
        downhill=max(one.largest_downhill for one in weights),
        post=max(one.post for one in weights),
    )


def _find_least_tension(
    row: NetRow, heads: Sequence[_Head], hidden: float, floor: HeadSpan | None
) -> float:
    """Least tension of the guys at work that is counted on [N].

    None where the panel is assumed: between two panels as they may be built, the guy of
    one side can give way to that of the other. None where the guideline's load is that
    of an altitude that is not known: a lower row has less.
    """
    is_assumed = row.panel is not None and bool(row.panel.assumed)
    if is_assumed or (floor is not None and row.altitude is None):
        return 0.0
    solved = max(0.0, min(head.tension for head in heads) - hidden)
    return min(solved, floor.least_tension) if floor else solved


def check_sideways(row: NetRow, sideways: Sideways, gap: Message | None) -> CheckResult:
    """Check of the load along the row; ``gap`` is that of the cases."""
    lack = sideways.gap or gap
    verdict = Verdict.NOT_PROVEN if lack else Verdict.PASS
    held = say(
        "sideways.held",
        share=100.0 * sideways.share,
        splay=degree_from_radian(row.guys.splay or 0.0),
    )
    return CheckResult(
        id=f"{Member.POST}.lateral",
        clause="-",
        member=Member.POST,
        mode="lateral",
        verdict=verdict,
        reason=not_proven(lack) if lack else held,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Head:
    """One case: pull on the head with its error, tension at work [N], geometry."""

    pull: Point
    error: float
    tension: float
    points: SupportPoints
    weights: SplayWeights | None

    @property
    def size(self) -> float:
        return math.hypot(*self.pull)

    def fail(self, share: float, splay: float) -> Message | None:
        """Reason why the load along the row is not held in this case."""
        found = compute_splayed_head(
            self.pull, self.points, sideways=share * self.size, splay=splay
        )
        if isinstance(found, FailedSupport):
            return found.reason
        return None if self.weights else say("support.not_held_sideways")


def place_row(row: NetRow, result: CaseResult) -> SupportPoints:
    """Points of a support of the row in a case [m]."""
    height = row.net_height
    head = (height * math.tan(result.case.inclination), height)
    return place_support(row.layout, head)


def _list_heads(row: NetRow, result: CaseResult) -> list[_Head]:
    """Head of a case, also with the pull of its panel; none of a failed case."""
    if not result.is_converged or result.anchors is None:
        return []
    points, bands = place_row(row, result), result.member_forces
    error = result.solution.head.error if result.solution else 0.0
    error *= row.layout.post_spacing
    pulls = [(result.anchors.head_pull, error, _add_guys(bands, GUYS))]
    panels = result.panel.variants if isinstance(result.panel, PanelForces) else ()
    pulls += [
        (
            one.anchors.head_pull,
            one.head.error * row.layout.post_spacing,
            _add_guys(one.bands, GUYS_BY_PANEL),
        )
        for one in panels
    ]
    return [
        _Head(
            pull=pull,
            error=wrong,
            tension=tension,
            points=points,
            weights=weigh_splay(points),
        )
        for pull, wrong, tension in pulls
    ]


def _add_guys(bands: Mapping[str, Band], guys: Sequence[str]) -> float:
    """Least tension of the guys on both sides, of which one is at work [N]."""
    return sum(bands[guy].low for guy in guys)


def find_hidden(member: str, extremes: Mapping[str, Extreme]) -> float:
    """Part of a member's force that may hide, by section or panel [N]."""
    names = (member, name_in_panel(member))
    return max(extremes[name].hidden for name in names if name in extremes)


def _widen(heads: Sequence[_Head], hidden: float, least: float) -> Band:
    """Largest pull on a head with its error and with what may hide [N].

    None of its ends lies below ``least``, that of the floor.
    """
    return Band(
        low=max(least, *(head.size - head.error for head in heads)),
        value=max(least, *(head.size for head in heads)),
        high=max(least, max(head.size + head.error for head in heads) + hidden),
    )


def find_lack(row: NetRow) -> Message | None:
    """Lack of the workbook, of guys that hold a load along the row."""
    if row.guys.count < 2:
        return say("sideways.one_guy")
    if row.guys.splay is None:
        return say("sideways.no_splay")
    if row.layout.is_foot_shared:
        return say("sideways.at_foot")
    return None
