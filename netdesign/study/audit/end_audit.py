"""Checks of a row's end against the largest pulls of its ropes along the row."""

from __future__ import annotations

from collections.abc import Iterator

from netdesign.structure.members import ROPE_OF, EndMember
from netdesign.study.audit.comparing import Pair, tell_unequal
from netdesign.study.audit.envelope_audit import same_point
from netdesign.study.case_records import ExtremeRecord
from netdesign.study.records import CheckRecord, RowStudy
from netdesign.words.message import Message, say


def audit_end(place: Message, check: CheckRecord, row: RowStudy) -> Iterator[Message]:
    """Follow the largest pull of a rope along the row to an end member's demand."""
    record, extreme = check.action, _find_rope(check, row)
    if extreme is None or record is None:
        if check.action_kN is not None or (extreme is None) is not (record is None):
            yield say("audit.action_or_force", place=place)
        return
    factor, share = check.action_factor or 0.0, record.share
    on_row = record.loaded_width_m / record.post_spacing_m
    reach = record.end_length_m / record.post_spacing_m
    expected = 1.0 + record.end_factor * (reach if reach <= 0.5 else 1.0)
    pairs: list[Pair] = [
        ("solved_kN", record.solved_kN, extreme.max_kN),
        ("loaded_width_m", on_row, expected),
        ("action_kN", check.action_kN, share * record.solved_kN * on_row),
    ]
    if check.member == EndMember.LATERAL_ANCHOR:
        pairs.append(("share", share, 1.0))
    if factor:
        low = share * extreme.low_kN * on_row * factor
        pairs.append(("demand_low_kN", check.demand_low_kN, low))
        high = record.coupled_kN * factor
        pairs.append(("demand_high_kN", check.demand_high_kN, high))
    if extreme.upper_bound_kN is not None:
        high = share * extreme.high_kN * on_row
        pairs.append(("coupled_kN", record.coupled_kN, high))
    yield from tell_unequal(place, pairs)
    if not same_point(check.case, extreme.case):
        yield say("audit.other_case", place=place)


def _find_rope(check: CheckRecord, row: RowStudy) -> ExtremeRecord | None:
    name = ROPE_OF[check.member]
    found = row.panel.extremes if row.panel else []
    return next((one for one in found if one.quantity == name), None)
