"""From the section's forces to the characteristic action of each check of a row."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Band, Standard
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.panel_forces import PanelForces
from netdesign.envelope.ranges import Ranges
from netdesign.envelope.run import CaseResult
from netdesign.guideline.floor import Floor
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import Member, name_in_panel
from netdesign.structure.row_position import LoadedWidth
from netdesign.study.demand import NOTHING, Demand, build_demand
from netdesign.study.effects import RowEffects, find_effects
from netdesign.study.pulls import AnchorPull, list_pulls
from netdesign.study.records import ActionRecord
from netdesign.study.row_end import EndLoads, find_end_loads
from netdesign.study.sideways import MemberLoad, Sideways, find_sideways, place_row
from netdesign.units import kilonewton_from_newton

_PUSHED = (Member.POST, Member.POST_BASE)


@dataclass(frozen=True, slots=True, kw_only=True)
class RowLoads:
    """Loads that turn a solved force of the section into the demand of a check.

    Attributes
    ----------
    effects : RowEffects
        Loaded widths, and the load along the row at the foot.
    floor : Floor or None
        The guideline's forces; None where they are no floor.
    sideways : Sideways
        The load along the row at the head.
    pulls : tuple of AnchorPull
        Directions at the anchors.
    tilt : float
        Largest force along the slope at the post's base over that across, (S19) [-].
    end : EndLoads or None
        Pulls of the ropes along the row, at its end; None without any.
    """

    effects: RowEffects
    floor: Floor | None
    sideways: Sideways
    pulls: tuple[AnchorPull, ...]
    tilt: float
    end: EndLoads | None = None

    def demand(
        self,
        given: Resistance,
        extreme: Extreme,
        width: LoadedWidth,
        panel: Extreme | None = None,
    ) -> Demand:
        """Demand of a check on the support of that width.

        ``panel`` is the largest force by the panel between posts.
        """
        load = self.sideways.load(given.member)
        if given.mode == "sliding":
            load = self._turn(load)
        least = self.floor.find(given.member) if self.floor else None
        return build_demand(
            self.effects,
            given.member,
            width,
            extreme.widened,
            least,
            load,
            panel.widened if panel else None,
            self._find_along(given, width),
        )

    def press(
        self, extreme: Extreme, width: LoadedWidth, panel: Extreme | None = None
    ) -> float:
        """Characteristic force across the base plate, from one in the section [N].

        ``panel`` is that by the panel between posts.
        """
        load = self.sideways.load(Member.POST_BASE)
        least = self.floor.find(Member.POST_BASE) if self.floor else None
        found = build_demand(
            self.effects,
            Member.POST_BASE,
            width,
            extreme.widened,
            least,
            load,
            panel.widened if panel else None,
            self._find_push(width),
        )
        return found.action.value

    def _find_along(self, given: Resistance, width: LoadedWidth) -> Band:
        """Part of a force that the ropes' pull along the row brings at its end [N]."""
        if given.member not in _PUSHED:
            return NOTHING
        tilt = self.tilt if given.mode == "sliding" else 1.0
        return self._find_push(width).times(tilt)

    def _find_push(self, width: LoadedWidth) -> Band:
        """Compression by the end guy of a post at the row's end [N]."""
        if self.end is None or width.position != "edge":
            return NOTHING
        return self.end.on_post

    def _turn(self, load: MemberLoad) -> MemberLoad:
        """Force along the slope instead of that across the base plate, (S19)."""
        return MemberLoad(
            share=self.tilt * load.share,
            added=load.added.times(self.tilt),
            pull=load.pull,
            rise=self.tilt * load.rise,
            sideways=load.sideways
            and replace(load.sideways, part=self.tilt * load.sideways.part),
        )


def add_parts(record: ActionRecord, governing: CaseResult, member: str) -> ActionRecord:
    """Record with both forces on one anchor that carries net and uphill guy, (S7)."""
    anchors = governing.anchors
    if record.is_by_panel:  # parts of that force, in its own case
        anchors = None
        if isinstance(governing.panel, PanelForces):
            panel = governing.panel.find_worst(name_in_panel(member))
            if panel.is_mid_largest(member):
                return record
            anchors = panel.anchors
    both = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR)
    if anchors is None or not anchors.is_foot_shared or member not in both:
        return record
    return replace(
        record,
        foot_part_kN=kilonewton_from_newton(anchors.foot_anchor.size),
        guy_part_kN=kilonewton_from_newton(anchors.uphill_anchor.size),
    )


def find_loads(
    row: NetRow,
    ranges: Ranges,
    results: Sequence[CaseResult],
    extremes: Mapping[str, Extreme],
    standard: Standard,
    floor: Floor | None,
) -> RowLoads:
    """Loads on a row beside its section, over its solved cases."""
    effects = find_effects(row, standard, ranges)
    head = floor.head if floor else None
    return RowLoads(
        effects=effects,
        floor=floor,
        sideways=find_sideways(row, results, extremes, standard, head),
        pulls=tuple(list_pulls(row, results, effects.lateral_share, head)),
        tilt=_find_tilt(row, results),
        end=find_end_loads(row, extremes, effects),
    )


def _find_tilt(row: NetRow, results: Sequence[CaseResult]) -> float:
    """Largest tangent of the post's tilt over the converged cases [-]."""
    places = [place_row(row, one) for one in results if one.is_converged]
    tilts = [(one.head[0] - one.post_base[0]) / one.head[1] for one in places]
    return max(map(math.fabs, tilts), default=0.0)
