"""From the section's forces to the characteristic action of each check of a row."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from netdesign.checks import Band, Standard
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.run import CaseResult
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import Member
from netdesign.study.effects import RowEffects, find_effects
from netdesign.study.pulls import AnchorPull, list_pulls
from netdesign.study.records import ActionRecord
from netdesign.study.sideways import MemberLoad, Sideways, find_sideways, place_row
from netdesign.units import kilonewton_from_newton


@dataclass(frozen=True, slots=True, kw_only=True)
class RowLoads:
    """Effects that turn a solved force of the section into the action of a check.

    Attributes
    ----------
    effects : RowEffects
        Loaded width, and the load along the row at the foot.
    sideways : Sideways
        The load along the row at the head.
    pulls : mapping of Member to AnchorPull
        Directions at the anchors.
    tilt : float
        Largest force along the slope at the post's base over that across, (S19) [-].
    """

    effects: RowEffects
    sideways: Sideways
    pulls: Mapping[Member, AnchorPull]
    tilt: float

    def act(self, given: Resistance, force: Band) -> Band:
        """Characteristic action of a check, from a force of the section [N]."""
        on_row = self._load(given).apply(force)
        return on_row.times(self.effects.factor(given.member))

    def press(self, force: Band) -> Band:
        """Characteristic force across the base plate, of one in the section [N]."""
        on_row = self.sideways.load(Member.POST_BASE).apply(force)
        return on_row.times(self.effects.factor(Member.POST_BASE))

    def record(self, given: Resistance, extreme: Extreme) -> ActionRecord:
        """The same for the worked calculation."""
        load = self._load(given)
        plain = self.effects.record(given.member, extreme.force)
        parts = self._list_parts(given.member, extreme.governing)
        return replace(
            plain,
            share=load.share,
            added_kN=kilonewton_from_newton(load.added.value),
            added_low_kN=kilonewton_from_newton(load.added.low),
            added_high_kN=kilonewton_from_newton(load.added.high),
            sideways=load.sideways,
            foot_part_kN=parts[0],
            guy_part_kN=parts[1],
        )

    def _load(self, given: Resistance) -> MemberLoad:
        load = self.sideways.load(given.member)
        if given.mode != "sliding":
            return load
        return MemberLoad(
            share=self.tilt * load.share,
            added=load.added.times(self.tilt),
            sideways=load.sideways
            and replace(load.sideways, part=self.tilt * load.sideways.part),
        )

    def _list_parts(
        self, member: str, governing: CaseResult
    ) -> tuple[float | None, float | None]:
        """Both forces on one anchor that carries net and uphill guy, (S7) [kN]."""
        anchors = governing.anchors
        both = (Member.FOOT_ANCHOR, Member.UPHILL_ANCHOR)
        if anchors is None or not anchors.is_foot_shared or member not in both:
            return None, None
        return (
            kilonewton_from_newton(anchors.foot_anchor.size),
            kilonewton_from_newton(anchors.uphill_anchor.size),
        )


def find_loads(
    row: NetRow,
    results: Sequence[CaseResult],
    extremes: Mapping[str, Extreme],
    standard: Standard,
) -> RowLoads:
    """Loads on a row beside its section, over its solved cases."""
    effects = find_effects(row, standard)
    return RowLoads(
        effects=effects,
        sideways=find_sideways(row, results, extremes, standard),
        pulls=list_pulls(row, results, effects.lateral_share),
        tilt=_find_tilt(row, results),
    )


def _find_tilt(row: NetRow, results: Sequence[CaseResult]) -> float:
    """Largest tangent of the post's tilt over the converged cases [-]."""
    places = [place_row(row, one) for one in results if one.is_converged]
    tilts = [(one.head[0] - one.post_base[0]) / one.head[1] for one in places]
    return max(map(math.fabs, tilts), default=0.0)
