"""All drawings of a net row, for every output that shows them."""

from __future__ import annotations

from dataclasses import dataclass

from netdesign.report.drawing.envelope_figure import draw_envelope
from netdesign.report.drawing.envelope_maps import (
    draw_drivers,
    draw_lines,
    draw_maps,
    split_members,
)
from netdesign.report.drawing.head_figure import draw_head
from netdesign.report.drawing.monitoring_figure import (
    describe_monitoring,
    draw_monitoring,
)
from netdesign.report.drawing.panel_figure import draw_panel
from netdesign.report.drawing.section_figure import draw_section
from netdesign.report.view.check_view import find_shown_member
from netdesign.report.words import Words
from netdesign.study.records import RowStudy


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberDrawings:
    """Envelope of one member."""

    maps: str
    lines: str
    drivers: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RowDrawings:
    """Drawings of a net row as SVG; "" where there is nothing to draw."""

    section: str
    envelope: str
    head: str
    panel: str
    monitoring: str
    monitoring_note: str
    searched: tuple[MemberDrawings, ...]  # the member that governs first


def draw_row(row: RowStudy, anchor: str, words: Words, *, is_full: bool) -> RowDrawings:
    """Drawings of a net row; a summary has its section alone."""
    section = draw_section(row.drawing, anchor, words) if row.drawing else ""
    if not is_full:
        return RowDrawings(
            section=section,
            envelope="",
            head="",
            panel="",
            monitoring="",
            monitoring_note="",
            searched=(),
        )
    monitoring = draw_monitoring(row.monitoring, words)
    return RowDrawings(
        section=section,
        envelope="" if row.envelope else draw_envelope(row, words),
        head=draw_head(row.head, words) if len(row.head) > 1 else "",
        panel=draw_panel(row.panel, words) if row.panel else "",
        monitoring=monitoring,
        monitoring_note=describe_monitoring(row.monitoring, words)
        if monitoring
        else "",
        searched=_draw_members(row, words),
    )


def _draw_members(row: RowStudy, words: Words) -> tuple[MemberDrawings, ...]:
    members = split_members(row.envelope) if row.envelope else []
    first = find_shown_member(row)
    members.sort(key=lambda one: one.bounds[0].quantity != first)
    return tuple(
        MemberDrawings(
            maps=draw_maps(one, words),
            lines=draw_lines(one, words),
            drivers=draw_drivers(one, words),
        )
        for one in members
    )
