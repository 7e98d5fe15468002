"""Drawing of the page: the model's bands, and what was measured in them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from netdesign.addons.evidence.validation.structure import MemberBand, Validation
from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    PALE,
    TEXT_PT,
    WIDTH,
    Chart,
    Frame,
    measure_words,
)
from netdesign.report.words import ENGLISH, show_member
from netdesign.words.catalogue import load_texts

_LINE = 13.0  # of a list [pt]
_BELOW = 32.0  # a list: its ticks, the name of its axis [pt]
_FEEBLE = 1.0  # least force of the axis [kN]: a slack guy has none


def draw_bands(validations: Sequence[Validation]) -> str:
    """Bands of the model and what was measured, one bar a member."""
    bars: list[tuple[str, MemberBand | None, float]] = []
    for one in validations:
        bars.append((one.structure.title, None, 0.0))
        bars += [
            (
                f"{pair.measured.name}: {name_validated(band.member)}",
                band,
                pair.measured.value,
            )
            for pair in one.comparisons
            for band in pair.bands
        ]
    largest = max(value for _, band, x in bars if band for value in (band.high, x))
    left = max(measure_words(name, TEXT_PT) for name, band, _ in bars if band) + 10.0
    frame = Frame(
        left=left,
        top=2.0,
        width=WIDTH - left - 4.0,
        height=_LINE * len(bars),
        x_low=math.log10(_FEEBLE / 1.3),
        x_high=math.log10(1.3 * largest),
        y_low=len(bars),
        y_high=0.0,
    )
    chart = Chart(language="en")
    for place, (name, band, value) in enumerate(bars):
        y = frame.y(place + 0.5)
        if band is None:
            chart.text(2.0, y + TEXT_PT / 3, name, bold=True)
            continue
        chart.text(frame.left - 6.0, y + TEXT_PT / 3, name, anchor="end")
        _draw_bar(chart, frame, y, band, value)
    return _end(chart, frame)


def _draw_bar(
    chart: Chart, frame: Frame, y: float, band: MemberBand, value: float
) -> None:
    """Band of a member, its middle, and what was measured."""
    for ends, color in (((band.low, band.high), PALE), (band.middle, GREY)):
        left, right = (frame.x(math.log10(max(end, _FEEBLE))) for end in ends)
        chart.rectangle(left, y - 3.5, max(right - left, 0.5), 7.0, color)
    x = frame.x(math.log10(max(value, _FEEBLE)))
    chart.line(((x, y - 5.5), (x, y + 5.5)), stroke=ACCENT, width=2.2)


def _end(chart: Chart, frame: Frame) -> str:
    chart.axes(frame, x_ticks=False, y_ticks=False)
    chart.decades(frame, across=True)
    bottom = frame.top + frame.height
    middle, axis = frame.left + frame.width / 2.0, ENGLISH("validation.bands_axis")
    chart.text(middle, bottom + _BELOW - 6.0, axis, anchor="middle")
    return chart.write(bottom + _BELOW, ENGLISH("validation.bands_title"))


def name_validated(member: str) -> str:
    """Member of the model that a measured value may be."""
    key = f"validation_member.{member}"
    return ENGLISH(key) if key in load_texts("en") else show_member(ENGLISH, member)
