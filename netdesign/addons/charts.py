"""Charts of add-ons: lines against time, few ticks, close names; decades; greys."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime, time, timedelta

from netdesign.report.drawing.plain_svg import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SOFT,
    TEXT_PT,
    TICK,
    WIDTH,
    Chart,
    Frame,
    bounds_of,
    drop_straight,
    measure_words,
    show_place,
)
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
_TICK = 3.0
_DOT, _MOST_DOTS = 1.2, 150  # half the width of a dot [pt]; more of them are a band
_SAMPLE = 12.0  # of a line, before its name at the side [pt]
# From white to the darkest: as many as a print tells apart.
GREYS = tuple(f"#{3 * f'{250 - 11 * level:02x}'}" for level in range(16))
_MONTHS_FROM = 45.0  # days from which on months are named, not days


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One line of a chart, broken where a value is NaN.

    ``label`` stands at the right; ``style`` is a number in ``SHADES``; an accented line
    is the one that the reader should look at. ``low`` and ``high`` are a band about it,
    or without it where ``y`` is empty.
    """

    label: str
    x: Sequence[float]
    y: Sequence[float]
    style: int = 0
    is_accent: bool = False
    is_thin: bool = False
    has_dots: bool = False  # at its points, which are measured
    low: Sequence[float] = ()
    high: Sequence[float] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """A time that matters, with a word at the top of its line."""

    x: float
    label: str
    is_accent: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One chart; ``title`` names the quantity and its unit.

    ``tiles`` are rectangles: start and end on both axes, and fill; ``key`` names fills.
    """

    title: str
    lines: Sequence[Line] = ()
    marks: Sequence[Mark] = ()
    from_zero: bool = False
    height_pt: float = 0.0  # that of all unless it has its own
    tiles: Sequence[tuple[float, float, float, float, str]] = ()
    key: Sequence[tuple[str, str]] = ()

    @property
    def words(self) -> list[str]:
        """Label at its right."""
        return [*(line.label for line in self.lines), *(text for _, text in self.key)]

    @property
    def values(self) -> list[float]:
        """All values up its axis."""
        found = [v for one in self.lines for v in (*one.y, *one.low, *one.high)]
        found += [end for tile in self.tiles for end in tile[2:4]]
        return [value for value in found if not math.isnan(value)]


def draw_panels(
    panels: Sequence[Panel],
    title: str,
    *,
    across: int = 1,
    panel_pt: float = 120.0,
    time_label: str = "",
    span: tuple[datetime, datetime] | None = None,
    language: Language = "en",
) -> str:
    """SVG of charts against time in days, side by side or one below the other.

    Names stand at the right, in the order of the largest values.
    Time has a logarithmic scale with ticks in seconds to days, or that of a calendar.

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
    time_label : str
        Below each column.
    span : (datetime, datetime), optional
        Ends of the time on calendar; days then count from the first, and dates stand
        below the last panel.
    language : Language
        Of the numbers beside the axes.
    """
    sketch = Chart(language=language)
    times = _find_times(panels, span)
    words = [word for panel in panels for word in panel.words]
    room = max(measure_words(word, TEXT_PT) for word in words) + _GAP + _SAMPLE
    pitch, top = (WIDTH + _GAP) / across, 0.0
    for place, panel in enumerate(panels):
        height = panel.height_pt or panel_pt
        frame = _place_frame(
            panel,
            times if span else [math.log(end) for end in times],
            left=place % across * pitch + _LEFT,
            top=top + _ABOVE,
            width=pitch - _GAP - _LEFT - room,
            height=height,
        )
        _Painter(sketch, frame, span is not None).draw(panel, times)
        if place % across == across - 1 or panel is panels[-1]:
            top += _ABOVE + height + (_TICK if span else _BELOW)
        if panel is panels[-1] and span:
            _draw_dates(sketch, frame, *span)
            top += _BELOW - TEXT_PT
    for place in range(min(across, len(panels)) if time_label else 0):
        middle = place * pitch + _LEFT + frame.width / 2
        sketch.text(middle, top + TEXT_PT - 3.0, time_label, anchor="middle")
    return sketch.write(top + TEXT_PT, title)


def _find_times(
    panels: Sequence[Panel], span: tuple[datetime, datetime] | None
) -> tuple[float, float]:
    """First and last time [d]."""
    if span:
        return 0.0, max((span[1] - span[0]) / timedelta(days=1), 1.0)
    return bounds_of([line.x for panel in panels for line in panel.lines])


def _place_frame(panel: Panel, times: Sequence[float], **place: float) -> Frame:
    """Frame of a panel; all lines and a margin above and below them."""
    low, high = bounds_of([panel.values or [0.0]])
    low = 0.0 if panel.from_zero else low
    margin = _MARGIN * ((high - low) or abs(high) or 1.0)
    return Frame(
        **place,
        x_low=times[0],
        x_high=times[1],
        y_low=low if panel.from_zero else low - margin,
        y_high=high + (2.0 * margin if panel.marks else margin),
    )


def _draw_dates(sketch: Chart, frame: Frame, begin: datetime, end: datetime) -> None:
    """First day of each month, or single days of a short span; words stand apart."""
    bottom, free = frame.top + frame.height, -math.inf
    days = (end - begin) / timedelta(days=1)
    step = max(1, round(days / 10.0))
    first = datetime.combine(begin.date(), time())
    first += timedelta(days=1) if first < begin else timedelta()
    for count in range(int((end - first) / timedelta(days=1)) + 1):
        moment = first + timedelta(days=count)
        if moment.day != 1 if days > _MONTHS_FROM else count % step:
            continue
        x = frame.x((moment - begin) / timedelta(days=1))
        sketch.line(((x, bottom), (x, bottom + _TICK)), stroke=GREY)
        word = f"{moment:%m/%Y}" if days > _MONTHS_FROM else f"{moment:%d/%m}"
        if x > free:
            sketch.text(x + 2.0, bottom + TEXT_PT + 4.0, word)
            free = x + 4.0 + measure_words(word, TEXT_PT)


@dataclass(frozen=True, slots=True)
class _Painter:
    """Paints one panel into its frame."""

    sketch: Chart
    frame: Frame
    is_dated: bool

    def draw(self, panel: Panel, times: Sequence[float]) -> None:
        sketch, frame = self.sketch, self.frame
        sketch.text(frame.left, frame.top - 6.0, panel.title, bold=True)
        if panel.tiles:
            self._draw_tiles(panel)
        for line in panel.lines:
            self._fill_band(line)
        sketch.axes(frame, x_ticks=False)
        if not self.is_dated:
            self._draw_clock(times)
        elif frame.y_low < 0.0 < frame.y_high:
            ends = [(x, frame.y(0.0)) for x in (frame.left, frame.left + frame.width)]
            sketch.line(ends, stroke=GREY, width=0.5, dash="2 2")
        for place, mark in enumerate(panel.marks, 1):
            self._draw_mark(mark, place)
        for line in panel.lines:
            self._draw_line(line)
        self._list_names([line for line in panel.lines if line.label and line.x])

    def _at(self, time: float) -> float:
        return self.frame.x(time if self.is_dated else math.log(time))

    def _draw_mark(self, mark: Mark, place: int) -> None:
        """Line at a time; its word on a line of its own, on the side with room."""
        x, top = self._at(mark.x), self.frame.top
        stroke = ACCENT if mark.is_accent else GREY
        ends = [(x, top), (x, top + self.frame.height)]
        self.sketch.line(ends, stroke=stroke, width=0.5, dash="1 2")
        is_right = x - measure_words(mark.label, TEXT_PT) < self.frame.left
        at = (x + 2.5 if is_right else x - 2.5, top + place * (TEXT_PT + 1.0) - 1.0)
        anchor = "start" if is_right else "end"
        self.sketch.text(*at, mark.label, anchor=anchor, fill=SOFT)

    def _draw_tiles(self, panel: Panel) -> None:
        """Rectangles, and what their fills mean at the right."""
        frame = self.frame
        placed = [
            (frame.x(x0), frame.y(y1), frame.x(x1) - frame.x(x0), y1 - y0, fill)
            for x0, x1, y0, y1, fill in panel.tiles
            if y1 > y0
        ]
        scale = frame.height / (frame.y_high - frame.y_low)
        tiles = ((x, y, w, h * scale, fill) for x, y, w, h, fill in placed)
        draw_tiles(self.sketch, tiles)
        x = frame.left + frame.width + 4.0
        for place, (fill, text) in enumerate(panel.key, 1):
            y = frame.top + frame.height - place * _SAMPLE
            draw_tiles(self.sketch, [(x, y, _SAMPLE, _SAMPLE, fill)])
            self.sketch.text(x + _SAMPLE + 3.0, y + 9.0, text)

    def _fill_band(self, line: Line) -> None:
        ends = [
            [(self._at(x), self.frame.y(y)) for x, y in zip(line.x, side, strict=True)]
            for side in (line.low, line.high)
            if len(side) > 1
        ]
        if ends:
            self.sketch.area([*ends[1], *reversed(ends[0])], PALE)

    def _draw_line(self, line: Line) -> None:
        stroke, dash = _look_of(line)
        for run in _split(line) if line.y else ():
            if len(run) == 1 and self.is_dated:  # as wide as its day, or nobody sees it
                ((x, y),) = run
                run = [(x - 0.5, y), (x + 0.5, y)]
            points = [(self._at(x), self.frame.y(y)) for x, y in run]
            width = 0.6 if line.is_thin or line.has_dots else 1.2
            kept = drop_straight(points)
            self.sketch.line(kept, stroke=stroke, width=width, dash=dash)
            if line.has_dots and len(points) <= _MOST_DOTS:
                side = 2.0 * _DOT
                dots = ((x - _DOT, y - _DOT, side, side, GREY) for x, y in points)
                draw_tiles(self.sketch, dots)

    def _list_names(self, lines: Sequence[Line]) -> None:
        """Names at the right beside a piece of each line, the largest value first."""
        tops = [(max(Panel(title="", lines=[one]).values), one) for one in lines]
        left, free = self.frame.left + self.frame.width + 4.0, self.frame.top - _APART
        for value, line in sorted(tops, key=lambda one: -one[0]):
            y = free = max(self.frame.y(value) + TEXT_PT / 3, free + _APART + 1.0)
            stroke, dash = _look_of(line)
            ends = ((left, y - 2.5), (left + _SAMPLE - 3.0, y - 2.5))
            if line.y:
                self.sketch.line(ends, stroke=stroke, width=1.2, dash=dash)
            else:
                self.sketch.line(ends, stroke=PALE, width=6.0)
            self.sketch.text(left + _SAMPLE, y, line.label)

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


def _look_of(line: Line) -> tuple[str, str]:
    """Stroke and dashes."""
    shade, dash = SHADES[line.style % len(SHADES)]
    return ACCENT if line.is_accent else shade, dash


def _split(line: Line) -> list[list[tuple[float, float]]]:
    """Runs of known values."""
    runs: list[list[tuple[float, float]]] = [[]]
    for x, y in zip(line.x, line.y, strict=True):
        if math.isnan(y):
            runs.append([])
        else:
            runs[-1].append((x, y))
    return [run for run in runs if run]


def draw_decades(chart: Chart, frame: Frame, *, across: bool) -> None:
    """Ticks across the page or up it, where the frame has logarithms to base 10."""
    ends = (frame.x_low, frame.x_high) if across else (frame.y_low, frame.y_high)
    bottom, path = frame.top + frame.height, ""
    for number in _list_decades(min(ends), max(ends)):
        place, word = math.log10(number), chart.write_tick(number)
        if across:
            x, y = frame.x(place), bottom + TICK + TEXT_PT + 1.5
            path += f"M{show_place(x)} {show_place(bottom)}v{TICK}"
            chart.text(x, y, word, anchor="middle")
        else:
            x, y = frame.left - TICK - 3.5, frame.y(place)
            path += f"M{show_place(frame.left)} {show_place(y)}h-{TICK}"
            chart.text(x, y + TEXT_PT / 3, word, anchor="end")
    chart.shapes.append(f'<path d="{path}" stroke="{GREY}" stroke-width="0.5"/>')


def _list_decades(low: float, high: float) -> list[float]:
    """Round numbers between two logarithms: powers of ten; 2 and 5 of few decades."""
    factors = (1, 2, 5) if high - low < 2.0 else (1,)
    powers = range(math.floor(low), math.ceil(high) + 1)
    numbers = [factor * 10.0**power for power in powers for factor in factors]
    return [x for x in numbers if low - 1e-9 <= math.log10(x) <= high + 1e-9]


def shade(value: float, low: float, high: float) -> str:
    """Grey for a value, white at the low end and for none; prints without colour."""
    if math.isnan(value):
        return "#fff"
    share = (value - low) / (high - low) if high > low else 0.0
    return GREYS[round((len(GREYS) - 1) * min(1.0, max(0.0, share)))]


def draw_tiles(
    chart: Chart, cells: Iterable[tuple[float, float, float, float, str]]
) -> None:
    """Filled rectangles: left, top, width, height [pt] and fill of each.

    A map has hundreds: each is a thick line, those of one fill are one path, and
    paths of one width in turn share it.
    """
    paths: dict[str, dict[str, str]] = {}
    for left, top, width, height, fill in cells:
        of_width = paths.setdefault(show_place(width), {})
        middle, start = show_place(left + width / 2), show_place(top)
        tile = f"M{middle} {start}v{show_place(height)}"
        of_width[fill] = of_width.get(fill, "") + tile
    for width_pt, fills in paths.items():
        lines = "".join(f'<path stroke="{f}" d="{d}"/>' for f, d in fills.items())
        chart.shapes.append(f'<g stroke-width="{width_pt}">{lines}</g>')
