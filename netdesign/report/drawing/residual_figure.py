"""Residuals of a fit: measured over computed force against date."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import date
from typing import Any

from netdesign.report.drawing.plain_svg import WIDTH, Chart, Frame
from netdesign.report.drawing.style import ACCENT, GREY, INK, TEXT_PT
from netdesign.report.words import Words, show_member

_LEFT, _RIGHT = 36.0, 116.0  # beside the panel [pt]
_HEAD, _HEIGHT, _FOOT = 16.0, 110.0, 22.0  # above, of, and below the panel [pt]
_BANDS = ((2.0, "#eef0f2"), (1.0, "#dfe2e6"))  # deviations and their greys
_STROKES = (ACCENT, INK, GREY, "#555b63")

Residual = Mapping[str, Any]


def draw_residuals(residuals: Sequence[Residual], words: Words) -> str:
    """SVG of the residuals of a fit; "" without any.

    Parameters
    ----------
    residuals : sequence of mapping
        Entries of ``residuals`` of the winter document.
    words : Words
        Language.
    """
    if not residuals:
        return ""
    chart = Chart(language=words.language)
    first = min(date.fromisoformat(one["date"]) for one in residuals)
    days = [(date.fromisoformat(one["date"]) - first).days for one in residuals]
    shares = [100.0 * math.expm1(one["residual"]) for one in residuals]
    frame = _place(days, shares, residuals)
    chart.text(_LEFT, _HEAD - 5.0, words("fit_page.figure_title"), bold=True)
    _draw_bands(chart, frame, days, residuals)
    zero = frame.y(0.0)
    chart.line(((frame.left, zero), (frame.left + frame.width, zero)), stroke=GREY)
    chart.axes(frame, x_ticks=False)
    members = list(dict.fromkeys(one["member"] for one in residuals))
    for member, stroke in zip(members, _STROKES, strict=False):
        for day, share, one in zip(days, shares, residuals, strict=True):
            if one["member"] == member:
                chart.ring(frame.x(day), frame.y(share), stroke)
    _name_members(chart, frame, members, words)
    _label_days(chart, frame, days, residuals)
    height = _HEAD + _HEIGHT + _FOOT
    return chart.write(height, words("fit_page.figure"))


def _place(
    days: Sequence[int], shares: Sequence[float], residuals: Sequence[Residual]
) -> Frame:
    """Frame that holds all residuals and two deviations of most of them."""
    usual = sorted(one["deviation"] for one in residuals)[len(residuals) // 2]
    reach = 1.1 * max(*(abs(share) for share in shares), 200.0 * usual)
    return Frame(
        left=_LEFT,
        top=_HEAD,
        width=WIDTH - _LEFT - _RIGHT,
        height=_HEIGHT,
        x_low=-2.0,
        x_high=max(days) + 2.0,
        y_low=-reach,
        y_high=reach,
    )


def _draw_bands(
    chart: Chart, frame: Frame, days: Sequence[int], residuals: Sequence[Residual]
) -> None:
    """Greys of one and two deviations; of several members the widest of a day."""
    widest: dict[int, float] = {}
    for day, one in zip(days, residuals, strict=True):
        widest[day] = max(one["deviation"], widest.get(day, 0.0))
    for count, fill in _BANDS:
        ends = [
            (frame.x(day), min(100.0 * math.expm1(count * wide), frame.y_high))
            for day, wide in widest.items()
        ]
        above = [(x, frame.y(end)) for x, end in ends]
        below = [(x, frame.y(-end)) for x, end in ends]
        if len(ends) > 1:
            chart.area([*above, *below[::-1]], fill)


def _name_members(
    chart: Chart, frame: Frame, members: Sequence[str], words: Words
) -> None:
    x = frame.left + frame.width + 8.0
    for place, (member, stroke) in enumerate(zip(members, _STROKES, strict=False)):
        y = frame.top + 8.0 + place * (TEXT_PT + 5.0)
        chart.ring(x, y - 2.5, stroke)
        chart.text(x + 8.0, y, show_member(words, member))


def _label_days(
    chart: Chart, frame: Frame, days: Sequence[int], residuals: Sequence[Residual]
) -> None:
    """Dates of the first and the last reading, and ticks of all."""
    bottom = frame.top + frame.height
    for day in sorted(set(days)):
        x = frame.x(day)
        chart.line(((x, bottom), (x, bottom + 3.0)), stroke=GREY)
    dated = dict(zip(days, (one["date"] for one in residuals), strict=True))
    for day, anchor in ((min(days), "start"), (max(days), "end")):
        y = bottom + TEXT_PT + 5.0
        chart.text(frame.x(day), y, dated[day], anchor=anchor)
