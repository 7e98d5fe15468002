"""Way of a check from the largest force of the cases to its demand, worked out again.

From the record alone, beside the code that made it: what it states twice must agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from netdesign.checks.schema import LATERAL_SHARE
from netdesign.structure.members import BROUGHT_BY, Member, name_in_panel
from netdesign.structure.row_position import compute_lateral_factor
from netdesign.study.audit.comparing import SAME, Pair, is_same, tell_unequal
from netdesign.study.audit.envelope_audit import same_point
from netdesign.study.case_records import ExtremeRecord
from netdesign.study.demand import leave_out_governing, tell_governing
from netdesign.study.guideline_records import FloorForceRecord
from netdesign.study.records import ActionRecord, CheckRecord, RowStudy
from netdesign.study.values import show_value
from netdesign.words.message import Message, say


@dataclass(frozen=True, slots=True, kw_only=True)
class _Sources:
    """Forces of the cases, and the record of what follows from them on a support."""

    record: ActionRecord
    section: ExtremeRecord
    panel: ExtremeRecord | None  # by the panel between posts
    floor: FloorForceRecord | None  # by the guideline

    @property
    def by_floor(self) -> float | None:
        """The same by the guideline's load [kN]."""
        if self.floor is None:
            return None
        inside = self.record.share * self.floor.force_kN + self.record.added_kN
        return inside * self.record.on_row

    @property
    def least(self) -> float:
        """Low end of the force on the support [kN]."""
        record, by_panel = self.record, 0.0
        low = record.share * (record.solved_low_kN or 0.0) + record.added_low_kN
        if self.panel is not None:
            inside = record.share * self.panel.low_kN + record.added_low_kN
            by_panel = inside * self.record.on_row + record.along_low_kN
        return max(low * self.record.on_row, self.by_floor or 0.0, by_panel)

    @property
    def most(self) -> float:
        """High end of the force on the support [kN]."""
        by_panel = self.record.panel_support_kN or 0.0
        return max(self.record.coupled_kN, by_panel, self.by_floor or 0.0)


