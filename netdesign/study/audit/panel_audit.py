"""The panel that a study is of against that of the site file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from netdesign.site.model import NetRow
from netdesign.study.record_panel import record_panel
from netdesign.study.records import RowStudy
from netdesign.study.support_records import PanelRecord
from netdesign.study.values import compare_values
from netdesign.words.message import Message, say


def audit_panel_inputs(row: RowStudy, given: NetRow) -> Iterator[Message]:
    """The panel that a study is of against that of the site file."""
    place = say("audit.row", row=row.id)
    stored = row.panel and _leave_out_forces(row.panel)
    for found in compare_values({"panel": stored}, {"panel": record_panel(given)}):
        yield say("audit.row_otherwise", place=place, value=found.message)


def _leave_out_forces(panel: PanelRecord) -> PanelRecord:
    ropes = [replace(one, along_kN=None, tension_kN=None) for one in panel.ropes]
    return replace(
        panel,
        ropes=ropes,
        extremes=[],
        failed=0,
        effective_height_m=None,
        lift_m=None,
        drawing=None,
    )
