"""Study -> one self-contained page: no script, no other file, ready for A4."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from netdesign.given_files import make_printable
from netdesign.report.envelope_figure import draw_envelope
from netdesign.report.gate import require_sections
from netdesign.report.head_figure import draw_head
from netdesign.report.monitoring_figure import describe_monitoring, draw_monitoring
from netdesign.report.page import build_environment, load_style
from netdesign.report.section_figure import draw_section
from netdesign.report.view import ReportView, build_view
from netdesign.study import RowStudy, Study

if TYPE_CHECKING:
    from markupsafe import Markup

_PAGE_SECTIONS = (
    "verdict",
    "identification",
    "summary",
    "ranges",
    "profile",
    "notes",
    "quality",
    "provenance",
)
_ROW_SECTIONS = (
    "drawing",
    "checks",
    "worked",
    "changes",
    "support",
    "guideline",
    "extremes",
    "envelope",
    "failed",
    "inputs",
)


def render_html(study: Study) -> str:
    """Page of a study: complete, or an error.

    Raises
    ------
    NetDesignError
        If the study contradicts its own numbers or a section would be missing.
    """
    from markupsafe import Markup

    environment = build_environment()
    environment.filters["subscripts"] = _write_subscripts
    view = build_view(study)
    page = environment.get_template("report.html").render(
        view=view,
        css=load_style("report.css"),
        running_title=Markup(_quote_css(view.running_title)),
        figures=[
            _draw_row(row, row_view.anchor)
            for row, row_view in zip(study.rows, view.rows, strict=True)
        ],
    )
    require_sections(page, list_sections(view))
    return make_printable(page)


def list_sections(view: ReportView) -> list[str]:
    """Ids of all sections that a page of ``view`` must have."""
    of_rows = [f"{row.anchor}-{name}" for row in view.rows for name in _ROW_SECTIONS]
    return [*_PAGE_SECTIONS, *of_rows]


def _draw_row(row: RowStudy, anchor: str) -> dict[str, Markup]:
    from markupsafe import Markup, escape

    section = draw_section(row.drawing, f"{anchor}-s") if row.drawing else ""
    envelope = draw_envelope(row, f"{anchor}-e")
    measured = draw_monitoring(row.monitoring, f"{anchor}-m")
    head = draw_head(row.head, f"{anchor}-h") if len(row.head) > 1 else ""
    return {
        "head": Markup(head),
        "section": Markup(section),
        "envelope": Markup(envelope),
        "monitoring": Markup(measured),
        "monitoring_note": escape(describe_monitoring(row.monitoring)),
    }


def _write_subscripts(symbols: str) -> Markup:
    """``E_d`` with a lowered d; everything else is escaped."""
    from markupsafe import Markup, escape

    lowered = re.sub(r"_(\w)", r"<sub>\1</sub>", str(escape(symbols)))
    return Markup(lowered)


def _quote_css(text: str) -> str:
    """CSS string in which every sign that could end it is a code."""
    safe = "".join(
        sign if sign.isascii() and sign.isalnum() else f"\\{ord(sign):06x}"
        for sign in text
    )
    return f'"{safe}"'