def audit_action(
    place: Message, check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> Iterator[Message]:
    """Follow the largest force of the cases to the demand."""
    record, extreme = check.action, _find_extreme(check, row)
    if extreme is None or record is None:
        if check.action_kN is not None or (extreme is None) is not (record is None):
            yield say("audit.action_or_force", place=place)
        return
    sources = _Sources(
        record=record,
        section=extreme,
        panel=_find_panel(check, row),
        floor=_find_floor(check, row),
    )
    lateral = _find_lateral(check, row, factors)
    pairs = [
        ("lateral_factor", record.lateral_factor, lateral),
        *_list_pairs(check, sources),
    ]
    if check.member == Member.POST_BASE:
        yield from _audit_base(place, sources)
    else:
        pairs.append(("solved_kN", record.solved_kN, extreme.max_kN))
        pairs.append(("solved_low_kN", record.solved_low_kN, extreme.low_kN))
        yield from _audit_largest(place, check, sources)
    yield from _audit_panel(place, sources)
    yield from tell_unequal(place, pairs)
    yield from _audit_governing(place, check, record, sources.floor)
    yield from _audit_width(place, check, record)


def _list_pairs(check: CheckRecord, sources: _Sources) -> list[Pair]:
    """Floor, action and ends of the demand, as stored and as they follow."""
    record, least = sources.record, sources.floor
    inclination = least.inclination_deg if least else None
    largest = max(
        record.section_force, record.panel_force or 0.0, sources.by_floor or 0.0
    )
    pairs: list[Pair] = [
        ("floor_kN", record.floor_kN, least.force_kN if least else None),
        ("guideline_kN", record.guideline_kN, sources.by_floor),
        ("floor_inclination_deg", record.floor_inclination_deg, inclination),
        ("action_kN", check.action_kN, largest),
    ]
    factor = check.action_factor
    if factor is not None:
        high, low = sources.most * factor, sources.least * factor
        pairs.append(("demand_high_kN", check.demand_high_kN, high))
        pairs.append(("demand_low_kN", check.demand_low_kN, low))
    return pairs


def _audit_largest(
    place: Message, check: CheckRecord, sources: _Sources
) -> Iterator[Message]:
    """High end and case of a member whose largest force is reported."""
    record, panel = sources.record, sources.panel
    high = record.coupled_kN
    yield from _audit_high_end(place, record, sources.section, record.on_row, high)
    larger = panel if panel and record.is_by_panel else sources.section
    if not same_point(check.case, larger.case):
        yield say("audit.other_case", place=place)


def _audit_base(place: Message, sources: _Sources) -> Iterator[Message]:
    """Force across a base plate: part of the post's, whose largest is reported."""
    record = sources.record
    if record.solved_kN > sources.section.max_kN * (1.0 + SAME):
        yield say("audit.more_on_base", place=place)
    elif record.coupled_kN < record.section_force * (1.0 - SAME):
        told = show_value(record.coupled_kN)
        yield say(
            "audit.too_low_end", place=place, high=told, least=record.section_force
        )


def _find_panel(check: CheckRecord, row: RowStudy) -> ExtremeRecord | None:
    """Largest force of the check's member by the panel between posts."""
    name = name_in_panel(check.member)
    found = row.panel.extremes if row.panel else []
    return next((one for one in found if one.quantity == name), None)


def _audit_panel(place: Message, sources: _Sources) -> Iterator[Message]:
    """The force by the panel between posts against the largest of the cases."""
    record, panel = sources.record, sources.panel
    yield from tell_unequal(
        place,
        [
            ("panel_kN", record.panel_kN, panel.max_kN if panel else None),
            ("panel_low_kN", record.panel_low_kN, panel.low_kN if panel else None),
        ],
    )
    if panel is not None:
        high = (record.panel_support_kN or 0.0) - record.along_high_kN
        yield from _audit_high_end(place, record, panel, record.on_row, high)


def _find_floor(check: CheckRecord, row: RowStudy) -> FloorForceRecord | None:
    forces = row.floor.forces if row.floor else []
    return next((one for one in forces if one.member == check.member), None)


def _audit_governing(
    place: Message,
    check: CheckRecord,
    record: ActionRecord,
    least: FloorForceRecord | None,
) -> Iterator[Message]:
    """Governing load: the larger one, which the reason names."""
    governs = record.governing
    case = least.load_case if least else ""
    reason = tell_governing(leave_out_governing(check.reason), record)
    if (record.governs, record.floor_case) != (governs, case) or reason != check.reason:
        yield say("audit.other_load", place=place, load=say(f"load_name.{governs}"))


def _audit_width(
    place: Message, check: CheckRecord, record: ActionRecord
) -> Iterator[Message]:
    """Width of the support that the check names; of two near a threshold the wider."""
    width, spacing = record.loaded_width_m, record.post_spacing_m
    ends = record.end_factor * record.end_length_m
    expected = 0.5 * spacing + ends if record.position == "edge" else spacing
    is_known = record.position in ("intermediate", "edge")
    is_wider = record.other_width_m is None or record.other_width_m <= width
    if (
        not (is_known and is_wider and is_same(width, expected))
        or record.position != check.position
    ):
        yield say("audit.position", place=place, width=width, spacing=spacing)


def _audit_high_end(
    place: Message,
    record: ActionRecord,
    extreme: ExtremeRecord,
    on_row: float,
    high: float,
) -> Iterator[Message]:
    """The high end: of a search exactly, of a grid with what is estimated between."""
    least = (record.share * extreme.high_kN + record.added_high_kN) * on_row
    if extreme.upper_bound_kN is not None:
        yield from tell_unequal(place, [("coupled_kN", high, least)])
    elif high < least * (1.0 - SAME):
        yield say("audit.too_low_end", place=place, high=show_value(high), least=least)


def _find_extreme(check: CheckRecord, row: RowStudy) -> ExtremeRecord | None:
    extremes = {extreme.quantity: extreme for extreme in row.extremes}
    if _is_shared(check, row):
        return extremes.get(Member.FOOT_ANCHOR)  # one anchor carries both, (S7)
    if check.member in extremes:
        return extremes[check.member]
    return extremes.get(BROUGHT_BY.get(check.member, Member.NET))  # its guy's or post's


def list_bringing(check: CheckRecord, row: RowStudy) -> list[ExtremeRecord]:
    """Largest forces that a check rests on: its member's, and what adds to it.

    The net's pull on the head brings what is added, as it does the post's force.
    """
    own = _find_extreme(check, row)
    by_panel = _find_panel(check, row)
    found = [one for one in (own, by_panel) if one is not None]
    if check.action is not None and check.action.added_high_kN > 0.0:
        found += [one for one in row.extremes if one.quantity == Member.POST]
    return found


def _find_lateral(
    check: CheckRecord, row: RowStudy, factors: dict[str, float]
) -> float:
    """Factor of the load along the row at the net's foot; 1 elsewhere.

    Decided from the study alone, as it is drawn: ``SupportLayout`` knows it of a site.
    """
    if check.member == Member.FOOT_ANCHOR or _is_shared(check, row):
        return compute_lateral_factor(factors.get(LATERAL_SHARE, 0.0))
    return 1.0


def _is_shared(check: CheckRecord, row: RowStudy) -> bool:
    """True of a check of an uphill anchor that lies at the net's foot."""
    drawing = row.drawing
    is_at_foot = drawing is not None and drawing.uphill_anchor_m == (0.0, 0.0)
    return check.member == Member.UPHILL_ANCHOR and is_at_foot
