"""Envelope of a net row: of the member that governs."""

from __future__ import annotations

from netdesign.report.drawing.envelope_maps import draw_lines, draw_maps, split_members
from netdesign.report.drawing.grid_record import record_grid
from netdesign.report.governing import find_shown_member
from netdesign.report.words import Words
from netdesign.study.records import RowStudy


def draw_envelope(row: RowStudy, words: Words) -> str:
    """Envelope of the member that governs; of another where that has no force."""
    members = split_members(row.envelope or record_grid(row))
    if not members:
        return ""
    first = find_shown_member(row)
    shown = min(members, key=lambda one: one.bounds[0].quantity != first)
    return draw_maps(shown, words) or draw_lines(shown, words)
