"""Line charts against time: few ticks, faint lines, labels at the lines' ends."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from netdesign.report.drawing.style import (
    ACCENT,
    GREY,
    INK,
    PALE,
    SOFT,
    TEXT_PT,
    WIDTH_IN,
    use_style,
    write_svg,
)
from netdesign.words.numerals import Language

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Told apart without colour: by shade and by dashes.
SHADES: tuple[tuple[str, Any], ...] = (
    (INK, "-"),
    ("#555b63", (0, (5, 1.6))),
    (GREY, (0, (1.2, 1.2))),
    (GREY, (0, (6, 1.5, 1.2, 1.5))),
)
_SECOND = 1.0 / 86_400.0  # [days]
_CLOCK = (
    *((_SECOND * n, f"{n} s") for n in (1, 10)),
    *((60 * _SECOND * n, f"{n} min") for n in (1, 10)),
    *((3600 * _SECOND * n, f"{n} h") for n in (1, 6)),
    *((1.0 * n, f"{n} d") for n in (1, 10, 100, 1000)),
)
_LETTER_IN = 0.066  # width of a letter in a label
_TICK_GAP = 0.05  # least distance of two ticks, in widths of a panel
_LABEL_REACH = 0.06  # names beginning that close, in widths of a panel, may overlap
_LINE_GAP = 0.075  # least distance of two labels, in heights of the panel


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
    name: str,
    title: str,
    *,
    across: int = 1,
    panel_in: float = 1.75,
    is_log: bool = True,
    time_label: str,
    language: Language = "en",
) -> str:
    """SVG of charts against time in days, side by side or one below the other.

    Parameters
    ----------
    panels : sequence of Panel
        In reading order; lines need not share their times.
    name, title : str
        As ``write_svg`` takes them.
    across : int
        Panels in a row.
    panel_in : float
        Height of a panel [inch].
    is_log : bool
        Time on a logarithmic scale, ticks in seconds to days.
    time_label : str
        Below the last row.
    language : Language
        Of the numbers beside the axes.
    """
    from matplotlib.figure import Figure

    scale = _find_scale(panels, across, is_log=is_log)
    down = math.ceil(len(panels) / across)
    height = down * (panel_in + 0.28) + 0.38
    with use_style(name):
        figure = Figure(figsize=(WIDTH_IN, height))
        grid = figure.subplots(down, across, squeeze=False)
        for panel, axes in zip(panels, grid.flat, strict=False):
            _draw_panel(axes, panel, scale)
        for axes in grid.flat[len(panels) :]:
            axes.set_axis_off()
        for axes in grid[-1]:
            axes.set_xlabel(time_label, labelpad=3)
        _arrange(figure, height, across)
        return write_svg(figure, name, title, language=language)


def dress(axes: Axes, title: str) -> None:
    """Faint grid, no frame, the quantity's name in bold above."""
    axes.set_title(title, loc="left", fontsize=TEXT_PT, fontweight="bold", pad=5)
    axes.grid(axis="y", color=PALE, linewidth=0.4)
    axes.spines[["top", "right"]].set_visible(False)
    axes.locator_params(axis="y", nbins=5)


