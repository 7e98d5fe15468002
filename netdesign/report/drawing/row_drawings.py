"""All drawings of a net row, for every output that shows them."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.report.drawing.chain_figure import draw_chains
from netdesign.report.drawing.envelope_maps import draw_lines, draw_maps, split_members
from netdesign.report.drawing.grid_record import record_grid
from netdesign.report.drawing.monitoring_figure import (
    describe_monitoring,
    draw_monitoring,
)
from netdesign.report.drawing.panel_figure import draw_panel
from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.governing import find_shown_member
from netdesign.report.words import Words
from netdesign.study.records import RowStudy


@dataclass(frozen=True, slots=True, kw_only=True)
class RowDrawings:
    """Drawings of a net row as SVG; "" where there is nothing to draw."""

    section: str
    chains: str
    envelope: str  # of the member that governs
    panel: str
    monitoring: str
    monitoring_note: str


def draw_row(row: RowStudy, anchor: str, words: Words) -> RowDrawings:
    """Drawings of a net row."""
    monitoring = draw_monitoring(row.monitoring, words)
    return RowDrawings(
        section=draw_section(row.drawing, anchor, words) if row.drawing else "",
        chains=draw_chains(row, words),
        envelope=_draw_member(row, words),
        panel=draw_panel(row.panel, words) if row.panel else "",
        monitoring=monitoring,
        monitoring_note=describe_monitoring(row.monitoring, words)
        if monitoring
        else "",
    )


def _draw_member(row: RowStudy, words: Words) -> str:
    """Envelope of the member that governs; of another where that has no force."""
    members = split_members(row.envelope or record_grid(row))
    if not members:
        return ""
    first = find_shown_member(row)
    shown = min(members, key=lambda one: one.bounds[0].quantity != first)
    return draw_maps(shown, words) or draw_lines(shown, words)
