"""Line charts against time: few ticks, thin lines, names at the lines' ends."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from netdesign.report.drawing.letters import measure_words
from netdesign.report.drawing.plain_svg import (
    WIDTH,
    Chart,
    Frame,
    bounds_of,
    drop_straight,
)
from netdesign.report.drawing.style import ACCENT, GREY, INK, SOFT, TEXT_PT
from netdesign.report.words import ENGLISH, Words, show_member
from netdesign.study.records import MonitoringRecord
from netdesign.words.catalogue import Language

# Told apart without colour: by shade and by dashes.
SHADES = ((INK, ""), ("#555b63", "5 1.6"), (GREY, "1.2 1.2"), (GREY, "6 1.5 1.2 1.5"))
_SECOND = 1.0 / 86_400.0  # [days]
_CLOCK = (
    *((_SECOND * n, f"{n} s") for n in (1, 10)),
    *((60 * _SECOND * n, f"{n} min") for n in (1, 10)),
    *((3600 * _SECOND * n, f"{n} h") for n in (1, 6)),
    *((1.0 * n, f"{n} d") for n in (1, 10, 100, 1000)),
)
_LEFT, _GAP = 34.0, 8.0  # of a panel: its numbers; beside the names of its lines [pt]
_ABOVE, _BELOW = 18.0, 20.0  # it: its title; its ticks [pt]
_MARGIN = 0.1  # of the values, above and below them
_APART = 1.15 * TEXT_PT  # names of two lines [pt]
_REACH = 20.0  # names beginning that close may overlap [pt]
_TICK = 3.0
_DOT, _MOST_DOTS = 1.2, 60  # half the width of a dot [pt]; more of them are a band


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One line of a chart.

    ``label`` stands at its end; ``style`` is a number in ``SHADES``; an accented line
    is the one that the reader should look at.
    """

    label: str
    x: Sequence[float]
    y: Sequence[float]
    style: int = 0
    is_accent: bool = False
    is_thin: bool = False
    has_dots: bool = False  # at its points, which are measured


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """A time that matters, with a word at the top of its line."""

    x: float
    label: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One chart; ``title`` names the quantity and its unit."""

    title: str
    lines: Sequence[Line]
    marks: Sequence[Mark] = ()
    from_zero: bool = False


def draw_panels(
    panels: Sequence[Panel],
    title: str,
    *,
    across: int = 1,
    panel_pt: float = 120.0,
    is_log: bool = True,
    time_label: str,
    language: Language = "en",
) -> str:
    """SVG of charts against time in days, side by side or one below the other.

    Parameters
    ----------
    panels : sequence of Panel
        In reading order; lines need not share their times.
    title : str
        What a screen reader says.
    across : int
        Panels in a row.
    panel_pt : float
        Height of a panel [pt].
    is_log : bool
        Time on a logarithmic scale, ticks in seconds to days.
    time_label : str
        Below each column.
    language : Language
        Of the numbers beside the axes.
    """
    sketch = Chart(language=language)
    lines = [line for panel in panels for line in panel.lines if len(line.x)]
    times = bounds_of([line.x for line in lines])
    room = max(measure_words(line.label, TEXT_PT) for line in lines) + _GAP
    pitch, step = (WIDTH + _GAP) / across, _ABOVE + panel_pt + _BELOW
    height = math.ceil(len(panels) / across) * step + TEXT_PT
    for place, panel in enumerate(panels):
        frame = _place_frame(
            panel,
            [math.log(end) for end in times] if is_log else times,
            left=place % across * pitch + _LEFT,
            top=place // across * step + _ABOVE,
            width=pitch - _GAP - _LEFT - room,
            height=panel_pt,
        )
        _Painter(sketch, frame, is_log).draw(panel, times)
        if place < across:
            middle = frame.left + frame.width / 2
            sketch.text(middle, height - 3.0, time_label, anchor="middle")
    return sketch.write(height, title)


def _place_frame(panel: Panel, times: Sequence[float], **place: float) -> Frame:
    """Frame of a panel; all lines and a margin above and below them."""
    low, high = bounds_of([line.y for line in panel.lines])
    low = 0.0 if panel.from_zero else low
    margin = _MARGIN * ((high - low) or abs(high) or 1.0)
    return Frame(
        **place,
        x_low=times[0],
        x_high=times[1],
        y_low=low if panel.from_zero else low - margin,
        y_high=high + (2.0 * margin if panel.marks else margin),
    )


@dataclass(frozen=True, slots=True)
class _Painter:
    """Paints one panel into its frame."""

    sketch: Chart
    frame: Frame
    is_log: bool

    def draw(self, panel: Panel, times: Sequence[float]) -> None:
        sketch, frame = self.sketch, self.frame
        sketch.text(frame.left, frame.top - 6.0, panel.title, bold=True)
        sketch.axes(frame, x_ticks=not self.is_log)
        if self.is_log:
            self._draw_clock(times)
        for mark in panel.marks:
            x = self._at(mark.x)
            ends = [(x, frame.top), (x, frame.top + frame.height)]
            sketch.line(ends, stroke=GREY, width=0.5, dash="1 2")
            at = (x - 2.5, frame.top + TEXT_PT)
            sketch.text(*at, mark.label, anchor="end", fill=SOFT)
        for line in panel.lines:
            self._draw_line(line)
        self._name_lines([one for one in panel.lines if one.label and len(one.x)])

    def _at(self, time: float) -> float:
        return self.frame.x(math.log(time) if self.is_log else time)

    def _draw_line(self, line: Line) -> None:
        shade, dash = SHADES[line.style % len(SHADES)]
        stroke = ACCENT if line.is_accent else shade
        points = [
            (self._at(x), self.frame.y(y)) for x, y in zip(line.x, line.y, strict=True)
        ]
        width = 0.6 if line.is_thin or line.has_dots else 1.2
        kept = drop_straight(points)
        self.sketch.line(kept, stroke=stroke, width=width, dash=dash)
        if line.has_dots and len(points) <= _MOST_DOTS:
            for x, y in points:
                self.sketch.rectangle(x - _DOT, y - _DOT, 2 * _DOT, 2 * _DOT, GREY)

    def _draw_clock(self, times: Sequence[float]) -> None:
        """Ticks of logarithmic time that a reader can picture, none too close."""
        bottom, free = self.frame.top + self.frame.height, -math.inf
        for days, word in _CLOCK:
            x, half = self._at(days), measure_words(word, TEXT_PT) / 2 + 1.5
            if times[0] * 0.999 <= days <= times[1] * 1.001 and x - half >= free:
                free = x + half
                self.sketch.line([(x, bottom), (x, bottom + _TICK)], stroke=GREY)
                base = bottom + _TICK + TEXT_PT + 1.5
                self.sketch.text(x, base, word, anchor="middle")

    def _name_lines(self, lines: Sequence[Line]) -> None:
        """Name each line at its end; names that would overlap are moved apart."""
        ends = [(self._at(one.x[-1]), self.frame.y(one.y[-1]), one) for one in lines]
        ends.sort(key=lambda end: end[0])
        while ends:
            first, last = ends[0][0], ends[-1][0]
            group = [end for end in ends if end[0] - first < _REACH]
            ends = ends[len(group) :]
            # the longer lines go on above or below the name of one that ends early
            drop = 7.0 if first < last - _REACH else 0.0
            group.sort(key=lambda end: end[1])
            heights = spread([y for _, y, _ in group], _APART)
            for (x, _, line), y in zip(group, heights, strict=True):
                shade, _ = SHADES[line.style % len(SHADES)]
                fill = ACCENT if line.is_accent else INK if shade == INK else SOFT
                at = (x + 3.0, y + TEXT_PT / 3 + drop)
                self.sketch.text(*at, line.label, fill=fill)


def spread(heights: Sequence[float], gap: float) -> list[float]:
    """Ascending heights moved apart to ``gap``, each group about its mean.

    >>> spread([0.0, 0.0, 1.0], 0.25)
    [-0.125, 0.125, 1.0]
    """
    groups: list[list[float]] = []
    for height in heights:
        groups.append([height])
        while len(groups) > 1 and _reach(groups[-2], gap) > _begin(groups[-1], gap):
            groups[-2:] = [groups[-2] + groups[-1]]
    return [
        _begin(group, gap) + place * gap
        for group in groups
        for place in range(len(group))
    ]


def _begin(group: Sequence[float], gap: float) -> float:
    return sum(group) / len(group) - gap * (len(group) - 1) / 2


def _reach(group: Sequence[float], gap: float) -> float:
    """Least height that the next group may begin at."""
    return _begin(group, gap) + gap * len(group)


_TALL = 84.0  # of a panel [pt]


def draw_monitoring(records: Sequence[MonitoringRecord], words: Words = ENGLISH) -> str:
    """SVG of all measured series of a net row; "" without any."""
    panels = [panel for record in records for panel in _list_panels(record, words)]
    if not panels:
        return ""
    return draw_panels(
        panels,
        _describe(panels, words),
        panel_pt=_TALL,
        is_log=False,
        time_label=words("drawing.days"),
        language=words.language,
    )


def _describe(panels: Sequence[Panel], words: Words) -> str:
    """Words for what the drawing says, with the range of each line."""
    values = [
        words(
            "show.label",
            label=words("drawing.of_member", member=panel.title, what=line.label),
            text=words(
                "show.band",
                low=words.show_share(min(line.y)),
                high=words.show_share(max(line.y)),
            ),
        )
        for panel in panels
        for line in panel.lines
    ]
    what = words("drawing.monitoring")
    return words("drawing.with_values", what=what, values=tuple(values))


def describe_monitoring(
    records: Sequence[MonitoringRecord], words: Words = ENGLISH
) -> str:
    """Note below the drawing: where the model's forces stand, or what they need."""
    told = dict.fromkeys(words.show(record.model) for record in records)
    return words("drawing.monitoring_note", model=tuple(told))


def _list_panels(record: MonitoringRecord, words: Words) -> list[Panel]:
    member = show_member(words, record.member)
    panels = []
    times, values = _pick(record.times_d, record.tensions_kN)
    if times:
        label, title = (
            words("drawing.measured"),
            words("drawing.tension", member=member),
        )
        line = Line(label=label, x=times, y=values, has_dots=True)
        panels.append(Panel(title=title, lines=[line]))
    times, values = _pick(record.times_d, record.air_temperatures_C)
    if times:
        air = words("drawing.air")
        line = Line(label=air, x=times, y=values, style=1, is_thin=True)
        panels.append(Panel(title=words("drawing.air_temperature"), lines=[line]))
    return panels


def _pick(
    times: Sequence[float], values: Sequence[float | None]
) -> tuple[list[float], list[float]]:
    """Times and values of the readings that exist."""
    known = [(t, v) for t, v in zip(times, values, strict=True) if v is not None]
    return [time for time, _ in known], [value for _, value in known]
