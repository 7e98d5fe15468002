"""End of a row of panels: what its ropes pull along the row, and what holds that.

Theory: panel/THEORY.md, (P7) and (P8).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from netdesign.checks import Band
from netdesign.envelope.extremes import Extreme
from netdesign.envelope.run import CaseResult
from netdesign.panel.solution import FailedPanel
from netdesign.site.model import NetRow, Resistance
from netdesign.structure.members import EndMember, Member, RopeForce
from netdesign.structure.row_position import LoadedWidth, Position
from netdesign.study.demand import NOTHING
from netdesign.study.effects import RowEffects
from netdesign.study.records import ActionRecord
from netdesign.units import kilonewton_from_newton
from netdesign.words.message import Message, say

_PUSHED = (Member.POST, Member.POST_BASE)  # by the end guy


@dataclass(frozen=True, slots=True, kw_only=True)
class EndLoads:
    """Pulls of both ropes along the row, on its first or last support.

    Attributes
    ----------
    lower, upper : Extreme
        Of the ropes, inside the row.
    width : LoadedWidth
        Of the end support.
    factor : float
        What the end effect makes of them at most, (P8) [-].
    guy_angle : float or None
        gamma, between the end guy and the row [rad]; None where none is given.
    """

    lower: Extreme
    upper: Extreme
    width: LoadedWidth
    factor: float
    guy_angle: float | None

    def find_extreme(self, member: str) -> Extreme:
        """Rope that pulls on an end member."""
        return self.lower if member == EndMember.LATERAL_ANCHOR else self.upper

    def share(self, member: str) -> float:
        """Force of an end member over that of its rope [-]."""
        if member == EndMember.LATERAL_ANCHOR:
            return 1.0
        return 1.0 / math.cos(self.guy_angle or 0.0)

    def demand(self, member: str) -> Band:
        """Characteristic force on an end member [N]."""
        on_member = self.share(member) * self.factor
        return self.find_extreme(member).widened.times(on_member)

    @property
    def on_post(self) -> Band:
        """Compression of the end post by its end guy [N]."""
        if self.guy_angle is None:
            return NOTHING
        return self.upper.widened.times(self.factor * math.tan(self.guy_angle))

    def record(self, member: str, spacing: float) -> ActionRecord:
        """Action of an end member with what it follows from."""
        extreme, demand = self.find_extreme(member), self.demand(member)
        return ActionRecord(
            solved_kN=kilonewton_from_newton(extreme.widened.value),
            post_spacing_m=spacing,
            position="edge",
            loaded_width_m=self.factor * spacing,
            end_factor=self.width.end_factor,
            end_length_m=self.width.end_length,
            lateral_factor=1.0,
            coupled_kN=kilonewton_from_newton(demand.high),
            share=self.share(member),
            governs="panel",
        )


def find_end_loads(
    row: NetRow, extremes: Mapping[str, Extreme], effects: RowEffects
) -> EndLoads | None:
    """Pulls along the row at its end; None of a row without panel or end.

    None, too, where no case has a panel: then the row has a gap.
    """
    lower, upper = (
        extremes.get(one) for one in (RopeForce.LOWER_ALONG, RopeForce.UPPER_ALONG)
    )
    if row.row_end is None or lower is None or upper is None:
        return None
    width = effects.find_support("edge")
    return EndLoads(
        lower=lower,
        upper=upper,
        width=width,
        factor=compute_end_factor(width, effects.post_spacing),
        guy_angle=row.row_end.guy_angle,
    )


def compute_end_factor(width: LoadedWidth, spacing: float) -> float:
    """Pull of a rope under the end effect over that without, at most, (P8) [-]."""
    share = width.end_length / spacing
    return 1.0 + width.end_factor * (share if share <= 0.5 else 1.0)


def find_unsaid(
    row: NetRow,
    given: Resistance,
    position: Position,
    results: Sequence[CaseResult] = (),
) -> Message | None:
    """Lack of what a force depends on, so that nothing is known of it."""
    if row.unsaid:
        return tell_unsaid(row)
    failed = [one for one in results if isinstance(one.panel, FailedPanel)]
    if failed and row.panel is not None and row.panel.assumed:
        return say("panel.assumed_fails", reason=failed[0].lack or "")
    return find_lack(row, given) if position == "edge" else None


def tell_unsaid(row: NetRow) -> Message:
    """The columns that a row leaves empty, and that every force depends on."""
    return say("check.unsaid", names=row.unsaid)


def find_lack(row: NetRow, given: Resistance) -> Message | None:
    """Lack of the workbook that leaves an end member, or the end post, open."""
    if row.row_end is None or given.member not in (*EndMember, *_PUSHED):
        return None
    if row.panel is None:
        return row.panel_lack
    if row.row_end.guy_angle is not None or given.member == EndMember.LATERAL_ANCHOR:
        return None
    return say("row_end.no_angle")


def find_other_panel(
    row: NetRow, given: Resistance, position: Position
) -> Message | None:
    """Doubt that the ropes between the posts are those that were computed.

    It concerns what they load more than the section does.
    """
    pulled = [Member.UPHILL_GUY, Member.UPHILL_ANCHOR]
    if row.layout.is_foot_shared:
        pulled.append(Member.FOOT_ANCHOR)
    at_end = (*EndMember, *_PUSHED) if position == "edge" and row.row_end else ()
    return row.panel_lack if given.member in (*pulled, *at_end) else None