def _arrange(figure: Figure, height: float, across: int) -> None:
    figure.subplots_adjust(
        left=0.45 / WIDTH_IN,
        right=1 - 0.08 / WIDTH_IN,
        top=1 - 0.24 / height,
        bottom=0.4 / height,
        wspace=0.22 if across > 1 else 0.0,
        hspace=0.32,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Scale:
    """Time axis that all panels share; ``room`` is for labels, a share of it."""

    low: float
    high: float
    room: float
    across: int
    is_log: bool


def _find_scale(panels: Sequence[Panel], across: int, *, is_log: bool) -> _Scale:
    lines = [line for panel in panels for line in panel.lines if len(line.x)]
    longest = max((len(line.label) for line in lines), default=0)
    return _Scale(
        low=min((min(line.x) for line in lines), default=1.0),
        high=max((max(line.x) for line in lines), default=1.0),
        room=(longest * _LETTER_IN + 0.06) * across / WIDTH_IN,
        across=across,
        is_log=is_log,
    )


def _draw_panel(axes: Axes, panel: Panel, scale: _Scale) -> None:
    dress(axes, panel.title)
    for line in panel.lines:
        shade, dashes = SHADES[line.style % len(SHADES)]
        axes.plot(
            line.x,
            line.y,
            color=ACCENT if line.is_accent else shade,
            linestyle=dashes,
            linewidth=0.5 if line.is_thin or line.has_dots else 1.2,
            marker="o" if line.has_dots else None,
            markersize=2.4,
            zorder=2 if line.is_thin else 3,
        )
    if scale.is_log:
        _set_clock(axes, scale)
    else:
        span = max(scale.high - scale.low, 1e-9)
        axes.set_xlim(scale.low, scale.low + span / (1.0 - scale.room))
    if panel.from_zero:
        axes.set_ylim(bottom=0.0)
    axes.margins(y=0.12)
    for mark in panel.marks:
        _draw_mark(axes, mark)
    _label_ends(axes, panel.lines)


def _set_clock(axes: Axes, scale: _Scale) -> None:
    """Logarithmic time with ticks that a reader can picture, none too close."""
    low, high = scale.low, scale.high
    efolds = math.log(max(high / low, 1.01)) / (1.0 - scale.room)
    axes.set_xscale("log")
    axes.set_xlim(low, low * math.exp(efolds))
    near = _TICK_GAP * scale.across * efolds
    shown: list[tuple[float, str]] = []
    for days, word in _CLOCK:
        is_apart = not shown or math.log(days / shown[-1][0]) >= near
        if low * 0.999 <= days <= high * 1.001 and is_apart:
            shown.append((days, word))
    axes.set_xticks([days for days, _ in shown], [word for _, word in shown])
    axes.minorticks_off()


def _draw_mark(axes: Axes, mark: Mark) -> None:
    axes.axvline(mark.x, color=GREY, linewidth=0.5, linestyle=(0, (1, 2)), zorder=1)
    axes.annotate(
        mark.label,
        (mark.x, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(-2.5, -1.5),
        textcoords="offset points",
        ha="right",
        va="top",
        color=SOFT,
        fontsize=TEXT_PT,
    )


def _label_ends(axes: Axes, lines: Sequence[Line]) -> None:
    """Name each line at its end; names that would overlap are moved apart."""
    named = [line for line in lines if line.label and len(line.x)]
    to_axes = axes.transData + axes.transAxes.inverted()
    ends = [to_axes.transform((line.x[-1], line.y[-1])) for line in named]
    placed = sorted(zip(ends, named, strict=True), key=lambda pair: float(pair[0][0]))
    last = max((float(end[0]) for end in ends), default=1.0)
    while placed:
        first = float(placed[0][0][0])
        group = [pair for pair in placed if pair[0][0] - first < _LABEL_REACH]
        # the longer lines go on above or below the name of one that ends early
        drop = 7.0 if first < last - _LABEL_REACH else 0.0
        _label_group(axes, sorted(group, key=lambda pair: float(pair[0][1])), drop)
        placed = placed[len(group) :]


def _label_group(axes: Axes, group: Sequence[tuple[Any, Line]], drop: float) -> None:
    heights = spread([float(end[1]) for end, _ in group], _LINE_GAP)
    for (end, line), height in zip(group, heights, strict=True):
        shade, _ = SHADES[line.style % len(SHADES)]
        axes.annotate(
            line.label,
            (float(end[0]), height),
            xycoords="axes fraction",
            xytext=(3, -drop),
            textcoords="offset points",
            va="center",
            color=ACCENT if line.is_accent else INK if shade == INK else SOFT,
        )


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
